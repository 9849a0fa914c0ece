#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Blender 5.x and Godot 4.6 in a chroot, on the lamps of the render gates. Blender is looked at
through the gates' own probe; Godot renders the exported rig through its own camera to a linear EXR,
whose cards `lightcal check --render` measures.
  unstable_gate.py --lightcal BINARY --root CHROOT"""
import argparse
import json
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, 'engines', 'render'))
import cases
import gate

BARS = {'blender': .005, 'godot': .01}
GODOT_KINDS = ['point', 'spot', 'sun', 'dome']
PROJECT = """config_version=5
[rendering]
lights_and_shadows/use_physical_light_units=true
renderer/rendering_method="forward_plus"
"""
# A SubViewport in half floats, linear: what the camera's locked exposure makes of the luminance.
PROBE = """extends SceneTree
func _initialize():
	render()
func render():
	for job in JSON.parse_string(FileAccess.get_file_as_string("res://jobs.json")):
		var view = SubViewport.new()
		view.size = Vector2i(600, 400)
		view.own_world_3d = true
		view.use_hdr_2d = true
		view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
		root.add_child(view)
		view.add_child(load(job.scene).instantiate())
		for i in 8:
			await process_frame
		await RenderingServer.frame_post_draw
		view.get_texture().get_image().save_exr(job.exr)
		view.queue_free()
		await process_frame
	quit()
"""


def in_chroot(root, *command):
    return subprocess.run(['chroot', root, '/usr/bin/env', 'HOME=/root', 'TERM=dumb', *command],
                          capture_output=True, text=True)


def names(kinds):
    return [(kind, color, f'{kind}_{color}') for kind in kinds for color in cases.COLORS]


def blender(root):
    kinds = names(gate.BARS['blender'])
    jobs = [{'script': f'/work/{n}/out/{n}.rig.blender.py', 'probes': cases.probes(kind)}
            for kind, _, n in kinds]
    with open(f'{root}/work/jobs.json', 'w') as f:
        json.dump(jobs, f)
    shutil.copy(f'{gate.HERE}/blender_probe.py', f'{root}/work/')
    done = in_chroot(root, 'blender', '-b', '--factory-startup', '-P', '/work/blender_probe.py', '--',
                     '/work/jobs.json', '/work/out.json')
    if not os.path.exists(f'{root}/work/out.json'):
        sys.exit('blender: ' + done.stdout[-3000:] + done.stderr[-3000:])
    answer = json.load(open(f'{root}/work/out.json'))
    print('Blender ' + answer['version'])
    for (kind, color, _), result in zip(kinds, answer['results']):
        errors = [got / p['lux'] - 1 for got, p in zip(result['lux'], cases.probes(kind))]
        yield 'blender', kind, color, cases.KINDS[kind][1], result['lux'][0], max(errors, key=abs)


def godot(root, lightcal):
    project = f'{root}/work/project'
    os.makedirs(project, exist_ok=True)
    kinds = names(GODOT_KINDS)
    for _, _, n in kinds:
        shutil.copy(f'{root}/work/{n}/out/{n}.rig.tscn', project)
    for name, text in (('project.godot', PROJECT), ('probe.gd', PROBE), ('jobs.json', json.dumps(
            [{'scene': f'res://{n}.rig.tscn', 'exr': f'/work/{n}.exr'} for _, _, n in kinds]))):
        with open(f'{project}/{name}', 'w') as f:
            f.write(text)
    print('Godot ' + in_chroot(root, 'godot', '--version').stdout.strip())
    done = in_chroot(root, 'timeout', '300', 'xvfb-run', '-a', 'godot', '--path', '/work/project',
                     '--rendering-driver', 'vulkan', '--audio-driver', 'Dummy', '--script', 'probe.gd')
    for kind, color, n in kinds:
        if not os.path.exists(f'{root}/work/{n}.exr'):
            sys.exit('godot: ' + done.stdout[-3000:] + done.stderr[-3000:])
        answer = json.loads(subprocess.run(
            [lightcal, 'check', '--render', f'{root}/work/{n}.exr', '--rig',
             f'{root}/work/{n}/out/{n}.rig.preset.json', '--engine', 'godot', '--json'],
            capture_output=True, text=True, check=True).stdout)
        got, read = answer['illuminance_lx'], answer['expected_lx']
        yield 'godot', kind, color, read, got, got / read - 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--root', required=True)
    args = parser.parse_args()
    lightcal, root = os.path.abspath(args.lightcal), os.path.abspath(args.root)
    shutil.rmtree(f'{root}/work', ignore_errors=True)
    os.makedirs(f'{root}/work')
    gate.export(lightcal, f'{root}/work')
    missed = 0
    for rows in (blender(root), godot(root, lightcal)):
        for engine, kind, color, read, got, error in rows:
            wrong = not abs(error) <= BARS[engine]
            missed += wrong
            print(f'{engine:8} {kind:6} {color:6} read {read:8.2f} lx  got {got:9.3f}  worst {error:+.3%}'
                  + ('  MISSED' if wrong else ''))
    sys.exit(1 if missed else 0)


main()
