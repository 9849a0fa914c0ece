# SPDX-License-Identifier: Apache-2.0
"""blender -b -P render_room.py -- ROOM.json WATTS R,G,B OUT.png LUX.json

Builds a traced room (traced_rooms --describe) in Blender, puts a point light of the typed watts and colour
where its lamp is, renders a view of it (OUT.png) and, by a diffuse card of 1 cm at .5, 1, 2 and 3 m that
faces the lamp, what a lux meter shows there (LUX.json)."""
import json
import math
import sys

import bpy
from mathutils import Vector

room_file, watts, color, picture, lux_file = sys.argv[sys.argv.index("--") + 1:]
room = json.load(open(room_file, encoding="utf-8"))
color = [float(c) for c in color.split(",")]
LUMINANCE = (0.2126, 0.7152, 0.0722)
CARD = 0.5  # its reflectance

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.world = bpy.data.worlds.new("none")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0
scene.cycles.max_bounces = 24
scene.cycles.diffuse_bounces = 24
scene.cycles.seed = 17
scene.cycles.use_denoising = False  # Debian builds without it


def matt(albedo):
    material = bpy.data.materials.new("matt")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs[0].default_value = (albedo, albedo, albedo, 1)
    diffuse.inputs[1].default_value = 0
    out = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs[0], out.inputs[0])
    return material


def face(name, corners, albedo):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    thing = bpy.data.objects.new(name, mesh)
    mesh.materials.append(matt(albedo))
    scene.collection.objects.link(thing)
    return thing


def box(name, low, high, albedos):
    """Six faces: x low, x high, y low, y high, z low, z high."""
    (a, b, c), (d, e, f) = low, high
    for i, corners in enumerate((
            [(a, b, c), (a, e, c), (a, e, f), (a, b, f)], [(d, b, c), (d, e, c), (d, e, f), (d, b, f)],
            [(a, b, c), (d, b, c), (d, b, f), (a, b, f)], [(a, e, c), (d, e, c), (d, e, f), (a, e, f)],
            [(a, b, c), (d, b, c), (d, e, c), (a, e, c)], [(a, b, f), (d, b, f), (d, e, f), (a, e, f)])):
        face(f"{name}{i}", corners, albedos[i])


box("wall", (0, 0, 0), room["size"], room["albedo"])
for n, one in enumerate(room["boxes"]):
    box(f"box{n}", one["low"], one["high"], [one["albedo"]] * 6)
place, towards = Vector(room["lamp"]["place"]), Vector(room["lamp"]["towards"])
light = bpy.data.lights.new("bulb", "POINT")
light.energy = float(watts)
light.color = color
light.shadow_soft_size = 0.03
bulb = bpy.data.objects.new("bulb", light)
bulb.location = place
scene.collection.objects.link(bulb)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
scene.camera = camera


def look(origin, target, clip=0.01):
    camera.location = origin
    camera.rotation_euler = (Vector(target) - Vector(origin)).to_track_quat("-Z", "Y").to_euler()
    camera.data.clip_start = clip


def render(path, kind, width, height, samples):
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.cycles.samples = samples
    scene.render.image_settings.file_format = kind
    if kind == "OPEN_EXR":
        scene.render.image_settings.color_depth = "32"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


# ---- lux: an orthographic look at a card that is too small to light anything ----
lux = {}
camera.data.type = "ORTHO"
camera.data.ortho_scale = 0.005
scene.view_settings.view_transform = "Raw"
up = Vector((0, 0, 1)).cross(towards).normalized()
side = towards.cross(up)
for d in (0.5, 1.0, 2.0, 3.0):
    middle = place + d * towards
    card = face("card", [middle + 0.005 * (s * up + t * side)
                         for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))], CARD)
    look(middle - 0.004 * towards, middle, 1e-4)
    render(lux_file + f".{d}.exr", "OPEN_EXR", 8, 8, 8192)
    image = bpy.data.images.load(lux_file + f".{d}.exr")
    pixels = list(image.pixels)
    mean = sum(LUMINANCE[k] * sum(pixels[k::4]) for k in range(3)) / 64
    lux[d] = 683 * math.pi / CARD * mean
    bpy.data.objects.remove(card)
json.dump(lux, open(lux_file, "w", encoding="utf-8"))

# ---- the view: from a corner, the wall where the lamp is and its light on it ----
camera.data.type = "PERSP"
camera.data.lens = 20
ball = bpy.ops.mesh.primitive_uv_sphere_add(radius=0.045, location=place)
glow = bpy.data.materials.new("glow")
glow.use_nodes = True
glow.node_tree.nodes.clear()
shine = glow.node_tree.nodes.new("ShaderNodeEmission")
shine.inputs[0].default_value = (*color, 1)
shine.inputs[1].default_value = 2.0
out = glow.node_tree.nodes.new("ShaderNodeOutputMaterial")
glow.node_tree.links.new(shine.outputs[0], out.inputs[0])
ball = bpy.context.object
ball.data.materials.append(glow)
for way in ("visible_shadow", "visible_diffuse"):
    setattr(ball, way, False)
for n, d in enumerate((0.5, 1.0, 2.0, 3.0)):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.035, location=place + d * towards)
    bpy.context.object.data.materials.append(matt(0.8))
    bpy.context.object.visible_shadow = False
look((0.35, 0.3, 1.75), (4.3, 2.2, 1.25))
scene.view_settings.view_transform = "Filmic"
scene.view_settings.exposure = 4.8
scene.render.image_settings.color_mode = "RGB"
scene.render.image_settings.quality = 88
render(picture, "JPEG", 420, 300, 256)
