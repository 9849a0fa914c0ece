// SPDX-License-Identifier: Apache-2.0
// node gate.mjs NODE_MODULES PAGE.html...
// Opens report pages in headless chromium, light and dark, on a phone, a screen and paper, and says
// what is wrong with them: serious faults by axe-core, elements that leave the viewport, texts of one
// drawing that lie on another, clipped labels, requests, errors. Exits 1 where there is any. With
// --fault it puts one fault of each kind into every page first and exits 1 unless all are found.
// With --screenshots FOLDER it writes what it saw.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';

const words = process.argv.slice(2);
const option = (name) => {
  const at = words.indexOf(name);
  return at < 0 ? undefined : words.splice(at, 2)[1];
};
const folder = option('--screenshots');
const withFaults = words.includes('--fault');
const [modules, ...pages] = words.filter((word) => word !== '--fault');
const require = createRequire(path.join(modules, 'x'));
const puppeteer = require('puppeteer-core');
const axe = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

const wide = { width: 1200, height: 900, deviceScaleFactor: 1 };
const narrow = { width: 360, height: 740, deviceScaleFactor: 2 };

// In the page. Texts are compared by what they cover; a halo belongs to its own text.
function lookAround() {
  const faults = [];
  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width) {
    faults.push(`the page is ${document.documentElement.scrollWidth} px wide, the view ${width}`);
  }
  const name = (element) => `${element.tagName.toLowerCase()}.${element.getAttribute('class') ?? ''}` +
    ` "${(element.textContent ?? '').trim().slice(0, 30)}"`;
  const seen = (box) => box.width > 0 && box.height > 0;
  for (const element of document.body.querySelectorAll('*')) {
    if (element.closest('.scroll')) continue;
    const box = element.getBoundingClientRect();
    const clipped = element.closest('svg') && element.tagName !== 'svg' && element.tagName !== 'text';
    if (clipped || !seen(box)) continue;
    if (box.right > width + 0.5 || box.left < -0.5) faults.push(`${name(element)} leaves the view`);
  }
  for (const svg of document.querySelectorAll('svg')) {
    const frame = svg.getBoundingClientRect();
    const texts = [...svg.querySelectorAll('text')].map((text) => [text, text.getBoundingClientRect()])
      .filter(([, box]) => seen(box));
    texts.forEach(([text, a], i) => {
      if (a.left < frame.left - 0.5 || a.right > frame.right + 0.5 || a.top < frame.top - 0.5 ||
          a.bottom > frame.bottom + 0.5) {
        faults.push(`${svg.id}: ${name(text)} is clipped`);
      }
      for (const [other, b] of texts.slice(i + 1)) {
        // The boxes hold room above and below the letters: a sixth of their height may overlap.
        const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const up = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (across > 0.5 && up > Math.min(a.height, b.height) / 6) {
          faults.push(`${svg.id}: ${name(text)} lies on ${name(other)}`);
        }
      }
    });
  }
  return faults;
}

// One fault of each kind, which the checks must find.
function spoil() {
  document.body.insertAdjacentHTML('beforeend', '<img id="no-name" src="data:image/gif;base64,R0lGODlhAQABAAAAACw="/>' +
    '<p style="width:2000px">wide</p><p style="color:#bbb;background:#ccc">pale</p>');
  const svg = document.querySelector('figure svg');
  const text = svg.querySelector('text');
  svg.append(text.cloneNode(true));
  const outside = text.cloneNode(true);
  outside.setAttribute('x', '-20');
  svg.append(outside);
  new Image().src = 'http://127.0.0.1:9/spy.png';
}
const spoiled = ['image-alt', 'color-contrast', 'leaves the view', 'lies on', 'is clipped', 'asks for'];

async function axeFaults(tab) {
  const { violations } = await tab.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return violations.filter((v) => v.impact === 'serious' || v.impact === 'critical')
    .map((v) => `${v.impact}: ${v.id}, ${v.nodes.length} times, first ${v.nodes[0].html.slice(0, 120)}`);
}

const wear = (tab, scheme) => tab.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);

// Colours do not depend on the width, nor places on the colours: axe looks at light and dark, the
// eye for places at wide and narrow.
async function look(tab, stem) {
  const faults = [];
  const note = (where, found) => faults.push(...found.map((fault) => `${stem}, ${where}: ${fault}`));
  const shoot = async (name) => {
    if (folder) await tab.screenshot({ path: path.join(folder, `${stem}-${name}.png`), fullPage: true });
  };
  for (const scheme of withFaults ? ['light'] : ['light', 'dark']) {
    await wear(tab, scheme);
    note(scheme, await axeFaults(tab));
    await shoot(scheme);
  }
  note('1200 px', await tab.evaluate(lookAround));
  await tab.setViewport(narrow);
  note('360 px', await tab.evaluate(lookAround));
  await shoot('phone-dark');
  await wear(tab, 'light');
  await shoot('phone');
  if (folder) await tab.pdf({ path: path.join(folder, `${stem}.pdf`), preferCSSPageSize: true });
  return faults;
}

async function open(browser, page) {
  const tab = await browser.newPage();
  const stem = path.basename(page, '.html');
  const faults = [];
  tab.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith('data:') && !url.startsWith('file:')) faults.push(`${stem}: asks for ${url}`);
  });
  tab.on('pageerror', (error) => faults.push(`${stem}: ${error}`));
  await tab.setViewport(wide);
  await tab.goto('file://' + path.resolve(page));
  if (withFaults) await tab.evaluate(spoil);
  await tab.evaluate(axe);
  const found = await look(tab, stem);
  await tab.close();
  return [...faults, ...found];
}

const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  headless: true, args: ['--no-sandbox', '--disable-dev-shm-usage', '--force-color-profile=srgb'] });
const faults = [];
try {
  for (const page of pages) faults.push(...await open(browser, page));
} finally {
  await browser.close();
}
if (withFaults) {
  const missed = spoiled.filter((word) => !faults.some((fault) => fault.includes(word)));
  for (const word of missed) console.error(`not found: ${word}`);
  process.exit(missed.length > 0 ? 1 : 0);
}
for (const fault of faults) console.error(fault);
process.exit(faults.length > 0 ? 1 : 0);
