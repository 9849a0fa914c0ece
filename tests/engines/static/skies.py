#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A panorama of six coloured sides, calibrated by `dome`, through the scripts for Unreal and Unity, run on
stand-ins of their documented names: the lux and colour of a white card that faces six ways, by each engine's
own published law of how it lights with a picture, against integrals of the panorama's formula. Neither engine ran.
  skies.py LIGHTCAL"""
import html
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, '..', 'render'))
import image_based_schema  # noqa: E402
import panorama  # noqa: E402
import unreal_stand_in as unreal  # noqa: E402

LIGHTCAL = os.path.abspath(sys.argv[1])
BAR, TINT = .01, .01
# ours, and where each engine has it
WAYS = list(panorama.WAYS)
UNITIES = {'Unity 2022': [], 'Unity 6': ['UNITY_6000_0_OR_NEWER'],
           'Unity 6, HDRP 17.3': ['UNITY_6000_0_OR_NEWER', 'HDRP_17_3']}
FAILURES = []


def radiance(path):
    """[height, width, 3] of a Radiance picture, packed."""
    with open(path, 'rb') as f:
        while True:
            line = f.readline().split()
            if line and line[0] == b'-Y':
                height, width = int(line[1]), int(line[3])
                break
        data, at = f.read(), 0
    pixels = np.zeros((height, width, 4))
    for row in pixels:
        assert data[at:at + 2] == b'\2\2'
        at += 4
        for channel in range(4):
            x = 0
            while x < width:
                count, at = data[at], at + 1
                run = count > 128
                count -= 128 * run
                row[x:x + count, channel] = data[at] if run else list(data[at:at + count])
                x, at = x + count, at + (1 if run else count)
    return pixels[..., :3] * np.exp2(pixels[..., 3:] - 136)


def unreal_irradiance(component, picture):
    """By TextureCompressorModule.cpp: a direction's column is (1 + atan2(x, -y)/pi)/2, its row acos(z)/pi,
    in Unreal's left-handed world; SkyLightComponent: black from below unless told otherwise."""
    held = component.captured
    height, width, _ = picture.shape
    zenith = np.pi * (np.arange(height) + 0.5) / height
    at = 2 * np.pi * ((np.arange(width) + 0.5) / width) - np.pi  # atan2(x, -y)
    z, a = np.meshgrid(zenith, at, indexing='ij')
    world = np.stack([np.sin(z) * np.sin(a), -np.sin(z) * np.cos(a), np.cos(z)], -1)
    turn = math.radians(held['source_cubemap_angle'])
    assert turn == 0.0
    edges = np.cos(np.pi * np.arange(height + 1) / height)
    omega = (edges[:-1] - edges[1:])[:, None] * 2 * np.pi / width
    light = picture * held['intensity']
    if held['lower_hemisphere_is_black']:
        light = np.where(world[..., 2:] < 0, 0.0, light)
    out = {}
    for way, n in panorama.WAYS.items():
        facing = np.array([n[0], -n[1], n[2]], float)
        out[way] = np.einsum('yx,yx,yxc->c', np.maximum(0, world @ facing), omega + 0 * z, light)
    return out


def compare(who, got, want, sun):
    errors = {}
    for way in WAYS:
        e = panorama.luminance(got[way]) / panorama.luminance(want[way]) - 1
        tint = max(abs(a / sum(got[way]) - b / sum(want[way])) for a, b in zip(got[way], want[way]))
        errors[way] = e
        if not abs(e) < BAR or not tint < TINT:
            FAILURES.append(f'{who}: {way} {e:+.2%}, tint {tint:.2%}')
    print(f'{who:20}' + '  '.join(f'{w} {e:+.2%}' for w, e in errors.items()) + f'  beside {sun}')


def through_unreal(folder, want):
    path = f'{folder}/light.unreal.py'
    script = open(path).read()
    spawned, warnings = unreal.run(script, path)
    FAILURES.extend('Unreal: ' + w for w in warnings)
    skies = [a.root for a, _, _ in spawned if isinstance(a.root, unreal.SkyLightComponent)]
    suns = [a for a, _, _ in spawned if isinstance(a, unreal.DirectionalLight)]
    if len(skies) != 1 or len(suns) != 1:
        FAILURES.append(f'Unreal: {len(skies)} sky lights and {len(suns)} suns')
        return
    if skies[0].captured['source_type'] is not unreal.SkyLightSourceType.SLS_SPECIFIED_CUBEMAP:
        FAILURES.append('Unreal: the sky light captures the scene')
    picture = radiance(f'{folder}/light-{panorama_name(folder)}.hdr')
    compare('Unreal', unreal_irradiance(skies[0], picture), want, 'the sun')
    # What the engine does by default is seen as wrong: nothing comes from below.
    dark = dict(skies[0].captured, lower_hemisphere_is_black=True)
    skies[0].captured = dark
    down = panorama.luminance(unreal_irradiance(skies[0], picture)['down'])
    if down > 0.01 * panorama.luminance(want['down']):
        FAILURES.append('Unreal: the stand-in does not see a black lower hemisphere')
    if 'SkyLight' in open(f'{folder}/light.t3d').read():
        FAILURES.append('Unreal: a .t3d brings no picture')
    # Run again it replaces its own; a sky light of the person's is named.
    scene = unreal.Scene()
    unreal.run_in(scene, script, path)
    other = unreal.SkyLight()
    other.set_actor_label('Their sky')
    scene.levels[scene.open].append((other, {}, {}))
    unreal.run_in(scene, script, path)
    own = [a for a in scene.actors() if isinstance(a.root, unreal.SkyLightComponent)]
    if len(own) != 2 or not any('Their sky' in w for w in scene.warnings):
        FAILURES.append(f'Unreal: run again there are {len(own)} sky lights, said {scene.warnings}')


def panorama_name(folder):
    return [f for f in os.listdir(folder) if f.endswith('.hdr')][0][len('light-'):-len('.hdr')]


def unity(folder, defines, pipeline):
    out = f'{folder}/run.exe'
    subprocess.run(['mcs', '-warnaserror+', '-nowarn:649,660,661', *[f'-define:{d}' for d in defines], f'-out:{out}',
                    f'{HERE}/unity_stand_in.cs', f'{HERE}/unity_pipelines.cs', f'{folder}/LightcalImporter.cs'],
                   check=True)
    done = subprocess.run(['mono', out, f'{folder}/light.unity.json', pipeline], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)
    return [line.split('\t') for line in done.stdout.splitlines()]


def through_unity(folder, want):
    # Unity's axes: right, up, forward.
    order = ['right', 'left', 'up', 'down', 'front', 'back']
    for who, defines in UNITIES.items():
        rows = unity(folder, defines, 'hdrp')
        FAILURES.extend(f'{who}: {row[0]}' for row in rows if row[0].startswith('said'))
        skies = [row for row in rows if row[0] == 'sky']
        suns = [row for row in rows if row[0] == 'light']
        if len(skies) != 1 or len(suns) != 1 or skies[0][1:5] != ['Lux', 'RGBAHalf', 'True', '0']:
            FAILURES.append(f'{who}: {[row[:5] for row in rows]}')
            continue
        values = [float(v) for v in skies[0][5:]]
        compare(who, {way: values[3 * i:3 * i + 3] for i, way in enumerate(order)}, want, suns[0][1])
    rows = unity(folder, [], 'urp')
    said = [row[0] for row in rows if row[0].startswith('said')]
    above = [row for row in rows if row[0] == 'light' and row[1] == 'environment']
    if any(row[0] == 'sky' for row in rows) or sum(row[0] == 'light' for row in rows) != 2 or len(above) != 1:
        FAILURES.append(f'URP: {rows}')
    # A light from above, of the picture's lux on a plane that faces up: exposure/pi times it; and it is said.
    preset = json.load(open(f'{folder}/light.unity.json'))
    lamp = next(lamp for lamp in preset['lights'] if lamp['name'] == 'environment')
    shown = float(above[0][3]) * lamp['color_luminance'] * math.pi / preset['exposure']['scale']
    if above[0][2] != 'Directional' or abs(shown / lamp['upward_lx'] - 1) > 1e-3:
        FAILURES.append(f'URP: {above} for {lamp["upward_lx"]} lx')
    if len(said) != 1 or 'from above' not in said[0] or 'HDRP' not in said[0]:
        FAILURES.append(f'URP says {said}')
    rows = unity(folder, [], 'built-in')
    if len(rows) != 1 or 'built-in' not in rows[0][0] or 'URP' not in rows[0][0]:
        FAILURES.append(f'built-in: {rows}')
    os.rename(f'{folder}/light-{panorama_name(folder)}.hdr', f'{folder}/moved.picture')
    rows = unity(folder, [], 'hdrp')
    if not any('beside the .unity.json' in row[0] for row in rows):
        FAILURES.append('Unity: a missing picture is not said')


def basis(d):
    x, y, z = d
    return [0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
            0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)]


def through_report(work, truth):
    """The report of the place with its sun left inside: six ways by each engine's law, the picture's own integral or
    nine harmonics of it (Ramamoorthi and Hanrahan 2001), which are worked out here."""
    up = panorama.luminance([a + b for a, b in zip(*truth['up'])])
    panorama.run(LIGHTCAL, 'dome', f'{work}/place.hdr', '--lux', repr(up), '--clip', panorama.DRAWN,
                 '--extract', '0', '-o', f'{work}/inside', '--quiet')
    panorama.run(LIGHTCAL, 'report', f'{work}/inside/light.json', '-o', f'{work}/report.html', '--quiet')
    text = open(f'{work}/report.html', encoding='utf-8').read()
    table = text[text.index('six ways</h3>'):]
    rows = {}
    for row in re.findall(r'<tr>(.*?)</tr>', table[:table.index('</table>')], re.S):
        name, *cells = [html.unescape(re.sub('<[^>]*>', '', c)).replace('\u00a0', ' ').replace('\u2212', '-')
                        for c in re.findall(r'<t[hd][^>]*>(.*?)</t[hd]>', row, re.S)]
        rows[name] = cells
    harmonics = [0.0] * 9
    for d, omega in panorama.directions(256):
        value = omega * panorama.luminance(panorama.sky(d))
        for i, b in enumerate(basis(d)):
            harmonics[i] += value * b
    for i, b in enumerate(basis(panorama.sun_direction())):
        harmonics[i] += panorama.SUN_LUX * b
    bands = [math.pi] + [2 * math.pi / 3] * 3 + [math.pi / 4] * 5
    ways = rows['a card facing'][:6]
    for n, way in enumerate(ways):
        whole = panorama.luminance([a + b for a, b in zip(*truth[way])])
        nine = sum(h * k * b for h, k, b in zip(harmonics, bands, basis(panorama.WAYS[way])))
        for name, cells in rows.items():
            if name == 'a card facing':
                continue
            if name == 'the picture':
                off, bar = float(cells[n].split()[0]) / whole - 1, .01
            else:
                off = float(cells[n].split()[0]) / 100 - (nine / whole - 1 if 'harmonics' in cells[6] else 0.0)
                bar = .01 if 'harmonics' in cells[6] else 1e-9
            if not abs(off) <= bar:
                FAILURES.append(f'report, {name}, {way}: {off:+.2%}')
    if len(rows) != 11 or 'not run' not in rows['Unreal Engine'][6] or 'not run' in rows['Blender'][6]:
        FAILURES.append(f'report: {rows}')
    print('report: down, by nine harmonics', rows['Unreal Engine'][1])


def main():
    truth = panorama.irradiance()
    want = {way: truth[way][0] for way in WAYS}  # the sky's alone: the sun stands beside it
    with tempfile.TemporaryDirectory() as work:
        panorama.write_panorama(f'{work}/place.hdr')
        up = panorama.luminance([a + b for a, b in zip(*truth['up'])])
        panorama.run(LIGHTCAL, 'dome', f'{work}/place.hdr', '--lux', repr(up), '--clip', panorama.DRAWN,
                     '--extract', '1', '-o', f'{work}/dome', '--quiet')
        out = f'{work}/dome/out'
        panorama.run(LIGHTCAL, 'export', f'{work}/dome/light.json', '--to', 'unreal,unity,gltf', '-o', out, '--quiet')
        if image_based_schema.check(json.load(open(f'{out}/light.gltf'))) != 1:
            FAILURES.append('glTF: no image based light')
        through_unreal(out, want)
        through_unity(out, want)
        through_report(work, truth)
    for failure in FAILURES:
        print('FAILED ' + failure)
    sys.exit(1 if FAILURES else 0)


main()
