#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""LightcalImporter.cs, run as Unity 2022, Unity 6 and Unity 6 with HDRP 17.3 would, against stand-ins that
know HDRP's documented members alone: what each light ends up with, by the pipeline's own cone law.
  run_unity.py LIGHTCAL"""
import math
import os
import subprocess
import sys
import tempfile

import golden_lights
from seen import cone

HERE = os.path.dirname(os.path.abspath(__file__))
UNITIES = {'Unity 2022': [], 'Unity 6': ['UNITY_6000_0_OR_NEWER'],
           'Unity 6, HDRP 17.3': ['UNITY_6000_0_OR_NEWER', 'HDRP_17_3']}


def run(folder, defines, pipeline):
    out = f'{folder}/run.exe'
    subprocess.run(['mcs', '-warnaserror+', '-nowarn:649,660,661',
                    *[f'-define:{d}' for d in defines], f'-out:{out}', f'{HERE}/unity_stand_in.cs',
                    f'{HERE}/unity_pipelines.cs', f'{folder}/LightcalImporter.cs'], check=True)
    done = subprocess.run(['mono', out, f'{folder}/set.unity.json', pipeline], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)
    lights, said = {}, []
    for line in done.stdout.splitlines():
        if line.startswith('said '):
            said.append(line[5:])
        elif line.startswith('light\t'):
            _, name, kind, intensity, unit, full, inner, percent, span = line.split('\t')
            lights[name] = dict(kind=kind, intensity=float(intensity), unit=unit, full=float(full),
                                inner=float(inner), percent=float(percent), range=float(span))
    return lights, said


def main():
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        with open(f'{folder}/set.json', 'w') as f:
            f.write(golden_lights.light_json(['key', 'green spot', 'sun', 'panel']))
        subprocess.run([sys.argv[1], 'export', f'{folder}/set.json', '--to', 'unity', '-o', folder, '--quiet'],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        want = cone('squared', 15.0, 25.0)
        for title, defines in UNITIES.items():
            lights, said = run(folder, defines, 'hdrp')
            for word in said:
                failures.append(f'{title}: {word}')
            spot = lights['green spot']
            # HDRP's own percent where it has one: Light.innerSpotAngle is not looked at then.
            inner = (spot['inner'] if 'HDRP_17_3' in defines else spot['full'] * spot['percent'] / 100) / 2
            got = cone('squared', inner, spot['full'] / 2)
            worst = max(abs(got(a) - want(a)) for a in [0.1 * i for i in range(300)])
            print(f'{title}: a 15/25 degree spot is {spot["full"]:.3f} degrees, inner {2 * inner:.3f}: off its axis '
                  f'within {100 * worst:.3f} %; {spot["unit"]}, sun {lights["sun"]["unit"]}')
            if worst > 1e-3:
                failures.append(f'{title}: the spot is {100 * worst:.1f} % of its axial value off')
            for name, unit in (('key', 'Candela'), ('green spot', 'Candela'), ('sun', 'Lux'), ('panel', 'Nits')):
                if lights[name]['unit'] != unit:
                    failures.append(f'{title}: {name} in {lights[name]["unit"]}')
        lights, said = run(folder, [], 'urp')
        # URP has no rectangles that light at once: the panel is said to be another light.
        if len(said) != 1 or 'panel' not in said[0] or abs(lights['green spot']['inner'] - 30.0) > 1e-3:
            failures.append(f'URP: {said} {lights}')
        lights, said = run(folder, [], 'built-in')
        if lights or not any('built-in' in s and 'square' in s for s in said):
            failures.append(f'the built-in pipeline is not refused: {lights} {said}')
    for failure in failures:
        print('FAILED ' + failure)
    sys.exit(1 if failures else 0)


main()
