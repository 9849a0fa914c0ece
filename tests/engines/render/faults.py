#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`check --render` on pictures of the rig that Cycles, three.js and Filament rendered with a known
mistake in them: the lux it prints and the cause it names.
  faults.py --lightcal BINARY --modules NODE_FOLDER [--work FOLDER]"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

import gate
import panorama

ALL_LAMPS = 'for l in lamps: l.energy *= '
EACH = 'built.lights.forEach((l, i) => { %s });'
Y = 'preset.lights[i].measured.color_luminance'
PI = math.pi
# (engine, lamp, picture, edit, cause, factor or None where no factor describes it)
FAULTS = [
    ('blender', 'point_2700K', 'exr16', ALL_LAMPS + "preset['lights'][0]['measured']['color_luminance']",
     'missing_luminance_division', 'Y'),
    ('blender', 'rect_6500K', 'exr32', ALL_LAMPS + '3.14159265', 'times_pi', PI),
    ('blender', 'axial_green', 'exr16', ALL_LAMPS + '683 / 177.83', 'lumens_per_watt_683_for_177',
     683 / 177.83),
    ('blender', 'point_green', 'png', 'scene.view_settings.exposure -= 1.37', 'exposure_unlocked',
     2 ** -1.37),
    ('blender', 'spot_6500K', 'png', "scene.view_settings.view_transform = 'Filmic'", 'tone_mapped',
     None),
    ('three', 'spot_6500K', 'exr', EACH % 'l.decay = 1', 'falloff_1_over_d', 2.0),
    ('three', 'point_2700K', 'exr', EACH % f'l.intensity *= {Y}', 'missing_luminance_division', 'Y'),
    ('three', 'spot_green', 'png',
     EACH % 'l.color.setRGB(...preset.lights[i].color, THREE.SRGBColorSpace)', 'color_read_as_srgb',
     'decoded'),
    ('three', 'sun_6500K', 'png', EACH % 'l.intensity /= Math.PI', 'over_pi', 1 / PI),
    ('three', 'point_green', 'exr', EACH % 'l.power = l.intensity', 'candela_as_lumens', 1 / (4 * PI)),
    ('filament', 'spot_6500K', 'png',
     'preset.lights.forEach((l) => { l.inner_rad *= 2; l.outer_rad *= 2; })', 'full_cone_for_half',
     (1 - math.cos(math.radians(25))) / (1 - math.cos(math.radians(50)))),
    ('filament', 'point_2700K', 'png',
     'preset.lights.forEach((l) => { l.intensity_lm *= l.measured.color_luminance; })',
     'missing_luminance_division', 'Y'),
    ('blender', 'dome_2700K', 'exr16', '', 'none', 1.0),
    ('blender', 'ies_green', 'png', '', 'none', 1.0),
    ('blender', 'dome_2700K', 'png', '', 'none', 1.0),
    ('blender', 'point_2700K', 'png', '', 'none', 1.0),
    ('three', 'point_2700K', 'png', '', 'none', 1.0),
    ('three', 'rect_green', 'exr', '', 'none', 1.0),
    ('filament', 'sun_6500K', 'png', '', 'none', 1.0),
]
# In Cycles, cards off the axis and facing four ways beside those of the rig: (rigs, edit, cause, words, turn)
CONE = ("import math\nci, co = math.cos(math.radians(15)), math.cos(math.radians(25))\n"
        "for l in lamps:\n    l.spot_size, l.spot_blend = math.radians(50), (ci - co) / (1 - co)")
TURN = ("node = [n for n in scene.world.node_tree.nodes if n.type == 'MAPPING'][0]\n"
        "node.inputs['%s'].default_value[%d] %s")
TOGETHER = [
    ('spot', CONE, 'other_cone_law', 'Cycles before 4.0', None),
    ('spot', '', 'cone_as_exported', 'Cycles before 4.0', None),
    ('set', '', 'none', 'key, fill, rim', None),
    ('set', "for l in lamps:\n    if 'rim' in l.name: l.energy *= 3.14159265", 'times_pi', 'rim gives 3.14', None),
    ('place', '', 'none', '', None),
    ('place', TURN % ('Rotation', 2, '+= 3.14159265 / 2'), 'panorama_turned', '', 90),
    ('place', TURN % ('Scale', 0, '= -1.0'), 'panorama_mirrored', '', 0),
]
LUX_BAR = {'blender': .005, 'three': .005, 'filament': .02}


def decoded_luminance(color):
    weights = (0.212639, 0.715169, 0.072192)
    decode = lambda v: v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4
    plain = sum(w * v for w, v in zip(weights, color))
    return sum(w * decode(v) for w, v in zip(weights, color)) / plain


def render(args, work):
    jobs = {}
    for number, (engine, lamp, kind, edit, _, _) in enumerate(FAULTS):
        picture = f'{work}/fault{number}.' + ('png' if kind == 'png' else 'exr')
        job = {'probes': [], 'edit': edit}
        if engine == 'blender':
            job |= {'script': f'{work}/{lamp}/out/{lamp}.rig.blender.py', 'percent': 50, 'samples': 32,
                    'exr_bits': 16 if kind == 'exr16' else 32,
                    ('rig_png' if kind == 'png' else 'rig_exr'): picture}
        else:
            suffix = 'filament.json' if engine == 'filament' else 'three.js'
            job |= {'engine': engine, 'module': f'{lamp}/out/{lamp}.rig.{suffix}',
                    ('png' if kind == 'png' else 'exr'): picture}
        jobs.setdefault(engine, []).append(job)
    for engine, rows in jobs.items():
        path = f'{work}/faults_{engine}.json'
        with open(path, 'w') as f:
            json.dump(rows, f)
        command = (['blender', '-b', '--factory-startup', '-P', f'{gate.HERE}/blender_probe.py', '--',
                    path, f'{work}/out.json'] if engine == 'blender' else
                   ['node', f'{gate.HERE}/browse.mjs', args.modules, work, path, f'{work}/out.json'])
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def together(args, work):
    """What did not come out as TOGETHER has it."""
    lines = {'spot': ['--rig-at', '18', '--rig-at', '21.5/90'], 'set': ['--rig-at', 'fill', '--rig-at', 'rim'],
             'place': ['--rig-at', '90', '--rig-at', '90/90', '--rig-at', '90/180']}
    sources = {'spot': f'{work}/spot_6500K/out/light.json', 'place': f'{work}/beside/light.json',
               'set': f'{work}/set.json'}
    with open(sources['set'], 'w') as f:
        json.dump({'schema': 'lightcal.light/1', 'lights': [
            {'name': name, 'kind': 'point', 'position_m': where, 'effects': [], 'color': {'xy': [0.3127, 0.3290]},
             'intensity_cd': {'value': candela, 'u95': 1},
             'fit': {'readings': 1, 'used': 1, 'rejected': [], 'learned': [], 'prior': []}}
            for name, where, candela in (('key', [0, 0, 3], 900), ('fill', [4, 1, 2.5], 300),
                                         ('rim', [-3, 5, 2], 60))]}, f)
    truth = panorama.irradiance()
    panorama.export(args.lightcal, work, truth)
    jobs, rigs = [], {}
    for name, words in lines.items():
        out = f'{work}/off_{name}'
        subprocess.run([args.lightcal, 'export', sources[name], '--to', 'blender,json', '--spots', 'cone', '--rig',
                        *words, '-o', out, '--force', '--quiet'], check=True, stdout=subprocess.DEVNULL)
        rigs[name] = sorted(file for file in os.listdir(out) if '.rig' in file and file.endswith('.preset.json'))
    for number, (name, edit, *_) in enumerate(TOGETHER):
        for rig in rigs[name]:
            jobs.append({'script': f'{work}/off_{name}/' + rig.replace('.preset.json', '.blender.py'), 'probes': [],
                         'percent': 30, 'samples': 64, 'exr_bits': 32, 'edit': edit,
                         'rig_exr': f'{work}/off_{name}/{number}_{rig}.exr'})
    with open(f'{work}/together.json', 'w') as f:
        json.dump(jobs, f)
    subprocess.run(['blender', '-b', '--factory-startup', '-P', f'{gate.HERE}/blender_probe.py', '--',
                    f'{work}/together.json', f'{work}/together_out.json'], check=True, stdout=subprocess.DEVNULL)
    failures = []
    for number, (name, _, cause, word, turn) in enumerate(TOGETHER):
        words = [w for rig in rigs[name] for w in ('--render', f'{work}/off_{name}/{number}_{rig}.exr', '--rig',
                                                   f'{work}/off_{name}/{rig}')]
        done = subprocess.run([args.lightcal, 'check', *words, '--engine', 'blender', '--json'], capture_output=True,
                              text=True)
        said = json.loads(done.stdout).get('cause', {'code': done.stdout, 'message': ''})
        print(f'Cycles, {len(rigs[name])} pictures of {name}: {cause:20} said {said["code"]} '
              f'{said.get("turn_deg", "")}')
        off = 0 if turn is None else (said.get('turn_deg', 999) - turn + 180) % 360 - 180
        if said['code'] != cause or word not in said['message'] or abs(off) > 2:
            failures.append(f'{name}, {cause}: {said}')
    return failures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--modules', required=True)
    parser.add_argument('--work')
    args = parser.parse_args()
    failures, right, faulty = [], 0, 0
    with tempfile.TemporaryDirectory() as temporary:
        work = os.path.abspath(args.work or temporary)
        os.makedirs(work, exist_ok=True)
        args.lightcal = os.path.abspath(args.lightcal)
        gate.export(args.lightcal, work)
        render(args, work)
        failures += together(args, work)
        for number, (engine, lamp, kind, edit, cause, factor) in enumerate(FAULTS):
            picture = f'{work}/fault{number}.' + ('png' if kind == 'png' else 'exr')
            rig = f'{work}/{lamp}/out/{lamp}.rig.preset.json'
            done = subprocess.run([args.lightcal, 'check', '--render', picture, '--rig', rig,
                                   '--engine', engine, '--json'], capture_output=True, text=True)
            answer = json.loads(done.stdout)
            if 'cause' not in answer:
                failures.append(f'{engine} {lamp} {cause}: {answer}')
                continue
            color = json.load(open(rig))['lights'][0]['color']['rec709_linear']
            factor = {'Y': color['luminance_of_max_normalised'],
                      'decoded': decoded_luminance(color['max_normalised'])}.get(factor, factor)
            named = answer['cause']['code'] == cause
            faulty += bool(edit)
            right += bool(edit) and named
            error = (answer['illuminance_lx'] / (answer['expected_lx'] * factor) - 1) if factor else None
            print(f'{engine:9}{lamp:12}{kind:6}{cause:28} said {answer["cause"]["code"]:28}'
                  f'{answer["illuminance_lx"]:9.2f} lx' + (f' {error:+.3%}' if factor else ''))
            if not edit and not named:
                failures.append(f'{engine} {lamp}: nothing is wrong, but it says {answer["cause"]}')
            if factor and abs(error) > LUX_BAR[engine]:
                failures.append(f'{engine} {lamp} {cause}: lux off by {error:+.3%}')
    print(f'{right} of {faulty} causes named')
    if faulty < 12 or right < faulty - 1:
        failures.append(f'{right} of {faulty} causes named')
    for failure in failures:
        print('FAILED ' + failure)
    sys.exit(1 if failures else 0)


main()
