// SPDX-License-Identifier: Apache-2.0
// node paths.mjs PACKAGE: words and folders of Windows, as text.
import assert from 'node:assert/strict';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const file = path.resolve(process.argv[2], 'node_files.js');
const { ofFolder, ofHost, ofWord } = await import(pathToFileURL(file));

for (const [word, read] of [
  ['C:\\lamps\\hall', 'C:/lamps/hall'], ['lamps\\hall', 'lamps/hall'], ['.\\hall\\out\\light.json', './hall/out/light.json'],
  ['C:/lamps/hall', 'C:/lamps/hall'],
  ['203lx@0.5m', '203lx@0.5m'], ['--fixture', '--fixture'],
]) {
  assert.equal(ofWord(word, true), read);
  assert.equal(ofWord(word, false), word);  // elsewhere a backslash is a letter of a name
}
assert.equal(ofFolder('C:\\Users\\me', true), '/C:/Users/me');
assert.equal(ofFolder('/home/me', false), '/home/me');
assert.equal(ofHost('/C:/Users/me/hall'), 'C:/Users/me/hall');
assert.equal(ofHost('/C:'), 'C:/');
assert.equal(ofHost('/home/me'), '/home/me');
