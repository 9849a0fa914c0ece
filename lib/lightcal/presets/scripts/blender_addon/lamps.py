# Written by lightcal: lamps of the scene, each by what its file says of it.
# SPDX-License-Identifier: Apache-2.0
"""An object knows its file ("lightcal_file"), its lamp there ("lightcal_light") and, of a lamp with
states, its controls ("lightcal dimmer" and so on, sliders that can be animated)."""
import os

import bpy
from mathutils import Matrix, Vector

from . import laws, states

COLLECTION = 'lightcal'
CONTROL = 'lightcal '  # before a control's name
READ = {}  # {path: (stamp, lights)}: what was read last


def units_per_metre(scene):
    """A scene kept in centimetres has 100: its lights shine by its own units, not by what it shows."""
    settings = scene.unit_settings
    return 1.0 if settings.system == 'NONE' else 1.0 / settings.scale_length


def in_units(values, units):
    """The same lamp in a scene of so many units a metre."""
    lengths = {key: values[key] * units for key in ('size', 'size_y', 'radius') if key in values}
    energy = values['energy'] * (1.0 if values['type'] == 'SUN' else units ** 2)
    place = [p * units for p in values['position']]
    return dict(values, energy=energy, position=place, **lengths)


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
        if hasattr(lamp, 'use_soft_falloff'):
            lamp.use_soft_falloff = False  # on, it is the disc of before 4.0, dark close to a sphere
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
    """[object]: the lamps of a file, those placed twice too."""
    return [thing for thing in scene.objects
            if thing.type == 'LIGHT' and thing.get('lightcal_file') == path]


def lights_of(path):
    """The file's lamps, read again where it changed. Raises laws.BadLight."""
    stamp = stamp_of(path)
    kept = READ.get(path)
    if kept is None or kept[0] != stamp:
        READ[path] = kept = (stamp, laws.read_lights(path))
    return kept[1]


def light_of(path, name):
    """One lamp as it was read last, where the file may have gone since; None = there is none."""
    try:
        lights = READ[path][1] if path in READ else lights_of(path)
    except laws.BadLight:
        return None
    return next((one for one in lights if one['name'] == name), None)


def collection_of(scene):
    found = next((c for c in scene.collection.children if c.name.startswith(COLLECTION)), None)
    if found is None:
        found = bpy.data.collections.new(COLLECTION)
        scene.collection.children.link(found)
    return found


# ---- controls ----

def set_controls(thing, light):
    """The object's sliders are those of the lamp, each as far as it was read."""
    known = states.controls_of(light)
    for key in [k for k in thing.keys() if k.startswith(CONTROL) and k[len(CONTROL):] not in known]:
        del thing[key]
    for name, ends in known.items():
        key, value = CONTROL + name, light['state'][name]
        if key not in thing:
            thing[key] = value
        if ends:
            unit = {'dimmer': 'percent', 'cct_K': 'kelvin'}.get(name, '')
            thing.id_properties_ui(key).update(
                min=ends[0], max=ends[1], soft_min=ends[0], soft_max=ends[1], default=value,
                precision=1,
                description=' '.join([name, unit, 'as it was read, %g to %g' % ends]))


def controls_at(thing, light):
    """The state that the object's sliders say; what has no slider stands as it was read."""
    at = dict(light.get('state', {}))
    for name in at:
        if CONTROL + name in thing:
            at[name] = thing[CONTROL + name]
    return at


def set_from(thing, light):
    """Light and interval of one object by its lamp and its sliders."""
    try:
        here = states.light_at(light, controls_at(thing, light))
    except states.Unknown as fault:
        note(thing, str(fault))
        return
    values = laws.lamp_of(here, bpy.app.version[:2])
    if values is None:
        note(thing, 'no figure')
        return
    units = units_per_metre(thing.users_scene[0]) if thing.users_scene else 1.0
    set_lamp(thing.data, in_units(values, units))
    note(thing, laws.interval_text(here))
    thing['lightcal_set'] = said_of(thing)


def note(thing, text):
    if thing.get('lightcal_interval') != text:
        thing['lightcal_interval'] = text


def said_of(thing):
    """What the sliders say, to tell a moved one."""
    return ' '.join('%s=%s' % (k[len(CONTROL):], thing[k]) for k in sorted(thing.keys())
                    if k.startswith(CONTROL))


def follow_sliders(scene):
    """Lamps whose sliders were moved, or animated, are set anew. Returns how many."""
    moved = 0
    for thing in scene.objects:
        if thing.type != 'LIGHT' or 'lightcal_file' not in thing:
            continue
        said = said_of(thing)
        if not said or said == thing.get('lightcal_set'):
            continue
        light = light_of(thing['lightcal_file'], thing['lightcal_light'])
        if light is not None:
            set_from(thing, light)
            thing['lightcal_set'] = said  # where it was refused too: once is enough
            moved += 1
    return moved


# ---- placing and following ----

def place(scene, path, light, at=None):
    """One more lamp of that name, where it was measured or at a place. None where Blender has no
    such lamp."""
    lamp = laws.lamp_of(light, bpy.app.version[:2])
    if lamp is None:
        return None
    data = bpy.data.lights.new(light['name'], lamp['type'])
    thing = bpy.data.objects.new(light['name'], data)
    thing['lightcal_file'], thing['lightcal_light'] = path, light['name']
    thing.matrix_world = matrix_of(in_units(lamp, units_per_metre(scene)))
    if at is not None:
        thing.matrix_world.translation = at
    collection_of(scene).objects.link(thing)
    set_controls(thing, light)
    set_from(thing, light)
    return thing


def place_all(scene, path):
    """Those of the file that are not there yet; returns the names of those that cannot be."""
    there = {thing['lightcal_light'] for thing in objects_of(scene, path)}
    return [light['name'] for light in lights_of(path)
            if light['name'] not in there and place(scene, path, light) is None]


def take(scene, path):
    """What the file says now, into its lamps that are there: they keep place, name and sliders.
    Returns what to tell; raises laws.BadLight, and then nothing was changed."""
    lights = {light['name']: light for light in lights_of(path)}
    gone, there = set(), objects_of(scene, path)
    for thing in there:
        light = lights.get(thing['lightcal_light'])
        if light is None:
            note(thing, 'no longer in its file')
            gone.add(thing['lightcal_light'])
            continue
        set_controls(thing, light)
        set_from(thing, light)
    placed = {thing['lightcal_light'] for thing in there} & set(lights)
    said = '%d of %d placed' % (len(placed), len(lights))
    if gone:
        said += '; no longer in the file: ' + ', '.join(sorted(gone))
    return said


def forget(scene, path):
    """Its lamps stay in the scene as they are, and follow nothing."""
    for thing in objects_of(scene, path):
        for key in [k for k in thing.keys() if k.startswith('lightcal')]:
            del thing[key]
