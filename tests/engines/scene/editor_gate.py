#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Unreal's script and Unity's importer in a person's scene, by strict stand-ins of the public API that
keep the scene between runs; and the files of all the other targets by their text.
  editor_gate.py LIGHTCAL [unittest arguments]"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
STATIC = os.path.join(HERE, os.pardir, 'static')
sys.path.insert(0, STATIC)
import golden_lights
import read_godot
import unreal_stand_in as unreal

LIGHTCAL = None
NAMES = ['key', 'green spot', 'panel', 'luminaire']


def export(folder, names, *arguments, stem='set', to='unreal'):
    os.makedirs(folder, exist_ok=True)
    lamps = os.path.join(folder, stem + '.json')
    with open(lamps, 'w') as out:
        out.write(golden_lights.light_json(names, (0.5, 1.0)))
    done = subprocess.run([LIGHTCAL, 'export', lamps, '--to', to, '-o', folder, '--json', *arguments],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr + done.stdout
    return json.loads(done.stdout)['files']


def map_file(folder, rows):
    path = folder + '/map.csv'
    with open(path, 'w') as out:
        out.write('lamp,object\n' + ''.join(f'{lamp},{thing}\n' for lamp, thing in rows))
    return path


def stage():
    """A person's level: a tone-mapped volume, a camera, lights of their own."""
    scene = unreal.Scene()
    for number in range(12):
        actor = (unreal.PointLight, unreal.SpotLight, unreal.RectLight)[number % 3]()
        actor.set_actor_label('PropLamp_%d' % number)
        for name, value in (('intensity', 8.0 + number), ('light_color', unreal.Color(b=9, g=8, r=7, a=255)),
                            ('intensity_units', unreal.LightUnits.LUMENS), ('use_temperature', False),
                            ('temperature', 6500.0), ('attenuation_radius', 1000.0)):
            actor.root.set_editor_property(name, value)
        scene.levels[scene.open].append((actor, dict(x=1.0 * number, y=0.0, z=2.0), dict(roll=0.0, pitch=0.0, yaw=0.0)))
    for made in (unreal.DirectionalLight(), unreal.PostProcessVolume(), unreal.CameraActor()):
        made.set_actor_label('mine ' + type(made).__name__)
        made.set_editor_property('tags', [unreal.Name('hero')])
        scene.levels[scene.open].append((made, dict(x=0.0, y=0.0, z=0.0), dict(roll=0.0, pitch=0.0, yaw=0.0)))
    return scene


def plain(value):
    if isinstance(value, unreal.Struct):
        return sorted(value.values.items())
    if isinstance(value, unreal.Enum):
        return value.name
    if isinstance(value, list):
        return [plain(v) for v in value]
    if isinstance(value, unreal.Name):
        return str(value)
    if isinstance(value, unreal.TextureLightProfile):
        return 'profile ' + os.path.basename(value.file)
    if isinstance(value, unreal.Object):
        return {k: plain(v) for k, v in sorted(value.held.items())}
    return value


def picture(scene, level=None):
    """Label -> all that is held of each actor."""
    rows = scene.levels[level or scene.open]
    return sorted((actor.label, type(actor).__name__, repr(at), repr(turn),
                   repr({k: plain(v) for k, v in sorted(actor.held.items())}),
                   repr({k: plain(v) for k, v in sorted(actor.root.held.items())}))
                  for actor, at, turn in rows)


def run_unreal(scene, path):
    with open(path) as script:
        unreal.run_in(scene, script.read(), path)


class Unreal(unittest.TestCase):
    def test_a_rerun_replaces_its_own_lights_and_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            export(folder, NAMES)
            scene = stage()
            before = picture(scene)
            run_unreal(scene, folder + '/set.unreal.py')
            once = picture(scene)
            self.assertEqual(len(once), len(before) + len(NAMES))
            self.assertEqual([row for row in once if row in before], before)
            self.assertEqual({row[1] for row in once if row not in before},
                             {'PointLight', 'SpotLight', 'RectLight'})
            run_unreal(scene, folder + '/set.unreal.py')
            self.assertEqual(picture(scene), once)
            # Another session's stand beside them; a lamp that is gone from the file goes.
            export(folder, NAMES[:1], stem='other')
            run_unreal(scene, folder + '/other.unreal.py')
            self.assertEqual(len(picture(scene)), len(once) + 1)
            export(folder, NAMES[:2])
            run_unreal(scene, folder + '/set.unreal.py')
            self.assertEqual(len(picture(scene)), len(before) + 3)
            self.assertEqual(scene.warnings + scene.errors, [])
            # Each run is one step of the editor's undo.
            self.assertEqual(scene.transactions, ['lightcal set'] * 2 + ['lightcal other', 'lightcal set'])

    def test_the_rig_opens_a_level_of_its_own_and_loses_no_work(self):
        with tempfile.TemporaryDirectory() as folder:
            export(folder, NAMES, '--rig')
            scene = stage()
            before = picture(scene)
            scene.unsaved = ['/Game/Stage']
            run_unreal(scene, folder + '/set.rig.unreal.py')
            self.assertEqual(picture(scene), before)
            self.assertIn('/Game/Stage has changes that are not saved', scene.errors[0])
            scene.unsaved = []
            run_unreal(scene, folder + '/set.rig.unreal.py')
            self.assertEqual(scene.open, '/Game/lightcal/set_rig')
            self.assertEqual(picture(scene, '/Game/Stage'), before)
            rig = picture(scene)
            self.assertEqual(len(rig), len(NAMES) + 4)
            run_unreal(scene, folder + '/set.rig.unreal.py')
            self.assertEqual(picture(scene), rig)


class UnrealInto(unittest.TestCase):
    def set_lights(self, scene, names, into, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            export(folder, names, '--into', map_file(folder, into), *arguments)
            self.assertFalse(os.path.exists(folder + '/set.t3d'))
            run_unreal(scene, folder + '/set.unreal.py')

    def test_only_the_named_lights_change_and_none_is_made(self):
        scene = stage()
        before, made = picture(scene), scene.spawned_in_all
        rows = [('key', 'PropLamp_0'), ('key', 'PropLamp_1?'), ('green spot', 'PropLamp_4'), ('panel', 'PropLamp_5')]
        self.set_lights(scene, NAMES, rows)
        after = picture(scene)
        named = {'PropLamp_0', 'PropLamp_10', 'PropLamp_11', 'PropLamp_4', 'PropLamp_5'}
        self.assertEqual({b[0] for b, a in zip(before, after) if a != b}, named)
        self.assertEqual([row[:4] for row in before], [row[:4] for row in after])  # nothing moved
        self.assertEqual((scene.spawned_in_all, scene.transactions), (made, ['lightcal set']))
        held = {actor.label: actor.root.held for actor in scene.actors()}
        self.assertIs(held['PropLamp_4']['intensity_units'], unreal.LightUnits.CANDELAS)
        for label, candela in (('PropLamp_0', 1000.0), ('PropLamp_11', 1000.0)):
            self.assertAlmostEqual(held[label]['intensity'], candela, delta=0.5)  # its square centimetre
            self.assertTrue(held[label]['use_temperature'])
        self.assertAlmostEqual(held['PropLamp_4']['inner_cone_angle'], 15.0, delta=1e-9)
        self.assertAlmostEqual(held['PropLamp_4']['outer_cone_angle'], 25.0, delta=1e-9)
        self.assertEqual((held['PropLamp_5']['source_width'], held['PropLamp_5']['source_height']), (60.0, 30.0))
        self.assertEqual(len([line for line in scene.log if ' -> ' in line]), 5)
        self.assertIn('intensity 8 LUMENS', scene.log[0])
        # Every light that changed was told to the undo first.
        self.assertEqual({a.label for a in scene.actors() if getattr(a.root, 'modified', 0)}, named)
        self.set_lights(scene, NAMES, rows)
        self.assertEqual(picture(scene), after)

    def test_a_photometric_file_comes_and_goes_with_the_lamp(self):
        scene = stage()
        self.set_lights(scene, NAMES, [('luminaire', 'PropLamp_3')])
        held = {actor.label: actor.root.held for actor in scene.actors()}
        self.assertIsNotNone(held['PropLamp_3']['ies_texture'])
        self.set_lights(scene, NAMES, [('key', 'PropLamp_3')])
        self.assertIsNone(held['PropLamp_3']['ies_texture'])

    def test_a_cone_that_was_there_cuts_no_lamp_of_another_class(self):
        scene = stage()
        for actor in scene.actors():
            if isinstance(actor.root, unreal.SpotLightComponent):
                actor.root.set_editor_property('inner_cone_angle', 0.0)
                actor.root.set_editor_property('outer_cone_angle', 22.0)
            if isinstance(actor.root, unreal.RectLightComponent):
                actor.root.set_editor_property('barn_door_length', 20.0)
        rows = [('key', 'PropLamp_1'), ('luminaire', 'PropLamp_4'), ('panel', 'PropLamp_7'), ('key', 'PropLamp_2'),
                ('panel', 'PropLamp_3'), ('green spot', 'PropLamp_6')]
        self.set_lights(scene, NAMES, rows)
        held = {actor.label: actor.root.held for actor in scene.actors()}
        for label, inner in (('PropLamp_1', 88.9), ('PropLamp_4', 88.9),  # the engine's widest
                             ('PropLamp_7', math.degrees(math.acos(2 * math.sqrt(2) - 2)))):  # nearest to a cosine
            self.assertAlmostEqual(held[label]['inner_cone_angle'], inner, delta=1e-6, msg=label)
            self.assertAlmostEqual(held[label]['outer_cone_angle'], 88.9, delta=1e-6, msg=label)
        self.assertEqual(held['PropLamp_2']['barn_door_length'], 0.0)
        for row, said in zip(rows, ('dark beyond 88.9 degrees', 'dark beyond 88.9 degrees', 'within 17 %',
                                    'right on the axis alone', 'right on the axis alone', 'right on the axis alone')):
            self.assertTrue([w for w in scene.warnings if row[1] + ' ' in w and said in w and row[0] in w],
                            (row, scene.warnings))
        self.assertEqual(len(scene.warnings), len(rows))

    def test_it_refuses_as_a_whole_and_says_what_to_do(self):
        for rows, said in (([('key', 'PropLamp_0'), ('key', 'Chandelier_*')],
                            'no light of the level is called "Chandelier_*"; it has PropLamp_0, PropLamp_1,'),
                           ([('key', 'PropLamp_*'), ('panel', 'PropLamp_2')],
                            '"PropLamp_2" would get two lamps, "key" and "panel"'),
                           ([('key', 'mine Dir*')], 'is directional, and "key" was measured in candela')):
            scene = stage()
            before = picture(scene)
            self.set_lights(scene, NAMES, rows)
            self.assertEqual(picture(scene), before)
            self.assertIn(said, '\n'.join(scene.errors))
            self.assertEqual(scene.transactions, [])


def run_unity(folder, pipeline, files, defines=()):
    """[{has, said, log, undo, untold}] after each import, the first before any."""
    out = folder + '/scene.exe'
    subprocess.run(['mcs', '-warnaserror+', '-nowarn:649,660,661', '-main:PersonsScene', *[f'-define:{d}' for d in defines],
                    f'-out:{out}', f'{STATIC}/unity_stand_in.cs', f'{STATIC}/unity_pipelines.cs',
                    f'{HERE}/unity_scene.cs', f'{folder}/LightcalImporter.cs'], check=True)
    done = subprocess.run(['mono', out, pipeline, *files], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    states = [{'has': [], 'said': [], 'log': [], 'undo': [], 'untold': []} for _ in range(len(files) + 1)]
    for line in done.stdout.splitlines():
        kind, step, text = line.split('\t', 2)
        states[int(step)][kind].append(text)
    return states


class Unity(unittest.TestCase):
    VERSIONS = ((), ('UNITY_6000_0_OR_NEWER',))

    def test_a_rerun_replaces_its_own_lights_and_the_rig_opens_a_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            export(folder, NAMES, '--rig', to='unity')
            export(folder, NAMES[:1], to='unity', stem='other')
            lights, rig, other = (folder + '/' + n + '.unity.json' for n in ('set', 'set.rig', 'other'))
            for defines in self.VERSIONS:
                start, once, twice, beside, rigged = run_unity(
                    folder, 'hdrp', [lights, lights, other, rig], defines)
                self.assertEqual(once['has'][:len(start['has'])], start['has'])
                self.assertEqual(len(once['has']), len(start['has']) + 1 + len(NAMES))
                self.assertEqual(twice['has'], once['has'])
                self.assertEqual(len(beside['has']), len(once['has']) + 2)
                self.assertFalse([line for line in rigged['has'] if line.startswith('PropLamp')])
                self.assertEqual(len(rigged['has']), 1 + len(NAMES) + 4)
                for state in (once, twice, beside, rigged):
                    self.assertEqual((state['said'], state['untold'], len(state['undo'])), ([], [], 1))

    def test_into_sets_the_named_lights_alone(self):
        rows = [('key', 'PropLamp_0'), ('key', 'PropLamp_1?'), ('green spot', 'PropLamp_4'), ('panel', 'PropLamp_5')]
        named = {'PropLamp_0', 'PropLamp_10', 'PropLamp_11', 'PropLamp_4', 'PropLamp_5'}
        with tempfile.TemporaryDirectory() as folder:
            export(folder, NAMES, '--into', map_file(folder, rows), to='unity')
            path = folder + '/set.unity.json'
            for pipeline in ('hdrp', 'urp'):
                for defines in self.VERSIONS:
                    start, once, twice = run_unity(folder, pipeline, [path, path], defines)
                    self.assertEqual({b.split()[0] for b, a in zip(start['has'], once['has']) if a != b}, named)
                    self.assertEqual(len(once['has']), len(start['has']))
                    self.assertEqual(twice['has'], once['has'])
                    self.assertEqual((once['untold'], once['undo']), ([], ['lightcal set']))
                    self.assertEqual(len([line for line in once['log'] if ' -> ' in line]), len(named))
                    # A light's type becomes the lamp's, or its old cone would cut it.
                    types = {l.split()[0]: l.split()[7] for l in once['has'] if l.startswith('PropLamp_')}
                    self.assertEqual([types[n] for n in ('PropLamp_0', 'PropLamp_10', 'PropLamp_11', 'PropLamp_4',
                                                         'PropLamp_5')],
                                     ['Point'] * 3 + ['Spot', 'Rectangle' if pipeline == 'hdrp' else 'Spot'])
                    if pipeline == 'hdrp':
                        # 1000 cd of a 2700 K lamp by a colour of luminance .517.
                        self.assertIn('Candela', [l for l in once['has'] if l.startswith('PropLamp_11 ')][0] +
                                      ''.join(l for l in once['log'] if ' PropLamp_11:' in l))
                        self.assertRegex([l for l in once['log'] if ' PropLamp_0:' in l][0],
                                         r'intensity .* -> Point, intensity 193[45][.0-9]* Candela')

    def test_into_refuses_as_a_whole(self):
        for rows, said in (([('key', 'PropLamp_0'), ('key', 'Chandelier_*')],
                            'no light of the scene is called "Chandelier_*"; it has PropLamp_0, PropLamp_1,'),
                           ([('key', 'PropLamp_*'), ('panel', 'PropLamp_2')],
                            '"PropLamp_2" would get two lamps, "key" and "panel"'),
                           ([('key', 'Sun')], '"Sun" is Directional, and "key" was measured in candela')):
            with tempfile.TemporaryDirectory() as folder:
                export(folder, NAMES, '--into', map_file(folder, rows), to='unity')
                start, after = run_unity(folder, 'hdrp', [folder + '/set.unity.json'])
                self.assertEqual(after['has'], start['has'])
                self.assertIn(said, '\n'.join(after['said']))
                self.assertEqual(after['undo'], [])


class Godot(unittest.TestCase):
    """The tool script holds the very figures of our own .tscn, and names no property that has not."""

    def test_it(self):
        with tempfile.TemporaryDirectory() as folder:
            export(folder, NAMES[:2] + ['sun'], to='godot')
            rows = [('key', 'PropLamp_*'), ('green spot', 'Spot'), ('sun', 'Sun')]
            export(folder, NAMES + ['sun'], '--into', map_file(folder, rows), '--force', to='godot')
            with open(folder + '/set.godot.gd') as f:
                script = f.read()
            with open(folder + '/set.tscn') as f:
                nodes = {head['name']: (head['type'], values) for kind, head, values in read_godot.sections(f.read())
                         if kind == 'node' and 'type' in head}
        data = json.JSONDecoder().raw_decode(script[script.index('{', script.index('const DATA')):])[0]
        self.assertEqual(data['into'], [{'lamp': lamp, 'object': thing} for lamp, thing in rows])
        self.assertEqual({lamp['name'] for lamp in data['lights']}, {'key', 'green spot', 'sun'})
        for lamp in data['lights']:
            kind, values = nodes[lamp['name']]
            self.assertEqual(kind, lamp['type'])
            for name in set(lamp) & set(values) - {'light_color'}:
                self.assertEqual(float(values[name]), lamp[name], name)
            if 'candela' in lamp:
                lumens = lamp['candela'] * math.pi * 4
                if kind == 'SpotLight3D':  # its shader takes no rim below 1e-4, on the axis either
                    lumens /= 4 * (1 - 1e-4 ** (1 / lamp['spot_angle_attenuation']))
                self.assertAlmostEqual(lumens / float(values['light_intensity_lumens']), 1.0, delta=1e-12)
        known = {name for _, values in nodes.values() for name in values} | {'light_energy'}
        for name in re.findall(r'\["(\w+)", ', script):
            self.assertIn(name, known)
        for suffix in re.findall(r'prefix \+ "(\w+)"', script):
            self.assertLessEqual({'omni' + suffix, 'spot' + suffix}, known)
        # A lamp that shines all round takes the widest spot, not the cone that was there.
        self.assertIn('lamp.get("spot_angle", 89.0)', script)
        self.assertNotIn('light.spot_angle', script)
        self.assertNotIn('add_child', script)
        self.assertNotIn('position', script)


class Refusals(unittest.TestCase):
    """Said before anything is written: what, where, what to do."""

    def refused(self, names, rows, target, code, *words):
        with tempfile.TemporaryDirectory() as folder:
            into = rows if isinstance(rows, str) else map_file(folder, rows)
            with open(folder + '/set.json', 'w') as out:
                out.write(golden_lights.light_json(names))
            done = subprocess.run([LIGHTCAL, 'export', folder + '/set.json', '--to', target, '--into', into,
                                   '-o', folder + '/out', '--json'], capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            error = json.loads(done.stdout)['error']
            self.assertEqual(error['code'], code)
            for word in words:
                self.assertIn(word, error['subject'] + ' ' + error['message'])
            self.assertFalse(os.path.exists(folder + '/out'))

    def test_them(self):
        self.refused(NAMES, 'PropLamp_*', 'unreal', 'into_many_lamps', 'PropLamp_*', '4 lamps', 'map.csv')
        self.refused(NAMES, [('kye', 'PropLamp_1')], 'unreal', 'into_unknown_lamp', 'did you mean "key"?')
        self.refused(NAMES, [('key', 'A'), ('panel', 'A')], 'unity', 'into_two_lamps', 'A', 'key and panel')
        self.refused(NAMES, [('key', '')], 'unity', 'into_map', 'line 2', 'lamp,object')
        self.refused(['sky'], 'World*', 'blender', 'into_no_light', 'light from all around')
        self.refused(['key'], 'Lamp', 'unreal,gltf', 'into_unsupported', 'gltf', '--into', 'blender')
        self.refused(['key'], 'Prop_*', 'usd', 'into_path', '/World/Lamps/Key')


class Text(unittest.TestCase):
    """What a rig has, the lights alone have not; and --bare is what is done anyway."""
    WORDS = {'gltf': ('set.gltf', ('"meshes"', '"cameras"')), 'usd': ('set.usda', ('card_0', 'def Camera', 'def Material')),
             'godot': ('set.tscn', ('WorldEnvironment', 'Camera3D', 'MeshInstance3D', 'CameraAttributes')),
             'mitsuba': ('set.mitsuba.xml', ('<sensor', '<integrator', '<bsdf')),
             'pbrt': ('set.pbrt', ('WorldBegin', 'Camera', 'Film', 'Material')),
             'blender': ('set.blender.py', ('"rig": {',)), 'three': ('set.three.js', ('"rig": {',)),
             'filament': ('set.filament.json', ('"rig": {',)), 'unity': ('set.unity.json', ('"cards"', '"camera"')),
             'unreal': ('set.unreal.py', ('"rig": {',))}

    def test_it(self):
        with tempfile.TemporaryDirectory() as folder:
            for target, (name, words) in self.WORDS.items():
                with self.subTest(target):
                    plain_files = export(folder + '/plain', NAMES, to=target)
                    files = export(folder + '/rig', NAMES, '--rig', to=target)
                    export(folder + '/bare', NAMES, '--bare', to=target)
                    rig = name.replace('set.', 'set.rig.')
                    self.assertEqual([f.replace('/rig/', '/plain/') for f in files if not f.endswith(rig)], plain_files)
                    texts = {}
                    for way in ('plain', 'rig', 'bare'):
                        with open(f'{folder}/{way}/{name}', newline='') as f:
                            texts[way] = f.read()
                    with open(f'{folder}/rig/{rig}', newline='') as f:
                        whole = f.read()
                    self.assertEqual(texts['plain'], texts['rig'])
                    self.assertEqual(texts['plain'], texts['bare'])
                    for word in words:
                        self.assertIn(word, whole)
                        self.assertNotIn(word, texts['plain'])


if __name__ == '__main__':
    LIGHTCAL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
