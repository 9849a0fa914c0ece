#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""<stem>.blender.py run by Blender in a person's scene of 40 objects: what it brings, what it leaves
alone, what a second run and an undo do.
  blender_gate.py LIGHTCAL [unittest arguments]"""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, 'static'))
import golden_lights

LIGHTCAL = None
NAMES = ['key', 'green spot', 'panel', 'luminaire', 'sky']


def export(folder, names, *arguments, stem='set'):
    lamps = os.path.join(folder, stem + '.json')
    with open(lamps, 'w') as out:
        out.write(golden_lights.light_json(names, (0.5, 1.0)))
    done = subprocess.run([LIGHTCAL, 'export', lamps, '--to', 'blender', '-o', folder, '--json', *arguments],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr + done.stdout
    return os.path.join(folder, stem + '.blender.py')


def blender(folder, *steps):
    job, out = os.path.join(folder, 'job.json'), os.path.join(folder, 'out.json')
    with open(job, 'w') as f:
        json.dump({'steps': list(steps)}, f)
    done = subprocess.run(['blender', '-b', '--factory-startup', '-P', HERE + '/blender_probe.py', '--', job, out],
                          capture_output=True, text=True)
    assert os.path.exists(out), done.stdout[-3000:] + done.stderr[-3000:]
    with open(out) as f:
        answer = json.load(f)
    os.remove(out)
    return answer['states'], answer['logs']


def changed(before, after):
    """Names of the datablocks that are new, gone or other."""
    return {name for name in before.keys() | after.keys() if before.get(name) != after.get(name)}


class LightsAlone(unittest.TestCase):
    def test_they_come_into_the_open_scene_are_replaced_by_a_rerun_and_undone_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            first = export(folder, NAMES)
            fewer = export(os.path.join(folder), NAMES[:2], stem='other')
            os.makedirs(folder + '/less')
            again = export(folder + '/less', NAMES[1:3])
            rig = export(folder, NAMES, '--rig').replace('.blender', '.rig.blender')
            states, logs = blender(
                folder, {'run': first}, {'run': first}, {'run': fewer}, {'run': again}, {'undo': True},
                {'undo': True}, {'run': rig}, {'run': rig})
        start, once, twice, beside, less, undone, all_undone, rigged, rigged_again = states
        made = changed(start, once)
        # The scene itself lists one collection more, and that is all.
        self.assertEqual({name for name in made if name in start},
                         {'collections:Scene Collection', 'scenes:Scene'} & made)
        self.assertEqual({n for n in made if n.startswith('objects:')},
                         {'objects:' + name for name in NAMES[:-1]})
        self.assertEqual(json.loads(once['scenes:Scene'])['world'], 'World')
        for name in ('view_settings', 'render', 'camera', 'cycles', 'display_settings'):
            self.assertEqual(json.loads(start['scenes:Scene']).get(name), json.loads(once['scenes:Scene']).get(name))
        self.assertEqual(changed(once, twice), set())
        # Another session's lamps of the same names stand beside them.
        self.assertEqual({n for n in changed(twice, beside) if n.startswith('objects:')},
                         {'objects:key.001', 'objects:green spot.001'})
        # Lamps that are gone from the file go; others are the other session's.
        self.assertEqual({n for n in changed(beside, less) if n.startswith('objects:') and n not in less},
                         {'objects:key', 'objects:luminaire'})
        self.assertEqual(changed(beside, undone), set())
        self.assertIn('4 lights in "Scene"', logs[1])
        self.assertIn('has one of its own', logs[1])
        for name in start:
            if name != 'scenes:Scene':
                self.assertEqual(start[name], less[name], name)
        # The rig opens a scene of its own, once.
        new = changed(all_undone, rigged)
        self.assertIn('scenes:lightcal set.rig', new)
        self.assertEqual(new & set(all_undone), set())
        self.assertEqual(changed(rigged, rigged_again), set())


class SceneUnits(unittest.TestCase):
    def test_a_scene_in_centimetres_shows_the_same_light(self):
        """E = P/(4 pi d^2) in the scene's own units: a hundred times as far, ten thousand times the watts."""
        names = ['key', 'green spot', 'panel', 'luminaire', 'sun']
        centimetres = "bpy.context.scene.unit_settings.scale_length = 0.01"
        with tempfile.TemporaryDirectory() as folder:
            path = export(folder, names)
            metres, _ = blender(folder, {'run': path})
            (_, _, small), logs = blender(folder, {'edit': centimetres}, {'run': path})
        for name in names:
            there, here = json.loads(metres[1]['lights:' + name]), json.loads(small['lights:' + name])
            times = 1.0 if name == 'sun' else 1e4
            self.assertAlmostEqual(float(here['energy']) / float(there['energy']) / times, 1.0, delta=1e-4, msg=name)
            for side in ('size', 'size_y', 'shadow_soft_size') if name in ('key', 'panel') else ():
                if side in there and (side == 'shadow_soft_size') == (name == 'key'):
                    self.assertAlmostEqual(float(here[side]), 100 * float(there[side]), delta=1e-3, msg=name)
            for x, y in zip(json.loads(metres[1]['objects:' + name])['location'].strip('[]').split(','),
                            json.loads(small['objects:' + name])['location'].strip('[]').split(',')):
                self.assertAlmostEqual(float(y), 100 * float(x), delta=1e-3, msg=name)
        self.assertIn('has 100 units a metre', logs[-1])


class Domes(unittest.TestCase):
    def test_export_says_that_a_scenes_own_world_stays(self):
        for names, said in ((NAMES, True), (NAMES[:-1], False)):
            with tempfile.TemporaryDirectory() as folder:
                lamps = os.path.join(folder, 'set.json')
                with open(lamps, 'w') as out:
                    out.write(golden_lights.light_json(names, (0.5, 1.0)))
                done = subprocess.run([LIGHTCAL, 'export', lamps, '--to', 'blender', '-o', folder],
                                      capture_output=True, text=True, check=True)
                self.assertEqual('choose "lightcal set" in World properties' in done.stdout + done.stderr, said)


class Into(unittest.TestCase):
    """Lights that are there, by name: nothing is made, nothing moves, nothing else changes."""
    ROWS = [('key', 'PropLamp_0'), ('key', 'PropLamp_1?'), ('green spot', 'PropLamp_4'), ('panel', 'PropLamp_5'),
            ('luminaire', 'PropLamp_3'), ('sun', 'Fill_12')]
    NAMED = {'PropLamp_0', 'PropLamp_10', 'PropLamp_11', 'PropLamp_4', 'PropLamp_5', 'PropLamp_3', 'Fill_12'}

    def script(self, folder, rows, names=('key', 'green spot', 'panel', 'luminaire', 'sun')):
        with open(folder + '/map.csv', 'w') as out:
            out.write(''.join(f'{lamp},{thing}\n' for lamp, thing in rows))
        return export(folder, list(names), '--into', folder + '/map.csv')

    def test_only_the_named_lights_change_twice_the_same_and_an_undo_restores_them(self):
        with tempfile.TemporaryDirectory() as folder:
            path = self.script(folder, self.ROWS)
            states, logs = blender(folder, {'run': path}, {'undo': True}, {'run': path}, {'run': path})
        start, once, undone, again, twice = states
        self.assertEqual(sum(name.startswith('objects:') for name in start), 40)
        self.assertEqual(changed(start, once), {'lights:' + name for name in self.NAMED} | {'texts:PropLamp_3.ies'})
        self.assertEqual((changed(once, again), changed(once, twice)), (set(), set()))
        self.assertEqual(changed(start, undone), set())  # one step
        lamp = {name: json.loads(once['lights:' + name]) for name in self.NAMED}
        watts = {name: float(one['energy']) for name, one in lamp.items()}
        y = 0.51677  # luminance of the 2700 K lamp's colour, its largest component 1
        self.assertAlmostEqual(watts['PropLamp_0'] * 683 * y / (4 * math.pi), 1000.0, delta=1.0)
        self.assertEqual({json.loads(once['lights:' + name])['type'] for name in ('PropLamp_10', 'PropLamp_11')},
                         {"'POINT'"})  # were a SPOT and an AREA
        self.assertAlmostEqual(watts['PropLamp_11'], watts['PropLamp_0'], delta=0.01)
        self.assertAlmostEqual(watts['PropLamp_10'], watts['PropLamp_0'], delta=0.01)
        self.assertAlmostEqual(float(lamp['PropLamp_5']['size']), 0.6, delta=1e-6)
        self.assertEqual(len([line for line in logs[1].splitlines() if ' -> ' in line]), len(self.NAMED))
        self.assertIn('PropLamp_0: POINT, 40 W, colour 0.900 0.800 0.100', logs[1])
        self.assertIn('PropLamp_3: shone all round, and shines along its -Z now', logs[1])

    def test_it_refuses_as_a_whole_and_says_what_to_do(self):
        share = "bpy.data.objects['PropLamp_3'].data = bpy.data.objects['PropLamp_0'].data"
        cases = (
            ([('key', 'PropLamp_0'), ('key', 'Chandelier_*')],
             'no light of the scene "Scene" is called "Chandelier_*"; it has PropLamp_0, PropLamp_1,'),
            ([('key', 'Table_*')], 'no light of the scene "Scene" is called "Table_*"'),
            ([('key', 'PropLamp_*'), ('panel', 'PropLamp_2')], '"PropLamp_2" would get two lamps, "key" and "panel"'),
            ([('key', 'Fill_12')], '"Fill_12" is a SUN, and "key" was measured in candela'),
            ([('key', 'PropLamp_0')], 'shares its light with "PropLamp_3"'),  # from here on it does
            ([('key', 'PropLamp_0'), ('panel', 'PropLamp_3')], 'gets another lamp'))
        with tempfile.TemporaryDirectory() as folder:
            steps = []
            for number, (rows, _) in enumerate(cases):
                os.makedirs(f'{folder}/{number}')
                steps += [{'edit': share if number == 4 else ''}, {'run': self.script(f'{folder}/{number}', rows)}]
            states, logs = blender(folder, *steps)
        for number, (rows, said) in enumerate(cases):
            self.assertEqual(changed(states[2 * number + 1], states[2 * number + 2]), set(), rows)
            self.assertIn(said, logs[2 * number + 2])
            self.assertIn('nothing set', logs[2 * number + 2])


def spot_law(inner, outer):
    """t^2 of the cosine between two half angles."""
    high, low = math.cos(math.radians(inner)), math.cos(math.radians(outer))
    return lambda c: min(max((c - low) / (high - low), 0.0), 1.0) ** 2


class IntoWhateverIsThere(unittest.TestCase):
    """A lamp onto a light of any type, size and cone shows that lamp: rendered on a floor below it."""
    # By the cosine from the axis, over the axial intensity; the last is what the engine's own cone
    # may stray by (README of presets, off the axis).
    LAWS = {'key': (lambda c: 1.0, 0.01), 'globe': (lambda c: 1.0, 0.01), 'panel': (lambda c: c, 0.01),
            'luminaire': (lambda c: c ** 8, 0.01), 'green spot': (spot_law(15.0, 25.0), 0.07)}
    HEIGHT = 4.0  # six times the largest lamp

    def rendered(self, height, pairs):
        """[({lamp, type}, [[x, lux] ...]) ...] of (lamp, type of the light that is there)."""
        with tempfile.TemporaryDirectory() as folder:
            jobs = []
            for name, kind in pairs:
                os.makedirs(f'{folder}/{name}', exist_ok=True)
                script = export(f'{folder}/{name}', [name], '--into', 'Prop', '--force')
                jobs.append({'script': script, 'type': kind, 'lamp': name})
            with open(folder + '/jobs.json', 'w') as out:
                json.dump({'height': height, 'jobs': jobs}, out)
            done = subprocess.run(['blender', '-b', '--factory-startup', '-P', HERE + '/into_probe.py', '--',
                                   folder + '/jobs.json', folder + '/out.json'], capture_output=True, text=True)
            self.assertTrue(os.path.exists(folder + '/out.json'), done.stdout[-3000:] + done.stderr[-3000:])
            with open(folder + '/out.json') as f:
                return list(zip(jobs, json.load(f)))

    def test_a_sphere_close_by_is_what_the_note_says_of_this_version(self):
        """Before 4.0 a disc that faces each point, I/(d^2 + r^2); from then on I/d^2."""
        height, globe = 0.3, golden_lights.LAMPS['globe']
        said = subprocess.run(['blender', '--version'], capture_output=True, text=True).stdout
        disc = int(said.split()[1].split('.')[0]) < 4
        (_, row), = self.rendered(height, [('globe', 'POINT')])
        square = height ** 2 + ((globe['diameter'] / 2) ** 2 if disc else 0.0)
        self.assertAlmostEqual(row[0][1] / (globe['cd'] / square), 1.0, delta=0.01)

    def test_every_lamp_onto_every_type(self):
        pairs = [(name, kind) for name in self.LAWS for kind in ('POINT', 'SPOT', 'AREA')]
        for job, row in self.rendered(self.HEIGHT, pairs):
            law, tolerance = self.LAWS[job['lamp']]
            axial = golden_lights.LAMPS[job['lamp']]['cd']
            self.assertGreater(len(row), 8)
            for x, lux in row:
                slant = math.hypot(x, self.HEIGHT)
                cosine = self.HEIGHT / slant
                candela = lux * slant ** 2 / cosine
                self.assertAlmostEqual(candela / axial, law(cosine), delta=tolerance,
                                       msg=f"{job['lamp']} onto a {job['type']}, {math.degrees(math.acos(cosine)):.0f} deg")


if __name__ == '__main__':
    LIGHTCAL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
