# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of surfaces whose readings are known."""

import math
import tempfile
from pathlib import Path

import bpy
import mathutils
import numpy as np
from rough_spectra.addon.instrument import spot
from rough_spectra.addon.support import png

STEEPEST = 0.45
"""Slope of waves. Light from 45° then reaches all of them."""
WAVES = 5
"""Within a square of one unit."""
DARK = 0.02
LEFT, RIGHT = (0.6, 0.2, 0.1), (0.1, 0.3, 0.5)
LEAN = (math.sin(0.2), 0.0, math.cos(0.2))
TILE = (0.25, 0.5, 0.125)


def material(name, node="ShaderNodeBsdfDiffuse", **sockets):
    made = bpy.data.materials.new(name)
    if made.node_tree is None:
        made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output, shader = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new(node)
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    for socket, value in sockets.items():
        shader.inputs[socket.replace("_", " ")].default_value = value
    return made


def colored(name, color, roughness=0.0):
    return material(name, Color=(*color, 1), Roughness=roughness)


def add(name, vertices, faces, *materials, **place):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], [tuple(f) for f in faces])
    for each in materials:
        mesh.materials.append(each)
    thing = bpy.data.objects.new(name, mesh)
    for key, value in place.items():
        setattr(thing, key, value)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def square(name, *materials, size=1.0, **place):
    """Two halves, beside each other along x, each with its own material."""
    x = np.array([-1, 0, 1]) * size / 2
    vertices = [(each, y * size / 2, 0) for y in (-1, 1) for each in x]
    thing = add(name, vertices, [(0, 1, 4, 3), (1, 2, 5, 4)], *materials, **place)
    thing.data.polygons[1].material_index = len(materials) - 1
    return thing


def cube(name, *materials, **place):
    vertices = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return add(name, vertices, faces, *materials, **place)


def waves(name, made, height, cells=160, **place):
    """A smooth square whose vertices have the heights that are given."""
    at = np.linspace(-0.5, 0.5, cells + 1)
    x, y = np.meshgrid(at, at)
    vertices = np.stack((x, y, height * np.sin(2 * np.pi * WAVES * x)), axis=-1).reshape(-1, 3)
    first = (np.arange(cells)[:, np.newaxis] * (cells + 1) + np.arange(cells)).ravel()
    faces = np.stack((first, first + 1, first + cells + 2, first + cells + 1), axis=1)
    thing = add(name, vertices, faces, made, **place)
    thing.data.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
    return thing


def displaced(name, color, height):
    """Waves along the object's x, made by the material."""
    made = colored(name, color)
    tree = made.node_tree
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    new = tree.nodes.new
    apart, turned, sine = new("ShaderNodeSeparateXYZ"), new("ShaderNodeMath"), new("ShaderNodeMath")
    turned.operation, sine.operation = "MULTIPLY", "SINE"
    turned.inputs[1].default_value = 2 * math.pi * WAVES
    moved = new("ShaderNodeDisplacement")
    moved.inputs["Scale"].default_value, moved.inputs["Midlevel"].default_value = height, 0.0
    tree.links.new(new("ShaderNodeTexCoord").outputs["Object"], apart.inputs[0])
    tree.links.new(apart.outputs["X"], turned.inputs[0])
    tree.links.new(turned.outputs[0], sine.inputs[0])
    tree.links.new(sine.outputs[0], moved.inputs["Height"])
    tree.links.new(moved.outputs[0], output.inputs["Displacement"])
    made.displacement_method = "DISPLACEMENT"
    return made


def raised(name, color, height):
    """Moved away by the material, all of it by as much."""
    made = colored(name, color)
    moved = made.node_tree.nodes.new("ShaderNodeDisplacement")
    moved.inputs["Height"].default_value, moved.inputs["Scale"].default_value = height, 1.0
    moved.inputs["Midlevel"].default_value = 0.0
    output = made.node_tree.nodes["Material Output"]
    made.node_tree.links.new(moved.outputs[0], output.inputs["Displacement"])
    made.displacement_method = "DISPLACEMENT"
    return made


def leaning(name):
    """Matte, its normals leaning along U."""
    made = colored(name, (0.5, 0.5, 0.5))
    tree = made.node_tree
    leans = tree.nodes.new("ShaderNodeNormalMap")
    leans.inputs["Color"].default_value = tuple(0.5 + 0.5 * x for x in (*LEAN, 1))
    tree.links.new(leans.outputs[0], tree.nodes["Diffuse BSDF"].inputs["Normal"])
    return made


def by_attribute(name):
    made = colored(name, (0, 0, 0))
    tree = made.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    node = tree.nodes.new("ShaderNodeVertexColor")
    node.layer_name = "Paint"
    tree.links.new(node.outputs["Color"], shader.inputs["Color"])
    return made


def by_image(name, image, uv_map):
    made = colored(name, (0, 0, 0))
    tree = made.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    texture, at = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeUVMap")
    texture.image, texture.interpolation, at.uv_map = image, "Closest", uv_map
    tree.links.new(at.outputs[0], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], shader.inputs["Color"])
    return made


def udim(folder):
    """Two tiles: one is red, and the other has the color `TILE`."""
    for number, color in ((1001, (1, 0, 0)), (1002, TILE)):
        values = np.broadcast_to(np.round(np.array(color) * 255).astype(np.uint8), (4, 4, 3))
        (folder / f"tiles.{number}.png").write_bytes(png.encode(values))
    image = bpy.data.images.load(str(folder / "tiles.1001.png"))
    image.source, image.filepath = "TILED", str(folder / "tiles.<UDIM>.png")
    if 1002 not in [tile.number for tile in image.tiles]:
        image.tiles.new(1002)
    image.colorspace_settings.name = "Non-Color"
    return image


def put_uv(thing, name, values, offset):
    layer = thing.data.uv_layers.new(name=name)
    layer.data.foreach_set("uv", (np.asarray(values) + offset).astype(np.float32).ravel())


def build():
    """Make the scene; gives its objects, and flat samples of its colors, by name."""
    folder = Path(tempfile.mkdtemp(prefix="tiles-"))
    paint, matte = colored("Paint", (0.4, 0.25, 0.1), 0.3), colored("Matte", (0.4, 0.25, 0.1))
    dark, white = colored("Dark", (DARK,) * 3), colored("White", (0.9,) * 3)
    image = udim(folder)
    shiny = material("Shiny", "ShaderNodeBsdfPrincipled", Base_Color=(0.4, 0.2, 0.1, 1))
    height = STEEPEST / (2 * math.pi * WAVES)
    turned = {"rotation_euler": (0.3, 0.5, 0.7)}
    bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, location=(-2, 1, 0))
    ball = bpy.context.object
    ball.data.materials.append(matte)
    ball.data.polygons.foreach_set("use_smooth", np.ones(len(ball.data.polygons), bool))
    two_uv = square("Named", by_image("By map", image, "Second"), location=(0, 30, 0))
    tiled = square("Tiled", by_image("By tile", image, "UVMap"), location=(3, 30, 0))
    corners = np.tile([[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]], (2, 1))
    put_uv(two_uv, "UVMap", corners, (0, 0))
    put_uv(two_uv, "Second", corners, (1, 0))
    put_uv(tiled, "UVMap", corners, (1, 0))
    leans = square("Leaning", leaning("Leaning"), location=(9, -3, 1), **turned)
    put_uv(leans, "UVMap", corners, (0, 0))
    attribute = square("Attribute", by_attribute("By attribute"), location=(6, 30, 0))
    layer = attribute.data.color_attributes.new("Paint", "FLOAT_COLOR", "CORNER")
    for number, corner in enumerate(layer.data):
        corner.color = (*(LEFT if number < 4 else RIGHT), 1)
    things = {
        "cube": cube("Cube", paint, location=(5, -3, 2), **turned),
        "shiny": cube("Shiny", shiny, location=(9, 3, 1), **turned),
        "leaning": leans,
        "ball": ball,
        "waves": waves("Waves", dark, height, location=(0, 10, 0)),
        "white waves": waves("White waves", white, height, location=(2, 10, 0)),
        "displaced": waves(
            "Displaced", displaced("Displaced", (DARK,) * 3, height), 0.0, location=(4, 10, 0)
        ),
        "raised": square("Raised", raised("Raised", (0.4, 0.25, 0.1), 0.3), location=(6, 10, 0)),
        "attribute": attribute,
        "tile": tiled,
        "named": two_uv,
        "floor": square("Floor", paint, location=(0, 20, 0), size=0.1),
        "room": cube("Room", matte, location=(20, 0, 0)),
        "two": square("Two", paint, dark, location=(9, 30, 0)),
    }
    red = colored("Red", (0.8, 0, 0))
    glow = red.node_tree.nodes.new("ShaderNodeEmission")
    glow.inputs["Color"].default_value = (1, 0, 0, 1)
    both = red.node_tree.nodes.new("ShaderNodeAddShader")
    output = next(node for node in red.node_tree.nodes if node.type == "OUTPUT_MATERIAL")
    red.node_tree.links.new(red.node_tree.nodes["Diffuse BSDF"].outputs[0], both.inputs[0])
    red.node_tree.links.new(glow.outputs[0], both.inputs[1])
    red.node_tree.links.new(both.outputs[0], output.inputs["Surface"])
    square("Wall", red, location=(0.011, 20, 0), rotation_euler=(0, math.pi / 2, 0), size=0.1)
    stored = square("Stored", paint)
    kept = bpy.data.collections.new("Kept")
    bpy.context.scene.collection.objects.unlink(stored)
    kept.objects.link(stored)
    instance = bpy.data.objects.new("Instance", None)
    instance.instance_type, instance.instance_collection = "COLLECTION", kept
    instance.location, instance.rotation_euler = (0, -20, 0), (0.2, 0.1, 0)
    bpy.context.scene.collection.objects.link(instance)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    bpy.context.scene.collection.objects.link(sun)
    flats = {"paint": paint, "matte": matte, "dark": dark, "white": white, "shiny": shiny}
    for name, color in (("left", LEFT), ("right", RIGHT)):
        flats[name] = colored(name, color)
    flats["tile"] = colored("tile", np.round(np.array(TILE) * 255) / 255)
    return things, flats


def spots(things):
    """Put the instrument down, by name."""
    context, down = bpy.context, (0, 0, -1)

    def ray(x, y, **how):
        return spot.at_ray(context, (x, y, 5), down, **how)

    top = bpy.data.objects.new("Top", None)
    face = things["leaning"].matrix_world
    top.matrix_world = face @ mathutils.Matrix.Translation((0.2, 0.3, 0.5))
    context.scene.collection.objects.link(top)
    room = things["room"]
    return {
        "cube": spot.on_materials(things["cube"])[0],
        "shiny": spot.on_materials(things["shiny"])[0],
        "leaning": spot.at_empty(things["leaning"], top),
        "ball": ray(-2, 1.01),
        "wide ball": ray(-2, 1, diameter=800),
        "waves": ray(0, 10, diameter=800),
        "white waves": ray(2, 10, diameter=800),
        "displaced": ray(4, 10, diameter=800),
        "raised": ray(6.1, 10),
        "attribute": ray(6, 30, diameter=100),
        "tile": ray(3.1, 30),
        "named": ray(0.1, 30),
        "alone": ray(0, 20),
        "beside": ray(0, 20, is_alone=False),
        "room": spot.at_ray(context, tuple(room.location), (1, 0.1, 0.1)),
        "instance": ray(0.1, -20),
        "edge": ray(9, 29.5 + 0.0108, diameter=40),
    }
