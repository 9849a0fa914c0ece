#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""<stem>.blender.py run by Blender in a person's scene of 40 objects: what it brings, what it leaves
alone, what a second run and an undo do.
  blender_gate.py LIGHTCAL [unittest arguments]"""
import json
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


if __name__ == '__main__':
    LIGHTCAL = os.path.abspath(sys.argv.pop(1))
    unittest.main()
