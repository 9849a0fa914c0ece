// SPDX-License-Identifier: Apache-2.0
// node page.mjs NODE_MODULES PAGE.html [--screenshots FOLDER] < lines
// Opens the page from the disk in headless chromium, on a phone and on a screen, does what a person
// does with it, and answers every line of words as the page calculates it. Prints one JSON document:
// { ready_ms, answers, otherwise, session, candela, refused, saved, thousands, rooms, unsaved,
//   requests, errors }; otherwise: the lines
// that the screen answers with other bytes than the phone.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';

const words = process.argv.slice(2);
const at = words.indexOf('--screenshots');
const folder = at < 0 ? undefined : words.splice(at, 2)[1];
const [modules, page] = words;
const puppeteer = createRequire(path.join(modules, 'x'))('puppeteer-core');
const lines = fs.readFileSync(0, 'utf8').split('\n').filter((line) => line.trim() !== '').map((line) => JSON.parse(line));

const answered = (tab) => tab.evaluate((all) => all.map(({ words: line, files }) => {
  const began = performance.now();
  const { code, out, err } = window.lightcal.run(line, files);
  return { code, out, err, ms: performance.now() - began };
}), lines);

const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  headless: true, args: ['--no-sandbox', '--disable-dev-shm-usage', '--force-color-profile=srgb'] });
const result = { ready_ms: {}, requests: [], errors: [] };
try {
  for (const [name, width, height] of [['phone', 360, 740], ['screen', 1200, 800]]) {
    const tab = await browser.newPage();
    tab.on('request', (request) => {
      if (!/^(data|file|blob):/.test(request.url())) result.requests.push(request.url());
    });
    tab.on('pageerror', (error) => result.errors.push(String(error)));
    tab.on('console', (message) => {
      if (message.type() === 'error') result.errors.push(message.text());
    });
    await tab.setViewport({ width, height, deviceScaleFactor: 2, isMobile: name === 'phone', hasTouch: name === 'phone' });
    await tab.goto('file://' + path.resolve(page));
    await tab.waitForSelector('html[data-ready]', { timeout: 60000 });
    result.ready_ms[name] = Number(await tab.$eval('html', (html) => html.dataset.ready));
    if (folder) {
      await tab.screenshot({ path: path.join(folder, `page-${name}.png`) });
      await tab.screenshot({ path: path.join(folder, `page-${name}-whole.png`), fullPage: true });
    }
    if (name === 'screen') {
      for (const part of ['color', 'exposure', 'ratio', 'lights']) {
        await tab.click(`#tab-${part}`);
        if (folder) await tab.screenshot({ path: path.join(folder, `page-${part}.png`) });
      }
      const here = await answered(tab);
      result.otherwise = lines.filter((_, i) => ['code', 'out', 'err'].some((key) => here[i][key] !== result.answers[i][key]))
        .map((line) => line.words);
      continue;
    }
    // A reading more by hand, as a thumb does it; then nonsense, which is refused in words.
    await tab.tap('#add-reading');
    await tab.type('#readings li:last-child [name=lux]', '12');
    await tab.type('#readings li:last-child [name=metres]', '3');
    await tab.waitForFunction(() => document.querySelectorAll('.bar').length === 4, { timeout: 20000 });
    result.session = await tab.evaluate(() => window.lightcal.sessionText());
    result.candela = Number(await tab.$eval('#candela', (p) => p.dataset.cd));
    await tab.select('#engine', 'json');
    await tab.tap('#save-preset');
    await tab.waitForFunction(() => document.querySelector('#lamp-saved').textContent !== '');
    result.saved = await tab.$eval('#lamp-saved', (p) => p.textContent);
    // What may part thousands is asked back, a decimal comma is none of that.
    const typed = async (field, text) => {
      await tab.$eval(field, (input) => { input.value = ''; });
      await tab.type(field, text);
    };
    const lux = '#readings li:last-child [name=lux]';
    await typed(lux, '1,200');
    await tab.waitForSelector('#lamp-answer .fault', { timeout: 20000 });
    result.thousands = await tab.$eval('#lamp-answer .fault', (p) => p.textContent);
    await typed(lux, '12,5');
    await tab.waitForSelector('#candela', { timeout: 20000 });
    // A room as it was measured.
    await tab.select('#room', 'size');
    await tab.waitForSelector('#size', { visible: true });
    result.rooms = {};
    for (const room of ['5m,4.4m,2.8m', '16ft,13ft,8ft', '5, 4, 2.6, 0.7']) {
      await typed('#size', room);
      result.rooms[room] = await tab.evaluate(() => window.lightcal.sessionText());
    }
    await typed('#name', 'a/b');
    await tab.$eval('#save-session', (button) => button.click());
    await tab.waitForFunction(() => document.querySelector('#lamp-saved').textContent.startsWith('Not saved'));
    result.unsaved = await tab.$eval('#lamp-saved', (p) => p.textContent);
    await typed('#name', 'key');
    await tab.select('#room', '');
    await tab.waitForSelector('#candela', { timeout: 20000 });  // the name's fault has gone
    await tab.type('#readings li:last-child [name=metres]', 'x');
    await tab.waitForSelector('#lamp-answer .fault', { timeout: 20000 });
    result.refused = await tab.$eval('#lamp-answer .fault', (p) => p.textContent);
    if (folder) await tab.screenshot({ path: path.join(folder, 'page-refused.png') });
    result.answers = await answered(tab);
  }
} finally {
  await browser.close();
}
process.stdout.write(JSON.stringify(result));
