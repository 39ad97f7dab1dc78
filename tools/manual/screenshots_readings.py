# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""States of gloss, textures, instruments and of matching by measuring, for the manual's pictures.

As those of `screenshots_states`, which registers them and makes what they begin with.
"""

from __future__ import annotations

import importlib
import math
from typing import Any

import bpy

from tools.checks import textures
from tools.manual import screenshots_states as states

TILE = "\n".join(
    [
        "name,Gloss 60," + ",".join(f"R{nm} nm" for nm in states.BANDS),
        "Tile (SCI),15.8," + ",".join(f"{0.209 + (nm - 400) / 1500:.3f}" for nm in states.BANDS),
        "Tile (SCE),15.8," + ",".join(f"{0.2 + (nm - 400) / 1500:.3f}" for nm in states.BANDS),
    ]
)
"""Invented numbers, for pictures alone."""


def _ours(name: str) -> Any:
    return importlib.import_module(f"{states.PACKAGE}.addon.{name}")


def _material() -> Any:
    return bpy.context.view_layer.objects.active.active_material


def _principled(name: str) -> tuple[Any, Any]:
    """Put a Principled BSDF as Blender makes it on the plane; gives the material and the node."""
    thing = states._fresh()
    material = bpy.data.materials.new(name)
    thing.active_material = material
    return material, next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")


# Gloss -------------------------------------------------------------------------------------------


@states.picture("panel")
def gloss_too_much() -> None:
    """Show a black below a shine that sends more into the instrument than the whole is to read."""
    _, node = _principled("Paint")
    node.inputs["Specular IOR Level"].default_value = 1.0
    bpy.ops.rough_spectra.assign_preset(
        "EXEC_DEFAULT", preset="colorchecker/24-black-2", sigma=math.radians(20)
    )
    states.open_details()


@states.picture("panel")
def gloss_read() -> None:
    """Show a material that got the gloss of its sample: a sphere with and without, and 60°."""
    thing = states._fresh()
    path = states._write("tile.csv", TILE)
    bpy.ops.rough_spectra.assign_file("EXEC_DEFAULT", filepath=str(path))
    thing.active_material.rough_spectra.read_at = "de:8"
    bpy.ops.rough_spectra.renew("EXEC_DEFAULT")
    for twin in states.open_details(source=True):
        if "plots" in twin.__name__:  # all else fits into the window without them
            twin.poll = classmethod(lambda _cls, _context: False)


# Textures ----------------------------------------------------------------------------------------


def _textured() -> Any:
    """Let an image of bricks be the color of the plane, all of which it shows."""
    material, shader = _principled("Wall")
    shader.inputs["Specular IOR Level"].default_value = 0.0
    thing = bpy.context.view_layer.objects.active
    layer = thing.data.uv_layers.new(name="UVMap")
    layer.uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
    bpy.data.batch_remove(list(bpy.data.images))  # of earlier pictures
    texture = material.node_tree.nodes.new("ShaderNodeTexImage")
    texture.image = textures.image("bricks", textures.pictures()["bricks"])
    texture.location = (-620, 300)
    material.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    return material


def _choose(preset: str = "everyday/terracotta") -> None:
    states._press("rough_spectra.assign_sample", sample=preset)


def _is_looking() -> bool:
    window = bpy.context.window_manager.windows[0]
    return any("assign_sample" in operator.bl_idname for operator in window.modal_operators)


def _is_scaled() -> bool:
    return bool(_material().rough_spectra.spectrum)


@states.picture("status", ready=_is_looking)
def looking_at_textures() -> None:
    """Show how far the second Blender is that looks at a texture."""
    _textured()
    _choose()


@states.picture("panel", ready=_is_scaled)
def texture_scaled() -> None:
    """Show what is told of a texture that was scaled."""
    _textured()
    states.open_details()
    _choose()


_arranged: list[bool] = []


@states.picture("nodes", ready=lambda: bool(_arranged))
def texture_nodes() -> None:
    """Show the node that scales a texture, between it and the shader."""
    _arranged.clear()
    _textured()
    area = states._wide_area()
    area.ui_type = "ShaderNodeTree"
    space = area.spaces.active
    space.show_region_ui = space.show_region_toolbar = False
    space.overlay.show_context_path = False
    bpy.context.preferences.themes[0].node_editor.grid_levels = 0
    bpy.context.preferences.view.smooth_view = 0
    _choose()
    bpy.app.timers.register(_arrange, first_interval=0.5)


def _arrange() -> float | None:
    """Put the nodes side by side, once all are there and drawn, so that they fill the editor."""
    if not _is_scaled():
        return 0.2
    tree = _material().node_tree
    kinds = ("TEX_IMAGE", "MIX", "BSDF_PRINCIPLED", "OUTPUT_MATERIAL")
    for place, kind in enumerate(kinds):
        node = next(n for n in tree.nodes if n.type == kind)
        node.select, node.location = False, (290 * place, 0)
    bpy.app.timers.register(_look_at_all, first_interval=1.0)
    return None


def _look_at_all() -> None:
    area = states._wide_area()
    region = next(region for region in area.regions if region.type == "WINDOW")
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.node.view_all()
        bpy.ops.view2d.zoom_out(zoomfacx=-0.2, zoomfacy=-0.2)
    _arranged.append(True)


# Instruments -------------------------------------------------------------------------------------


@states.picture("panel", ready=lambda: states._is_measured())
def read_at() -> None:
    """Show a material that reads right toward the light, measured there."""
    states._assigned("everyday/concrete", 30.0).rough_spectra.read_at = "45as75"
    states.open_details()
    states._press("rough_spectra.measure", scope="ACTIVE")


# Matching by measuring ---------------------------------------------------------------------------


def _mixed() -> Any:
    """Mix some sheen into a material, so that no formula tells what it reads."""
    material = states._assigned("everyday/terracotta", 20.0)
    tree = material.node_tree
    shader = _ours("blender.surface").shader_node(material)
    mix, sheen = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("MixShader", "BsdfSheen"))
    mix.inputs[0].default_value = 0.3
    tree.links.new(shader.outputs[0], mix.inputs[1])
    tree.links.new(sheen.outputs[0], mix.inputs[2])
    output = tree.get_output_node("CYCLES")
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    return material


@states.picture("dialog")
def match_by_measuring() -> None:
    """Show what is asked before a material is matched by measuring."""
    _mixed()
    states._invoke(bpy.ops.rough_spectra.match_by_measuring)


@states.picture("panel", ready=lambda: states._is_measured())
def matched_by_measuring() -> None:
    """Show a mix of shaders whose color was found by measuring."""
    _mixed()
    states.open_details()
    # As a script does: nobody is asked.
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.rough_spectra.match_by_measuring("EXEC_DEFAULT")


@states.picture("panel", ready=lambda: states._is_measured())
def measured_flat() -> None:
    """Show what is said of a measurement that a flat sample cannot do right."""
    material = states._assigned("everyday/terracotta", 20.0)
    tree = material.node_tree
    paint = tree.nodes.new("ShaderNodeVertexColor")
    paint.layer_name = "Dirt"
    tree.links.new(paint.outputs["Color"], states._color_socket(material))
    states.open_details()
    states._press("rough_spectra.measure", scope="ACTIVE")
