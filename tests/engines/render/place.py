#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The README's place: a panorama and one lux reading through `dome` and `export`, then a chrome ball and an 18 %
grey one in it, as Blender Cycles and three.js show the exported files, at the rig's exposure. Under each
the lux of its upward card.
  place.py --lightcal BINARY --modules NODE_FOLDER -o PLACE.png [--panorama FILE] [--lux 420]
Inside Blender it is run with the arguments SCRIPT OUT.png."""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
# Ours: +Y front, +Z up, metres.
EYE, TARGET, FIELD_DEG = (0.0, -4.6, 0.35), (0.0, 0.0, 0.0), 32.0
BALLS = [((-0.85, 0.0, 0.0), 0.72, True), ((0.85, 0.0, 0.0), 0.72, False)]
WIDTH, HEIGHT = 600, 400


def in_blender(script, out):
    import bpy
    import runpy
    from mathutils import Vector
    sys.argv = [script]
    made = runpy.run_path(script, run_name='__main__')
    scene = bpy.data.scenes['lightcal ' + made['PRESET']['name']]
    for thing in list(scene.objects):
        if thing.type == 'MESH':
            bpy.data.objects.remove(thing)
    for at, radius, chrome in BALLS:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius=radius, location=at)
        ball = bpy.context.object
        for other in list(ball.users_collection):
            other.objects.unlink(ball)
        scene.collection.objects.link(ball)
        for face in ball.data.polygons:
            face.use_smooth = True
        material = bpy.data.materials.new('ball')
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        surface = tree.nodes.new('ShaderNodeBsdfGlossy' if chrome else 'ShaderNodeBsdfDiffuse')
        value = 0.95 if chrome else 0.18
        surface.inputs['Color'].default_value = (value, value, value, 1)
        if chrome:
            surface.inputs['Roughness'].default_value = 0.0
        output = tree.nodes.new('ShaderNodeOutputMaterial')
        tree.links.new(surface.outputs[0], output.inputs[0])
        ball.data.materials.append(material)
    camera = scene.camera
    camera.location = EYE
    camera.rotation_euler = (Vector(TARGET) - Vector(EYE)).to_track_quat('-Z', 'Y').to_euler()
    camera.data.sensor_fit = 'VERTICAL'
    camera.data.angle = math.radians(FIELD_DEG)
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.resolution_percentage = 100
    scene.cycles.samples = 128
    scene.render.image_settings.file_format = 'PNG'
    scene.render.filepath = out
    bpy.ops.render.render(write_still=True, scene=scene.name)


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        sys.exit(' '.join(words) + '\n' + done.stdout[-2000:] + done.stderr[-2000:])
    return done.stdout


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--lightcal', required=True)
    parser.add_argument('--modules', required=True)
    parser.add_argument('-o', '--output', required=True)
    parser.add_argument('--panorama', default='sample_data/pictures/latlong/lobby.hdr')
    parser.add_argument('--lux', default='420')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        # The README's lines.
        run(args.lightcal, 'dome', args.panorama, '--lux', args.lux, '--extract', '3', '-o', f'{work}/place')
        run(args.lightcal, 'export', f'{work}/place/light.json', '--to', 'blender,three,json', '--rig', '-o',
            f'{work}/engine')
        run('blender', '-b', '--factory-startup', '-P', os.path.abspath(__file__), '--',
            f'{work}/engine/light.rig.blender.py', f'{work}/cycles.png')
        balls = [{'at': at, 'radius': radius, 'chrome': chrome} for at, radius, chrome in BALLS]
        up = [{'point': [0, 0, 0], 'normal': [0, 0, 1]}]
        jobs = [{'engine': 'three', 'module': 'engine/light.rig.three.js', 'png': f'{work}/three.png', 'probes': up,
                 'balls': balls, 'view': {'eye': EYE, 'target': TARGET, 'field_deg': FIELD_DEG}}]
        with open(f'{work}/jobs.json', 'w') as f:
            json.dump(jobs, f)
        run('node', f'{HERE}/browse.mjs', os.path.abspath(args.modules), work, f'{work}/jobs.json', f'{work}/out.json')
        three = json.load(open(f'{work}/out.json'))['results'][0]
        if 'lux' not in three:
            sys.exit(str(three))
        with open(f'{work}/probe.json', 'w') as f:
            json.dump([{'script': f'{work}/engine/light.rig.blender.py', 'probes': up, 'probe_samples': 512}], f)
        run('blender', '-b', '--factory-startup', '-P', f'{HERE}/blender_probe.py', '--', f'{work}/probe.json',
            f'{work}/probed.json')
        cycles = json.load(open(f'{work}/probed.json'))['results'][0]
        print(f'upward: Cycles {cycles["lux"][0]:.1f} lx, three.js {three["lux"][0]:.1f} lx of {args.lux}')
        tile = lambda name, title, lux: (
            f'<td><img src="file://{work}/{name}.png"><div><b>{title}</b> &nbsp; a card facing up: {lux:.0f} lx; the '
            f'meter read {args.lux}</div></td>')
        with open(f'{work}/place.html', 'w') as f:
            f.write('<!doctype html><meta charset="utf-8"><style>body{font:14px sans-serif;margin:8px;width:948px}'
                    'img{width:464px;display:block;margin-bottom:4px}</style><table><tr>'
                    + tile('cycles', 'Blender Cycles', cycles['lux'][0])
                    + tile('three', 'three.js', three['lux'][0]) + '</tr></table>')
        run('node', f'{HERE}/screenshot.mjs', os.path.abspath(args.modules), f'{work}/place.html',
            os.path.abspath(args.output))


if __name__ == '__main__':
    if '--' in sys.argv:
        in_blender(*sys.argv[sys.argv.index('--') + 1:])
    else:
        main()
