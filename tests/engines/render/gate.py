#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders one set of measured lamps in every engine that runs here and holds the lux of a white card
at the meter's place against what the meter read.
  gate.py --lightcal BINARY --modules NODE_FOLDER [--work FOLDER] [--engines a,b] [--table FILE] [--contact PNG]
Exits 1 when a bar is missed. --table writes the parity table into FILE between its marks, --contact
the rigs of all of them on one sheet."""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

import cases
import contact_rows
import pictures

HERE = os.path.dirname(os.path.abspath(__file__))
# engine -> kind -> largest |got/read - 1|. A kind that is not here was not rendered.
BARS = {
    'blender': {'point': .005, 'spot': .005, 'sun': .005, 'rect': .005, 'ies': .002, 'dome': .005},
    'three': {'point': .002, 'spot': .002, 'sun': .002, 'rect': .002, 'dome': .01},
    'three_ies': {'axial': .02},
    'babylon': {'point': .002, 'spot': .002, 'sun': .002, 'axial': .02, 'dome': .01},
    'babylon_gltf': {'dome': .01},
    'filament': {'point': .02, 'spot': .02, 'sun': .02, 'dome': .02},
}
TITLES = {'blender': 'Blender Cycles', 'three': 'three.js', 'three_ies': 'three.js WebGPU build',
          'babylon': 'Babylon.js', 'babylon_gltf': 'Babylon.js, its glTF', 'filament': 'Filament'}
WITHOUT_RIG = ('three_ies', 'babylon_gltf')
KIND_TITLES = {'point': 'point', 'spot': 'spot 15/25', 'sun': 'sun', 'rect': 'rect 0.6 x 0.3 m',
               'ies': 'IES, asymmetric', 'axial': 'IES, axial', 'dome': 'uniform dome'}
RIG_BAR = .02


def export(lightcal, work):
    for kind in cases.KINDS:
        for color in cases.COLORS:
            folder = f'{work}/{kind}_{color}'
            os.makedirs(folder, exist_ok=True)
            with open(f'{folder}/session.toml', 'w') as f:
                f.write(cases.session_toml(kind, color))
            if kind in ('ies', 'axial'):
                with open(f'{folder}/lamp.ies', 'w', newline='') as f:
                    f.write(cases.ies_text(kind == 'axial'))
            subprocess.run([lightcal, 'run', folder, '-o', f'{folder}/out', '--to',
                            'json,gltf,blender,three,filament,godot', '--rig', '--force', '--quiet'], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def run_blender(work, jobs):
    rows = [{'script': f'{work}/{j["name"]}/out/{j["name"]}.rig.blender.py', 'probes': j['probes'],
             'rig_png': j['png'], 'percent': 100 if j['name'] == 'point_2700K' else 25,
             **({} if j['name'] == 'point_2700K' else {'samples': 16})} for j in jobs]
    with open(f'{work}/blender_jobs.json', 'w') as f:
        json.dump(rows, f)
    out = f'{work}/blender_results.json'
    done = subprocess.run(['blender', '-b', '--factory-startup', '-P', f'{HERE}/blender_probe.py',
                           '--', f'{work}/blender_jobs.json', out], capture_output=True, text=True)
    if not os.path.exists(out):
        sys.exit('blender: ' + done.stdout[-2000:] + done.stderr[-2000:])
    got = json.load(open(out))
    return got['version'], got['results']


def run_browser(modules, work, engine, jobs):
    suffix = {'filament': 'filament.json', 'babylon_gltf': 'gltf'}.get(engine, 'three.js')
    rows = [{'engine': engine, 'module': f'{j["name"]}/out/{j["name"]}.rig.{suffix}',
             'probes': j['probes'], **({} if engine in WITHOUT_RIG else {'png': j['png']})}
            for j in jobs]
    with open(f'{work}/{engine}_jobs.json', 'w') as f:
        json.dump(rows, f)
    out = f'{work}/{engine}_results.json'
    subprocess.run(['node', f'{HERE}/browse.mjs', modules, work, f'{work}/{engine}_jobs.json', out],
                   check=True)
    package = ('@babylonjs/core' if engine.startswith('babylon') else
               'filament' if engine == 'filament' else 'three')
    version = json.load(open(f'{modules}/node_modules/{package}/package.json'))['version']
    return version, json.load(open(out))['results']


def measure(args, work):
    """[{engine, kind, color, read, got, worst, rig}]"""
    rows, versions = [], {}
    for engine in args.engines:
        jobs = [{'name': f'{kind}_{color}', 'kind': kind, 'color': color,
                 'probes': cases.probes(kind), 'png': f'{work}/{engine}_{kind}_{color}.png'}
                for kind in BARS[engine] for color in cases.COLORS]
        versions[engine], results = (run_blender(work, jobs) if engine == 'blender' else
                                     run_browser(args.modules, work, engine, jobs))
        for job, result in zip(jobs, results):
            if 'lux' not in result:
                sys.exit(f'{engine} {job["name"]}: {result}')
            errors = [got / probe['lux'] - 1 for got, probe in zip(result['lux'], job['probes'])]
            row = {'engine': engine, 'kind': job['kind'], 'color': job['color'],
                   'read': job['probes'][0]['lux'], 'got': result['lux'][0],
                   'worst': max(errors, key=abs)}
            if os.path.exists(job['png']):
                row['rig'] = grey(work, job)
                row['png'] = job['png']
            rows.append(row)
    return rows, versions


def grey(work, job):
    rig = json.load(open(f'{work}/{job["name"]}/out/{job["name"]}.rig.preset.json'))['rig']
    return pictures.card_luminance(job['png'], rig, 1)


def judge(rows):
    failures = []
    for row in rows:
        where = f'{row["engine"]} {row["kind"]} {row["color"]}'
        rig = f' card {row["rig"]:.4f}' if 'rig' in row else ''
        print(f'{where:28} read {row["read"]:8.2f} lx  got {row["got"]:9.3f}  worst {row["worst"]:+.3%}{rig}')
        if not abs(row['worst']) <= BARS[row['engine']][row['kind']]:
            failures.append(f'{where}: {row["worst"]:+.3%} of the meter\'s lux')
        if 'rig' in row and not abs(row['rig'] / 0.18 - 1) <= RIG_BAR:
            failures.append(f'{where}: the 18 % card shows as {row["rig"]:.4f}')
    return failures


def table(rows, versions):
    engines = [e for e in TITLES if e in versions]
    lines = ['| lamp | read | ' + ' | '.join(f'{TITLES[e]} {versions[e].split()[0]}' for e in engines) + ' |',
             '|---|---|' + '---|' * len(engines)]
    for kind in cases.KINDS:
        for color in cases.COLORS:
            cells = []
            for engine in engines:
                row = next((r for r in rows if (r['engine'], r['kind'], r['color']) == (engine, kind, color)), None)
                digits = 1 if engine == 'filament' else 2
                cells.append(f'{row["got"]:.{digits}f} ({row["got"] / row["read"] - 1:+.{digits}%})'.replace('-0.00%', '0.00%').replace('+0.00%', '0.00%')
                             if row else '')
            lines.append(f'| {KIND_TITLES[kind]}, {color} | {cases.KINDS[kind][1]:g} lx | ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines)


def contact_sheet(args, work, rows):
    """The rigs of the 2700 K lamps as each engine opens them, a row a lamp."""
    engines = [e for e in args.engines if e not in WITHOUT_RIG]
    lines = ['<tr><th></th>' + ''.join(f'<th>{TITLES[e]}</th>' for e in engines) + '</tr>']
    for kind in cases.KINDS:
        cells = []
        for engine in engines:
            row = next((r for r in rows if (r['engine'], r['kind'], r['color']) == (engine, kind, '2700K')
                        and 'png' in r), None)
            cells.append(f'<td><img src="file://{row["png"]}"><br>card {row["got"]:.4g} lx, 18 % shows as '
                         f'{row["rig"]:.3f}</td>' if row else '<td class="none">no picture</td>')
        lines.append(f'<tr><th>{KIND_TITLES[kind]}<br>meter {cases.KINDS[kind][1]:g} lx</th>'
                     + ''.join(cells) + '</tr>')
    lines += [contact_rows.off_axis(args, work, engines), contact_rows.balls(args, work, engines)]
    with open(f'{work}/contact.html', 'w') as f:
        f.write('<!doctype html><meta charset="utf-8"><style>body{font:13px sans-serif;margin:12px;width:948px}'
                'img{width:196px}td,th{vertical-align:top;text-align:left;padding:2px 4px}.none{color:#777}'
                '</style><p>One lamp of each kind, 2700 K: its exposed rig as each engine opens it, a 90 % and '
                'an 18 % card at the place of the reading; then beside the axis, and in a panorama.</p><table>' + ''.join(lines) + '</table>')
    subprocess.run(['node', f'{HERE}/screenshot.mjs', args.modules, f'{work}/contact.html',
                    os.path.abspath(args.contact)], check=True)


def write_table(path, text):
    old = open(path).read()
    new = re.sub(r'(<!-- parity begin[^\n]*-->\n).*?(<!-- parity end -->)',
                 lambda m: m.group(1) + text + '\n' + m.group(2), old, flags=re.S)
    with open(path, 'w') as f:
        f.write(new)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--modules', required=True)
    parser.add_argument('--work')
    parser.add_argument('--engines', default=','.join(BARS))
    parser.add_argument('--table')
    parser.add_argument('--contact')
    args = parser.parse_args()
    args.engines = args.engines.split(',')
    for engine, further in (('three', 'three_ies'), ('babylon', 'babylon_gltf')):
        if args.engines == [engine]:
            args.engines.append(further)
    with tempfile.TemporaryDirectory() as temporary:
        work = os.path.abspath(args.work or temporary)
        os.makedirs(work, exist_ok=True)
        export(os.path.abspath(args.lightcal), work)
        rows, versions = measure(args, work)
        if args.contact:
            contact_sheet(args, work, rows)
    failures = judge(rows)
    if args.table:
        write_table(args.table, table(rows, versions))
    for failure in failures:
        print('FAILED ' + failure)
    sys.exit(1 if failures else 0)


if __name__ == '__main__':
    main()
