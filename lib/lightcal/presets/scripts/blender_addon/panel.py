# Written by lightcal: the sidebar of the 3D view.
# SPDX-License-Identifier: Apache-2.0
import os

import bpy
import bpy.utils.previews
from bpy.props import (BoolProperty, CollectionProperty, FloatProperty, IntProperty, StringProperty)

from . import cards, lamps, laws, pictures

PREVIEWS = {}  # 'all': Blender's collection, while the add-on is on

# Properties stand in __annotations__ by name, which is what Blender reads: written as annotations,
# their texts would be taken for names of types by every checker.


class LightcalLink(bpy.types.PropertyGroup):
    __annotations__ = {
        'path': StringProperty(name='File', subtype='FILE_PATH'),
        'stamp': StringProperty(),
        'message': StringProperty(),
    }


class LightcalLamp(bpy.types.PropertyGroup):
    """A lamp that a linked file has, placed or not; `name` is the light's."""
    __annotations__ = {
        'path': StringProperty(subtype='FILE_PATH'),
        'interval': StringProperty(),
    }


class LightcalState(bpy.types.PropertyGroup):
    __annotations__ = {
        'links': CollectionProperty(type=LightcalLink),
        'chosen': IntProperty(),
        'lamps': CollectionProperty(type=LightcalLamp),
        'chosen_lamp': IntProperty(),
        'lock': BoolProperty(
            name='Lock exposure', update=cards.on_exposure,
            description='White cards under this illuminance show as 1.0, and stay so'),
        'card_lux': FloatProperty(
            name='Card', default=1000.0, min=1e-3, max=1e7, update=cards.on_exposure,
            description='Illuminance of the card in lux'),
        'measured': StringProperty(),
    }


def redraw():
    """The sidebars anew: nothing else tells them that a lamp changed."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == 'VIEW_3D':
                area.tag_redraw()


# ---- the list of lamps ----

def list_lamps(state):
    """Every lamp of every linked file that can be read, by file and name."""
    chosen = chosen_item(state)
    before = (chosen.path, chosen.name) if chosen else None
    state.lamps.clear()
    for link in state.links:
        try:
            lights = lamps.lights_of(link.path)
        except laws.BadLight:
            continue
        for light in lights:
            item = state.lamps.add()
            item.name, item.path = light['name'], link.path
            item.interval = laws.interval_text(light)
            if (item.path, item.name) == before:
                state.chosen_lamp = len(state.lamps) - 1
    state.chosen_lamp = min(state.chosen_lamp, max(0, len(state.lamps) - 1))


def thumbnail(item):
    """The icon of a lamp, painted anew when its file changed."""
    light = lamps.light_of(item.path, item.name)
    if light is None or 'all' not in PREVIEWS:
        return 0
    key = '%s\n%s\n%s' % (item.path, item.name, lamps.READ[item.path][0])
    every = PREVIEWS['all']
    if key not in every:
        preview, painted = every.new(key), pictures.pixels(light).ravel()
        for of in ('icon', 'image'):
            setattr(preview, of + '_size', (pictures.SIDE, pictures.SIDE))
            setattr(preview, of + '_pixels_float', painted)
    return every[key].icon_id


class LIGHTCAL_UL_links(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active, _property, _index=0,
                  _flags=0):
        layout.label(text=os.path.basename(item.path), icon='FILE')
        layout.label(text=item.message)


class LIGHTCAL_UL_lamps(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active, _property, _index=0,
                  _flags=0):
        icon = thumbnail(item)
        layout.label(text=item.name, **({'icon_value': icon} if icon else {'icon': 'LIGHT'}))
        layout.label(text=item.interval.split(' (')[0])


def chosen_item(state):
    return state.lamps[state.chosen_lamp] if 0 <= state.chosen_lamp < len(state.lamps) else None


# ---- what buttons do ----

class LIGHTCAL_OT_link(bpy.types.Operator):
    """Link a light.json, whose lamps are placed, or a folder of them, whose lamps are listed"""
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
        paths, state, taken = [path], context.scene.lightcal, 0
        if os.path.isdir(path):
            paths = sorted(os.path.join(path, name) for name in os.listdir(path)
                           if name.endswith('.json'))
        for one in paths:
            if any(link.path == one for link in state.links):
                continue
            try:
                left_out = lamps.place_all(context.scene, one) if one == path else []
                message = lamps.take(context.scene, one)
            except laws.BadLight as fault:
                if one == path:
                    self.report({'ERROR'}, os.path.basename(one) + ' ' + str(fault))
                continue
            link = state.links.add()
            link.path, link.stamp, link.message = one, lamps.stamp_of(one), message
            if left_out:
                link.message += '; not placed: ' + ', '.join(left_out)
            taken += 1
        if not taken:
            self.report({'WARNING'}, 'no light.json that is not linked yet')
            return {'CANCELLED'}
        list_lamps(state)
        return {'FINISHED'}


def place_chosen(context):
    item = chosen_item(context.scene.lightcal)
    light = item and lamps.light_of(item.path, item.name)
    thing = light and lamps.place(context.scene, item.path, light, context.scene.cursor.location)
    if not thing:
        raise RuntimeError('Blender has no such lamp' if item else 'choose a lamp of the list')
    context.view_layer.objects.active = thing
    return thing.name


def unlink_chosen(context):
    state = context.scene.lightcal
    if not 0 <= state.chosen < len(state.links):
        raise RuntimeError('choose a file of the list')
    lamps.forget(context.scene, state.links[state.chosen].path)
    state.links.remove(state.chosen)
    state.chosen = max(0, state.chosen - 1)
    list_lamps(state)


def put_card(context):
    card = cards.add_card(context.scene, context.scene.cursor.location, (0, 0, 1))
    context.view_layer.objects.active = card


def measure(context):
    thing = context.active_object
    if thing is None or 'lightcal_reflectance' not in thing:
        raise RuntimeError('choose a grey card of the scene')
    said = '%.4g lx' % cards.measure_card(context.scene, thing)
    context.scene.lightcal.measured = said
    return said


def button(name, label, tip, act, undo=True):
    """An operator that does one thing: `act` of the context, which returns what to say or raises
    RuntimeError with what is wrong."""
    def execute(self, context):
        try:
            said = act(context)
        except (RuntimeError, laws.BadLight) as fault:
            self.report({'ERROR'}, str(fault))
            return {'CANCELLED'}
        if said:
            self.report({'INFO'}, said)
        return {'FINISHED'}
    return type('LIGHTCAL_OT_' + name, (bpy.types.Operator,), {
        '__doc__': tip, 'bl_idname': 'lightcal.' + name, 'bl_label': label,
        'bl_options': {'REGISTER', 'UNDO'} if undo else {'REGISTER'}, 'execute': execute})


def buttons(read_again):
    return (
        button('place', 'Place', 'Place the chosen lamp at the 3D cursor', place_chosen),
        button('unlink', 'Unlink', 'Forget the file; its lamps stay in the scene as they are',
               unlink_chosen),
        button('refresh', 'Read again', 'Read every linked file again', read_again, undo=False),
        button('add_card', 'Add grey card',
               'Put an 18 % card at the 3D cursor, facing up; turn it to the lamp', put_card),
        button('measure_card', 'Measure card',
               'Render, and say how many lux fall on the active card', measure))


# ---- the panel ----

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
        item = chosen_item(state)
        if item is not None:
            layout.template_list('LIGHTCAL_UL_lamps', '', state, 'lamps', state, 'chosen_lamp',
                                 rows=3)
            icon = thumbnail(item)
            if icon:
                layout.template_icon(icon_value=icon, scale=4.0)
            layout.operator('lightcal.place', icon='ADD', text='Place ' + item.name)
        for thing in scene.objects:
            if 'lightcal_interval' in thing:
                box = layout.box()
                value, _, interval = thing['lightcal_interval'].partition(' (')
                row = box.row()
                row.label(text=thing.name, icon='LIGHT_' + thing.data.type)
                row.label(text=value if interval else '')
                box.label(text='(' + interval if interval else value)
                for key in sorted(thing.keys()):
                    if key.startswith(lamps.CONTROL):
                        box.prop(thing, '["%s"]' % key, text=key[len(lamps.CONTROL):], slider=True)
        layout.separator()
        row = layout.row(align=True)
        row.prop(state, 'lock')
        row.prop(state, 'card_lux', text='lx')
        row = layout.row(align=True)
        row.operator('lightcal.add_card')
        row.operator('lightcal.measure_card')
        if state.measured:
            layout.label(text='Card: ' + state.measured)


CLASSES = (LightcalLink, LightcalLamp, LightcalState, LIGHTCAL_OT_link, LIGHTCAL_UL_links,
           LIGHTCAL_UL_lamps, LIGHTCAL_PT_panel)
