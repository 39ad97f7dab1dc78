# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of `screenshots` that runs inside the desktop Blender.

A picture is a function that puts the window into a state. Blender then redraws until everything
that is drawn later has arrived, and the area or the window is saved.
"""

from __future__ import annotations

import math
import shlex
import subprocess
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy

ZIP, OUT, SCALE, THEME, GRAB, *NAMES = sys.argv[sys.argv.index("--") + 1 :]
SETTLE_SECONDS = 1.5
PANEL_WIDTH = 440  # pixels at UI scale 1
CONTRAST = 8  # of 255: what differs more within a row of pixels is not background

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

Picture = Callable[[], str]
PICTURES: dict[str, Picture] = {}


def picture(function: Picture) -> Picture:
    """Register a picture; the function returns "panel" or "window", what is to be saved."""
    PICTURES[function.__name__.replace("_", "-")] = function
    return function


def start() -> None:
    """Install the extension, set scale and theme, and take the pictures one by one."""
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.view.ui_scale = float(SCALE)
    bpy.ops.extensions.package_install_files(
        filepath=ZIP, repo="user_default", enable_on_install=True, overwrite=True
    )
    if THEME == "light":
        folders = bpy.utils.preset_paths("interface_theme")
        [path] = [path for root in folders for path in Path(root).glob("Blender_Light.xml")]
        bpy.ops.script.execute_preset(
            filepath=str(path),
            menu_idname="USERPREF_MT_interface_theme_presets",
        )
    _layout()
    waiting = [name for name in PICTURES if not NAMES or name in NAMES]
    bpy.app.timers.register(lambda: _begin(waiting), first_interval=0.5)


def _begin(waiting: list[str]) -> None:
    _material_tab()
    bpy.app.timers.register(lambda: _set(waiting), first_interval=0.5)


def _set(waiting: list[str]) -> None:
    if not waiting:
        bpy.ops.wm.quit_blender()
        return
    name = waiting.pop(0)
    try:
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            what = PICTURES[name]()
    except Exception:  # the window would stay open forever
        traceback.print_exc()
        sys.stderr.flush()
        bpy.ops.wm.quit_blender()
        return
    bpy.app.timers.register(lambda: _take(name, what, waiting), first_interval=SETTLE_SECONDS)


def _take(name: str, what: str, waiting: list[str]) -> None:
    bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
    path = str(Path(OUT) / f"{name}.png")
    window = bpy.context.window_manager.windows[0]
    if GRAB:
        subprocess.run([*shlex.split(GRAB), path], check=True)
    else:
        with bpy.context.temp_override(window=window):
            bpy.ops.screen.screenshot(filepath=path)
    if what == "panel":
        _cut(path, max(window.screen.areas, key=lambda area: area.x), window.height)
    elif what == "dialog":
        _cut(path, min(window.screen.areas, key=lambda area: area.x), window.height)
        for value in ("PRESS", "RELEASE"):
            window.event_simulate(type="ESC", value=value)
    print(path, flush=True)
    bpy.app.timers.register(lambda: _set(waiting), first_interval=0.5)


def _cut(path: str, area: Any, height: int) -> None:
    """Leave what an area shows: of the empty text editor, the dialog in it."""
    bpy.utils.expose_bundled_modules()
    import numpy as np
    import OpenImageIO

    whole = OpenImageIO.ImageBuf(path)
    pixels = whole.get_pixels(OpenImageIO.UINT8)
    top = height - area.y - area.height
    pixels = pixels[top : top + area.height, area.x : area.x + area.width, :3]
    if area.type == "TEXT_EDITOR":
        margin = round(40 * float(SCALE))
        pixels = pixels[margin:-margin, margin:-margin]
        shown = np.abs(pixels.astype(int) - pixels[0, 0]).max(axis=-1) > 2
        rows, columns = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
        pixels = pixels[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    else:
        inner = pixels[:-8, 48:-48]
        busy = np.flatnonzero(np.ptp(inner, axis=1).max(axis=-1) > CONTRAST)
        pixels = pixels[: min(len(pixels), int(busy.max()) + 12)]
    pixels = np.ascontiguousarray(pixels)
    rows, columns, channels = pixels.shape
    spec = OpenImageIO.ImageSpec(columns, rows, channels, OpenImageIO.UINT8)
    cut = OpenImageIO.ImageBuf(spec)
    cut.set_pixels(OpenImageIO.ROI(), pixels)
    cut.write(path)


# States ------------------------------------------------------------------------------------------


def _layout() -> None:
    """Make the window a text editor beside the Material tab: a viewport would draw for minutes."""
    window = bpy.context.window_manager.windows[0]
    for area in sorted(window.screen.areas, key=lambda area: area.width * area.height)[:-1]:
        with bpy.context.temp_override(window=window, area=area):
            bpy.ops.screen.area_close()
    area = window.screen.areas[0]
    area.type = "TEXT_EDITOR"
    factor = 1 - PANEL_WIDTH * float(SCALE) / area.width
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=factor)


def _material_tab() -> None:
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
    """Leave one plane, without a material."""
    bpy.ops.wm.set_working_color_space(convert_colors=True, working_space="Linear Rec.709")
    things = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    bpy.data.batch_remove([*things, *bpy.data.materials])
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    thing = bpy.data.objects.new("Wall", mesh)
    scene.collection.objects.link(thing)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    return thing


def _assigned(preset: str = "colorchecker/14-green", degrees: float = 30.0) -> Any:
    thing = _fresh()
    bpy.ops.rough_spectra.assign_preset("EXEC_DEFAULT", preset=preset, sigma=math.radians(degrees))
    return thing.active_material


def _color_socket(material: Any) -> Any:
    node = next(node for node in material.node_tree.nodes if node.type.startswith("BSDF"))
    return node.inputs[0]


def _invoke(operator: Callable[..., Any], **options: Any) -> None:
    """Open an operator's dialog in the middle of the text editor."""
    window = bpy.context.window_manager.windows[0]
    area = min(window.screen.areas, key=lambda area: area.x)
    window.cursor_warp(area.x + area.width // 2, area.y + area.height // 2)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        operator("INVOKE_DEFAULT", **options)


@picture
def empty() -> str:
    """Show a mesh without a material."""
    _fresh()
    return "panel"


@picture
def assigned() -> str:
    """Show a preset at 30°."""
    _assigned()
    return "panel"


@picture
def out_of_gamut() -> str:
    """Show a color that the working space cannot hold."""
    _assigned("colorchecker/18-cyan")
    return "panel"


@picture
def reading() -> str:
    """Show a reading of a sphere whose peak bounds σ."""
    material = _assigned("colorchecker/19-white-9-5", 20.0)
    material.rough_spectra.kind = "reading"
    return "panel"


@picture
def edited() -> str:
    """Show a color that was edited by hand."""
    _color_socket(_assigned()).default_value = (0.4, 0.1, 0.1, 1)
    return "panel"


@picture
def kept() -> str:
    """Show an edit by hand that the user keeps."""
    _color_socket(_assigned()).default_value = (0.08, 0.25, 0.1, 1)
    bpy.ops.rough_spectra.keep()
    return "panel"


@picture
def working_space() -> str:
    """Show what a change of the working space does."""
    _assigned()
    bpy.ops.wm.set_working_color_space(convert_colors=True, working_space="ACEScg")
    return "panel"


@picture
def linked() -> str:
    """Show a material of another file."""
    material = _assigned()
    path = str(Path(bpy.app.tempdir) / "library.blend")
    bpy.data.libraries.write(path, {material}, fake_user=True)
    thing = _fresh()
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.materials = ["Wall"]
    thing.data.materials.append(wanted.materials[0])
    return "panel"


@picture
def eevee() -> str:
    """Show that Eevee leaves the roughness out."""
    _assigned()
    bpy.context.scene.render.engine = "BLENDER_EEVEE"
    return "panel"


@picture
def lit_by_the_scene() -> str:
    """Show a material that follows an incandescent lamp and the sky."""
    _assigned("colorchecker/09-moderate-red")
    _lights()
    bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT")
    return "panel"


def _lights() -> None:
    scene = bpy.context.scene
    for kind, place, energy, kelvin in (
        ("AREA", (1.5, -1.0, 2.0), 150.0, 2856.0),
        ("SUN", (-2.0, 2.0, 3.0), 1.0, 6500.0),
    ):
        light = bpy.data.lights.new("Lamp" if kind == "AREA" else "Sun", kind)
        light.energy, light.use_temperature, light.temperature = energy, True, kelvin
        thing = bpy.data.objects.new(light.name, light)
        thing.location = place
        scene.collection.objects.link(thing)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0.0, 0.0, 6.0)
    scene.collection.objects.link(camera)
    scene.camera = camera


@picture
def measured() -> str:
    """Show a measurement beside the prediction."""
    material = _assigned()
    module = sys.modules[type(material.rough_spectra).__module__.rpartition(".")[0] + ".measured"]
    module.note(material, module.fingerprint(material), (0.05, 0.24, 0.06), 0.0012)
    return "panel"


@picture
def choose_sample() -> str:
    """Show the search among presets and library."""
    _fresh()
    _invoke(bpy.ops.rough_spectra.choose_sample)
    return "dialog"


@picture
def find_nearest() -> str:
    """Show the samples nearest to a color."""
    _fresh()
    _invoke(bpy.ops.rough_spectra.find_nearest, color=(0.55, 0.35, 0.25))
    return "dialog"


@picture
def import_review() -> str:
    """Show what is in files before anything is kept."""
    _fresh()
    folder = Path(bpy.app.tempdir)
    (folder / "plaster.csv").write_text(PLASTER, encoding="utf-8")
    (folder / "lamp.csv").write_text(LAMP, encoding="utf-8")
    files = [{"name": "plaster.csv"}, {"name": "lamp.csv"}]
    _invoke(bpy.ops.rough_spectra.import_samples, directory=str(folder), files=files)
    return "dialog"


@picture
def preferences() -> str:
    """Show what new materials begin with."""
    _fresh()
    bpy.ops.preferences.addon_show(module="bl_ext.user_default.rough_spectra")
    return "window"


if __name__ == "__main__":
    start()
