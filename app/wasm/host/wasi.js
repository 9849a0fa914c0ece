// SPDX-License-Identifier: Apache-2.0
// The host of lightcal.wasm: what WASI preview 1 asks of one, over any file system `files` of
//   kind(path)          "file", "folder" or undefined
//   read(path)          its bytes;  write(path, bytes), list(path), makeFolder(path)
//   remove(path), removeFolder(path), rename(from, to)
//   link(path)          what a symbolic link there says, undefined where none is; absent: there are none
//   real(path)          the path without links, of what is there
// that throws { wasi: errno } where it cannot. Paths are absolute, parted by "/".
// Source: WASI snapshot preview 1 (the witx files of the WASI repository).

export const errno = {
  access: 2, badDescriptor: 8, exists: 20, invalid: 28, io: 29, isFolder: 31, loop: 32, absent: 44,
  noSpace: 51, unsupported: 52, notFolder: 54, notEmpty: 55, denied: 63, readOnly: 69,
};

const kFolder = 3, kFile = 4, kCharacter = 2, kLink = 7;
const kFollow = 1;
const kCreate = 1, kFolderOnly = 2, kExclusive = 4, kTruncate = 8;
const kWriteRight = 1n << 6n;
const kAppend = 1;

class Exit { constructor(code) { this.code = code; } }

function normal(path) {
  const kept = [];
  for (const part of path.split('/')) {
    if (part === '..') kept.pop();
    else if (part !== '' && part !== '.') kept.push(part);
  }
  return '/' + kept.join('/');
}

function inode(path) {  // the same file, the same number
  let hash = 0xcbf29ce484222325n;
  for (const byte of new TextEncoder().encode(path)) {
    hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
  }
  return hash;
}

class Host {
  constructor(words, { files, here, environment, input, seconds }) {
    Object.assign(this, { words, files, here, input, seconds });
    this.environment = Object.entries({ PWD: here, ...environment }).map(([k, v]) => `${k}=${v}`);
    this.out = { 1: [], 2: [] };
    this.open = new Map([
      [0, { stream: 0, at: 0 }], [1, { stream: 1 }], [2, { stream: 2 }],
      [3, { folder: '/', root: '/' }],
    ]);
    this.next = 4;
  }
  get view() { return new DataView(this.memory.buffer); }
  bytes(at, size) { return new Uint8Array(this.memory.buffer, at, size); }
  text(at, size) { return new TextDecoder().decode(this.bytes(at, size).slice()); }
  descriptor(fd) {
    const found = this.open.get(fd);
    if (!found) throw { wasi: errno.badDescriptor };
    return found;
  }
  path(fd, at, size) {
    const { folder } = this.descriptor(fd);
    if (folder === undefined) throw { wasi: errno.notFolder };
    return normal(folder + '/' + this.text(at, size));
  }
  strings(list, pointers, buffer) {
    for (const word of list) {
      const bytes = new TextEncoder().encode(word + '\0');
      this.view.setUint32(pointers, buffer, true);
      this.bytes(buffer, bytes.length).set(bytes);
      pointers += 4;
      buffer += bytes.length;
    }
  }
  sizes(list, count, size) {
    this.view.setUint32(count, list.length, true);
    const total = list.reduce((sum, word) => sum + new TextEncoder().encode(word).length + 1, 0);
    this.view.setUint32(size, total, true);
  }
  stat(at, kind, path, size) {
    this.bytes(at, 64).fill(0);
    this.view.setBigUint64(at, 1n, true);
    this.view.setBigUint64(at + 8, inode(kind === kLink ? path : this.files.real?.(path) ?? path), true);
    this.view.setUint8(at + 16, kind);
    this.view.setBigUint64(at + 24, 1n, true);
    this.view.setBigUint64(at + 32, BigInt(size), true);
  }
  link(path) { return this.files.link?.(path); }
  flush(file) {
    if (!file.changed) return;
    this.files.write(file.path, file.bytes.slice(0, file.size));
    file.changed = false;
  }
  grow(file, size) {
    if (size > file.bytes.length) {
      const wider = new Uint8Array(Math.max(size, 2 * file.bytes.length, 4096));
      wider.set(file.bytes);
      file.bytes = wider;
    }
    if (size < file.size) file.bytes.fill(0, size, file.size);
  }
  each(at, count, take) {  // over an iovec
    let done = 0;
    for (let i = 0; i < count; ++i) {
      const to = this.view.getUint32(at + 8 * i, true), size = this.view.getUint32(at + 8 * i + 4, true);
      const n = take(this.bytes(to, size));
      done += n;
      if (n < size) break;
    }
    return done;
  }
  readAt(file, place, vectors, count) {
    return this.each(vectors, count, (to) => {
      const part = file.bytes.subarray(place, Math.min(place + to.length, file.size));
      to.set(part);
      place += part.length;
      return part.length;
    });
  }

  calls() {
    const nothing = () => 0;
    const unsupported = () => errno.unsupported;
    const host = this;
    const all = {
      args_get(pointers, buffer) { host.strings(host.words, pointers, buffer); },
      args_sizes_get(count, size) { host.sizes(host.words, count, size); },
      environ_get(pointers, buffer) { host.strings(host.environment, pointers, buffer); },
      environ_sizes_get(count, size) { host.sizes(host.environment, count, size); },
      clock_res_get(_, at) { host.view.setBigUint64(at, 1000000n, true); },
      clock_time_get(clock, _, at) {
        const now = clock === 0 ? Date.now() : host.seconds() * 1000;
        host.view.setBigUint64(at, BigInt(Math.round(now * 1e6)), true);
      },
      random_get(at, size) {
        const part = new Uint8Array(Math.min(size, 65536));
        globalThis.crypto.getRandomValues(part);
        host.bytes(at, part.length).set(part);
      },
      proc_exit(code) { throw new Exit(code); },
      sched_yield: nothing, fd_advise: nothing, fd_allocate: unsupported,
      fd_fdstat_set_flags: nothing, fd_fdstat_set_rights: nothing,
      fd_filestat_set_times: nothing, path_filestat_set_times: nothing,
      path_link: unsupported, path_symlink: unsupported, poll_oneoff: unsupported,
      sock_accept: unsupported, sock_recv: unsupported, sock_send: unsupported,
      sock_shutdown: unsupported, proc_raise: unsupported, fd_renumber: unsupported,
      fd_prestat_get(fd, at) {
        const { root } = host.descriptor(fd);
        if (root === undefined) return errno.badDescriptor;
        host.view.setUint32(at, 0, true);
        host.view.setUint32(at + 4, root.length, true);
      },
      fd_prestat_dir_name(fd, at) {
        const { root } = host.descriptor(fd);
        host.bytes(at, root.length).set(new TextEncoder().encode(root));
      },
      fd_fdstat_get(fd, at) {
        const d = host.descriptor(fd);
        host.bytes(at, 24).fill(0);
        host.view.setUint8(at, d.folder !== undefined ? kFolder : d.stream !== undefined ? kCharacter : kFile);
        host.view.setUint16(at + 2, d.append ? kAppend : 0, true);
        const every = 0x1fffffffn, tty = every & ~(1n << 2n) & ~(1n << 5n);
        host.view.setBigUint64(at + 8, d.stream !== undefined ? tty : every, true);
        host.view.setBigUint64(at + 16, every, true);
      },
      fd_filestat_get(fd, at) {
        const d = host.descriptor(fd);
        if (d.folder !== undefined) host.stat(at, kFolder, d.folder, 0);
        else if (d.stream !== undefined) host.stat(at, kCharacter, `:${d.stream}`, 0);
        else host.stat(at, kFile, d.path, d.size);
      },
      fd_filestat_set_size(fd, size) {
        const file = host.descriptor(fd);
        if (file.bytes === undefined) return errno.invalid;
        host.grow(file, Number(size));
        file.size = Number(size);
        file.changed = true;
      },
      path_filestat_get(fd, how, at, size, to) {
        const path = host.path(fd, at, size), kind = host.files.kind(path);
        if (!(how & kFollow) && host.link(path) !== undefined) {
          host.stat(to, kLink, path, 0);
          return 0;
        }
        if (!kind) return errno.absent;
        host.stat(to, kind === 'folder' ? kFolder : kFile, path,
          kind === 'file' ? host.files.size(path) : 0);
      },
      path_open(fd, follow, at, size, how, rights, __, flags, to) {
        const path = host.path(fd, at, size), kind = host.files.kind(path);
        const linked = host.link(path) !== undefined;
        if ((kind || linked) && (how & kExclusive)) return errno.exists;
        if (linked && !(follow & kFollow)) return errno.loop;
        if (!kind && !(how & kCreate)) return errno.absent;
        if (kind !== 'folder' && (how & kFolderOnly)) return errno.notFolder;
        const writes = (rights & kWriteRight) !== 0n;
        let made;
        if (kind === 'folder') {
          if (writes && (how & (kCreate | kTruncate))) return errno.isFolder;
          made = { folder: path };
        } else {
          const fresh = !kind || (how & kTruncate) !== 0;
          const bytes = fresh ? new Uint8Array(0) : host.files.read(path);
          made = { path, bytes, size: bytes.length, at: 0, append: (flags & kAppend) !== 0, changed: fresh };
          if (!kind) host.flush(made);
        }
        host.open.set(host.next, made);
        host.view.setUint32(to, host.next++, true);
      },
      fd_close(fd) {
        const d = host.descriptor(fd);
        host.open.delete(fd);
        if (d.bytes !== undefined) host.flush(d);
      },
      fd_sync(fd) {
        const d = host.descriptor(fd);
        if (d.bytes !== undefined) host.flush(d);
      },
      fd_read(fd, vectors, count, to) {
        const d = host.descriptor(fd);
        if (d.folder !== undefined) return errno.isFolder;
        if (d.stream !== undefined) {
          if (d.stream !== 0) return errno.badDescriptor;
          if (d.bytes === undefined) {
            d.bytes = host.input ? host.input() : new Uint8Array(0);
            d.size = d.bytes.length;
          }
        }
        const n = host.readAt(d, d.at, vectors, count);
        d.at += n;
        host.view.setUint32(to, n, true);
      },
      fd_pread(fd, vectors, count, place, to) {
        host.view.setUint32(to, host.readAt(host.descriptor(fd), Number(place), vectors, count), true);
      },
      fd_write(fd, vectors, count, to) {
        const d = host.descriptor(fd);
        if (d.folder !== undefined) return errno.isFolder;
        const n = host.each(vectors, count, (part) => {
          if (d.stream !== undefined) {
            host.out[d.stream].push(part.slice());
          } else {
            if (d.append) d.at = d.size;
            host.grow(d, Math.max(d.size, d.at + part.length));
            d.bytes.set(part, d.at);
            d.at += part.length;
            d.size = Math.max(d.size, d.at);
            d.changed = true;
          }
          return part.length;
        });
        host.view.setUint32(to, n, true);
      },
      fd_seek(fd, by, from, to) {
        const d = host.descriptor(fd);
        if (d.bytes === undefined || d.stream !== undefined) return errno.invalid;
        const base = from === 0 ? 0 : from === 1 ? d.at : d.size;
        d.at = base + Number(by);
        host.view.setBigUint64(to, BigInt(d.at), true);
      },
      fd_tell(fd, to) { host.view.setBigUint64(to, BigInt(host.descriptor(fd).at ?? 0), true); },
      fd_readdir(fd, at, size, cookie, to) {
        const d = host.descriptor(fd);
        if (d.folder === undefined) return errno.notFolder;
        d.names ??= ['.', '..', ...host.files.list(d.folder)];
        let used = 0;
        for (let i = Number(cookie); i < d.names.length && used < size; ++i) {
          const name = new TextEncoder().encode(d.names[i]);
          const entry = new Uint8Array(24 + name.length), view = new DataView(entry.buffer);
          const path = normal(d.folder + '/' + d.names[i]);
          view.setBigUint64(0, BigInt(i + 1), true);
          view.setBigUint64(8, inode(path), true);
          view.setUint32(16, name.length, true);
          view.setUint8(20, host.link(path) !== undefined ? kLink
            : host.files.kind(path) === 'folder' ? kFolder : kFile);
          entry.set(name, 24);
          const part = entry.subarray(0, size - used);
          host.bytes(at + used, part.length).set(part);
          used += part.length;
        }
        host.view.setUint32(to, used, true);
      },
      path_create_directory(fd, at, size) {
        const path = host.path(fd, at, size);
        if (host.files.kind(path)) return errno.exists;
        host.files.makeFolder(path);
      },
      path_readlink(fd, at, size, to, room, used) {
        const said = host.link(host.path(fd, at, size));
        if (said === undefined) return errno.invalid;
        const bytes = new TextEncoder().encode(said).subarray(0, room);
        host.bytes(to, bytes.length).set(bytes);
        host.view.setUint32(used, bytes.length, true);
      },
      path_remove_directory(fd, at, size) { host.files.removeFolder(host.path(fd, at, size)); },
      path_unlink_file(fd, at, size) {
        const path = host.path(fd, at, size);
        const kind = host.link(path) !== undefined ? 'file' : host.files.kind(path);
        if (kind !== 'file') return kind ? errno.isFolder : errno.absent;
        host.files.remove(path);
      },
      path_rename(from, at, size, to, toAt, toSize) {
        host.files.rename(host.path(from, at, size), host.path(to, toAt, toSize));
      },
    };
    all.fd_datasync = all.fd_sync;
    for (const [name, call] of Object.entries(all)) {
      all[name] = (...given) => {
        try {
          return call(...given) ?? 0;
        } catch (error) {
          if (error?.wasi !== undefined) return error.wasi;
          throw error;
        }
      };
    }
    return all;
  }
}

function joined(parts) {
  const whole = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return new TextDecoder().decode(whole);
}

// One command line; answers { code, out, err }. `module` is lightcal.wasm, compiled.
export function runCommand(module, words, { files, here = '/', environment = {}, input } = {}) {
  const began = globalThis.performance.now();
  const seconds = () => (globalThis.performance.now() - began) / 1000;
  const host = new Host(['lightcal', ...words], { files, here, environment, input, seconds });
  const calls = host.calls();
  const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: calls });
  host.memory = instance.exports.memory;
  let code = 0;
  try {
    instance.exports._start();
  } catch (error) {
    if (error instanceof Exit) {
      code = error.code;
    } else {
      code = 1;
      host.out[2].push(new TextEncoder().encode(`lightcal: internal error: ${error.message ?? error}\n`));
    }
  }
  return { code, out: joined(host.out[1]), err: joined(host.out[2]) };
}
