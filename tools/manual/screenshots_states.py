# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The states that the manual's pictures show; see `screenshots_inside`."""

from __future__ import annotations

import importlib
import math
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bmesh
import bpy

from tools.run.run_command_line import ROOT

BANDS = range(400, 701, 20)
PLASTER = "\n".join(
    [
        "name," + ",".join(f"R{nm} nm" for nm in BANDS),
        "Plaster," + ",".join(f"{0.6 + (nm - 400) / 2000:.3f}" for nm in BANDS),
        "Plaster with noise," + ",".join(f"{(nm - 404) / 1000:.3f}" for nm in BANDS),
    ]
)
LAMP = "wavelength,irradiance\n" + "\n".join(f"{nm},{nm / 10}" for nm in BANDS)
"""Invented numbers, for pictures alone."""

TERRACOTTA = ROOT / "tests" / "fixtures" / "nix" / "terracotta.csv"

KEY = "F19"
PACKAGE = "bl_ext.user_default.rough_spectra"


@dataclass(frozen=True)
class Picture:
    """A state of the window.

    Parameters
    ----------
    show
        Puts the window into the state.
    part
        "panel", "sidebar", "dialog", "nodes", "status", "preferences", "view" or "window": what is
        saved.
    ready
        Whether what takes its time is there.
    """

    show: Callable[[], Any]
    part: str
    ready: Callable[[], bool]


PICTURES: dict[str, Picture] = {}


def picture(part: str, ready: Callable[[], bool] = lambda: True) -> Callable[..., Any]:
    """Register what puts the window into a state."""

    def register(show: Callable[[], Any]) -> Callable[[], Any]:
        PICTURES[show.__name__.replace("_", "-")] = Picture(show, part, ready)
        return show

    return register


# The window --------------------------------------------------------------------------------------


def split_window(width: float) -> None:
    """Make the window a text editor beside the Material tab: a viewport would draw for minutes."""
    window = bpy.context.window_manager.windows[0]
    for area in sorted(window.screen.areas, key=lambda area: area.width * area.height)[:-1]:
        with bpy.context.temp_override(window=window, area=area):
            bpy.ops.screen.area_close()
    area = window.screen.areas[0]
    area.type = "TEXT_EDITOR"
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=1 - width / area.width)


def show_material_tab() -> None:
    """Turn the narrow area, whose place is known after a redraw, into the Material tab."""
    window = bpy.context.window_manager.windows[0]
    panel = max(window.screen.areas, key=lambda area: area.x)
    panel.type = "PROPERTIES"
    # A script cannot fold panels, so the others of the tab are hidden.
    for cls in bpy.types.Panel.__subclasses__():
        in_tab = getattr(cls, "bl_context", "") == "material" and getattr(cls, "bl_label", "")
        if in_tab and cls.is_registered and "rough_spectra" not in cls.__module__:
            cls.poll = classmethod(lambda _cls, _context: False)
    with bpy.context.temp_override(window=window, area=panel):
        panel.spaces.active.context = "MATERIAL"


def _fresh() -> Any:
    """Leave one plane, without a material, and no light; Details is closed."""
    close_details()
    if _wide_area().type != "TEXT_EDITOR":
        _wide_area().type = "TEXT_EDITOR"
    bpy.ops.wm.set_working_color_space(convert_colors=True, working_space="Linear Rec.709")
    things = [thing for thing in bpy.data.objects if thing.type != "CAMERA"]
    bpy.data.batch_remove([*things, *bpy.data.materials, *bpy.data.lights])
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    thing = bpy.data.objects.new("Wall", mesh)
    scene.collection.objects.link(thing)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    return thing


def _wide_area() -> Any:
    return min(bpy.context.window_manager.windows[0].screen.areas, key=lambda area: area.x)


def _assigned(preset: str = "everyday/brick", degrees: float = 20.0) -> Any:
    thing = _fresh()
    bpy.ops.rough_spectra.assign_preset("EXEC_DEFAULT", preset=preset, sigma=math.radians(degrees))
    return thing.active_material


def _color_socket(material: Any) -> Any:
    node = next(node for node in material.node_tree.nodes if node.type.startswith("BSDF"))
    return node.inputs[0]


def _invoke(operator: Callable[..., Any], **options: Any) -> None:
    """Open an operator's dialog in the middle of the text editor."""
    window = bpy.context.window_manager.windows[0]
    area = _wide_area()
    window.cursor_warp(area.x + area.width // 2, area.y + area.height // 2)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        operator("INVOKE_DEFAULT", **options)


def _press(operator: str, **options: Any) -> None:
    """Have the user press a key for an operator: only then does Blender show its messages."""
    window = bpy.context.window_manager.windows[0]
    keys = bpy.context.window_manager.keyconfigs.addon.keymaps.new("Window")
    for item in [item for item in keys.keymap_items if item.type == KEY]:
        keys.keymap_items.remove(item)
    item = keys.keymap_items.new(operator, KEY, "PRESS")
    for name, value in options.items():
        setattr(item.properties, name, value)
    area = _wide_area()
    where = {"x": area.x + area.width * 3 // 4, "y": area.y + area.height // 2}

    def strike() -> None:
        window.event_simulate(type="MOUSEMOVE", value="NOTHING", **where)
        for value in ("PRESS", "RELEASE"):
            window.event_simulate(type=KEY, value=value, **where)

    bpy.app.timers.register(strike, first_interval=0.3)  # when Blender knows of the key


def _folder() -> Path:
    """Where pictures show that files are."""
    folder = Path(tempfile.gettempdir(), "measured")
    folder.mkdir(exist_ok=True)
    return folder


def _write(name: str, text: str) -> Path:
    path = _folder() / name
    path.write_text(text, encoding="utf-8")
    return path


# States of the panel -----------------------------------------------------------------------------


@picture("panel")
def empty() -> None:
    """Show a mesh without a material."""
    _fresh()


@picture("panel")
def without_spectrum() -> None:
    """Show a material that stores no spectrum."""
    _fresh().data.materials.append(bpy.data.materials.new("Paint"))


@picture("panel")
def assigned() -> None:
    """Show a preset as everybody sees it."""
    _assigned()


@picture("panel")
def details() -> None:
    """Show all that Details holds."""
    _assigned()
    open_details()


@picture("panel")
def stale_details() -> None:
    """Show what Details says of a color that was edited by hand."""
    edited()
    open_details()


@picture("panel")
def glossy() -> None:
    """Show a preset with gloss."""
    _assigned().rough_spectra.gloss = 0.4


@picture("panel")
def polished() -> None:
    """Show a preset as shiny as can be."""
    _assigned().rough_spectra.gloss = 1.0


@picture("panel")
def several() -> None:
    """Show three selected objects with a material of their own each."""
    material = _assigned()
    for _ in range(2):
        thing = bpy.context.view_layer.objects.active.copy()
        thing.data = thing.data.copy()
        bpy.context.scene.collection.objects.link(thing)
        thing.active_material = material.copy()
        thing.select_set(True)


@picture("panel")
def smooth() -> None:
    """Show a preset as it is assigned first, at 0°."""
    _assigned(degrees=0.0)


@picture("panel")
def out_of_gamut() -> None:
    """Show a color that the working space cannot hold."""
    _assigned("colorchecker/18-cyan")


@picture("panel")
def reading() -> None:
    """Show a reading of a ring light."""
    material = _assigned("colorchecker/19-white-9-5", 20.0)
    material.rough_spectra.kind = "reading"


@picture("panel")
def infeasible() -> None:
    """Show a reading that is brighter than white facets of this roughness would give."""
    thing = _fresh()
    path = _write("chalk.csv", "wavelength,Chalk\n" + "\n".join(f"{nm},0.94" for nm in BANDS))
    bpy.ops.rough_spectra.assign_file("EXEC_DEFAULT", filepath=str(path), sigma=math.radians(60))
    thing.active_material.rough_spectra.model = "two-bounce"
    open_details()


@picture("panel")
def edited() -> None:
    """Show a color that was edited by hand."""
    _color_socket(_assigned()).default_value = (0.4, 0.1, 0.1, 1)


@picture("panel")
def kept() -> None:
    """Show an edit by hand that the user keeps."""
    _color_socket(_assigned()).default_value = (0.08, 0.25, 0.1, 1)
    bpy.ops.rough_spectra.keep()


@picture("panel")
def working_space() -> None:
    """Show what a change of the working space does."""
    _assigned()
    bpy.ops.wm.set_working_color_space(convert_colors=True, working_space="ACEScg")


@picture("panel")
def not_derived() -> None:
    """Show a setting with which the color cannot be derived."""
    material = _assigned()
    links = material.node_tree.links
    noise = material.node_tree.nodes.new("ShaderNodeTexNoise")
    links.new(noise.outputs["Color"], _color_socket(material))
    material.rough_spectra.sigma = math.radians(20)


@picture("panel")
def driven() -> None:
    """Show a driver that keeps the color from being renewed, and the button that clears it."""
    socket = _color_socket(_assigned())
    socket.default_value = (0.4, 0.08, 0.08, 1)
    socket.driver_add("default_value", 3)
    open_details()


@picture("panel")
def metallic() -> None:
    """Show metal that keeps the color from being predicted, and the buttons for it."""
    material = _assigned()
    material.rough_spectra.shader = "PRINCIPLED"
    node = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    node.inputs["Metallic"].default_value = 0.5
    open_details()


@picture("panel")
def linked() -> None:
    """Show a material of another file."""
    material = _assigned()
    path, name = str(_folder() / "library.blend"), material.name
    bpy.data.libraries.write(path, {material}, fake_user=True)
    thing = _fresh()
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.materials = [name]
    thing.data.materials.append(wanted.materials[0])


@picture("panel")
def eevee() -> None:
    """Show that Eevee leaves the roughness out."""
    _assigned()
    bpy.context.scene.render.engine = "BLENDER_EEVEE"


@picture("panel")
def lit_by_the_scene() -> None:
    """Show a material that follows one incandescent lamp."""
    _assigned("colorchecker/09-moderate-red")
    _lights(("AREA", (1.5, -1.0, 2.0), 150.0, 2856.0))
    bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT")


@picture("panel")
def lit_by_several() -> None:
    """Show a material that no color makes right under all of its lights."""
    _assigned("colorchecker/09-moderate-red")
    _lights(("AREA", (1.5, -1.0, 2.0), 150.0, 2856.0), ("SUN", (-2.0, 2.0, 3.0), 1.0, 6500.0))
    bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT")
    open_details()


def _lights(*lights: tuple[str, tuple[float, float, float], float, float]) -> None:
    scene = bpy.context.scene
    scene.world = None
    for kind, place, energy, kelvin in lights:
        light = bpy.data.lights.new("Lamp" if kind == "AREA" else "Sun", kind)
        light.energy, light.use_temperature, light.temperature = energy, True, kelvin
        thing = bpy.data.objects.new(light.name, light)
        thing.location = place
        scene.collection.objects.link(thing)
    camera = scene.camera
    camera.location, camera.rotation_euler = (0.0, 0.0, 6.0), (0.0, 0.0, 0.0)


@picture("panel")
def source() -> None:
    """Show where a spectrum comes from: an instrument's file, with all that it says."""
    _fresh()
    path = _write("terracotta.csv", TERRACOTTA.read_text(encoding="utf-8"))
    bpy.ops.rough_spectra.assign_file("EXEC_DEFAULT", filepath=str(path), sigma=math.radians(15))
    open_details(source=True)


def open_details(source: bool = False) -> list[Any]:
    """Show Details open, which a script cannot do: by twins that are so by default, which it gives.

    `source` is whether the box Source is open, too.
    """
    panels = importlib.import_module(f"{PACKAGE}.addon.interface.panels.panels")
    closed = bpy.types.ROUGHSPECTRA_PT_details
    kept = ("__doc__", "bl_label", "bl_options", "poll", "draw")
    content: dict[str, Any] = {"bl_options": set(), "bl_parent_id": closed.bl_parent_id}
    twins = [type(f"{closed.__name__}_open", closed.__bases__, content)]
    for cls in panels.classes:
        if getattr(cls, "bl_parent_id", "") != closed.__name__:
            continue
        content = {name: vars(cls)[name] for name in kept if name in vars(cls)}
        content["bl_parent_id"] = twins[0].__name__
        if source:
            content["bl_options"] = set()
        name = f"{cls.__name__}_{'all' if source else 'some'}"
        twins.append(type(name, cls.__bases__, content))
    for twin in twins:
        bpy.utils.register_class(twin)
    _twins.extend(twins)
    closed.poll = classmethod(lambda _cls, _context: False)
    return twins


def close_details() -> None:
    """Undo `open_details`."""
    for twin in reversed(_twins):
        bpy.utils.unregister_class(twin)
    if _twins:
        del bpy.types.ROUGHSPECTRA_PT_details.poll
    _twins.clear()


_twins: list[Any] = []


# Measuring ---------------------------------------------------------------------------------------


def _is_measured() -> bool:
    material = bpy.context.view_layer.objects.active.active_material
    return bool(material.rough_spectra.measured)


@picture("status")
def measuring() -> None:
    """Show how far a measurement is."""
    _assigned()
    _press("rough_spectra.measure", scope="ACTIVE")


@picture("panel", ready=_is_measured)
def metal_measured() -> None:
    """Show what a measurement found of metal, of which nothing is predicted."""
    metallic()
    close_details()
    _press("rough_spectra.measure", scope="ACTIVE")


@picture("panel", ready=_is_measured)
def measured() -> None:
    """Show a measurement beside the prediction."""
    _assigned()
    open_details()
    _press("rough_spectra.measure", scope="ACTIVE")


@picture("panel")
def measured_before() -> None:
    """Show a measurement that is of earlier settings: in the state that `measured` left."""
    if not _is_measured_here():
        return
    material = bpy.context.view_layer.objects.active.active_material
    material.rough_spectra.sigma = math.radians(30)


def _is_measured_here() -> bool:
    thing = bpy.context.view_layer.objects.active
    return thing is not None and thing.active_material is not None and _is_measured()


@picture("panel", ready=_is_measured)
def measured_here() -> None:
    """Show what was read of a spot on a surface."""
    _assigned()
    open_details()
    above = {"origin": (0.3, 0.2, 5.0), "direction": (0.0, 0.0, -1.0)}
    _press("rough_spectra.measure_here", **above)


def _is_choosing() -> bool:
    window = bpy.context.window_manager.windows[0]
    return any("measure_here" in operator.bl_idname for operator in window.modal_operators)


@picture("status", ready=_is_choosing)
def measure_here() -> None:
    """Show what the keys do while a place is chosen."""
    _assigned()
    _wide_area().type = "VIEW_3D"
    _press("rough_spectra.measure_here")


# Dialogs, menus and messages ---------------------------------------------------------------------


@picture("dialog")
def choose_own() -> None:
    """Show that the list begins with what the file has."""
    _assigned().rough_spectra.gloss = 0.5
    choosing = bpy.context.view_layer.objects.active
    other = choosing.copy()
    other.data = choosing.data.copy()
    other.data.materials.clear()
    bpy.context.scene.collection.objects.link(other)
    choosing.select_set(False)
    other.select_set(True)
    bpy.context.view_layer.objects.active = other
    _invoke(bpy.ops.rough_spectra.choose_sample)


@picture("dialog")
def choose_sample() -> None:
    """Show the search among presets and library."""
    _fresh()
    _invoke(bpy.ops.rough_spectra.choose_sample)


@picture("dialog")
def find_nearest() -> None:
    """Show the samples nearest to a color."""
    _fresh()
    _invoke(bpy.ops.rough_spectra.find_nearest, color=(0.55, 0.35, 0.25))


@picture("dialog")
def import_review() -> None:
    """Show what is in files before anything is kept."""
    _fresh()
    paths = (_write("plaster.csv", PLASTER), _write("lamp.csv", LAMP))
    files = [{"name": path.name} for path in paths]
    _invoke(bpy.ops.rough_spectra.import_samples, directory=str(paths[0].parent), files=files)


@picture("dialog")
def file_refused() -> None:
    """Show what is said of a file that cannot be used."""
    _fresh()
    _press("rough_spectra.import_samples", filepath=str(_write("lamp.csv", LAMP)))


@picture("dialog")
def context_menu() -> None:
    """Show the entry in a right-click menu."""
    _assigned()
    _invoke(bpy.ops.wm.call_menu, name="MATERIAL_MT_context_menu")


def _is_pictured() -> bool:
    """Whether the balls of tab and sidebar are made, which differ in size: a viewport is slow."""
    icons = importlib.import_module(f"{PACKAGE}.addon.preview.icons")
    material = bpy.context.view_layer.objects.active.active_material
    balls = [wish for wish in icons._pictures if wish.figure == "ball"]
    return sum(wish.material == material.session_uid for wish in balls) > 1


@picture("sidebar", ready=_is_pictured)
def shader_editor() -> None:
    """Show the panel in the shader editor's sidebar."""
    material = _assigned()
    for node in material.node_tree.nodes:
        node.location.x -= 2000  # it would show through
    area = _wide_area()
    area.ui_type = "ShaderNodeTree"
    area.spaces.active.show_region_ui = True
    bpy.app.timers.register(_choose_tab, first_interval=0.5)  # when the sidebar has tabs


def _choose_tab() -> None:
    [region] = [region for region in _wide_area().regions if region.type == "UI"]
    region.active_panel_category = "Rough Spectra"
    region.tag_redraw()


SHELF_SECONDS = 12.0
_since: dict[str, float] = {}


def _shelf_is_there() -> bool:
    _wide_area().tag_redraw()  # pictures are asked for where they are drawn
    return time.monotonic() > _since["shelf"] + SHELF_SECONDS


@picture("view", _shelf_is_there)
def shelf() -> None:
    """Show the asset shelf below a cube of bricks' color; its pictures arrive by and by."""
    thing = _fresh()
    cube = bmesh.new()
    bmesh.ops.create_cube(cube, size=2)
    cube.to_mesh(thing.data)
    cube.free()
    ours = importlib.import_module("bl_ext.user_default.rough_spectra.addon.assets.shelf")
    path = str(ours.folder() / ours.BLEND)
    with bpy.data.libraries.load(path) as (_, wanted):
        wanted.materials = ["Brick"]  # as a drag does
    thing.active_material = wanted.materials[0]
    thing.active_material.asset_clear()  # or it would be on the shelf itself
    area = _wide_area()
    area.type = "VIEW_3D"
    space = area.spaces.active
    space.shading.type, space.shading.color_type = "SOLID", "MATERIAL"
    space.region_3d.view_location = (0, 0, 5.2)  # the cube in the lower half, which is shown
    space.region_3d.view_distance = 12
    _since["shelf"] = time.monotonic()


@picture("sidebar", ready=_is_pictured)
def view() -> None:
    """Show the panel in the sidebar of the 3D view."""
    _assigned()
    area = _wide_area()
    area.ui_type = "VIEW_3D"
    area.spaces.active.overlay.show_overlays = False
    area.spaces.active.show_region_ui = True
    bpy.app.timers.register(_choose_tab, first_interval=0.5)


@picture("preferences")
def preferences() -> None:
    """Show what new materials begin with."""
    _fresh()
    bpy.ops.preferences.addon_show(module=PACKAGE)
