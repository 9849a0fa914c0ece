// SPDX-License-Identifier: Apache-2.0
// Node's files for wasi.js. Paths come as "/tmp/a" and, on Windows, as "/C:/lamps/a".
import fs from 'node:fs';
import { errno } from './wasi.js';

const codes = {
  EACCES: errno.access, EPERM: errno.denied, EEXIST: errno.exists, EISDIR: errno.isFolder,
  ENOENT: errno.absent, ENOTDIR: errno.notFolder, ENOTEMPTY: errno.notEmpty,
  ENOSPC: errno.noSpace, EROFS: errno.readOnly, EINVAL: errno.invalid,
};

function tried(work) {
  try {
    return work();
  } catch (error) {
    throw { wasi: codes[error.code] ?? errno.io };
  }
}

// "/C:/lamps/a" is "C:/lamps/a", which Windows takes.
export function ofHost(path) {
  const drive = /^\/([A-Za-z]:)(\/.*)?$/.exec(path);
  return drive ? drive[1] + (drive[2] ?? '/') : path;
}

// A word of the command line as lightcal reads it: on Windows "C:\lamps\hall" is "C:/lamps/hall".
export function ofWord(word, windows = process.platform === 'win32') {
  if (!windows || !word.includes('\\')) return word;
  return word.replaceAll('\\', '/');
}

// The working directory, as lightcal names it: "C:\lamps" is "/C:/lamps".
export function ofFolder(folder, windows = process.platform === 'win32') {
  const parted = ofWord(folder, windows);
  return parted.startsWith('/') ? parted : '/' + parted;
}

export class NodeFiles {
  kind(path) {
    try {
      return fs.statSync(ofHost(path)).isDirectory() ? 'folder' : 'file';
    } catch (error) {  // nothing there, or what it would lie in is a file
      if (['ENOENT', 'ENOTDIR'].includes(error.code)) return undefined;
      throw { wasi: codes[error.code] ?? errno.io };
    }
  }
  link(path) {
    let said;
    try {
      said = fs.readlinkSync(ofHost(path));
    } catch {  // no link, or nothing
      return undefined;
    }
    return /^[A-Za-z]:/.test(said) ? ofFolder(said, true) : ofWord(said);
  }
  real(path) {
    try {
      return ofFolder(fs.realpathSync(ofHost(path)));
    } catch {
      return path;
    }
  }
  size(path) { return tried(() => fs.statSync(ofHost(path)).size); }
  read(path) { return tried(() => new Uint8Array(fs.readFileSync(ofHost(path)))); }
  write(path, bytes) { tried(() => fs.writeFileSync(ofHost(path), bytes)); }
  list(path) { return tried(() => fs.readdirSync(ofHost(path)).sort()); }
  makeFolder(path) { tried(() => fs.mkdirSync(ofHost(path))); }
  remove(path) { tried(() => fs.unlinkSync(ofHost(path))); }
  removeFolder(path) { tried(() => fs.rmdirSync(ofHost(path))); }
  rename(from, to) { tried(() => fs.renameSync(ofHost(from), ofHost(to))); }
}
