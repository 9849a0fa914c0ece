# SPDX-License-Identifier: Apache-2.0
"""blender -b --factory-startup -P blender_probe.py -- JOB.json OUT.json
A person's scene of 40 objects, then the steps of the job, with a picture of all data after each:
{"steps": [{"run": SCRIPT} | {"undo": true} | {"edit": PYTHON}]} -> {"states": [{"objects:key": text}]}.
The picture is every property of every datablock, by Blender's own reflection."""
import contextlib
import io
import json
import math
import runpy
import sys

import bpy

job_path, out_path = sys.argv[sys.argv.index('--') + 1:]
job = json.load(open(job_path))
KINDS = ('scenes', 'objects', 'lights', 'meshes', 'materials', 'worlds', 'collections', 'texts', 'cameras',
         'curves', 'node_groups')
# Counters and caches that are no part of what a person made.
VOLATILE = {'rna_type', 'bl_rna', 'users', 'tag', 'original', 'is_evaluated', 'session_uuid', 'depsgraph',
            'view_layers', 'users_collection', 'users_scene', 'is_missing', 'is_runtime_data',
            'is_library_indirect', 'preview', 'asset_data', 'override_library', 'library', 'active_clip',
            'sequence_editor_storage', 'is_updated', 'is_updated_data', 'loop_triangles', 'id_data',
            'use_extra_user',
            'matrix_world', 'matrix_local', 'is_dirty', 'is_modified', 'is_in_memory', 'current_line', 'current_line_index'}


def picture(thing, depth=0):
    if depth > 7:
        return '...'
    found = {}
    for prop in thing.bl_rna.properties:
        name = prop.identifier
        if name in VOLATILE:
            continue
        value = getattr(thing, name, None)
        if prop.type == 'POINTER':
            if value is None or isinstance(value, bpy.types.ID) and not is_embedded(value):
                found[name] = value and value.name
            elif isinstance(value, (bpy.types.Node, bpy.types.NodeSocket)):
                found[name] = value.name  # the far end of a link
            else:
                found[name] = picture(value, depth + 1)
        elif prop.type == 'COLLECTION':
            found[name] = [item.name if isinstance(item, bpy.types.ID) else picture(item, depth + 1)
                           for item in value if not (depth > 1 and isinstance(item, bpy.types.NodeLink))]
        else:
            found[name] = repr(list(value)) if hasattr(value, '__len__') and not isinstance(value, str) else repr(value)
    if isinstance(thing, bpy.types.ID):
        groups = {key: thing[key] for key in thing.keys()}
        found['custom'] = {key: repr(value.to_dict() if hasattr(value, 'to_dict') else value)
                           for key, value in groups.items()}
        if isinstance(thing, bpy.types.Text):
            found['text'] = thing.as_string()
    return found


def is_embedded(value):
    return isinstance(value, bpy.types.NodeTree) and value.name not in bpy.data.node_groups


def state():
    found = {}
    for kind in KINDS:
        for thing in getattr(bpy.data, kind):
            found[kind + ':' + thing.name] = json.dumps(picture(thing), sort_keys=True, default=str)
    return found


def person_makes_a_scene():
    scene = bpy.context.scene
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    for number in range(40):
        kind = 'lamp' if number < 12 else 'other' if number < 18 else 'mesh' if number < 38 else 'empty'
        if kind == 'lamp':
            data = bpy.data.lights.new('PropLamp_%d' % number, ('POINT', 'SPOT', 'AREA')[number % 3])
            data.energy, data.color = 40.0 + number, (0.9, 0.8, 0.1)
        elif kind == 'other':
            data = bpy.data.lights.new('Fill_%d' % number, ('SUN', 'POINT', 'SPOT')[number % 3])
            data.energy = 3.0
        elif kind == 'mesh':
            data = bpy.data.meshes.new('Table_%d' % number)
            data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, number)], [], [(0, 1, 2)])
        else:
            data = bpy.data.cameras.new('Eye') if number == 38 else None
        name = data.name if data else 'Handle'
        thing = bpy.data.objects.new(name, data)
        thing.location = (number, math.sin(number), 2.0)
        thing.rotation_euler = (0.1 * number, 0, 0.5)
        thing['mine'] = number
        scene.collection.objects.link(thing)
    bpy.data.objects['PropLamp_0'].parent = bpy.data.objects['Handle']
    scene.camera = bpy.data.objects['Eye']
    scene.view_settings.exposure = 1.5
    scene.view_settings.view_transform = 'Filmic'
    bpy.context.view_layer.update()


person_makes_a_scene()
bpy.ops.ed.undo_push(message='a person at work')
states, logs = [state()], ['']
for step in job['steps']:
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        if 'run' in step:
            sys.argv = [step['run']]
            try:
                runpy.run_path(step['run'], run_name='__main__')
            except RuntimeError as stop:
                print(stop)
        elif 'undo' in step:
            bpy.ops.ed.undo()
        else:
            exec(step['edit'], {'bpy': bpy})
            bpy.ops.ed.undo_push(message='a person at work')
    states.append(state())
    logs.append(said.getvalue())
json.dump({'states': states, 'logs': logs}, open(out_path, 'w'))
