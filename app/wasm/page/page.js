// SPDX-License-Identifier: Apache-2.0
// The page: words in, the command's own words out. No number is made here.
import { runCommand } from './wasi.js';
import { MemoryFiles } from './memory_files.js';

const byId = (id) => document.getElementById(id);
const make = (tag, text = '', attributes = {}) => {
  const element = document.createElement(tag);
  element.textContent = text;
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
};

// Z85 (ZeroMQ RFC 32): five letters are four bytes.
function bytesFromZ85(text, count) {
  const letters =
    '0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?&<>()[]{}@%$#';
  const digit = new Uint8Array(128);
  for (let i = 0; i < letters.length; i += 1) digit[letters.charCodeAt(i)] = i;
  const words = new DataView(new ArrayBuffer((text.length / 5) * 4));
  for (let at = 0; at < text.length; at += 5) {
    let word = 0;
    for (let i = 0; i < 5; i += 1) word = word * 85 + digit[text.charCodeAt(at + i)];
    words.setUint32((at / 5) * 4, word);
  }
  return new Uint8Array(words.buffer, 0, count);
}

async function loadModule() {
  const kept = byId('wasm');
  const packed = bytesFromZ85(kept.textContent.trim(), Number(kept.dataset.bytes));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

let module;
const lightcal = (words, files = new MemoryFiles()) => runCommand(module, words, { files });

// { value: the JSON document } or { error }
function asked(words, files) {
  const answer = lightcal([...words, '--json'], files);
  try {
    const value = JSON.parse(answer.out);
    return value.error ? { error: value.error } : { value };
  } catch {
    return { error: { message: answer.err || `it ended with ${answer.code}` } };
  }
}
function said(words, files) { return lightcal([...words, '--quiet'], files).out; }

// "type in           Blender ..." and its lines below: [head line, [[label, text], ...]]
function labelled(text) {
  const lines = text.split('\n').filter((line) => line.trim() !== '');
  const rows = [];
  for (const line of lines) {
    const parts = /^(\S.*?)\s{2,}(\S.*)$/.exec(line);
    if (parts) rows.push([parts[1], parts[2]]);
    else if (rows.length > 0) rows.at(-1)[1] += '\n' + line.trim();
    else rows.push(['', line]);
  }
  return rows;
}
function showRows(target, rows) {
  const list = make('dl');
  for (const [label, text] of rows) list.append(make('dt', label), make('dd', text));
  target.append(list);
}
function showFault(target, error) {
  const text = [error.subject, error.message].filter(Boolean).join(': ');
  target.replaceChildren(make('p', text, { class: 'fault' }));
}
function showTable(target, text) {  // the command's own table: quantity, value, unit
  const rows = text.split('\n').filter((line) => line.trim() !== '').slice(1);
  showRows(target, rows.map((line) => /^(.*?)\s{2,}(?=[-+.\d])(.*)$/.exec(line)?.slice(1) ?? labelled(line)[0]));
}
function save(name, text, type = 'text/plain') {
  const link = make('a', '', { download: name, href: URL.createObjectURL(new Blob([text], { type })) });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// ---- the lamp ----

const decimal = (text) => text.trim().replace(',', '.');
// A comma that may part thousands (1,200) stays: the command says how either is typed.
const number = (text) => (/^[1-9]\d{0,2}(,\d{3})+(\.|$)/.test(text.trim()) ? text.trim() : decimal(text));

function addReading(lux = '', metres = '', card = '') {
  const row = make('li');
  const index = byId('readings').children.length + 1;
  const field = (label, value, name) => {
    const wrap = make('label', label);
    wrap.append(make('input', '', { value, name, inputmode: 'decimal', autocomplete: 'off' }));
    return wrap;
  };
  const away = make('button', '×', { type: 'button', 'aria-label': `Take reading ${index} away` });
  away.addEventListener('click', () => {
    if (byId('readings').children.length > 1) row.remove();
    answerLamp();
  });
  row.append(field('Lux', lux, 'lux'), field('at, m', metres, 'metres'), field('card, lx', card, 'card'), away);
  byId('readings').append(row);
  return row;
}
function readings() {
  return [...byId('readings').children].map((row) => {
    const typed = (name) => row.querySelector(`[name=${name}]`).value;
    return { lux: number(typed('lux')), metres: decimal(typed('metres')), card: number(typed('card')) };
  }).filter((one) => one.lux !== '' && one.metres !== '');
}
const wordOf = ({ lux, metres, card }) => `${lux}lx@${metres}m` + (card === '' ? '' : `,card=${card}lx`);

function roomWord() {
  const where = byId('room').value;
  return where === 'size' ? byId('size').value.replaceAll(' ', '') : where;
}
function lampWords(some) {
  const words = ['quick', ...some.map(wordOf)];
  const option = (name, value) => { if (value !== '') words.push(name, value); };
  option('--fixture', byId('fixture').value);
  const cct = number(byId('cct').value);
  option('--cct', cct === '' ? '' : cct + 'K');
  option('--meter', byId('meter').value);
  option('--room', roomWord());
  option('--name', byId('name').value.trim());
  return words;
}
const interval = (cd) => ({ low: cd.low95 ?? cd.value - cd.u95, high: cd.high95 ?? cd.value + cd.u95 });
const short = (x) => (x >= 1000 ? Math.round(x).toString() : Number(x.toPrecision(3)).toString());

// `last`: what all of them together say.
function showGrowth(all, last) {
  const steps = [];
  for (let n = 1; n <= all.length; ++n) {
    const value = n === all.length ? last : asked(lampWords(all.slice(0, n))).value;
    if (value) steps.push({ n, cd: value.lights[0].intensity_cd });
  }
  byId('growth').hidden = steps.length < 2;
  if (steps.length < 2) return;
  const ends = steps.map((s) => interval(s.cd));
  const low = Math.max(1e-9, Math.min(...ends.map((e) => e.low)) * 0.95), high = Math.max(...ends.map((e) => e.high)) * 1.05;
  const at = (cd) => 100 * Math.log(Math.max(cd, low) / low) / Math.log(high / low);
  byId('bars').replaceChildren(...steps.map(({ n, cd }, i) => {
    const { low: a, high: b } = ends[i];
    const bar = make('div', '', { class: 'bar' }), track = make('div', '', { class: 'track' });
    const band = make('i'), mark = make('b');
    band.style.left = at(a) + '%';
    band.style.width = (at(b) - at(a)) + '%';
    mark.style.left = at(cd.value) + '%';
    track.append(band, mark);
    bar.append(make('span', `${n}.`), track, make('span', `${short(a)} … ${short(b)}`));
    return bar;
  }));
}

function answerLamp() {
  const all = readings(), target = byId('lamp-answer');
  byId('size-field').hidden = byId('room').value !== 'size';
  byId('lamp-files').hidden = true;
  byId('growth').hidden = true;
  if (all.length === 0) {
    target.replaceChildren(make('p', 'One reading answers: lux, and the distance from lamp to meter.', { class: 'soft' }));
    return;
  }
  const words = lampWords(all), { value, error } = asked(words);
  if (error) return showFault(target, error);
  const cd = value.lights[0].intensity_cd;
  const [head, ...rows] = labelled(said(words));
  const parts = (head[0] + '   ' + head[1]).split(/\s{2,}/);
  const big = make('p', parts[1].replace(/ cd$/, ' '), { class: 'big', id: 'candela', 'data-cd': cd.value });
  big.append(make('small', 'cd'));
  target.replaceChildren(big, make('p', parts.slice(2).join(' · '), { class: 'interval' }));
  showRows(target, [['lamp', parts[0]], ...rows]);
  showGrowth(all, value);
  byId('lamp-files').hidden = false;
}

const toml = (text) => '"' + text.replace(/[\\"]/g, (c) => '\\' + c) + '"';
function plain(text) {
  const value = String(Number(text));
  if (!Number.isFinite(Number(text))) throw new Error(`"${text}" is not a number alone, as a session.toml has it`);
  return /[.e]/.test(value) ? value : value + '.0';
}
// As the command reads a length (core/units_text.cc).
const kMetres = { '': 1, m: 1, cm: 0.01, mm: 0.001, km: 1000, in: 0.0254, inch: 0.0254, '"': 0.0254, ft: 0.3048, "'": 0.3048 };
function metresOf(text, unitOfBare) {
  const [, value, unit] = /^(.*?)([a-z"']*)$/i.exec(text ?? '');
  const metres = value === '' ? NaN : value * kMetres[unit || unitOfBare];
  if (!(metres > 0)) throw new Error('a room is written LENGTH,WIDTH,HEIGHT, for example 5,4,2.6');
  return plain(Number(metres.toPrecision(14)));
}

// The same lamp as a session: what `quick` was told, in session.toml's words. Throws where a field is
// no number alone.
export function sessionText() {
  const name = byId('name').value.trim() || 'light', fixture = byId('fixture').value;
  const where = byId('room').value, meter = byId('meter').value, cct = number(byId('cct').value);
  const lines = ['# ' + document.querySelector('meta[name=generator]').content + ', its page',
    'lightcal = 1', `name = ${toml(name)}`, ''];
  if (where === 'dark' || where === 'outdoors') lines.push('[room]', `${where} = true`, '');
  if (where === 'size') {
    const [length, width, height, reflectance] = roomWord().split(',');
    const unit = /[a-z"']*$/i.exec(height ?? '')[0];
    lines.push('[room]', `size_m = [${[length, width, height].map((side) => metresOf(side, unit)).join(', ')}]`);
    if (reflectance) lines.push(`reflectance = ${plain(reflectance)}`);
    lines.push('');
  }
  lines.push('[[light]]', `name = ${toml(name)}`, 'kind = "point"');
  if (fixture) lines.push(`fixture = "${fixture}"`);
  lines.push('');
  // What a meter's class leaves, of which 95 % is the figure.
  const figure = { phone: 0.25, hobby: 0.05, lab: 0.02 }[meter];
  if (figure) lines.push('[[meter]]', 'name = "meter"', `sigma_relative = ${figure / 1.959963984540054}`, '');
  for (const one of readings()) {
    for (const [lux, card] of [[one.lux, false], ...(one.card === '' ? [] : [[one.card, true]])]) {
      lines.push('[[reading]]', `light = ${toml(name)}`);
      if (figure) lines.push('meter = "meter"');
      lines.push(`distance_m = ${plain(one.metres)}`, `illuminance_lx = ${plain(lux)}`);
      if (card) lines.push('shadow_card = true');
      else if (cct !== '') lines.push(`cct_K = ${plain(cct)}`);
      lines.push('');
    }
  }
  return lines.join('\n');
}
// { text }, or { error } where it would not be read back.
function readableSession() {
  try {
    const text = sessionText();
    const { error } = asked(['fit', '/lamp/session.toml'], new MemoryFiles({ '/lamp/session.toml': text }));
    return error ? { error } : { text };
  } catch (error) {
    return { error };
  }
}
function fileStem() { return (byId('name').value.trim() || 'light').replace(/[^\p{L}\p{N}_-]+/gu, '_'); }

function savePresets(words, files, folder, status) {
  const { value, error } = asked([...words, '-o', folder], files);
  if (error) { status.textContent = error.message; return; }
  const names = files.list(folder);
  if (names.length === 0) {
    const why = (value.warnings ?? []).map((one) => `${one.subject}: ${one.message}`);
    status.textContent = ['Nothing was saved.', ...why].join(' ');
    return;
  }
  for (const name of names) save(name, files.read(`${folder}/${name}`), 'application/octet-stream');
  // Only the browser knows where they went.
  const paste = (value.paste ?? []).map((line) => line.replaceAll(`${folder}/`, 'FOLDER/'));
  status.textContent = [`Saved ${names.join(', ')}.`,
    ...(paste.length > 0 ? ['Where FOLDER is the one they were saved to:', ...paste] : [])].join(' ');
}

// ---- the others ----

function answerColor() {
  const target = byId('color-answer'), x = number(byId('color-x').value), y = number(byId('color-y').value);
  const file = byId('spectrum').bytes, files = new MemoryFiles(file ? { ['/' + file.name]: file.bytes } : {});
  const duv = number(byId('color-duv').value);
  const words = file ? ['color', '--spectrum', '/' + file.name]
    : x !== '' && y !== '' ? ['color', '--xy', x, y]
      : ['color', '--cct', number(byId('color-cct').value) + 'K', ...(duv === '' ? [] : ['--duv', duv])];
  const { value, error } = asked(words, files);
  byId('swatch').hidden = true;
  if (error) return showFault(target, error);
  target.replaceChildren();
  showTable(target, said(words, files));
  if (!value.rgb) return;
  const linear = value.rgb.srgb_linear.map((c) => Math.max(0, c)), most = Math.max(...linear);
  const shown = linear.map((c) => c / most).map((c) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
  byId('swatch').style.background = `rgb(${shown.map((c) => Math.round(255 * c)).join(' ')})`;
  byId('swatch').hidden = false;
}
function answerExposure() {
  const target = byId('exposure-answer');
  const words = ['exposure', '--aperture', byId('aperture').value.trim(), '--shutter', byId('shutter').value.trim(),
    '--iso', number(byId('iso').value)];
  if (byId('exposed').value.trim() !== '') words.push('--light', byId('exposed').value.trim());
  const { error } = asked(words);
  if (error) return showFault(target, error);
  target.replaceChildren();
  for (const table of said(words).split('\n\n')) showTable(target, table);
}
function answerRatio() {
  const target = byId('ratio-answer');
  const words = ['ratio', number(byId('key-lux').value) + 'lx', number(byId('fill-lux').value) + 'lx'];
  const { error } = asked(words);
  if (error) return showFault(target, error);
  const [head, ...rows] = said(words).split('\n');
  target.replaceChildren(make('p', head.split(' · ')[0], { class: 'big' }), make('p', head.split(' · ')[1], { class: 'interval' }));
  showRows(target, labelled(rows.join('\n')));
}

let carried;  // the light.json that "Lights" shows
function showLights(text, name) {
  const target = byId('lights-answer'), session = name.endsWith('.toml');
  byId('lights-files').hidden = true;
  let file = text;
  if (session) {
    const answer = asked(['fit', '/lamp/session.toml'], new MemoryFiles({ '/lamp/session.toml': text }));
    if (answer.error) return showFault(target, answer.error);
    file = JSON.stringify(answer.value);
  }
  const stem = name.replace(/\.[^.]*$/, '').replace(/[^\p{L}\p{N}_-]+/gu, '_') || 'light';
  let lights;
  try {
    ({ lights } = JSON.parse(file));
    if (!Array.isArray(lights)) throw new Error();
  } catch {
    return showFault(target, { subject: name, message: 'is no light.json and no session.toml' });
  }
  carried = { text: file, stem };
  const table = make('table'), head = make('tr'), body = make('tbody');
  for (const [title, kind] of [['Lamp', ''], ['Intensity', 'number'], ['95 %', 'number'], ['Colour', 'number']]) {
    head.append(make('th', title, { scope: 'col', class: kind }));
  }
  for (const light of lights) {
    const row = make('tr'), value = light.intensity_cd ?? light.illuminance_lx;
    const unit = light.intensity_cd ? 'cd' : 'lx';
    row.append(make('th', light.name, { scope: 'row' }),
      make('td', value ? `${short(value.value)} ${unit}` : '', { class: 'number' }),
      make('td', value ? `${short(interval(value).low)} … ${short(interval(value).high)}` : '', { class: 'number' }),
      make('td', light.color?.cct_K ? `${Math.round(light.color.cct_K.value)} K` : '', { class: 'number' }));
    body.append(row);
  }
  const top = make('thead');
  top.append(head);
  table.append(top, body);
  target.replaceChildren(make('h3', name), table);
  byId('lights-files').hidden = false;
}

// ---- wiring ----

function chooseTab(tab) {
  for (const one of document.querySelectorAll('[role=tab]')) {
    const chosen = one === tab;
    one.setAttribute('aria-selected', chosen);
    one.tabIndex = chosen ? 0 : -1;
    byId(one.getAttribute('aria-controls')).hidden = !chosen;
  }
}
function wireTabs() {
  const tabs = [...document.querySelectorAll('[role=tab]')];
  tabs.forEach((tab, i) => {
    tab.addEventListener('click', () => chooseTab(tab));
    tab.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      const next = tabs[(i + step + tabs.length) % tabs.length];
      chooseTab(next);
      next.focus();
    });
  });
}
function soon(work) {  // after the last of quick keystrokes
  let waiting;
  return () => {
    clearTimeout(waiting);
    waiting = setTimeout(work, 120);
  };
}
async function fileOf(input) {
  const file = input.files[0];
  return file && { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
}
function engineWords() {
  const { error } = asked(['quick', '1lx@1m', '--to', '?']);
  const words = /none of (.*)$/.exec(error?.message ?? '');
  return words ? words[1].split(', ').filter((word) => !['all', 'page'].includes(word)) : ['json'];
}

function wire() {
  for (const [id, work] of [['lamp', answerLamp], ['color', answerColor], ['exposure', answerExposure], ['ratio', answerRatio]]) {
    const form = byId(id).querySelector('form');
    form.addEventListener('input', soon(work));
    form.addEventListener('submit', (event) => event.preventDefault());
  }
  byId('add-reading').addEventListener('click', () => addReading().querySelector('input').focus());
  const engines = engineWords();
  for (const select of [byId('engine'), byId('lights-engine')]) {
    select.append(...engines.map((word) => make('option', word, { value: word })));
    select.value = 'blender';
  }
  byId('save-session').addEventListener('click', () => {
    const { text, error } = readableSession();
    if (text) save('session.toml', text);
    byId('lamp-saved').textContent = text ? 'Saved session.toml.'
      : `Not saved: ${[error.subject, error.message].filter(Boolean).join(': ')}`;
  });
  byId('save-preset').addEventListener('click', () => {
    const words = [...lampWords(readings()), '--to', byId('engine').value];
    savePresets(words, new MemoryFiles(), `/${fileStem()}`, byId('lamp-saved'));
  });
  byId('spectrum').addEventListener('change', async (event) => {
    event.target.bytes = await fileOf(event.target);
    answerColor();
  });
  for (const id of ['color-cct', 'color-duv', 'color-x', 'color-y']) {
    byId(id).addEventListener('input', () => { byId('spectrum').bytes = undefined; });
  }
  byId('light-file').addEventListener('change', async (event) => {
    const file = await fileOf(event.target);
    if (file) showLights(new TextDecoder().decode(file.bytes), file.name);
  });
  byId('lights-save').addEventListener('click', () => {
    const files = new MemoryFiles({ [`/in/${carried.stem}.json`]: carried.text });
    const words = ['export', `/in/${carried.stem}.json`, '--to', byId('lights-engine').value];
    savePresets(words, files, '/out', byId('lights-saved'));
  });
}

wireTabs();
try {
  module = await loadModule();
  byId('starting').remove();
  wire();
  addReading('203', '0.5');
  addReading('58', '1');
  addReading('20', '2', '8');
  byId('fixture').value = 'bulb';
  byId('cct').value = '2900';
  answerLamp();
  answerColor();
  answerExposure();
  answerRatio();
  const brought = JSON.parse(byId('carried').textContent);
  if (brought) {
    showLights(JSON.stringify(brought.light), brought.name);
    chooseTab(byId('tab-lights'));
  }
  window.lightcal = { run: (words, contents) => lightcal(words, new MemoryFiles(contents ?? {})), sessionText };
  document.documentElement.dataset.ready = performance.now().toFixed(0);
} catch (error) {
  byId('starting').textContent = `This browser cannot calculate here (${error.message}). Chrome 95, Firefox 113, Safari 16.4 and newer can.`;
  byId('starting').className = 'fault';
}
