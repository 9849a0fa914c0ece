# SPDX-License-Identifier: Apache-2.0
"""blender -b --factory-startup -P blender_probe.py -- JOBS.json OUT.json
Runs each exported script as a person would, then looks at a small white card where the meter stood.
A job: {"script", "probes": [{point, normal}], "rig_png"?, "rig_exr"?, "exr_bits"?, "percent"?,
"samples"?, "edit"?}; edit is Python that spoils the scene, for tests of `check --render`."""
import json
import math
import os
import pathlib
import runpy
import sys

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from white_face import white_face  # noqa: E402

jobs_path, out_path = sys.argv[sys.argv.index('--') + 1:]
jobs = json.load(open(jobs_path))


def look(scene, point, normal, size, samples=256):
    normal = Vector(normal)
    side = normal.orthogonal().normalized()
    matrix = Matrix.Identity(4)
    for i, column in enumerate((side, normal.cross(side), normal)):
        for row in range(3):
            matrix[row][i] = column[row]
    card = white_face('probe', size / 2)
    card.matrix_world = matrix.copy()
    card.matrix_world.translation = Vector(point)
    camera = bpy.data.cameras.new('probe')
    camera.type = 'ORTHO'
    camera.ortho_scale = size * 0.5
    camera.clip_start = 0.0001
    eye = bpy.data.objects.new('probe', camera)
    eye.matrix_world = matrix.copy()
    eye.matrix_world.translation = Vector(point) + normal * 0.01
    scene.collection.objects.link(card)
    scene.collection.objects.link(eye)
    scene.camera = eye
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.cycles.samples = samples
    path = os.path.join(os.path.dirname(out_path), 'probe.exr')
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth = 'OPEN_EXR', '32'
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True, scene=scene.name)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = 'Non-Color'
    pixels = list(image.pixels)
    mean = [sum(pixels[c::4]) / (len(pixels) // 4) for c in range(3)]
    for thing in (card, eye):
        bpy.data.objects.remove(thing)
    bpy.data.images.remove(image)
    return math.pi * 683.0 * (0.212639 * mean[0] + 0.715169 * mean[1] + 0.072192 * mean[2]), mean


def render_rig(scene, path, job):
    scene.render.resolution_percentage = job.get('percent', 100)
    if 'samples' in job:
        scene.cycles.samples = job['samples']
    settings = scene.render.image_settings
    exr = path.endswith('.exr')
    settings.file_format = 'OPEN_EXR' if exr else 'PNG'
    settings.color_depth = str(job.get('exr_bits', 32)) if exr else '8'
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True, scene=scene.name)


results = []
for job in jobs:
    sys.argv = [job['script']]
    made = runpy.run_path(job['script'], run_name='__main__')
    scene = bpy.data.scenes['lightcal ' + made['PRESET']['name']]
    if 'edit' in job:
        lamps = [thing.data for thing in scene.objects if thing.type == 'LIGHT']
        exec(job['edit'], {'bpy': bpy, 'scene': scene, 'lamps': lamps, 'preset': made['PRESET']})
    for key in ('rig_png', 'rig_exr'):
        if key in job:
            render_rig(scene, job[key], job)
    scene.render.resolution_percentage = 100
    for thing in scene.objects:
        thing.hide_render = thing.type == 'MESH'
    seen = [look(scene, p['point'], p['normal'], 0.02, job.get('probe_samples', 256)) for p in job['probes']]
    results.append({'lux': [lux for lux, _ in seen], 'rgb': [rgb for _, rgb in seen]})
    for other in list(bpy.data.scenes):
        if other.name.startswith('lightcal') and len(bpy.data.scenes) > 1:
            bpy.data.scenes.remove(other)
json.dump({'version': bpy.app.version_string, 'results': results}, open(out_path, 'w'))
