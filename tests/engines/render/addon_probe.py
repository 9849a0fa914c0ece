# SPDX-License-Identifier: Apache-2.0
"""blender -b --factory-startup -P addon_probe.py -- ADDON.zip LIGHT.json NEXT.json DIMMED.json ANSWERS.json
Installs the add-on as a person would, links the file, changes it and looks what became of it."""
import json
import math
import os
import shutil
import sys

import bpy
from mathutils import Matrix, Vector

archive, path, following, dimmed, answers = sys.argv[sys.argv.index('--') + 1:]
seen = {}


def light_up(scene):
    """An empty Cycles scene with no world and a camera above the origin, looking down."""
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = 64
    scene.cycles.use_denoising = False
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0.0
    scene.cycles.light_sampling_threshold = 0.0
    scene.render.resolution_x = scene.render.resolution_y = 64
    scene.render.resolution_percentage = 100
    scene.world = None
    for thing in list(scene.objects):
        bpy.data.objects.remove(thing)
    camera = bpy.data.objects.new('eye', bpy.data.cameras.new('eye'))
    camera.data.angle = math.radians(12)
    camera.matrix_world = Matrix.Translation((0, -0.6, 0.9)) @ Vector((0, -0.6, 0.9)).to_track_quat(
        'Z', 'Y').to_matrix().to_4x4()
    scene.collection.objects.link(camera)
    scene.camera = camera


def lamps(scene):
    return {thing['lightcal_light']: {
        'object': thing.name, 'energy': thing.data.energy, 'type': thing.data.type,
        'at': list(thing.matrix_world.translation), 'color': list(thing.data.color),
        'interval': thing['lightcal_interval']} for thing in scene.objects
        if 'lightcal_light' in thing}


seen['classes_before'] = sorted(n for n in dir(bpy.types) if 'lightcal' in n.lower())
bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
bpy.ops.preferences.addon_enable(module='lightcal')
addon = sys.modules['lightcal']
scene = bpy.context.scene
light_up(scene)
seen['timer'] = bpy.app.timers.is_registered(addon.timer)
seen['linked'] = sorted(bpy.ops.lightcal.link(filepath=path))
seen['again'] = sorted(bpy.ops.lightcal.link(filepath=path))
seen['first'] = lamps(scene)
seen['quiet'] = addon.poll()

# Each alone over a card at the origin that faces up, and turned out of the way.
seen['lux'] = {}
card = addon.add_card(scene, (0, 0, 0), (0, 0, 1))
bpy.context.view_layer.objects.active = card
things = {thing['lightcal_light']: thing for thing in scene.objects if 'lightcal_light' in thing}
for name, thing in things.items():
    for other in things.values():
        other.hide_render = other is not thing
    kept = thing.matrix_world.copy()
    up = Matrix.Translation((0, 0, 2))  # two metres above, shining down
    thing.matrix_world = up
    bpy.context.view_layer.update()
    bpy.ops.lightcal.measure_card()
    seen['lux'][name] = float(scene.lightcal.measured.split()[0])
    thing.matrix_world = kept
for other in things.values():
    other.hide_render = False

# A person moves and renames one; then the file changes, torn at first.
edited = things[sorted(things)[0]]
edited.name = 'my own name'
edited.matrix_world.translation = (7, 8, 9)
bpy.context.view_layer.update()
whole = open(following).read()
with open(path, 'w') as out:
    out.write(whole[:len(whole) // 2])
seen['torn'] = addon.poll()
seen['torn_message'] = scene.lightcal.links[0].message
seen['while_torn'] = lamps(scene)
with open(path + '.new', 'w') as out:
    out.write(whole)
os.replace(path + '.new', path)
seen['taken'] = addon.poll()
seen['second'] = lamps(scene)

# Exposure.
scene.lightcal.card_lux = 250.0
scene.lightcal.lock = True
seen['exposure'] = scene.view_settings.exposure
scene.view_settings.exposure = 0.0
addon.poll()
seen['exposure_kept'] = scene.view_settings.exposure

# A folder, a file that is none, a file that goes.
folder = os.path.join(os.path.dirname(path), 'library')
os.mkdir(folder)
shutil.copy(following, os.path.join(folder, 'b.json'))
with open(os.path.join(folder, 'other.json'), 'w') as out:
    out.write('{"schema": "something"}')
seen['folder'] = sorted(bpy.ops.lightcal.link(filepath=folder))
seen['links'] = [os.path.basename(link.path) for link in scene.lightcal.links]
seen['listed'] = [(os.path.basename(item.path), item.name, item.interval)
                  for item in scene.lightcal.lamps]
seen['only_listed'] = len([t for t in scene.objects if t.type == 'LIGHT'])

# One of the list at the cursor, with a picture of it.
scene.lightcal.chosen_lamp = max(i for i, one in enumerate(scene.lightcal.lamps)
                                 if one.name == 'key')
item = scene.lightcal.lamps[scene.lightcal.chosen_lamp]
scene.cursor.location = (1, 2, 3)
seen['placed'] = sorted(bpy.ops.lightcal.place())
thing = bpy.context.view_layer.objects.active
bpy.context.view_layer.update()
seen['placed_lamp'] = thing['lightcal_light'], list(thing.matrix_world.translation)
addon.panel.thumbnail(item)
preview = next(iter(addon.panel.PREVIEWS['all'].values()))
seen['thumbnail'] = list(preview.image_size), sum(preview.image_pixels_float[:]) / 64 ** 2
bpy.data.objects.remove(thing)

# Sliders of a lamp that was read at states, and an animation of one.
bpy.ops.lightcal.link(filepath=dimmed)
thing, two = (next(t for t in scene.objects if t.get('lightcal_file') == dimmed and
                   t['lightcal_light'] == name) for name in ('module', 'panel'))
ends = thing.id_properties_ui('lightcal dimmer').as_dict()
seen['slider'] = ends['min'], ends['max'], thing['lightcal dimmer']
seen['states'] = {}


def look(name, one):
    seen['states'][name] = {'energy': one.data.energy, 'color': list(one.data.color),
                            'interval': one['lightcal_interval']}


look('as read', thing)
for dimmer in (60.0, 25.0, 10.0):
    thing['lightcal dimmer'] = dimmer
    addon.poll()
    look('module %g' % dimmer, thing)
two['lightcal dimmer'], two['lightcal cct_K'] = 40.0, 4700.0
addon.poll()
look('panel 40 4700', two)
thing['lightcal dimmer'] = 100.0
thing.keyframe_insert('["lightcal dimmer"]', frame=1)
thing['lightcal dimmer'] = 40.0
thing.keyframe_insert('["lightcal dimmer"]', frame=11)
scene.frame_set(1)
look('frame 1', thing)
scene.frame_set(11)
look('frame 11', thing)
scene.lightcal.chosen = len(scene.lightcal.links) - 1
bpy.ops.lightcal.unlink()
for one in list(scene.objects):
    if one.type == 'LIGHT' and 'lightcal_light' not in one:
        bpy.data.objects.remove(one)
seen['refused'] = []
for act in (bpy.ops.lightcal.measure_card,):
    bpy.context.view_layer.objects.active = None
    try:
        act()
    except RuntimeError as fault:
        seen['refused'].append(str(fault))

os.remove(path)
addon.poll()
seen['gone'] = scene.lightcal.links[0].message
seen['after_gone'] = len(lamps(scene))
scene.lightcal.chosen = 0
bpy.ops.lightcal.unlink()
seen['unlinked'] = len(scene.lightcal.links), len(lamps(scene)), len(
    [t for t in scene.objects if t.type == 'LIGHT'])

bpy.ops.preferences.addon_disable(module='lightcal')
seen['timer_after'] = bpy.app.timers.is_registered(addon.timer)
try:
    bpy.ops.preferences.addon_remove(module='lightcal')
except RuntimeError as fault:  # without a window Blender's operator fails in its last line
    assert 'tag_redraw' in str(fault), fault
seen['classes_after'] = sorted(n for n in dir(bpy.types) if 'lightcal' in n.lower())
seen['state_after'] = hasattr(bpy.types.Scene, 'lightcal')
seen['folder_after'] = os.path.exists(os.path.dirname(addon.__file__))
with open(answers, 'w') as out:
    json.dump(seen, out)
