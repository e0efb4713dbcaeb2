"""The passes file of a Blender scene: blender -b SCENE.blend -P blender_passes.py -- PASSES_ [SAMPLES]

Writes PASSES_0001.exr, the number being the frame's. Glossy becomes what has a Glossy BSDF of roughness 0 and of one
colour. Then, as often as you like: glossfilter PASSES_0001.exr --roughness 0.2 -o picture.png

Cycles renders the colours; the camera's rays and the mirrored ones are cast here, through the pixels' centres and off
the faces' own normals: smooth shading is not followed.
"""
import os
import sys

import bpy
import numpy as np


def mirrors():
    """The Glossy nodes of roughness 0 with the trees that they are in."""
    return [(material.node_tree, node) for material in bpy.data.materials if material.use_nodes
            for node in material.node_tree.nodes
            if node.type == "BSDF_GLOSSY" and node.inputs["Roughness"].default_value == 0]


def cast(scene):
    """Position and endpoint as images of four channels, rows from the bottom as Blender has them."""
    width, height = scene.render.resolution_x, scene.render.resolution_y
    graph = bpy.context.evaluated_depsgraph_get()
    camera = scene.camera.matrix_world
    eye, turn = camera.translation, camera.to_3x3()
    right, _, left, top = scene.camera.data.view_frame(scene=scene)  # upper and lower right, lower and upper left
    trees = [tree for tree, _ in mirrors()]
    position, endpoint = np.zeros((2, height, width, 4), np.float32)
    for y in range(height):
        for x in range(width):
            corner = left + (right - top) * ((x + 0.5) / width) + (top - left) * ((y + 0.5) / height)
            ray = (turn @ corner).normalized()
            hit, a, normal, face, thing, _ = scene.ray_cast(graph, eye, ray)
            if not hit:
                continue
            position[y, x, :3] = a
            slot = thing.data.polygons[face].material_index
            material = thing.material_slots[slot].material if slot < len(thing.material_slots) else None
            if not material or material.node_tree not in trees:
                continue
            mirrored = ray.reflect(normal)
            hit, b, *_ = scene.ray_cast(graph, a + mirrored * 1e-4 * (a - eye).length, mirrored)
            endpoint[y, x] = [*(b if hit else mirrored), hit]
    return position, endpoint


def image_node(tree, name, pixels):
    image = bpy.data.images.new(name, pixels.shape[1], pixels.shape[0], alpha=True, float_buffer=True, is_data=True)
    image.alpha_mode = "CHANNEL_PACKED"
    image.pixels.foreach_set(pixels.ravel())
    node = tree.nodes.new("CompositorNodeImage")
    node.image = image
    return node


def main(output, samples="64"):
    scene, layer = bpy.context.scene, bpy.context.view_layer
    scene.render.engine = "CYCLES"
    scene.render.resolution_percentage = 100
    scene.cycles.samples = int(samples)
    scene.cycles.use_denoising = False  # the filter is one, and not every build has another
    layer.use_pass_glossy_direct = layer.use_pass_glossy_indirect = layer.use_pass_glossy_color = True

    # The base: to the camera mirrors are black, to all other rays they are as they were.
    base = os.path.join(bpy.app.tempdir, "base.exr")
    added = []
    for tree, mirror in mirrors():
        path, mix = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMixRGB")
        mix.inputs["Color1"].default_value = mirror.inputs["Color"].default_value
        mix.inputs["Color2"].default_value = (0, 0, 0, 1)
        tree.links.new(path.outputs["Is Camera Ray"], mix.inputs["Fac"])
        tree.links.new(mix.outputs["Color"], mirror.inputs["Color"])
        added += [(tree, path), (tree, mix)]
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = base
    bpy.ops.render.render(write_still=True)
    for tree, node in added:
        tree.nodes.remove(node)

    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    rendered = tree.nodes.new("CompositorNodeRLayers")
    black = tree.nodes.new("CompositorNodeImage")
    black.image = bpy.data.images.load(base)
    target = tree.nodes.new("CompositorNodeOutputFile")
    target.base_path = output
    target.format.file_format = "OPEN_EXR_MULTILAYER"
    target.format.color_depth = "32"
    target.layer_slots.clear()

    def combine(operation, a, b):
        node = tree.nodes.new("CompositorNodeMixRGB")
        node.blend_type = operation
        tree.links.new(a, node.inputs[1])
        tree.links.new(b, node.inputs[2])
        return node.outputs[0]

    position, endpoint = cast(scene)
    for name, socket in {
            "base": black.outputs["Combined"],
            "specular": combine("ADD", rendered.outputs["GlossDir"], rendered.outputs["GlossInd"]),
            "reflectance": combine("SUBTRACT", rendered.outputs["GlossCol"], black.outputs["GlossCol"]),
            "P": image_node(tree, "P", position).outputs["Image"],
            "endpoint": image_node(tree, "endpoint", endpoint).outputs["Image"]}.items():
        target.layer_slots.new(name)
        tree.links.new(socket, target.inputs[name])
    bpy.ops.render.render()


main(*sys.argv[sys.argv.index("--") + 1:])
