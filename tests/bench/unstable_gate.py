#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Blender 5.x and Godot 4.6 in a chroot, on the lamps of the render gates. Blender is looked at
through the gates' own probe; Godot renders the exported rig through its own camera to a linear EXR,
whose cards `lightcal check --render` measures. Then a panorama of six sides, its sun beside it as a light and
left inside: a white card facing six ways in both, against the panorama's own integral (engines/render/panorama.py).
  unstable_gate.py --lightcal BINARY --root CHROOT [--only lamps|panorama]"""
import argparse
import json
import math
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, 'engines', 'render'))
import cases
import gate
import panorama

BARS = {'blender': .005, 'godot': .01}
# Godot lights matt surfaces by the roughest layer of its blurred sky, not by an integral.
AROUND_BARS = {'blender': .003, 'godot': .12}
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


# The rig's camera, its exposure as it is, in front of a white card of ours that faces each way in turn.
AROUND = """extends SceneTree
func _initialize():
	render()
func render():
	var answers = []
	for job in JSON.parse_string(FileAccess.get_file_as_string("res://around.json")):
		var view = SubViewport.new()
		view.size = Vector2i(32, 32)
		view.own_world_3d = true
		view.use_hdr_2d = true
		view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
		root.add_child(view)
		var place = load(job.scene).instantiate()
		view.add_child(place)
		var white = StandardMaterial3D.new()
		white.diffuse_mode = BaseMaterial3D.DIFFUSE_LAMBERT
		white.specular_mode = BaseMaterial3D.SPECULAR_DISABLED
		white.metallic_specular = 0.0
		white.roughness = 1.0
		white.albedo_color = Color(1, 1, 1)
		var card = MeshInstance3D.new()
		card.mesh = QuadMesh.new()
		card.mesh.size = Vector2(0.1, 0.1)
		card.material_override = white
		for thing in place.get_children():
			if thing is MeshInstance3D:
				thing.visible = false
		place.add_child(card)
		var eye = place.get_node("rig camera")
		eye.projection = Camera3D.PROJECTION_ORTHOGONAL
		eye.size = 0.05
		for n in job.normals:
			var normal = Vector3(n[0], n[1], n[2])
			var up = Vector3(0, 1, 0) if abs(normal.y) < 0.9 else Vector3(1, 0, 0)
			card.look_at_from_position(Vector3(0, 0, 0), -normal, up)
			eye.look_at_from_position(normal * 0.3, Vector3(0, 0, 0), up)
			for i in 12:
				await process_frame
			await RenderingServer.frame_post_draw
			var image = view.get_texture().get_image()
			var sum = Vector3(0, 0, 0)
			for y in 16:
				for x in 16:
					var c = image.get_pixel(x + 8, y + 8)
					sum += Vector3(c.r, c.g, c.b) / 256.0
			var to_lux = PI / place.get_meta("exposure")
			answers.append([sum.x * to_lux, sum.y * to_lux, sum.z * to_lux])
		view.queue_free()
		await process_frame
	FileAccess.open("/work/around_out.json", FileAccess.WRITE).store_string(JSON.stringify(answers))
	quit()
"""
CASES = ['beside', 'inside']


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


def blender_around(root):
    probes = [{'point': [0.0, 0.0, 0.0], 'normal': list(n)} for n in panorama.WAYS.values()]
    with open(f'{root}/work/jobs.json', 'w') as f:
        json.dump([{'script': f'/work/around/{case}/out/light.rig.blender.py', 'probes': probes,
                    'probe_samples': 1024} for case in CASES], f)
    shutil.copy(f'{gate.HERE}/blender_probe.py', f'{root}/work/')
    done = in_chroot(root, 'blender', '-b', '--factory-startup', '-P', '/work/blender_probe.py', '--',
                     '/work/jobs.json', '/work/around_out.json')
    if not os.path.exists(f'{root}/work/around_out.json'):
        sys.exit('blender: ' + done.stdout[-3000:] + done.stderr[-3000:])
    results = json.load(open(f'{root}/work/around_out.json'))['results']
    return [[[683 * math.pi * v for v in rgb] for rgb in result['rgb']] for result in results]


def godot_around(root):
    project = f'{root}/work/around_project'
    jobs = []
    for case in CASES:
        os.makedirs(f'{project}/{case}')
        out = f'{root}/work/around/{case}/out'
        for name in os.listdir(out):
            if name.endswith(('.hdr', '.rig.tscn')):
                shutil.copy(f'{out}/{name}', f'{project}/{case}')
        jobs.append({'scene': f'res://{case}/light.rig.tscn',
                     'normals': [[x, z, -y] for x, y, z in panorama.WAYS.values()]})
    for name, text in (('project.godot', PROJECT), ('around.gd', AROUND), ('around.json', json.dumps(jobs))):
        with open(f'{project}/{name}', 'w') as f:
            f.write(text)
    said = ''
    for words in (['--headless', '--import'],
                  ['--rendering-driver', 'vulkan', '--audio-driver', 'Dummy', '--script', 'around.gd']):
        done = in_chroot(root, 'timeout', '300', 'xvfb-run', '-a', 'godot', '--path', '/work/around_project', *words)
        said += done.stdout + done.stderr
    if not os.path.exists(f'{root}/work/around_out.json'):
        sys.exit('godot: ' + said[-3000:])
    answers = json.load(open(f'{root}/work/around_out.json'))
    return [answers[6 * i:6 * i + 6] for i in range(len(CASES))]


def around(root, lightcal):
    truth = panorama.irradiance()
    whole = [[a + b for a, b in zip(*truth[way])] for way in panorama.WAYS]
    os.makedirs(f'{root}/work/around', exist_ok=True)
    panorama.export(lightcal, f'{root}/work/around', truth)
    for engine, run in (('blender', blender_around), ('godot', godot_around)):
        if os.path.exists(f'{root}/work/around_out.json'):
            os.remove(f'{root}/work/around_out.json')
        for case, cards in zip(CASES, run(root)):
            errors = [panorama.luminance(got) / panorama.luminance(want) - 1 for got, want in zip(cards, whole)]
            tint = max(abs(a / sum(got) - b / sum(want)) for got, want in zip(cards, whole)
                       for a, b in zip(got, want))
            print(f'{engine:8} panorama, sun {case:7}' + '  '.join(f'{way} {e:+.2%}' for way, e in zip(
                panorama.WAYS, errors)) + f'  tint {tint:.2%}')
            yield engine, case, max(map(abs, errors)), tint


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--root', required=True)
    parser.add_argument('--only', choices=['lamps', 'panorama'])
    args = parser.parse_args()
    lightcal, root = os.path.abspath(args.lightcal), os.path.abspath(args.root)
    shutil.rmtree(f'{root}/work', ignore_errors=True)
    os.makedirs(f'{root}/work')
    missed = 0
    if args.only != 'lamps':
        for engine, case, worst, tint in around(root, lightcal):
            missed += case == 'beside' and not (worst <= AROUND_BARS[engine] and tint <= panorama.CHROMA)
    if args.only == 'panorama':
        sys.exit(1 if missed else 0)
    gate.export(lightcal, f'{root}/work')
    for rows in (blender(root), godot(root, lightcal)):
        for engine, kind, color, read, got, error in rows:
            wrong = not abs(error) <= BARS[engine]
            missed += wrong
            print(f'{engine:8} {kind:6} {color:6} read {read:8.2f} lx  got {got:9.3f}  worst {error:+.3%}'
                  + ('  MISSED' if wrong else ''))
    sys.exit(1 if missed else 0)


main()
