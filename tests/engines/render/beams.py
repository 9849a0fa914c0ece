#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Spots and a measured beam rendered off their axis in every engine that runs here, as the engine's own
cone and as `--spots auto` has it, against closed forms written here: flux, the largest error in percent of
the axial value, and whether that is what the exported file says.
  beams.py --lightcal BINARY --modules NODE_FOLDER [--work FOLDER] [--engines a,b]
Exits 1 when a bar is missed."""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

import cases
import gate

LUX = 1000.0


def squared(inner, outer):
    ci, co = math.cos(math.radians(inner)), math.cos(math.radians(outer))
    return lambda deg: min(1.0, max(0.0, (math.cos(math.radians(deg)) - co) / (ci - co))) ** 2


def cos8(deg):
    return math.cos(math.radians(deg)) ** 8 if deg < 90 else 0.0


# name -> (inner, outer, closed form); no inner: a photometric file
BEAMS = {'spot 15/25': (15, 25, squared(15, 25)), 'spot 5/40': (5, 40, squared(5, 40)),
         'spot 20/22': (20, 22, squared(20, 22)), 'cos8': (None, 65, cos8)}
# (engine, mode) -> beam -> percent of the axial value
WORST = {
    ('blender', 'cone'): {'spot 15/25': 7, 'spot 5/40': 14, 'spot 20/22': 11, 'cos8': 21},
    ('three', 'cone'): {'spot 15/25': 7, 'spot 5/40': 14, 'spot 20/22': 11, 'cos8': 21},
    ('babylon', 'cone'): {'spot 15/25': 1, 'spot 5/40': 1, 'spot 20/22': 1, 'cos8': 6},
    ('filament', 'cone'): {'spot 15/25': 1, 'spot 5/40': 1, 'spot 20/22': 1, 'cos8': 6},
    ('blender', 'auto'): dict.fromkeys(BEAMS, 1.5),
    ('three', 'auto'): dict.fromkeys(BEAMS, 1.5),
    ('babylon', 'auto'): dict.fromkeys(BEAMS, 1.5),
}
FLUX = 2.5
# What Filament's 8 bit pictures cannot tell.
NOISE = {'filament': 0.3}


def stem(beam):
    return beam.replace(' ', '_').replace('/', '_')


def export(lightcal, work):
    for beam, (inner, outer, shape) in BEAMS.items():
        folder = f'{work}/{stem(beam)}'
        os.makedirs(folder, exist_ok=True)
        kind = (f'kind = "spot"\nfixture = "bulb"\ninner_deg = {inner}\nouter_deg = {outer}' if inner else
                'kind = "photometric"\ndistribution = "lamp.ies"')
        if not inner:
            angles = [i * 1.0 for i in range(181)]
            values = [round(1e4 * shape(a), 3) for a in angles]
            rows = lambda v: '\r\n'.join(' '.join(f'{x:g}' for x in v[i:i + 10]) for i in range(0, len(v), 10))
            with open(f'{folder}/lamp.ies', 'w', newline='') as f:
                f.write('IESNA:LM-63-2002\r\n[TEST] made\r\n[TESTLAB] lightcal\r\n[ISSUEDATE] 2026-01-01\r\n'
                        f'[MANUFAC] lightcal\r\nTILT=NONE\r\n1 -1 1 {len(angles)} 1 1 2 0 0 0\r\n1 1 10\r\n'
                        f'{rows(angles)}\r\n0\r\n{rows(values)}\r\n')
        with open(f'{folder}/session.toml', 'w') as f:
            f.write(f'lightcal = 1\nname = "{beam}"\n[room]\ndark = true\n[[light]]\nname = "lamp"\n{kind}\n'
                    f'aim = {cases.AIM}\nposition_m = {cases.POSITION}\n[[reading]]\nlight = "lamp"\n'
                    f'distance_m = {cases.D}\nilluminance_lx = {LUX}\ncct_K = 6500\nduv = 0\n')
        subprocess.run([lightcal, 'fit', folder, '-o', f'{folder}/{stem(beam)}.json', '--force', '--quiet'],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for mode in ('cone', 'auto'):
            subprocess.run([lightcal, 'export', f'{folder}/{stem(beam)}.json', '--to', 'json,blender,three,filament',
                            '--spots', mode, '--rig', '-o', f'{folder}/{mode}', '--force', '--quiet'], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def angles_of(beam, engine):
    inner, outer, _ = BEAMS[beam]
    count = 16 if engine == 'filament' else 44
    return [(outer + 5.0) * i / count for i in range(count + 1)]


def flux_of(angles, values):
    """Over the sphere, per candela on the axis; trapezia."""
    total = 0.0
    for i in range(1, len(angles)):
        a, b = math.radians(angles[i - 1]), math.radians(angles[i])
        total += 0.5 * (b - a) * (values[i - 1] * math.sin(a) + values[i] * math.sin(b))
    return total


def printed(work, beam, engine, mode):
    """What the file itself says: (worst, flux) over the axial value and the measured flux, or None."""
    folder = f'{work}/{stem(beam)}/{mode}'
    if engine == 'blender':
        text = open(f'{folder}/{stem(beam)}.blender.py').read()
        light = json.JSONDecoder().raw_decode(text[text.index('{', text.index("json.loads(r'''")):])[0]['lights'][0]
        cone = light.get('before_4_0')
    elif engine == 'three':
        text = open(f'{folder}/{stem(beam)}.three.js').read()
        light = json.JSONDecoder().raw_decode(text[text.index('{', text.index('export const preset')):])[0]['lights'][0]
        cone = light['projected'] | {'flux_factor': 1.0} if 'projected' in light else light.get('three')
    else:
        cone = None
    return (cone['worst_of_axial'], cone['flux_factor']) if cone else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--modules', required=True)
    parser.add_argument('--work')
    parser.add_argument('--engines', default='blender,three,babylon,filament')
    args = parser.parse_args()
    args.modules = os.path.abspath(args.modules)
    failures = []
    with tempfile.TemporaryDirectory() as temporary:
        work = os.path.abspath(args.work or temporary)
        os.makedirs(work, exist_ok=True)
        export(os.path.abspath(args.lightcal), work)
        for engine in args.engines.split(','):
            jobs, meant = [], []
            for (of, mode), bars in WORST.items():
                if of != engine:
                    continue
                for beam, bar in bars.items():
                    angles = angles_of(beam, engine)
                    # Round about too: the turn goes on by an odd share of it.
                    probes = [cases.off_axis(137.5 * i % 360, a, LUX * BEAMS[beam][2](a))
                              for i, a in enumerate(angles)]
                    jobs.append({'name': f'{stem(beam)}/{mode}', 'beam': beam, 'mode': mode, 'bar': bar,
                                 'angles': angles, 'probes': probes})
            results = render(args, work, engine, jobs)
            for job, result in zip(jobs, results):
                if 'lux' not in result:
                    sys.exit(f'{engine} {job["name"]}: {result}')
                got = [v / LUX for v in result['lux']]
                want = [p['lux'] / LUX for p in job['probes']]
                off = [100 * (g - w) for g, w in zip(got, want)]
                worst = max(off, key=abs)
                flux = 100 * (flux_of(job['angles'], got) / flux_of(job['angles'], want) - 1)
                said = printed(work, job['beam'], engine, job['mode'])
                where = f'{engine} {job["beam"]} {job["mode"]}'
                print(f'{where:28} axis {got[0]:.4f}  worst {worst:+.2f} % at '
                      f'{job["angles"][off.index(worst)]:.1f} deg (bar {job["bar"]})  flux {flux:+.2f} %'
                      + (f'  said {100 * said[0]:.2f} %, {100 * (said[1] - 1):+.2f} %' if said else ''))
                noise = NOISE.get(engine, 0.0)
                if abs(worst) > job['bar'] + noise:
                    failures.append(f'{where}: {worst:+.2f} % of the axial value')
                if abs(flux) > FLUX:
                    failures.append(f'{where}: flux {flux:+.2f} %')
                if said and abs(abs(worst) - 100 * said[0]) > 1.0:
                    failures.append(f'{where}: the file says {100 * said[0]:.2f} %, rendered {abs(worst):.2f} %')
    for failure in failures:
        print('FAILED ' + failure)
    sys.exit(1 if failures else 0)


def render(args, work, engine, jobs):
    path, out = f'{work}/{engine}_beams.json', f'{work}/{engine}_beams_out.json'
    if engine == 'blender':
        rows = [{'script': f'{work}/{j["name"]}/{stem(j["beam"])}.rig.blender.py', 'probes': j['probes'],
                 'probe_samples': 64} for j in jobs]
        command = ['blender', '-b', '--factory-startup', '-P', f'{gate.HERE}/blender_probe.py', '--', path, out]
    else:
        suffix = 'filament.json' if engine == 'filament' else 'three.js'
        rows = [{'engine': engine, 'module': f'{j["name"]}/{stem(j["beam"])}.rig.{suffix}', 'probes': j['probes']}
                for j in jobs]
        command = ['node', f'{gate.HERE}/browse.mjs', args.modules, work, path, out]
    with open(path, 'w') as f:
        json.dump(rows, f)
    done = subprocess.run(command, capture_output=True, text=True)
    if not os.path.exists(out):
        sys.exit(f'{engine}: ' + done.stdout[-2000:] + done.stderr[-2000:])
    return json.load(open(out))['results']


if __name__ == '__main__':
    main()
