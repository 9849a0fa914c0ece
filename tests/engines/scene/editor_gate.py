#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Unreal's script and Unity's importer in a person's scene, by strict stand-ins of the public API that
keep the scene between runs; and the files of all the other targets by their text.
  editor_gate.py LIGHTCAL [unittest arguments]"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
STATIC = os.path.join(HERE, os.pardir, 'static')
sys.path.insert(0, STATIC)
import golden_lights
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
