# Written by lightcal: measured lamps in Blender 3.4 and later, linked to their light.json and live.
# SPDX-License-Identifier: Apache-2.0
"""Sidebar of the 3D view, tab "lightcal": link a light.json or a folder of them, see each lamp's
value beside its interval, lock the exposure, put a card and measure it. A file that changes is
taken within a second; where a person put a lamp, and what they called it, stays."""
import math
import os
import tempfile

import bpy
from bpy.props import (BoolProperty, CollectionProperty, FloatProperty, IntProperty,
                       PointerProperty, StringProperty)
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Matrix, Vector

from . import laws

bl_info = {
    'name': 'lightcal',
    'author': 'lightcal',
    'version': (0, 1, 0),
    'blender': (3, 4, 0),
    'location': '3D View > Sidebar > lightcal',
    'description': 'Measured lamps, linked and live',
    'category': 'Lighting',
}

COLLECTION = 'lightcal'
SECONDS = 0.5  # between two looks at the files


# ---- lamps ----

def stamp_of(path):
    """What tells a changed file; '' = it is not there."""
    try:
        found = os.stat(path)
    except OSError:
        return ''
    return '%d %d %d' % (found.st_mtime_ns, found.st_size, found.st_ino)


def set_ies(lamp, text):
    """The distribution's candela as the light's strength; None = a lamp without one."""
    if text is None:
        lamp.use_nodes = False
        return
    lamp.use_nodes = True
    tree = lamp.node_tree
    old = [node.ies for node in tree.nodes if node.type == 'TEX_IES' and node.ies]
    tree.nodes.clear()
    for block in old:
        if block.users == 0:
            bpy.data.texts.remove(block)
    ies = tree.nodes.new('ShaderNodeTexIES')
    ies.mode = 'INTERNAL'
    ies.ies = bpy.data.texts.new(lamp.name + '.ies')
    ies.ies.write(text)
    emission = tree.nodes.new('ShaderNodeEmission')
    output = tree.nodes.new('ShaderNodeOutputLight')
    tree.links.new(ies.outputs[0], emission.inputs['Strength'])
    tree.links.new(emission.outputs[0], output.inputs[0])


def set_lamp(lamp, values):
    """Everything the measurement says; returns the light block, which is another after `type`."""
    if lamp.type != values['type']:
        lamp.type = values['type']
        lamp = bpy.data.lights[lamp.name]
    lamp.color = values['color']
    if values['type'] == 'AREA':
        lamp.shape = values['shape']
        lamp.size = values['size']
        lamp.size_y = values['size_y']
    elif values['type'] == 'SUN':
        lamp.angle = values['angle']
    else:
        lamp.shadow_soft_size = values['radius']
    if values['type'] == 'SPOT':
        lamp.spot_size = values['spot_size']
        lamp.spot_blend = values['spot_blend']
    lamp.energy = values['energy']
    for name, neutral in (('exposure', 0.0), ('normalize', True), ('use_temperature', False)):
        if hasattr(lamp, name):
            setattr(lamp, name, neutral)
    set_ies(lamp, values.get('ies'))
    return lamp


def matrix_of(values):
    matrix = Matrix.Identity(4)
    for i, column in enumerate(values['axes']):
        for row in range(3):
            matrix[row][i] = column[row]
    matrix.translation = Vector(values['position'])
    return matrix


def objects_of(scene, path):
    """{name in the file: object}"""
    return {thing['lightcal_light']: thing for thing in scene.objects
            if thing.type == 'LIGHT' and thing.get('lightcal_file') == path}


def collection_of(scene):
    found = next((c for c in scene.collection.children if c.name.startswith(COLLECTION)), None)
    if found is None:
        found = bpy.data.collections.new(COLLECTION)
        scene.collection.children.link(found)
    return found


def take(scene, path):
    """The file's lamps into the scene: those that are there keep place and name. Returns what to
    tell; raises laws.BadLight, and then nothing was changed."""
    lights = laws.read_lights(path)
    there, left_out = objects_of(scene, path), []
    values = [(light, laws.lamp_of(light, bpy.app.version[:2])) for light in lights]
    for light, lamp in values:
        if lamp is None:
            left_out.append(light['name'])
            continue
        thing = there.get(light['name'])
        if thing is None:
            data = bpy.data.lights.new(light['name'], lamp['type'])
            thing = bpy.data.objects.new(light['name'], data)
            thing['lightcal_file'], thing['lightcal_light'] = path, light['name']
            thing.matrix_world = matrix_of(lamp)
            collection_of(scene).objects.link(thing)
        set_lamp(thing.data, lamp)
        thing['lightcal_interval'] = laws.interval_text(light)
    gone = set(there) - {light['name'] for light in lights}
    for name in gone:
        there[name]['lightcal_interval'] = 'no longer in its file'
    said = '%d lamps' % (len(values) - len(left_out))
    if left_out:
        said += '; not placed: ' + ', '.join(left_out)
    if gone:
        said += '; no longer in the file: ' + ', '.join(sorted(gone))
    return said


# ---- live ----

def poll(force=False):
    """Looks at every linked file once; True where one was taken. A file that is being written is
    looked at again, and the lamps stay as they are."""
    changed = False
    for scene in bpy.data.scenes:
        state = scene.lightcal
        for link in state.links:
            stamp = stamp_of(link.path)
            if stamp == link.stamp and not force:
                continue
            if not stamp:
                link.message = 'is gone; its lamps stay as they are'
                link.stamp = stamp
                continue
            try:
                link.message = take(scene, link.path)
                link.stamp = stamp
                changed = True
            except laws.BadLight as fault:
                link.message = str(fault)
        if state.lock and abs(scene.view_settings.exposure - exposure_of(state)) > 1e-6:
            lock_exposure(scene)
    return changed


def timer():
    poll()
    return SECONDS


# ---- exposure and cards ----

def exposure_of(state):
    """A white card (reflectance 1) under that illuminance shows as 1.0; radiance is nits/683."""
    return math.log2(math.pi / state.card_lux * laws.LUMENS_PER_WATT)


def lock_exposure(scene):
    view = scene.view_settings
    scene.display_settings.display_device = 'sRGB'
    view.view_transform, view.look, view.gamma = 'Standard', 'None', 1.0
    view.exposure = exposure_of(scene.lightcal)


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
    h = side / 2
    mesh = bpy.data.meshes.new('lightcal card')
    mesh.from_pydata([(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    card = bpy.data.objects.new('lightcal card', mesh)
    card['lightcal_reflectance'] = reflectance
    normal = Vector(normal).normalized()
    right = normal.orthogonal().normalized()
    card.matrix_world = matrix_of({'axes': [right, normal.cross(right), normal],
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


# ---- the panel ----

# Properties stand in __annotations__ by name, which is what Blender reads: written as annotations,
# their texts would be taken for names of types by every checker.

class LightcalLink(bpy.types.PropertyGroup):
    __annotations__ = {
        'path': StringProperty(name='File', subtype='FILE_PATH'),
        'stamp': StringProperty(),
        'message': StringProperty(),
    }


class LightcalState(bpy.types.PropertyGroup):
    __annotations__ = {
        'links': CollectionProperty(type=LightcalLink),
        'chosen': IntProperty(),
        'lock': BoolProperty(
            name='Lock exposure', update=on_exposure,
            description='White cards under this illuminance show as 1.0, and stay so'),
        'card_lux': FloatProperty(
            name='Card', default=1000.0, min=1e-3, max=1e7, update=on_exposure,
            description='Illuminance of the card in lux'),
        'measured': StringProperty(),
    }


class LIGHTCAL_OT_link(bpy.types.Operator):
    """Link a light.json, or every one in a folder: their lamps are placed and follow the file"""
    bl_idname = 'lightcal.link'
    bl_label = 'Link lamps'
    bl_options = {'REGISTER', 'UNDO'}
    __annotations__ = {
        'filepath': StringProperty(subtype='FILE_PATH'),
        'filter_glob': StringProperty(default='*.json', options={'HIDDEN'}),
    }

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {'RUNNING_MODAL'}

    def execute(self, context):
        path = os.path.abspath(bpy.path.abspath(self.filepath))
        paths = [path]
        if os.path.isdir(path):
            paths = [os.path.join(path, name) for name in sorted(os.listdir(path))
                     if name.endswith('.json')]
        state, taken = context.scene.lightcal, 0
        for one in paths:
            if any(link.path == one for link in state.links):
                continue
            try:
                stamp, message = stamp_of(one), take(context.scene, one)
            except laws.BadLight as fault:
                if one == path:
                    self.report({'ERROR'}, os.path.basename(one) + ' ' + str(fault))
                continue
            link = state.links.add()
            link.path, link.stamp, link.message = one, stamp, message
            taken += 1
        if not taken:
            self.report({'WARNING'}, 'no light.json that is not linked yet')
            return {'CANCELLED'}
        return {'FINISHED'}


class LIGHTCAL_OT_unlink(bpy.types.Operator):
    """Forget the file; its lamps stay in the scene as they are"""
    bl_idname = 'lightcal.unlink'
    bl_label = 'Unlink'
    bl_options = {'REGISTER', 'UNDO'}

    def execute(self, context):
        state = context.scene.lightcal
        if not 0 <= state.chosen < len(state.links):
            return {'CANCELLED'}
        for thing in objects_of(context.scene, state.links[state.chosen].path).values():
            for key in ('lightcal_file', 'lightcal_light', 'lightcal_interval'):
                del thing[key]
        state.links.remove(state.chosen)
        state.chosen = max(0, state.chosen - 1)
        return {'FINISHED'}


class LIGHTCAL_OT_refresh(bpy.types.Operator):
    """Read every linked file again"""
    bl_idname = 'lightcal.refresh'
    bl_label = 'Read again'

    def execute(self, _context):
        poll(force=True)
        return {'FINISHED'}


class LIGHTCAL_OT_add_card(bpy.types.Operator):
    """Put an 18 % card at the 3D cursor, facing up; turn it to the lamp"""
    bl_idname = 'lightcal.add_card'
    bl_label = 'Add grey card'
    bl_options = {'REGISTER', 'UNDO'}

    def execute(self, context):
        card = add_card(context.scene, context.scene.cursor.location, (0, 0, 1))
        context.view_layer.objects.active = card
        return {'FINISHED'}


class LIGHTCAL_OT_measure_card(bpy.types.Operator):
    """Render, and say how many lux fall on the active card"""
    bl_idname = 'lightcal.measure_card'
    bl_label = 'Measure card'

    @classmethod
    def poll(cls, context):
        thing = context.active_object
        return thing is not None and 'lightcal_reflectance' in thing

    def execute(self, context):
        try:
            lux = measure_card(context.scene, context.active_object)
        except RuntimeError as fault:
            self.report({'ERROR'}, str(fault))
            return {'CANCELLED'}
        context.scene.lightcal.measured = '%.4g lx' % lux
        self.report({'INFO'}, context.scene.lightcal.measured)
        return {'FINISHED'}


class LIGHTCAL_UL_links(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active, _property, _index=0,
                  _flags=0):
        layout.label(text=os.path.basename(item.path), icon='LIGHT')
        layout.label(text=item.message)


class LIGHTCAL_PT_panel(bpy.types.Panel):
    bl_label = 'lightcal'
    bl_idname = 'LIGHTCAL_PT_panel'
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = 'lightcal'

    def draw(self, context):
        layout, scene = self.layout, context.scene
        state = scene.lightcal
        layout.template_list('LIGHTCAL_UL_links', '', state, 'links', state, 'chosen', rows=2)
        row = layout.row(align=True)
        row.operator('lightcal.link', icon='LINKED')
        row.operator('lightcal.unlink', icon='UNLINKED')
        row.operator('lightcal.refresh', icon='FILE_REFRESH', text='')
        for thing in scene.objects:
            if 'lightcal_interval' in thing:
                box = layout.box()
                box.label(text=thing.name, icon='LIGHT_' + thing.data.type)
                box.label(text=thing['lightcal_interval'])
        layout.separator()
        row = layout.row(align=True)
        row.prop(state, 'lock')
        row.prop(state, 'card_lux', text='lx')
        row = layout.row(align=True)
        row.operator('lightcal.add_card')
        row.operator('lightcal.measure_card')
        if state.measured:
            layout.label(text='Card: ' + state.measured)


CLASSES = (LightcalLink, LightcalState, LIGHTCAL_OT_link, LIGHTCAL_OT_unlink, LIGHTCAL_OT_refresh,
           LIGHTCAL_OT_add_card, LIGHTCAL_OT_measure_card, LIGHTCAL_UL_links, LIGHTCAL_PT_panel)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.lightcal = PointerProperty(type=LightcalState)
    bpy.app.timers.register(timer, first_interval=SECONDS, persistent=True)


def unregister():
    if bpy.app.timers.is_registered(timer):
        bpy.app.timers.unregister(timer)
    del bpy.types.Scene.lightcal
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
