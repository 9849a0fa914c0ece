# SPDX-License-Identifier: Apache-2.0
"""Run by Blender: a square that throws back all light alike to every side."""
import bpy


def white_face(name, half):
    """The object, `half` metres to each side of its place, facing up; to be linked to a scene."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse = tree.nodes.new('ShaderNodeBsdfDiffuse')
    diffuse.inputs['Color'].default_value = (1, 1, 1, 1)
    output = tree.nodes.new('ShaderNodeOutputMaterial')
    tree.links.new(diffuse.outputs[0], output.inputs[0])
    mesh.materials.append(material)
    return bpy.data.objects.new(name, mesh)
