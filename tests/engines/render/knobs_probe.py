# SPDX-License-Identifier: Apache-2.0
"""blender -b --factory-startup -P knobs_probe.py -- PRESET.blender.py STATES.json ANSWERS.json
Turns the exported lamp's own properties and renders a white card under it at each state."""
import json
import math
import os
import pathlib
import runpy
import sys
import tempfile

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from white_face import white_face  # noqa: E402

script, states, answers = sys.argv[sys.argv.index('--') + 1:]
scene = bpy.context.scene
for thing in list(scene.objects):
    bpy.data.objects.remove(thing)
scene.render.engine = 'CYCLES'
scene.cycles.samples = 64
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 0
scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0.0
scene.cycles.light_sampling_threshold = 0.0
scene.render.resolution_x = scene.render.resolution_y = 16
scene.render.resolution_percentage = 100
scene.view_settings.view_transform = 'Standard'
scene.world = None

sys.argv = ['blender', '--']
runpy.run_path(script, run_name='__main__')
[thing] = [t for t in scene.objects if t.type == 'LIGHT']
lamp = thing.data
thing.matrix_world = Matrix.Translation((0, 0, 2))  # two metres above the card, shining down

scene.collection.objects.link(white_face('card', 0.1))
camera = bpy.data.objects.new('eye', bpy.data.cameras.new('eye'))
camera.data.angle = math.radians(1)
back = Vector((0, -1.0, 1.0))
camera.matrix_world = Matrix.Translation(back) @ back.to_track_quat('Z', 'Y').to_matrix().to_4x4()
scene.collection.objects.link(camera)
scene.camera = camera

settings = scene.render.image_settings
settings.file_format, settings.color_depth = 'OPEN_EXR', '32'
seen = []
with open(states) as source:
    wanted = json.load(source)
for state in wanted:
    for name, value in state.items():
        lamp[name] = float(value)
    lamp.update_tag()
    bpy.context.view_layer.update()
    path = os.path.join(tempfile.mkdtemp(), 'card.exr')
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(path)
    picture.colorspace_settings.name = 'Non-Color'
    pixels = list(picture.pixels)
    count = len(pixels) // 4
    rgb = [sum(pixels[c::4]) / count for c in range(3)]
    seen.append({'rgb': rgb, 'energy': lamp.energy, 'color': list(lamp.color)})
limits = lamp.id_properties_ui('dimmer').as_dict()
with open(answers, 'w') as out:
    json.dump({'seen': seen, 'blender': bpy.app.version_string,
               'limits': [limits['min'], limits['max']]}, out)
