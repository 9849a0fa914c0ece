# SPDX-License-Identifier: Apache-2.0
"""Two rows of the contact sheet that no card on the axis shows: a spot's rig 20 degrees off its axis, and a
chrome and a grey ball in the six-sided panorama of panorama.py, whose sun stands beside it as a light."""
import json
import math
import os
import subprocess

import cases
import panorama
import place

HERE = os.path.dirname(os.path.abspath(__file__))
OFF_DEG = 20.0


def browser(args, work, engine, job):
    with open(f'{work}/row.json', 'w') as f:
        json.dump([{'engine': engine, **job}], f)
    place.run('node', f'{HERE}/browse.mjs', args.modules, work, f'{work}/row.json', f'{work}/row_out.json')
    return json.load(open(f'{work}/row_out.json'))['results'][0]


def blender(work, job):
    with open(f'{work}/row.json', 'w') as f:
        json.dump([job], f)
    place.run('blender', '-b', '--factory-startup', '-P', f'{HERE}/blender_probe.py', '--', f'{work}/row.json',
              f'{work}/row_out.json')
    return json.load(open(f'{work}/row_out.json'))['results'][0]


def cell(png, text):
    return f'<td><img src="file://{png}"><br>{text}</td>' if os.path.exists(png) else '<td class="none">no picture</td>'


def off_axis(args, work, engines):
    folder, lux = f'{work}/spot_2700K/out', cases.KINDS['spot'][1]
    subprocess.run([os.path.abspath(args.lightcal), 'export', f'{folder}/light.json', '--to',
                    'blender,three,filament', '--rig', '--rig-at', f'{OFF_DEG:g}', '-o', folder, '--force', '--quiet'],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    stem = f'light.rig_{OFF_DEG:g}'
    # glTF's and Frostbite's squared law between 15 and 25 degrees.
    ci, co, c = (math.cos(math.radians(v)) for v in (15, 25, OFF_DEG))
    wanted = lux * ((c - co) / (ci - co)) ** 2
    probes = [cases.off_axis(0.0, OFF_DEG, wanted)]
    cells = []
    for engine in engines:
        png = f'{work}/{engine}_off_axis.png'
        if engine == 'blender':
            got = blender(work, {'script': f'{folder}/{stem}.blender.py', 'probes': probes, 'rig_png': png,
                                 'percent': 25, 'samples': 16})
        else:
            suffix = 'filament.json' if engine == 'filament' else 'three.js'
            got = browser(args, work, engine, {'module': f'spot_2700K/out/{stem}.{suffix}', 'probes': probes, 'png': png})
        if 'lux' not in got:
            raise SystemExit(f'{engine}: {got}')
        print(f'{engine}: {got["lux"][0]:.2f} of {wanted:.2f} lx {OFF_DEG:g} degrees off the axis')
        cells.append(cell(png, f'card {got["lux"][0]:.4g} lx ({got["lux"][0] / wanted - 1:+.1%})'))
    return f'<tr><th>spot 15/25, {OFF_DEG:g}° off its axis<br>law {wanted:.4g} lx</th>' + ''.join(cells) + '</tr>'


def balls(args, work, engines):
    panorama.export(os.path.abspath(args.lightcal), work, panorama.irradiance())
    folder = 'beside/out/light.rig'
    job = {'probes': [], 'balls': [{'at': at, 'radius': r, 'chrome': c} for at, r, c in place.BALLS],
           'view': {'eye': place.EYE, 'target': place.TARGET, 'field_deg': place.FIELD_DEG}}
    cells = []
    for engine in engines:
        png = f'{work}/{engine}_balls.png'
        if engine == 'blender':
            place.run('blender', '-b', '--factory-startup', '-P', f'{HERE}/place.py', '--',
                      f'{work}/{folder}.blender.py', png)
        elif engine in ('three', 'filament'):
            suffix = 'filament.json' if engine == 'filament' else 'three.js'
            got = browser(args, work, engine, {**job, 'module': f'{folder}.{suffix}', 'png': png})
            if 'lux' not in got:
                raise SystemExit(f'{engine}: {got}')
        cells.append(cell(png, 'chrome, 18 % grey'))
    return '<tr><th>panorama of six sides, its sun a light</th>' + ''.join(cells) + '</tr>'
