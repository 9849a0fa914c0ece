// SPDX-License-Identifier: Apache-2.0
// node answers.mjs PACKAGE < lines: one command's words a line, as JSON; its answer a line.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const { command } = await import(pathToFileURL(path.resolve(process.argv[2], 'index.js')));
for (const line of fs.readFileSync(0, 'utf8').split('\n')) {
  if (line.trim() === '') continue;
  const { words, files } = JSON.parse(line);
  process.stdout.write(JSON.stringify(command(words, files && { files })) + '\n');
}
