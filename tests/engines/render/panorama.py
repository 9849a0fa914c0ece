#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A panorama of six coloured sides with a sun, calibrated by `dome`, exported, and rendered: the lux and the
colour of a white card that faces each of six ways, against integrals of the panorama's own formula written
here. With the sun as a light of its own; with --inside also left inside, and by three's own blur: printed
beside it, as no bar is set for what nine harmonics make of a sun.
  panorama.py --lightcal BINARY --modules NODE_FOLDER [--work FOLDER] [--engines a,b] [--inside]
Exits 1 when a bar is missed."""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

import gate

# cd/m2, by the way a side lies, and linear Rec. 709.
SIDES = [((1, 0, 0), 1.0, (1.0, 0.3, 0.2)), ((-1, 0, 0), 0.5, (0.2, 1.0, 0.3)), ((0, 1, 0), 0.2, (0.3, 0.4, 1.0)),
         ((0, -1, 0), 0.1, (1.0, 1.0, 0.2)), ((0, 0, 1), 0.8, (0.6, 0.8, 1.0)), ((0, 0, -1), 0.05, (0.9, 0.6, 0.4))]
NITS = 3000.0
SUN_AZIMUTH, SUN_ELEVATION, SUN_RADIUS, SUN_LUX = 60.0, 35.0, 1.0, 4000.0
SUN_COLOR = (1.0, 0.85, 0.6)
WAYS = {'up': (0, 0, 1), 'down': (0, 0, -1), 'front': (0, 1, 0), 'right': (1, 0, 0), 'back': (0, -1, 0),
        'left': (-1, 0, 0)}
# Where a mirror looks: no turn and no reflection of the picture shows the same.
MIRRORS = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)] + [
    tuple(v / math.sqrt(14) for v in d) for d in ((3, 2, -1), (-1, 3, 2), (2, -3, -1), (-2, -1, 3))]
MIRROR_BAR = .05  # of the brightest channel there: a mirror's lobe over soft edges, 8 bits
LUMINANCE = (0.212639, 0.715169, 0.072192)
BARS = {'blender': .003, 'three': .02, 'babylon_gltf': .02, 'filament': .02}
CHROMA, SUN_DEGREES = .01, .3
WIDTH = 512
DRAWN = '1e9'  # from where samples would be clipped: the flat sun was drawn, not cut off


def sun_direction():
    a, e = math.radians(SUN_AZIMUTH), math.radians(SUN_ELEVATION)
    return (math.sin(a) * math.cos(e), math.cos(a) * math.cos(e), math.sin(e))


def sky(d):
    """Soft edges: the fourth power of the cosine to each side, as shares of one."""
    weights = [max(0.0, sum(x * y for x, y in zip(d, way))) ** 4 for way, _, _ in SIDES]
    total = sum(weights)
    return [sum(w * v * c[k] for w, (_, v, c) in zip(weights, SIDES)) / total * NITS for k in range(3)]


def sun_nits(d):
    cosine = sum(a * b for a, b in zip(d, sun_direction()))
    return 1.0 if cosine >= math.cos(math.radians(SUN_RADIUS)) else 0.0


def directions(width):
    height = width // 2
    for y in range(height):
        zenith = math.pi * (y + 0.5) / height
        omega = 2 * math.pi / width * (math.cos(math.pi * y / height) - math.cos(math.pi * (y + 1) / height))
        for x in range(width):
            azimuth = 2 * math.pi * ((x + 0.5) / width - 0.5)
            yield (math.sin(zenith) * math.sin(azimuth), math.sin(zenith) * math.cos(azimuth),
                   math.cos(zenith)), omega


def irradiance():
    """{way: ([r, g, b] of the sky, [r, g, b] of the sun)}"""
    out = {way: [0.0, 0.0, 0.0] for way in WAYS}
    for d, omega in directions(256):
        rgb = sky(d)
        for way, n in WAYS.items():
            cosine = sum(a * b for a, b in zip(d, n))
            if cosine > 0:
                for k in range(3):
                    out[way][k] += omega * cosine * rgb[k]
    y = sum(a * b for a, b in zip(LUMINANCE, SUN_COLOR))
    sun = lambda n: max(0.0, sum(a * b for a, b in zip(n, sun_direction()))) * SUN_LUX / y
    return {way: (out[way], [sun(WAYS[way]) * c for c in SUN_COLOR]) for way in WAYS}


def luminance(rgb):
    return sum(a * b for a, b in zip(LUMINANCE, rgb))


def rgbe(rgb):
    top = max(rgb)
    mantissa, exponent = math.frexp(top)
    return [min(255, int(math.ldexp(v, 8 - exponent))) for v in rgb] + [exponent + 128]


def write_panorama(path):
    """Truncated, as Radiance writes; every pixel of the sun by its share of the disc."""
    pixels, covered = [], 0.0
    sub = [(i + 0.5) / 4 - 0.5 for i in range(4)]
    height = WIDTH // 2
    shares = []
    for number, (d, omega) in enumerate(directions(WIDTH)):
        share = 0.0
        if sum(a * b for a, b in zip(d, sun_direction())) > math.cos(math.radians(SUN_RADIUS + 1)):
            y, x = divmod(number, WIDTH)
            for j in sub:
                zenith = math.pi * (y + 0.5 + j) / height
                for i in sub:
                    azimuth = 2 * math.pi * ((x + 0.5 + i) / WIDTH - 0.5)
                    share += sun_nits((math.sin(zenith) * math.sin(azimuth), math.sin(zenith) * math.cos(azimuth),
                                       math.cos(zenith))) / 16
        shares.append(share)
        covered += share * omega
        pixels.append(sky(d))
    nits = SUN_LUX / covered / luminance(SUN_COLOR)
    for pixel, share in zip(pixels, shares):
        for k in range(3):
            pixel[k] += share * nits * SUN_COLOR[k]
    with open(path, 'wb') as f:
        f.write(b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n' % (height, WIDTH))
        f.write(bytes(v for pixel in pixels for v in rgbe(pixel)))


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        sys.exit(' '.join(words) + '\n' + done.stdout + done.stderr)
    return done.stdout


def export(lightcal, work, truth):
    write_panorama(f'{work}/place.hdr')
    up = luminance([a + b for a, b in zip(*truth['up'])])
    for case, taken in (('beside', '1'), ('inside', '0')):
        run(lightcal, 'dome', f'{work}/place.hdr', '--lux', repr(up), '--clip', DRAWN, '--extract', taken, '-o',
            f'{work}/{case}', '--force', '--quiet')
        run(lightcal, 'export', f'{work}/{case}/light.json', '--to',
            'json,gltf,blender,three,filament,mitsuba,pbrt,usd,godot', '--rig', '-o', f'{work}/{case}/out', '--force', '--quiet')


def render(args, work, engine, case, environment=False):
    probes = [{'point': [0.0, 0.0, 0.0], 'normal': list(n)} for n in WAYS.values()]
    if engine == 'filament':
        probes += [{'point': [0.0, 0.0, 0.0], 'normal': list(n), 'mirror': True} for n in MIRRORS]
    path, out = f'{work}/jobs.json', f'{work}/results.json'
    if os.path.exists(out):
        os.remove(out)
    folder = f'{case}/out/light'
    if engine == 'blender':
        jobs = [{'script': f'{work}/{folder}.rig.blender.py', 'probes': probes, 'probe_samples': 1024}]
        command = ['blender', '-b', '--factory-startup', '-P', f'{gate.HERE}/blender_probe.py', '--', path, out]
    else:
        suffix = {'filament': 'filament.json', 'babylon_gltf': 'gltf'}.get(engine, 'three.js')
        jobs = [{'engine': engine, 'module': f'{folder}.rig.{suffix}', 'probes': probes, 'environment': environment,
                 'suns': 1 if case == 'beside' else 0}]
        command = ['node', f'{gate.HERE}/browse.mjs', args.modules, work, path, out]
    with open(path, 'w') as f:
        json.dump(jobs, f)
    done = subprocess.run(command, capture_output=True, text=True)
    if not os.path.exists(out):
        sys.exit(f'{engine}: ' + done.stdout[-2000:] + done.stderr[-2000:])
    result = json.load(open(out))['results'][0]
    if 'lux' not in result:
        sys.exit(f'{engine}: {result}')
    return result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--modules', required=True)
    parser.add_argument('--work')
    parser.add_argument('--engines', default=','.join(BARS))
    parser.add_argument('--inside', action='store_true')
    args = parser.parse_args()
    args.modules = os.path.abspath(args.modules)
    failures = []
    truth = irradiance()
    whole = {way: [a + b for a, b in zip(*truth[way])] for way in WAYS}
    with tempfile.TemporaryDirectory() as temporary:
        work = os.path.abspath(args.work or temporary)
        os.makedirs(work, exist_ok=True)
        export(os.path.abspath(args.lightcal), work, truth)
        sun = json.load(open(f'{work}/beside/light.json'))['lights'][0]
        off = math.degrees(math.acos(min(1.0, -sum(a * b for a, b in zip(sun['aim'], sun_direction())))))
        lux = sun['illuminance_lx']['value']
        print(f'the sun: {off:.3f} degrees off, {lux:.1f} lx of {SUN_LUX:g}')
        if off > SUN_DEGREES:
            failures.append(f'the sun is {off:.2f} degrees off')
        for engine in args.engines.split(','):
            runs = [('beside', False)]
            if args.inside:
                runs += [('inside', False)] + ([('beside', True)] if engine == 'three' else [])
            for case, environment in runs:
                got = render(args, work, engine, case, environment)
                errors, tints = {}, {}
                for way, value, rgb in zip(WAYS, got['lux'], got['rgb']):
                    errors[way] = value / luminance(whole[way]) - 1
                    tints[way] = max(abs(a / sum(rgb) - b / sum(whole[way])) for a, b in zip(rgb, whole[way]))
                where = f'{engine}, sun {case}' + (', by three\'s own blur' if environment else '')
                print(f'{where:40} ' + '  '.join(f'{way} {e:+.2%}' for way, e in errors.items())
                      + f'  tint {max(tints.values()):.2%}')
                if engine == 'filament':
                    mirrored = max(max(abs(a - b) for a, b in zip(rgb, sky(n))) / max(sky(n))
                                   for rgb, n in zip(got['rgb'][len(WAYS):], MIRRORS))
                    print(f'{where:40} ten mirrors show the picture within {mirrored:.2%}')
                    if case == 'beside' and mirrored > MIRROR_BAR:
                        failures.append(f'{where}: a mirror is {mirrored:.2%} off')
                if case == 'inside' or environment:
                    continue  # nine harmonics cannot hold a sun: printed
                for way, e in errors.items():
                    if abs(e) > BARS[engine]:
                        failures.append(f'{where}: {way} {e:+.2%}')
                if engine != 'filament' and max(tints.values()) > CHROMA:
                    failures.append(f'{where}: tint {max(tints.values()):.2%}')
    for failure in failures:
        print('FAILED ' + failure)
    sys.exit(1 if failures else 0)


if __name__ == '__main__':
    main()
