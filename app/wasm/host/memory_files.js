// SPDX-License-Identifier: Apache-2.0
// A file system in memory: { "/lamp/session.toml": "text or bytes" }.
import { errno } from './wasi.js';

export class MemoryFiles {
  constructor(contents = {}) {
    this.contents = new Map();
    this.folders = new Set(['/']);
    for (const [path, what] of Object.entries(contents)) {
      const parts = path.split('/');
      for (let i = 2; i < parts.length; ++i) this.folders.add(parts.slice(0, i).join('/'));
      this.contents.set(path, typeof what === 'string' ? new TextEncoder().encode(what) : what);
    }
  }
  kind(path) {
    if (this.contents.has(path)) return 'file';
    return this.folders.has(path) ? 'folder' : undefined;
  }
  size(path) { return this.read(path).length; }
  read(path) { return this.contents.get(path); }
  text(path) { return new TextDecoder().decode(this.read(path)); }
  write(path, bytes) { this.contents.set(path, bytes); }
  list(path) {
    const inside = path === '/' ? '/' : path + '/';
    const names = [...this.contents.keys(), ...this.folders]
      .filter((one) => one.startsWith(inside) && one.length > inside.length)
      .map((one) => one.slice(inside.length))
      .filter((name) => !name.includes('/'));
    return names.sort();
  }
  makeFolder(path) {
    const parent = path.slice(0, path.lastIndexOf('/')) || '/';
    if (!this.folders.has(parent)) throw { wasi: errno.absent };
    this.folders.add(path);
  }
  remove(path) { this.contents.delete(path); }
  removeFolder(path) {
    if (this.list(path).length > 0) throw { wasi: errno.notEmpty };
    this.folders.delete(path);
  }
  rename(from, to) {
    const bytes = this.contents.get(from);
    if (bytes === undefined) throw { wasi: errno.absent };
    this.contents.set(to, bytes);
    this.contents.delete(from);
  }
}
