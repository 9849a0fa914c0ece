#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The demonstration sheet: one published film light in every engine that runs here, as lightcal
exports it and as everyone types it, with the lux of the grey card on each tile.
  sheet.py --lightcal BINARY --modules NODE_FOLDER -o SHEET.png [--session SESSION] [--watts 200]"""
import argparse
import html
import json
import math
import os
import subprocess
import tempfile

import gate
import pictures

TITLES = {'blender': 'Blender Cycles', 'three': 'three.js', 'babylon': 'Babylon.js',
          'filament': 'Filament'}
# What people type from the data sheet: watts in Blender, candela with a colour beside it elsewhere,
# and whatever exposure the program starts with.
NAIVE = {
    'blender': ("for l in lamps: l.energy = {watts}\nscene.view_settings.exposure = 0\n"
                "scene.view_settings.view_transform = 'Filmic'", 'the lamp\'s {watts:g} W, default view'),
    'three': ("built.lights.forEach((l, i) => {{ l.intensity = {cd}; }});"
              "preset.exposure.exposure = 1;", '{cd:.0f} cd beside its colour, exposure 1'),
    'babylon': ("built.lights.forEach((l) => {{ l.intensity = {cd}; }});",
                '{cd:.0f} cd beside its colour, exposure 1'),
    'filament': ("preset.lights.forEach((l) => {{ l.intensity_lm = {cd}; }});"
                 "Object.assign(preset.exposure, {{ aperture: 16, shutter_s: 1 / 125, iso: 100 }});",
                 '{cd:.0f} as intensity, f/16 1/125'),
}


def jobs_of(work, stem, edits):
    blender, browser = [], []
    for engine in TITLES:
        for naive in (False, True):
            if naive and engine not in NAIVE:
                continue
            png = f'{work}/{engine}_{"naive" if naive else "ours"}.png'
            edit = edits[engine] if naive else ''
            if engine == 'blender':
                blender.append({'script': f'{work}/out/{stem}.rig.blender.py', 'probes': [], 'percent': 100,
                                'samples': 64, 'rig_png': png, 'edit': edit})
            else:
                suffix = 'filament.json' if engine == 'filament' else 'three.js'
                browser.append({'engine': engine, 'module': f'out/{stem}.rig.{suffix}', 'probes': [],
                                'png': png, 'edit': edit})
    return blender, browser


def tile(work, rig, engine, naive, note):
    path = f'{work}/{engine}_{"naive" if naive else "ours"}.png'
    if not os.path.exists(path):
        return '<td class="none">not executed</td>'
    pixel = pictures.card_luminance(path, rig['rig'], 1)
    expected = rig['rig']['cards'][1]['illuminance_lx']
    lux = math.pi * pixel / 0.18 / rig['exposure']['exposure']
    clipped = pixel > 0.98
    stops = math.log2(max(lux, 1e-9) / expected)
    text = (f'{">" if clipped else ""}{lux:.0f} lx &nbsp; {">" if clipped else ""}{stops:+.2f} stops'
            if pixel > 1e-4 else 'black')
    return (f'<td><img src="file://{path}"><div class="lux">{text}</div>'
            f'<div class="note">{html.escape(note)}</div></td>')


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--modules', required=True)
    parser.add_argument('-o', '--output', required=True)
    parser.add_argument('--session', default='sample_data/sessions/amaran_200x_s_bare')
    parser.add_argument('--watts', type=float, default=200.0)
    args = parser.parse_args()
    stem = os.path.basename(os.path.normpath(args.session))
    with tempfile.TemporaryDirectory() as work:
        quiet = {'check': True, 'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL}
        subprocess.run([args.lightcal, 'fit', args.session, '-o', f'{work}/all.json', '--quiet'], **quiet)
        one = json.load(open(f'{work}/all.json'))
        one['lights'] = one['lights'][:1]  # a session may hold one lamp at several settings
        with open(f'{work}/{stem}.json', 'w') as f:
            json.dump(one, f)
        subprocess.run([args.lightcal, 'export', f'{work}/{stem}.json', '--to',
                        'json,blender,three,filament', '--rig', '-o', f'{work}/out', '--quiet'], **quiet)
        rig = json.load(open(f'{work}/out/{stem}.rig.preset.json'))
        lamp = rig['lights'][0]
        cd = lamp['photometry']['intensity_cd']['value']
        edits = {e: edit.format(watts=args.watts, cd=cd) for e, (edit, _) in NAIVE.items()}
        blender, browser = jobs_of(work, stem, edits)
        for rows, command in ((blender, ['blender', '-b', '--factory-startup', '-P',
                                         f'{gate.HERE}/blender_probe.py', '--']),
                              (browser, ['node', f'{gate.HERE}/browse.mjs', args.modules, work])):
            with open(f'{work}/jobs.json', 'w') as f:
                json.dump(rows, f)
            subprocess.run(command + [f'{work}/jobs.json', f'{work}/done.json'], check=True,
                           stdout=subprocess.DEVNULL)
        card = rig['rig']['cards'][1]
        head = (f'<h1>{html.escape(stem)}: {cd:.0f} cd, {lamp["color"].get("cct_K", {}).get("value", 0):.0f} K'
                f' &mdash; the meter reads {card["illuminance_lx"]:.0f} lx on the cards</h1>'
                '<p>A 90 % and an 18 % card at a reading\'s place. Above: as lightcal exports it, opened with '
                'default settings. Below: what everyone types.</p>')
        rows = ''
        for naive in (False, True):
            rows += '<tr>' + ''.join(
                tile(work, rig, e, naive, NAIVE[e][1].format(watts=args.watts, cd=cd) if naive and e in NAIVE
                     else 'lightcal export') for e in TITLES) + '</tr>'
        titles = ''.join(f'<th>{t}</th>' for t in TITLES.values())
        page = (f'<!doctype html><meta charset="utf-8"><style>body{{font:15px sans-serif;margin:16px;width:948px}}'
                f'h1{{font-size:19px}}img{{width:228px;display:block}}.lux{{font-weight:bold;margin-top:4px}}'
                f'.note{{color:#555;font-size:12px;margin-bottom:8px}}td{{vertical-align:top}}.none{{color:#777}}'
                f'</style>{head}<table><tr>{titles}</tr>{rows}</table>')
        with open(f'{work}/sheet.html', 'w') as f:
            f.write(page)
        subprocess.run(['node', f'{gate.HERE}/screenshot.mjs', args.modules, f'{work}/sheet.html',
                        os.path.abspath(args.output)], check=True)


main()
