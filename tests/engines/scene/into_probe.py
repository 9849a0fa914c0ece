# SPDX-License-Identifier: Apache-2.0
"""blender -b --factory-startup -P into_probe.py -- JOBS.json OUT.json
{"height", "jobs": [{"script", "type"}]} -> [[[x, lux] ...] ...]: a light "Prop" of that type, with all
that a person may have set on it, hangs above a white floor and looks down; the script sets it; what the
floor then shows along x, in lux."""
import json
import math
import os
import pathlib
import runpy
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from white_face import white_face  # noqa: E402

jobs_path, out_path = sys.argv[sys.argv.index('--') + 1:]
asked = json.load(open(jobs_path))
PIXELS, ROWS, SIDE = 24, 5, 2.4 * asked['height']  # to 50 degrees; fewer rows Blender does not render


def a_persons_light(kind):
    """Whatever shapes it, set to something else."""
    lamp = bpy.data.lights.new('Prop', kind)
    lamp.energy = 10.0
    if kind == 'AREA':
        lamp.shape, lamp.size, lamp.size_y, lamp.spread = 'ELLIPSE', 3.0, 1.0, math.radians(30)
        lamp.cycles.is_portal = True
    else:
        lamp.shadow_soft_size = 1.5
    if kind == 'SPOT':
        lamp.spot_size, lamp.spot_blend, lamp.use_square = math.radians(20), 0.15, True
    lamp.use_nodes = True
    lamp.node_tree.nodes['Emission'].inputs['Strength'].default_value = 7.0
    thing = bpy.data.objects.new('Prop', lamp)
    thing.location = (0, 0, asked['height'])
    bpy.context.scene.collection.objects.link(thing)
    return thing


def look_down(scene):
    """A row of pixels from the lamp's foot along x."""
    camera = bpy.data.cameras.new('eye')
    camera.type, camera.ortho_scale = 'ORTHO', SIDE / 2
    camera.clip_end = 100.0
    eye = bpy.data.objects.new('eye', camera)
    eye.location = (SIDE / 4, 0, 20.0)
    scene.collection.objects.link(eye)
    scene.camera = eye
    render, cycles = scene.render, scene.cycles
    render.engine = 'CYCLES'
    render.resolution_x, render.resolution_y, render.resolution_percentage = PIXELS, ROWS, 100
    render.image_settings.file_format, render.image_settings.color_depth = 'OPEN_EXR', '32'
    cycles.samples, cycles.max_bounces, cycles.use_denoising, cycles.use_adaptive_sampling = 256, 0, False, False
    cycles.pixel_filter_type, cycles.light_sampling_threshold = 'BOX', 0.0


scene = bpy.context.scene
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
scene.world = None
scene.collection.objects.link(white_face('floor', SIDE))
look_down(scene)
rows = []
for number, job in enumerate(asked['jobs']):
    thing = a_persons_light(job['type'])
    sys.argv = [job['script']]
    runpy.run_path(job['script'], run_name='__main__')
    scene.render.filepath = os.path.join(os.path.dirname(out_path), 'floor_%d.exr' % number)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = 'Non-Color'
    texels = list(image.pixels)[4 * PIXELS * (ROWS // 2):]
    rows.append([])
    for i in range(PIXELS):
        red, green, blue = texels[4 * i:4 * i + 3]
        nits = 683.0 * (0.2126 * red + 0.7152 * green + 0.0722 * blue)
        rows[-1].append([(i + 0.5) * SIDE / 2 / PIXELS, math.pi * nits])
    bpy.data.images.remove(image)
    bpy.data.objects.remove(bpy.data.objects['Prop'])
json.dump(rows, open(out_path, 'w'))
