# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scenes begin with: a window of two editors, and a wall."""

import importlib
import math

import bpy
from driver import TICK, area, window

PACKAGE = "bl_ext.user_default.rough_spectra"
OPS = bpy.ops.rough_spectra
GREEN = "colorchecker/14-green"


def ours(name):
    """Import a module of the installed extension."""
    return importlib.import_module(f"{PACKAGE}.{name}")


def layout(beside="TEXT_EDITOR"):
    """Show the Material tab, and another editor beside it.

    Not a viewport where none is needed: without a graphics card it draws for minutes.
    """
    areas = window().screen.areas
    for surplus in sorted(areas, key=lambda area: area.width * area.height)[:-2]:
        with bpy.context.temp_override(window=window(), area=surplus):
            bpy.ops.screen.area_close()
        yield TICK
    if len(areas) == 1:
        with bpy.context.temp_override(window=window(), area=areas[0]):
            bpy.ops.screen.area_split(direction="VERTICAL", factor=0.72)
        yield TICK
    left, right = sorted(areas, key=lambda area: area.x)
    left.type = "TEXT_EDITOR"
    right.type = "PROPERTIES"
    yield 0.3
    _ours_only()
    if beside != "TEXT_EDITOR":
        left.ui_type = beside
    with bpy.context.temp_override(window=window(), area=right):
        right.spaces.active.context = "MATERIAL"
    yield 0.3


def _ours_only():
    """Hide other panels of the tab, so that all of ours fits into it: a script cannot fold them."""
    for cls in bpy.types.Panel.__subclasses__():
        in_tab = getattr(cls, "bl_context", "") == "material" and getattr(cls, "bl_label", "")
        if in_tab and cls.is_registered and "rough_spectra" not in cls.__module__:
            cls.poll = classmethod(lambda _cls, _context: False)


def open_details():
    """Register the panels anew, with Details open at first: a script cannot unfold one."""
    panels = ours("addon.interface.panels.panels")
    for cls in reversed(panels.classes):
        bpy.utils.unregister_class(cls)
    panels._Details.bl_options = set()
    for cls in panels.classes:
        bpy.utils.register_class(cls)


def empty_file(beside="TEXT_EDITOR"):
    """Open an empty file, with a plane in it that has no material."""
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    yield 0.3
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    thing = bpy.data.objects.new("Wall", mesh)
    scene.collection.objects.link(thing)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    yield from layout(beside)
    undo_step("Wall")


def green_file(beside="TEXT_EDITOR"):
    """As `empty_file`, with the green of the ColorChecker at 30° on the plane."""
    yield from empty_file(beside)
    with bpy.context.temp_override(window=window(), area=area("PROPERTIES")):
        OPS.assign_preset("EXEC_DEFAULT", preset=GREEN, sigma=math.radians(30))
    undo_step("Green")
    yield 1.0


def undo_step(name):
    """Push a step, as an operator that the user calls does."""
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo_push(message=name)


def wall():
    """Give the plane's material, or None; undo makes it another one in memory."""
    return bpy.data.objects["Wall"].active_material


def state():
    """Tell everything that undo has to restore."""
    material = wall()
    if material is None:
        return None
    nodes = ours("addon.blender.shader_nodes")
    node = nodes.shader_node(material)
    group = material.rough_spectra
    return {
        "sample": group.sample_name,
        "sigma": group.sigma,
        "color": list(nodes.color_socket(node).default_value)[:3],
        "roughness": nodes.roughness_socket(node).default_value,
        "stamp": group.stamp,
        "kind": ours("addon.material.state").state(material).kind,
    }
