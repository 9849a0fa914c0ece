# Written by lightcal: the exposure that a card fixes, and cards that are measured.
# SPDX-License-Identifier: Apache-2.0
import math
import os
import tempfile

import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

from . import lamps, laws


def exposure_of(state):
    """A white card (reflectance 1) under that illuminance shows as 1.0; radiance is nits/683."""
    return math.log2(math.pi / state.card_lux * laws.LUMENS_PER_WATT)


def lock_exposure(scene):
    view = scene.view_settings
    scene.display_settings.display_device = 'sRGB'
    view.view_transform, view.look, view.gamma = 'Standard', 'None', 1.0
    view.exposure = exposure_of(scene.lightcal)


def keep_exposure(scene):
    state = scene.lightcal
    if state.lock and abs(scene.view_settings.exposure - exposure_of(state)) > 1e-6:
        lock_exposure(scene)


def on_exposure(state, _context):
    if state.lock:
        lock_exposure(state.id_data)


def add_card(scene, place, normal, reflectance=0.18, side=0.1):
    """A matt grey card that can be measured."""
    material = bpy.data.materials.new('lightcal card')
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new('ShaderNodeBsdfDiffuse')
    diffuse.inputs['Color'].default_value = [reflectance] * 3 + [1.0]
    output = tree.nodes.new('ShaderNodeOutputMaterial')
    tree.links.new(diffuse.outputs[0], output.inputs['Surface'])
    h = side / 2 * lamps.units_per_metre(scene)
    mesh = bpy.data.meshes.new('lightcal card')
    mesh.from_pydata([(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    card = bpy.data.objects.new('lightcal card', mesh)
    card['lightcal_reflectance'] = reflectance
    normal = Vector(normal).normalized()
    right = normal.orthogonal().normalized()
    card.matrix_world = lamps.matrix_of({'axes': [right, normal.cross(right), normal],
                                         'position': place})
    scene.collection.objects.link(card)
    return card


def measure_card(scene, card):
    """Lux of a card, from a render through the scene's camera: E = pi L/rho over its middle half.
    Raises RuntimeError with what is wrong."""
    if scene.camera is None:
        raise RuntimeError('the scene has no camera that sees the card')
    if scene.render.engine != 'CYCLES':
        raise RuntimeError('cards are measured in Cycles; this scene renders with another engine')
    settings, render = scene.render.image_settings, scene.render
    kept = (settings.file_format, settings.color_depth, render.filepath)
    handle, path = tempfile.mkstemp(suffix='.exr')
    os.close(handle)
    picture = None
    try:
        settings.file_format, settings.color_depth, render.filepath = 'OPEN_EXR', '32', path
        bpy.ops.render.render(write_still=True, scene=scene.name)
        picture = bpy.data.images.load(path)
        picture.colorspace_settings.name = 'Non-Color'
        width, height = picture.size
        pixels = picture.pixels[:]
        channels = picture.channels
    finally:
        settings.file_format, settings.color_depth, render.filepath = kept
        if picture is not None:
            bpy.data.images.remove(picture)
        os.remove(path)
    corners = [world_to_camera_view(scene, scene.camera, card.matrix_world @ (v.co * 0.5))
               for v in card.data.vertices]
    if any(c.z <= 0 or not 0 <= c.x <= 1 or not 0 <= c.y <= 1 for c in corners):
        raise RuntimeError('the camera does not see the whole card')
    quad = [(c.x * width, c.y * height) for c in corners]
    total, count = 0.0, 0
    for y in range(int(min(q[1] for q in quad)), int(max(q[1] for q in quad)) + 1):
        for x in range(int(min(q[0] for q in quad)), int(max(q[0] for q in quad)) + 1):
            sides = [(b[0] - a[0]) * (y + .5 - a[1]) - (b[1] - a[1]) * (x + .5 - a[0])
                     for a, b in zip(quad, quad[1:] + quad[:1])]
            if x >= width or y >= height or not (min(sides) > 0 or max(sides) < 0):
                continue
            at = (y * width + x) * channels
            total += sum(w * c for w, c in zip(laws.WEIGHTS, pixels[at:at + 3]))
            count += 1
    if count < 16:
        raise RuntimeError('the card is %d pixels large; come nearer or render larger' % count)
    exposed = getattr(scene.cycles, 'film_exposure', 1.0)
    return math.pi * total / count / exposed * laws.LUMENS_PER_WATT / card['lightcal_reflectance']
