// SPDX-License-Identifier: Apache-2.0
// node browse.mjs NODE_MODULES WORK JOBS.json OUT.json
// Headless chromium with a software GPU; every job runs in its engine's page. A job: {engine, module
// (path under WORK), probes, rig?, png?, exr?, edit?}; png and exr are paths to write.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { createRequire } from 'node:module';

const [, , modules, work, jobsPath, outPath] = process.argv;
const here = path.dirname(new URL(import.meta.url).pathname);
const puppeteer = createRequire(path.join(modules, 'x'))('puppeteer-core');
const roots = { m: path.join(modules, 'node_modules'), w: work, h: here };
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript',
  '.wasm': 'application/wasm', '.json': 'application/json' };

const server = http.createServer((request, response) => {
  const [, root, ...rest] = decodeURI(request.url.split('?')[0]).split('/');
  const file = roots[root] && path.join(roots[root], ...rest);
  if (!file || !file.startsWith(roots[root]) || !fs.existsSync(file)) {
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, { 'content-type': types[path.extname(file)] ?? 'application/octet-stream' });
  fs.createReadStream(file).pipe(response);
}).listen(0, '127.0.0.1');
await new Promise((done) => server.once('listening', done));
const base = `http://127.0.0.1:${server.address().port}`;

const jobs = JSON.parse(fs.readFileSync(jobsPath));
const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true,
  protocolTimeout: 240000, args: ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--no-sandbox', '--disable-dev-shm-usage', '--force-color-profile=srgb'] });
const results = [];
const errors = [];
try {
  let page, pageEngine, used = 0;
  for (const job of jobs) {
    if (job.engine !== pageEngine || ++used > 24) {
      await page?.close();
      page = await browser.newPage();
      used = 0;
      pageEngine = job.engine;
      page.on('pageerror', (e) => errors.push(String(e)));
      page.on('console', (m) => (m.type() === 'error' ? errors.push(m.text()) : null));
      await page.goto(`${base}/h/page.html`);
      await page.waitForFunction('window.ready');
    }
    const { png, exr, ...rest } = job;
    const result = await page.evaluate((engine, j) => window.run(engine, j).catch((e) => ({ error: `${e}\n${e.stack}` })),
      job.engine, { ...rest, rig: !!png || !!exr, exr: !!exr, module: `/w/${job.module}` });
    if (png && result.png) fs.writeFileSync(png, Buffer.from(result.png.split(',')[1], 'base64'));
    if (exr && result.exr) fs.writeFileSync(exr, Buffer.from(result.exr, 'base64'));
    delete result.png;
    delete result.exr;
    results.push(result);
  }
} finally {
  await browser.close();
  server.close();
}
fs.writeFileSync(outPath, JSON.stringify({ results, errors }));
