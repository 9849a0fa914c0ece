// SPDX-License-Identifier: Apache-2.0
// node screenshot.mjs NODE_MODULES PAGE.html OUT.png
import { createRequire } from 'node:module';
import path from 'node:path';

const [, , modules, page, out] = process.argv;
const puppeteer = createRequire(path.join(modules, 'x'))('puppeteer-core');
const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  headless: true, args: ['--no-sandbox', '--disable-dev-shm-usage', '--force-color-profile=srgb'] });
const tab = await browser.newPage();
await tab.setViewport({ width: 980, height: 240 });
await tab.goto('file://' + path.resolve(page));
await tab.screenshot({ path: out, fullPage: true });
await browser.close();
