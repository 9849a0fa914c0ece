#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A sphere that was read close by: what Blender before 4.0 makes of it, a disc that faces each point
(I/(d^2 + r^2); rendered in Cycles 3.4 by tests/engines/scene/blender_gate.py), is said by export and by
check with its figure; far from it nothing is.
  near_spheres.py LIGHTCAL"""
import json
import re
import subprocess
import sys
import tempfile

CANDELA, DIAMETER = 300.0, 0.3


def run(*words):
    done = subprocess.run([sys.argv[1], *words], capture_output=True, text=True)
    assert done.returncode == 0, (words, done.stdout, done.stderr)
    return done


def said(distances):
    """(export's warning, check's warning, the note in the preset) of a sphere read at these from its centre."""
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + '/session.toml', 'w') as out:
            out.write('lightcal = 1\nname = "ball"\n[room]\ndark = true\n[[light]]\nname = "ball"\nkind = "sphere"\n'
                      f'diameter_m = {DIAMETER}\nposition_m = [0.0, 0.0, 2.0]\n')
            for d in distances:
                out.write(f'[[reading]]\nlight = "ball"\nposition_m = [0.0, 0.0, {2.0 - d}]\nnormal = [0.0, 0.0, 1.0]\n'
                          f'illuminance_lx = {CANDELA / d ** 2:.6f}\n')
        run('fit', folder, '-o', folder + '/ball.json')
        export = run('export', folder + '/ball.json', '--to', 'blender,json,gltf', '-o', folder)
        check = run('check', folder + '/ball.blender.py', '--session', folder)
        assert 'before Blender' not in run('check', folder + '/ball.gltf', '--session', folder).stderr
        with open(folder + '/ball.preset.json') as f:
            note = json.load(f)['lights'][0]['derived']['blender']['substituted']
        return export.stderr, check.stderr, note


def percent(text, words):
    found = re.search(r'([\d.]+) % ' + words, text)
    assert found, (text, words)
    return float(found[1])


def lack(d):
    return 100.0 * (1.0 - d ** 2 / (d ** 2 + (DIAMETER / 2) ** 2))


export, check, note = said([0.4, 0.6, 1.0, 2.0])
print(export, check)
for text in (export, note):
    assert abs(percent(text, 'low at one diameter') - lack(DIAMETER)) < 0.1, text
    assert abs(percent(text, 'at two') - lack(2 * DIAMETER)) < 0.1, text
    assert abs(percent(text, r'at five \(1.5') - lack(5 * DIAMETER)) < 0.1, text
assert abs(percent(check, 'lower than this at 0.4') - lack(0.4)) < 0.6, check  # two digits
export, check, _ = said([3.0, 4.0, 5.0])
assert 'before Blender' not in export + check, (export, check)
