# Written by lightcal: measured lights for Blender 3.4 and later, Cycles.
#   blender [-b] [yours.blend] -P THIS_FILE -- [--save out.blend]
# or open it in the Text editor and press Run. The lights come into the scene that is open; run again,
# it replaces its own and leaves all else as it is; one undo takes them back. NAME.rig.blender.py
# makes a scene of its own with cards, camera and exposure, and takes
#   [--render out.png|out.exr] [--samples N]  as well.
# Exported with --into it makes nothing: it sets lights that are there, by name, or refuses. Their type
# becomes the lamp's, for another shows another lamp: a SPOT's cone cuts what shines beyond it.
# Lights are watts of W = lm/683 (as Blender's glTF importer has it): every radiance of the scene is
# cd/m2 divided by 683, and the rig's exposure brings the white card to 1.0 (reflectance 1).
import json
import math
import os
import re
import sys

import bpy
from mathutils import Matrix, Vector

PRESET = json.loads(r'''
@DATA@''')
OWN, LAMP = 'lightcal_of', 'lightcal_lamp'  # custom properties: whose, and which


def is_own(thing):
    return thing.get(OWN) == PRESET['name']


def owned(thing):
    thing[OWN] = PRESET['name']
    return thing


def units_per_metre(scene):
    """A scene kept in centimetres has 100: its lights shine by its own units, not by what it shows."""
    settings = scene.unit_settings
    return 1.0 if settings.system == 'NONE' else 1.0 / settings.scale_length


def placed(name, data, collection, columns, position, thing=None):
    """A new object, or one that is there, moved."""
    if thing is None:
        thing = owned(bpy.data.objects.new(name, data))
        collection.objects.link(thing)
    matrix = Matrix.Identity(4)
    for i, column in enumerate(columns):
        for row in range(3):
            matrix[row][i] = column[row]
    matrix.translation = Vector(position)
    thing.parent = None
    thing.matrix_world = matrix
    return thing


def ies_nodes(lamp, text):
    """The distribution's candela as the light's strength; C0 is the node's -Y."""
    lamp.use_nodes = True
    tree = lamp.node_tree
    earlier = [node.ies for node in tree.nodes if node.type == 'TEX_IES' and node.ies]
    tree.nodes.clear()
    for block in [block for block in earlier if is_own(block)]:
        bpy.data.texts.remove(block)
    ies = tree.nodes.new('ShaderNodeTexIES')
    ies.mode = 'INTERNAL'
    block = owned(bpy.data.texts.new(lamp.name + '.ies'))
    block.write(text)
    ies.ies = block
    emission = tree.nodes.new('ShaderNodeEmission')
    output = tree.nodes.new('ShaderNodeOutputLight')
    tree.links.new(ies.outputs[0], emission.inputs['Strength'])
    tree.links.new(emission.outputs[0], output.inputs[0])


def discard(lamp):
    """Light data that nothing uses any more, with its photometric text."""
    nodes = list(lamp.node_tree.nodes) if lamp.node_tree else []
    texts = [node.ies for node in nodes if node.type == 'TEX_IES' and node.ies]
    if lamp.users == 0:
        bpy.data.lights.remove(lamp)
        for text in texts:
            if is_own(text):
                bpy.data.texts.remove(text)


def type_of(light):
    """Blender's type that shows this lamp. A photometric file shines all round: a cone would cut it."""
    return 'POINT' if light['type'] == 'IES' else light['type']


def set_figures(lamp, light, units=1.0):
    """All that shapes the light of a lamp whose type is type_of(light); units: of the scene, a metre."""
    kind = light['type']
    lamp.color = light['color']
    lamp.energy = light['energy_W'] * (1.0 if kind == 'SUN' else units ** 2)
    if kind == 'AREA':
        lamp.shape = light['shape']
        lamp.size, lamp.size_y = [side * units for side in light['size_m']]
        lamp.spread = math.pi  # all of its half space
        if hasattr(lamp, 'cycles'):
            lamp.cycles.is_portal = False  # portals give no light of their own
        if bpy.app.version < (4, 0):
            lamp.energy *= 4 / math.pi  # before 4.0 an area light of P watts has P/4 on its axis
    elif kind == 'SUN':
        lamp.angle = light['angle_rad']
    else:
        lamp.shadow_soft_size = light['radius_m'] * units
        if hasattr(lamp, 'use_soft_falloff'):
            lamp.use_soft_falloff = False  # on, it is the disc of before 4.0, dark close to a sphere
    if kind == 'SPOT':
        # Before 4.0 a spot is a disc, which its own cosine dims.
        cone = light['before_4_0'] if bpy.app.version < (4, 0) else light
        lamp.spot_size = cone['spot_size_rad']
        lamp.spot_blend = cone['spot_blend']
        lamp.use_square = False
    if hasattr(lamp, 'exposure'):
        lamp.exposure = 0.0
    if hasattr(lamp, 'normalize'):
        lamp.normalize = True
    if hasattr(lamp, 'use_temperature'):
        lamp.use_temperature = False
    if kind == 'IES':
        ies_nodes(lamp, light['ies'])
    elif lamp.use_nodes:
        lamp.use_nodes = False  # they would multiply the watts
    lamp['lightcal'] = json.dumps(light['measured'])
    set_knobs(lamp, light.get('controls', []))


def driven(lamp, path, index, expression, variables):
    """A driver without Python: one value by an arithmetic expression of the lamp's properties."""
    curve = lamp.driver_add(path, index) if index >= 0 else lamp.driver_add(path)
    for modifier in list(curve.modifiers):
        curve.modifiers.remove(modifier)
    curve.driver.type = 'SCRIPTED'
    curve.driver.expression = expression
    for name, source in variables:
        variable = curve.driver.variables.new()
        variable.name, variable.type = name, 'SINGLE_PROP'
        variable.targets[0].id_type, variable.targets[0].id = 'LIGHT', lamp
        variable.targets[0].data_path = source
    return curve


def set_knobs(lamp, controls):
    """A property a control of the lamp ("dimmer", "cct_K", as its label says), which moves watts and
    colour along what was measured: each by a driver whose curve is the table."""
    for curve in list(lamp.animation_data.drivers) if lamp.animation_data else []:
        if 'lightcal_' in curve.data_path or any(
                'lightcal_' in v.targets[0].data_path for v in curve.driver.variables):
            lamp.driver_remove(curve.data_path, curve.array_index if curve.data_path == 'color' else -1)
    if not controls:
        return
    energy, color = lamp.energy, list(lamp.color)
    factors = {what: [] for what in ('energy', 'r', 'g', 'b')}
    for control in controls:
        name, table = control['control'], control['table']
        lamp[name] = float(control['reference'])
        lamp.id_properties_ui(name).update(
            min=table[0][0], max=table[-1][0], soft_min=table[0][0], soft_max=table[-1][0],
            description='What the lamp says; its light follows what was measured')
        for column, what in enumerate(('energy', 'r', 'g', 'b'), 1):
            held = 'lightcal_%s_%s' % (what, name)
            lamp[held] = 1.0
            curve = driven(lamp, '["%s"]' % held, -1, 'x', [('x', '["%s"]' % name)])
            curve.keyframe_points.clear() if hasattr(curve.keyframe_points, 'clear') else None
            for row in table:
                point = curve.keyframe_points.insert(row[0], row[column], options={'FAST'})
                point.interpolation = 'LINEAR'
            curve.update()
            factors[what].append(held)
    targets = [('energy', -1, energy, 'energy')] + [
        ('color', i, color[i], what) for i, what in enumerate('rgb')]
    for path, index, value, what in targets:
        names = ['abc'[i] for i in range(len(factors[what]))]
        driven(lamp, path, index, '*'.join(['%.9g' % value] + names),
               [(n, '["%s"]' % held) for n, held in zip(names, factors[what])])


def add_light(collection, light, mine=None, units=1.0):
    """A light, in the place of ours of an earlier run where there is one."""
    lamp = bpy.data.lights.new(light['name'], type_of(light))
    if mine:
        earlier, mine.data = mine.data, lamp
        name = earlier.name
        discard(earlier)
        lamp.name = name
    set_figures(lamp, light, units)
    thing = placed(light['name'], lamp, collection, light['axes'],
                   Vector(light['position_m']) * units, mine)
    thing[LAMP] = light['name']


def picture_node(tree, name):
    """A lat-long picture in cd/m2: its middle looks along +Y; Cycles has it along +X."""
    folder = os.path.dirname(os.path.abspath(globals().get('__file__', '')))
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        raise FileNotFoundError(name + ' belongs beside this script, in ' + folder)
    coordinates = tree.nodes.new('ShaderNodeTexCoord')
    turn = tree.nodes.new('ShaderNodeMapping')
    turn.inputs['Rotation'].default_value = (0.0, 0.0, -math.pi / 2)
    picture = tree.nodes.new('ShaderNodeTexEnvironment')
    picture.image = bpy.data.images.load(path)
    picture.image.colorspace_settings.name = 'Non-Color'  # linear, as it is
    picture.image.pack()
    tree.links.new(coordinates.outputs['Generated'], turn.inputs['Vector'])
    tree.links.new(turn.outputs[0], picture.inputs['Vector'])
    return picture


def add_world(name, domes):
    """The light from all around, as a world; scenes take it or not."""
    world = owned(bpy.data.worlds.new(name))
    world.use_fake_user = True
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    shader = None
    for dome in domes:
        background = tree.nodes.new('ShaderNodeBackground')
        background.inputs['Strength'].default_value = dome['strength']
        background.inputs['Color'].default_value = list(dome['color']) + [1.0]
        if 'picture' in dome:
            picture = picture_node(tree, dome['picture'])
            tree.links.new(picture.outputs[0], background.inputs['Color'])
        last = background
        if shader:
            last = tree.nodes.new('ShaderNodeAddShader')
            tree.links.new(shader.outputs[0], last.inputs[0])
            tree.links.new(background.outputs[0], last.inputs[1])
        shader = last
    output = tree.nodes.new('ShaderNodeOutputWorld')
    tree.links.new(shader.outputs[0], output.inputs['Surface'])
    return world


def add_card(scene, rig, card):
    material = bpy.data.materials.new(card['name'])
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new('ShaderNodeBsdfDiffuse')
    diffuse.inputs['Color'].default_value = [card['reflectance']] * 3 + [1.0]
    diffuse.inputs['Roughness'].default_value = 0.0
    output = tree.nodes.new('ShaderNodeOutputMaterial')
    tree.links.new(diffuse.outputs[0], output.inputs['Surface'])
    half = rig['side_m'] / 2
    mesh = bpy.data.meshes.new(card['name'])
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [],
                     [(0, 1, 2, 3)])
    mesh.materials.append(material)
    row, normal = Vector(rig['row']), Vector(rig['normal'])
    placed(card['name'], mesh, scene.collection, [row, normal.cross(row), normal], card['centre_m'])


def add_camera(scene, camera):
    data = bpy.data.cameras.new('rig camera')
    data.lens_unit = 'FOV'
    data.sensor_fit = 'VERTICAL'
    data.angle = math.radians(camera['vertical_fov_deg'])
    data.clip_start = 0.001
    back = (Vector(camera['position_m']) - Vector(camera['target_m'])).normalized()
    up = Vector(camera['up'])
    scene.camera = placed('rig camera', data, scene.collection, [up.cross(back), up, back],
                          camera['position_m'])


def set_exposure(scene, scale):
    scene.render.engine = 'CYCLES'
    cycles = scene.cycles
    cycles.samples = 64
    cycles.use_denoising = False
    cycles.film_exposure = 1.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    if hasattr(cycles, 'light_sampling_threshold'):
        cycles.light_sampling_threshold = 0.0
    scene.display_settings.display_device = 'sRGB'
    scene.view_settings.view_transform = 'Standard'
    scene.view_settings.look = 'None'
    scene.view_settings.gamma = 1.0
    scene.view_settings.exposure = math.log2(scale * PRESET['lumens_per_watt'])
    scene.render.resolution_x, scene.render.resolution_y = 600, 400
    scene.render.resolution_percentage = 100
    scene.render.dither_intensity = 0.0  # Blender's only adds: .42 of an 8 bit code, 1 % of the grey


def own_collection(scene):
    for collection in scene.collection.children_recursive:
        if is_own(collection):
            return collection
    collection = owned(bpy.data.collections.new('lightcal ' + PRESET['name']))
    scene.collection.children.link(collection)
    return collection


def replace_world(scene, domes):
    """Ours, where the scene has none or ours: a person's own world stays."""
    earlier = [world for world in bpy.data.worlds if is_own(world)]
    for world in earlier:
        world.name = 'earlier'
    if domes and (scene.world is None or is_own(scene.world)):
        scene.world = add_world('lightcal ' + PRESET['name'], domes)
    elif domes:
        world = add_world('lightcal ' + PRESET['name'], domes)
        print('lightcal: the light from all around is the world "' + world.name +
              '"; choose it in World properties, where this scene has one of its own')
    for world in earlier:
        world.use_fake_user = False
        if world.users == 0:
            bpy.data.worlds.remove(world)


def say_units(scene):
    units = units_per_metre(scene)
    if abs(units - 1.0) > 1e-6:
        print('lightcal: "%s" has %.4g units a metre: places and sizes are in them, and the watts '
              'are %.6g times those of the preset' % (scene.name, units, units ** 2))


def bring_lights():
    """Into the scene that is open: ours of an earlier run are replaced, all else stays as it is."""
    scene = bpy.context.scene
    units = units_per_metre(scene)
    collection = own_collection(scene)
    ours = {}
    for thing in [t for t in scene.objects if is_own(t)]:
        ours.setdefault(thing.get(LAMP), []).append(thing)
    count = 0
    for light in PRESET['lights']:
        if light['type'] != 'WORLD':
            mine = ours.get(light['name'])
            add_light(collection, light, mine.pop(0) if mine else None, units)
            count += 1
    for thing in [thing for left in ours.values() for thing in left]:
        lamp = thing.data
        bpy.data.objects.remove(thing)
        discard(lamp)
    replace_world(scene, [light for light in PRESET['lights'] if light['type'] == 'WORLD'])
    stops = math.log2(PRESET['exposure']['exposure'] * PRESET['lumens_per_watt'])
    print('lightcal: %d lights in "%s"; as the meter saw it at exposure %+.1f (Color Management)'
          % (count, scene.name, stops))
    say_units(scene)
    return scene


def remove_rigs():
    for old in [scene for scene in bpy.data.scenes if is_own(scene)]:
        things = [thing for thing in old.objects if is_own(thing)]
        bpy.data.scenes.remove(old)
        data = [t.data for t in things if t.users == 0]
        materials = [m for d in data for m in getattr(d, 'materials', [])]
        bpy.data.batch_remove([t for t in things if t.users == 0])
        for lamp in [d for d in data if isinstance(d, bpy.types.Light)]:
            data.remove(lamp)
            discard(lamp)
        bpy.data.batch_remove([d for d in data if d.users == 0])
        bpy.data.batch_remove([m for m in materials if m.users == 0])
    for world in [world for world in bpy.data.worlds if is_own(world)]:
        bpy.data.worlds.remove(world)


def build_rig():
    """A scene of its own, in the place of that of an earlier run."""
    scene = bpy.data.scenes.new('lightcal')
    remove_rigs()
    owned(scene).name = 'lightcal ' + PRESET['name']
    for light in PRESET['lights']:
        if light['type'] != 'WORLD':
            add_light(scene.collection, light)
    domes = [light for light in PRESET['lights'] if light['type'] == 'WORLD']
    if domes:  # else no world at all: black, and no samples spent on it
        scene.world = add_world(scene.name, domes)
    set_exposure(scene, PRESET['exposure']['exposure'])
    for card in PRESET['rig']['cards']:
        add_card(scene, PRESET['rig'], card)
    add_camera(scene, PRESET['rig']['camera'])
    if bpy.context.window:
        bpy.context.window.scene = scene
    return scene


def matches(pattern, name):
    """* any letters, ? one; all else as it is."""
    spelled = re.escape(pattern).replace(r'\*', '.*').replace(r'\?', '.')
    return re.fullmatch(spelled, name, re.S) is not None


def figures(lamp):
    text = '%s, %.4g W, colour %.3f %.3f %.3f' % (lamp.type, lamp.energy, *lamp.color)
    if lamp.type == 'SPOT':
        text += ', cone %.4g deg, blend %.3g' % (math.degrees(lamp.spot_size), lamp.spot_blend)
    if lamp.type in ('POINT', 'SPOT'):
        text += ', radius %.4g' % lamp.shadow_soft_size
    if lamp.type == 'AREA':
        text += ', %s %.4g x %.4g' % (lamp.shape.lower(), lamp.size, lamp.size_y)
    if lamp.type == 'SUN':
        text += ', angle %.4g deg' % math.degrees(lamp.angle)
    return text + (', nodes' if lamp.use_nodes else '')


def why_not(thing, light, chosen):
    """What keeps this light from being set, and what to do; '' = nothing."""
    lamp, kind = thing.data, type_of(light)
    if (kind == 'SUN') != (lamp.type == 'SUN'):
        return ('is a %s, and "%s" was measured in %s: make it a %s, or leave it out'
                % (lamp.type, light['name'], 'lux' if kind == 'SUN' else 'candela', kind))
    if lamp.library or lamp.override_library:
        return 'is linked from another file: open that file, or make it local (Object > Relations)'
    others = [o.name for o in bpy.data.objects if o.data == lamp and o not in chosen]
    if others:
        return ('shares its light with "%s", which would change too: make it single user '
                '(Object > Relations), or name both' % others[0])
    return ''


def say_what_else_shapes(thing, was, light):
    """What of the scene turns, bends or moves the light that was set."""
    lamp, name = thing.data, thing.name
    if was == 'POINT' and light['type'] != 'POINT':
        print('lightcal: %s: shone all round, and shines along its -Z now: see that it aims' % name)
    scale = thing.matrix_world.to_scale()
    if lamp.type in ('SPOT', 'AREA') and max(abs(s - 1) for s in scale) > 1e-3:
        print('lightcal: %s: is scaled by %.3g, %.3g, %.3g, and so are its face and cone: apply the '
              'scale (Object > Apply)' % (name, *scale))
    moved = lamp.animation_data
    curves = list(moved.drivers) + list(getattr(moved.action, 'fcurves', [])) if moved else []
    paths = sorted({c.data_path for c in curves if not any(
        'lightcal_' in v.targets[0].data_path for v in (c.driver.variables if c.driver else []))})
    if paths:
        print('lightcal: %s: has keys or drivers on %s, which move it again' % (name, ', '.join(paths)))


def set_lights_that_are_there():
    """The rows of the export's --into; all of them, or nothing."""
    scene = bpy.context.scene
    lights = {light['name']: light for light in PRESET['lights']}
    taken, problems = {}, []
    for row in PRESET['into']:
        found = [t for t in scene.objects if t.type == 'LIGHT' and matches(row['object'], t.name)]
        if not found:
            problems.append('no light of the scene "%s" is called "%s"; it has %s' % (
                scene.name, row['object'],
                ', '.join(t.name for t in scene.objects if t.type == 'LIGHT') or 'none'))
        for thing in found:
            if taken.setdefault(thing, row['lamp']) != row['lamp']:
                problems.append('"%s" would get two lamps, "%s" and "%s": leave one of the lines'
                                % (thing.name, taken[thing], row['lamp']))
    data = {}
    for thing, lamp in taken.items():
        problem = why_not(thing, lights[lamp], taken)
        if problem:
            problems.append('"%s" %s' % (thing.name, problem))
        if data.setdefault(thing.data, lamp) != lamp:
            problems.append('"%s" shares its light with one that gets another lamp: make it single '
                            'user (Object > Relations)' % thing.name)
    if problems:
        raise RuntimeError('lightcal: nothing set: ' + '; '.join(problems))
    for thing, lamp in taken.items():
        before, was = figures(thing.data), thing.data.type
        thing.data.type = type_of(lights[lamp])
        set_figures(thing.data.type_recast(), lights[lamp], units_per_metre(scene))
        print('lightcal: %s: %s -> %s   (%s)' % (thing.name, before, figures(thing.data), lamp))
        say_what_else_shapes(thing, was, lights[lamp])
    say_units(scene)
    return scene


def run(arguments):
    options = dict(zip(arguments[0::2], arguments[1::2]))
    if 'rig' not in PRESET and ('--render' in options or '--samples' in options):
        raise RuntimeError('lightcal: these are the lights alone; what renders is ' + PRESET['name'] +
                           '.rig.blender.py, which export writes with --rig')
    bpy.ops.ed.undo_push(message='Before lightcal')
    bring = (build_rig if 'rig' in PRESET else set_lights_that_are_there if 'into' in PRESET else
             bring_lights)
    scene = bring()
    bpy.ops.ed.undo_push(message='lightcal ' + PRESET['name'])
    if '--samples' in options:
        scene.cycles.samples = int(options['--samples'])
    if '--save' in options:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options['--save']))
    if '--render' in options:
        path = os.path.abspath(options['--render'])
        settings = scene.render.image_settings
        settings.file_format = 'OPEN_EXR' if path.endswith('.exr') else 'PNG'
        settings.color_depth = '32' if path.endswith('.exr') else '8'
        scene.render.filepath = path
        bpy.ops.render.render(write_still=True, scene=scene.name)


if __name__ == '__main__':
    run(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
