#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Disks and rects as the spots of engines: what an exporter says of the error off the axis is that of
the engine's own published law against the lamp's cosine, and Godot, whose law holds the cosine, has it.
  flat_lamps.py LIGHTCAL"""
import json
import math
import re
import subprocess
import sys
import tempfile

ANGLES = [math.radians(0.05 * i) for i in range(1901)]  # to 95 degrees


def clamped(v):
    return min(max(v, 0.0), 1.0)


def smooth(t):
    return t * t * (3.0 - 2.0 * t)


def between(inner, outer):
    low, span = math.cos(outer), math.cos(inner) - math.cos(outer)
    return lambda a: clamped((math.cos(a) - low) / span)


def law_of(engine, figures):
    """Intensity by angle over that on the axis; None: no spot."""
    kind = figures['type']
    if engine in ('gltf', 'filament') and 'spot' in kind.lower():
        inner, outer = ((figures['innerConeAngle'], figures['outerConeAngle']) if engine == 'gltf' else
                        (figures['inner_rad'], figures['outer_rad']))
        t = between(inner, outer)
        return lambda a: t(a) ** 2
    if engine == 'godot':
        rim = 1.0 - math.cos(math.radians(figures['spot_angle']))
        power = 1.0 / figures['spot_angle_attenuation']
        axis = 1.0 - 1e-4 ** power
        return lambda a: (1.0 - clamped(max((1.0 - math.cos(a)) / rim, 1e-4)) ** power) / axis
    if engine == 'mitsuba' and kind == 'spot':
        inner, outer = math.radians(figures['beam_width']), math.radians(figures['cutoff_angle'])
        return lambda a: clamped((outer - a) / (outer - inner))
    if engine == 'pbrt' and kind == 'spot':
        outer = math.radians(figures['coneangle'])
        t = between(outer - math.radians(figures['conedeltaangle']), outer)
        return lambda a: smooth(t(a))
    return None


def worst_and_flux(law):
    lamp = [max(math.cos(a), 0.0) for a in ANGLES]
    worst = max(abs(law(a) - cosine) for a, cosine in zip(ANGLES, lamp))
    ring = [math.sin(a) for a in ANGLES]
    flux = sum(law(a) * s for a, s in zip(ANGLES, ring)) / sum(c * s for c, s in zip(lamp, ring))
    return 100.0 * worst, 100.0 * (flux - 1.0)


def stated(text):
    worst = re.search(r'off the axis within ([\d.]+) % of the axial', text)
    flux = re.search(r'flux ([\d.]+) % (low|high)', text)
    assert worst and flux, text
    return float(worst[1]), float(flux[1]) * (-1.0 if flux[2] == 'low' else 1.0)


def run(*words):
    return subprocess.run([sys.argv[1], *words], capture_output=True, text=True)


def lamp(name, kind, **size):
    return {'name': name, 'kind': kind, 'intensity_cd': {'value': 700.0, 'u95': 7.0}, 'effects': [],
            'aim': [0.0, 0.0, -1.0], 'position_m': [0.0, 0.0, 2.0], **size,
            'fit': {'readings': 1, 'used': 1, 'rejected': [], 'learned': [], 'prior': []}}


def stated_errors(folder):
    lamps = [lamp('disk', 'disk', diameter_m=0.3), lamp('rect', 'rect', width_m=0.3, height_m=0.3),
             lamp('sizeless', 'rect')]
    with open(folder + '/flat.json', 'w') as out:
        json.dump({'schema': 'lightcal.light/1', 'lights': lamps,
                   'provenance': {'generator': 'lightcal test'}}, out)
    done = run('export', folder + '/flat.json', '--to', 'json', '-o', folder)
    assert done.returncode == 0, done.stderr
    with open(folder + '/flat.preset.json') as f:
        lights = json.load(f)['lights']
    seen = set()
    for light in lights:
        for engine, figures in light['derived'].items():
            law = law_of(engine, figures)
            if law is None:
                continue
            seen.add((light['name'], engine))
            worst, flux = worst_and_flux(law)
            says = stated(figures['substituted'])
            print(f"{light['name']:9s}{engine:9s} {worst:5.2f} % {flux:+6.2f} % | says {says[0]} % {says[1]:+} %")
            # Two digits of it.
            assert abs(says[0] - worst) < 0.06 + 0.05 * worst, (light['name'], engine, worst, says)
            assert abs(says[1] - flux) < 0.06 + 0.05 * abs(flux), (light['name'], engine, flux, says)
            if engine == 'godot':
                assert worst < 1.8 and abs(flux) < 1.8, (worst, flux)  # the last degree of the cosine
                assert figures['spot_angle'] < 90.0  # at which versions of it cull wrongly
    assert seen >= {(name, engine) for name in ('disk', 'rect', 'sizeless') for engine in ('gltf', 'godot', 'filament')}
    assert ('sizeless', 'pbrt') in seen and ('sizeless', 'mitsuba') in seen, seen


def checked_against_readings(folder):
    """A panel read 75 degrees off its axis, exported and read back."""
    rows = [(2.0, 0), (3.0, 0), (4.0, 0), (3.0, 20), (3.0, 40), (3.0, 60), (3.0, 75)]
    with open(folder + '/session.toml', 'w') as out:
        out.write('lightcal = 1\nname = "off"\n[room]\ndark = true\n[[light]]\nname = "r"\nkind = "rect"\n'
                  'size_m = [0.3, 0.3]\n')
        for d, angle in rows:
            lux = 700.0 * math.cos(math.radians(angle)) / d ** 2
            out.write(f'[[reading]]\nlight = "r"\ndistance_m = {d}\noff_axis_deg = {angle}\nilluminance_lx = {lux:.4f}\n')
    for words in (('fit', folder, '-o', folder + '/light.json'),
                  ('export', folder + '/light.json', '--to', 'godot', '-o', folder),
                  ('check', folder + '/light.tscn', '--session', folder, '--max-error', '3%')):
        done = run(*words)
        assert done.returncode == 0, (words, done.stdout, done.stderr)
    print(done.stdout)


with tempfile.TemporaryDirectory() as at:
    stated_errors(at)
    checked_against_readings(at)
