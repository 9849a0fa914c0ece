# SPDX-License-Identifier: Apache-2.0
"""blender -b --factory-startup -P blender_area.py -- JOBS.json OUT.json
A white card where each meter stands, lit by a rectangle of radiance 1, rendered by Cycles with each
number of samples. Writes [[samples, seconds a render, [E/I ...]], ...]."""
import json
import math
import os
import sys
import time

import bpy
from mathutils import Matrix, Vector

jobs_path, out_path = sys.argv[sys.argv.index("--") + 1:]
jobs = json.load(open(jobs_path, encoding="utf-8"))
width, height = jobs["size"]
area = width * height

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.max_bounces = 0
scene.cycles.pixel_filter_type = "BOX"
scene.render.threads_mode = "FIXED"
scene.render.threads = 1
scene.render.use_persistent_data = True
scene.render.resolution_x = scene.render.resolution_y = 4
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = os.path.join(os.path.dirname(out_path), "area.exr")

lamp = bpy.data.lights.new("lamp", "AREA")
lamp.shape, lamp.size, lamp.size_y = "RECTANGLE", width, height
lamp.energy = 4 * area  # Cycles divides by four times the area
shining = bpy.data.objects.new("lamp", lamp)
shining.matrix_world = Matrix.Rotation(math.pi, 4, "X")  # an area light shines along its -z
scene.collection.objects.link(shining)

mesh = bpy.data.meshes.new("card")
H = 1e-4
mesh.from_pydata([(-H, -H, 0), (H, -H, 0), (H, H, 0), (-H, H, 0)], [], [(0, 1, 2, 3)])
material = bpy.data.materials.new("white")
material.use_nodes = True
material.node_tree.nodes.clear()
diffuse = material.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
material.node_tree.links.new(
    diffuse.outputs[0], material.node_tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
mesh.materials.append(material)
card = bpy.data.objects.new("card", mesh)
eye = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
eye.data.type, eye.data.ortho_scale, eye.data.clip_start = "ORTHO", H, 1e-5
for thing in (card, eye):
    scene.collection.objects.link(thing)
scene.camera = eye


def lux_per_candela(point, normal):
    normal = Vector(normal)
    side = normal.orthogonal().normalized()
    matrix = Matrix((side, normal.cross(side), normal)).transposed().to_4x4()
    card.matrix_world = Matrix.Translation(Vector(point)) @ matrix
    eye.matrix_world = Matrix.Translation(Vector(point) + normal * 1e-3) @ matrix
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    image.colorspace_settings.name = "Non-Color"
    pixels = list(image.pixels)[1::4]
    bpy.data.images.remove(image)
    return math.pi * sum(pixels) / len(pixels) / area


rows = []
for samples in jobs["samples"]:
    scene.cycles.samples = samples
    lux_per_candela(*jobs["meters"][0])
    start = time.process_time()
    answers = [lux_per_candela(*meter) for meter in jobs["meters"]]
    rows.append([samples, (time.process_time() - start) / len(answers), answers])
json.dump(rows, open(out_path, "w", encoding="utf-8"))
