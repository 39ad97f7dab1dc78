# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what the panel costs: first use, drawing among 500 materials, dragging σ and gloss.

    python -m tools.benchmarks.bench_panel [--gloss]

With --gloss, gloss alone.

Needs the bpy module. Processor time, which other programs disturb less than wall time; the least
and the median of many runs. Drawing goes onto a layout that does nothing, so that what is measured
is ours and not Blender's. The cores of a shared server are at times half as fast as at others:
beside each group stands what a fixed piece of plain Python took then.
"""

from __future__ import annotations

import argparse
import importlib
import statistics
import time
import types
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from tools.run.run_command_line import load_extension

MATERIALS = 500
DRAWS = 200
STEPS = 40
FIGURES = (("ball", 88), ("sheet", 280), ("swatches", 96))
PRESET = "colorchecker/14-green"


class Nothing:
    """A layout that draws nothing, and whose parts are itself."""

    def __getattr__(self, _name: str) -> Callable[..., Nothing]:
        return lambda *_values, **_options: self


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--gloss", action="store_true", help="drag the gloss alone")
    options = parser.parse_args()
    extension = load_extension()
    import bpy

    models = ("auto", *importlib.import_module("rough_spectra.core.models").NAMES)
    print(f"Blender {bpy.app.version_string}; milliseconds of processor time: least (median)")
    pace()
    row("register", [timed(extension.register)])
    thing = lit_plane()
    first = timed(lambda: assign(thing, "first"))
    row("first assignment", [first])
    material = thing.active_material
    row("first pictures", [timed(lambda: pictures(material, 1))])
    if options.gloss:
        shining(thing)
        pace()
        return
    drawing(thing)
    for model in models:
        dragging(material, model)
    others(material)
    shining(thing)
    pace()
    print(bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT"), "to the scene's lights")
    for model in models:
        dragging(material, model)
    others(material)
    pace()
    icons = importlib.import_module("rough_spectra.addon.preview.icons")
    icons.clear()
    extension.unregister()


def assign(thing: Any, name: str) -> Any:
    """Give an object a new material with a spectrum."""
    import bpy

    material = bpy.data.materials.new(name)
    thing.active_material = material
    bpy.ops.rough_spectra.assign_preset("EXEC_DEFAULT", preset=PRESET, sigma=0.5)
    return material


def lit_plane() -> Any:
    """Make a scene of a plane, two lights of different color, and a camera."""
    import bpy

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(None)
    thing = bpy.data.objects.new("Wall", mesh)
    scene.collection.objects.link(thing)
    for kind, place, energy, kelvin in (
        ("AREA", (1.5, -1.0, 2.0), 150.0, 2856.0),
        ("SUN", (-2.0, 2.0, 3.0), 1.0, 6500.0),
    ):
        light = bpy.data.lights.new(kind, kind)
        light.energy, light.use_temperature, light.temperature = energy, True, kelvin
        lamp = bpy.data.objects.new(kind, light)
        lamp.location = place
        scene.collection.objects.link(lamp)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (0.0, 0.0, 6.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    bpy.context.view_layer.update()
    return thing


def drawing(thing: Any) -> None:
    """Draw all panels of the Material tab, of one material after the other."""
    import bpy
    from rough_spectra.addon.interface.panels import panels
    from rough_spectra.addon.material import derive as assigning
    from rough_spectra.addon.material import storage

    request = storage.load(thing.active_material)
    others = [bpy.data.materials.new(f"{number}") for number in range(MATERIALS - 1)]
    for other in others:
        if bpy.app.version < (5, 0, 0):
            other.use_nodes = True
    assigning.assign([(other, request) for other in others])
    area = types.SimpleNamespace(type="PROPERTIES")
    region = types.SimpleNamespace(width=420)
    names = ("scene", "view_layer", "preferences", "object", "selected_objects")
    real = {name: getattr(bpy.context, name) for name in names}
    tab = [cls for cls in panels.classes if cls.bl_space_type == area.type]
    page = types.SimpleNamespace(layout=Nothing())
    for what, shown in (
        ("one material again and again", others[:1]),
        ("another each time", others),
    ):
        times = []
        for number in range(DRAWS):
            material = shown[number % len(shown)]
            context = types.SimpleNamespace(**real, material=material, region=region, area=area)
            times.append(timed(partial(drawn, tab, page, context)))
        row(f"draw, {what}", times[1:])


def drawn(tab: list[Any], page: Any, context: Any) -> None:
    """Draw the parts of the panel that are shown."""
    for part in tab:
        if part.poll(context):
            part.draw(page, context)


def pictures(material: Any, scale: int) -> None:
    """Ask for the panel's pictures, as drawing does, and make them."""
    import bpy
    from rough_spectra.addon.material import snapshot
    from rough_spectra.addon.preview import icons, theme

    state = (snapshot.of(material), theme.current(bpy.context.preferences))
    for figure, side in FIGURES:
        icons._pending[icons._Wish(material.session_uid, figure, side * scale)] = state
    icons._work()


def others(material: Any) -> None:
    """Drag σ of samples that cost more than the preset: many bands, instruments, next to white."""
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive as assigning
    from rough_spectra.addon.material import storage
    from rough_spectra.addon.samples.sample import Kind, Sample
    from rough_spectra.core.instruments import DEFAULT

    before = storage.load(material)
    fine = np.arange(380, 781, dtype=np.float64)
    kinds: tuple[Kind, Kind] = ("reading", "albedo")
    reading, albedo = kinds
    for name, nm, low, high, kind, instrument in (
        ("401 bands", fine, 0.1, 0.8, reading, DEFAULT),
        ("401 bands, albedo", fine, 0.1, 0.8, albedo, DEFAULT),
        ("sphere", fine[::10], 0.1, 0.6, reading, "di:8"),
        ("dark", fine[::10], 0.03, 0.03, reading, DEFAULT),
        ("white", fine[::10], 0.95, 0.95, reading, DEFAULT),
    ):
        step = low + (high - low) / (1 + np.exp((580 - nm) / 20))
        sample = Sample(name, nm, step, kind=kind, instrument=instrument)
        for model in ("auto", "reference"):
            assigning.assign([(material, Request(sample, 0.5, model))])
            dragging(material, model, f"{name}, ", scales=(2,))
    assigning.assign([(material, before)])


def dragging(material: Any, model: str, what: str = "", scales: Sequence[int] = (1, 2)) -> None:
    """Drag σ: derive, write the sockets, make the pictures and hand them to Blender."""
    from rough_spectra.addon.preview import icons

    material.rough_spectra.model = model
    for scale in scales:
        icons.clear()
        pictures(material, scale)

        def drag(sigma: float) -> None:
            for picture in icons._pictures.values():
                picture.drawn = time.monotonic()
            material.rough_spectra.sigma = sigma

        times = [timed(partial(drag, 0.1 + 1.3 * i / STEPS)) for i in range(STEPS)]
        row(f"drag σ, {what}{model}, scale {scale}", times[1:])


def shining(thing: Any) -> None:
    """Drag the gloss of Principled BSDFs, as sockets: the color below follows.

    An update of the depsgraph is counted, too, of which Blender tells what was changed.
    """
    import bpy
    from rough_spectra.addon.blender import surface
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive as assigning
    from rough_spectra.addon.preview import icons
    from rough_spectra.addon.samples import presets

    before = thing.active_material
    update = bpy.context.view_layer.update
    material = bpy.data.materials.new("Shining")
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    thing.active_material = material
    node: Any = surface.shader_node(material)
    node.inputs["Coat Weight"].default_value = 1.0
    for preset, read_at in (
        ("colorchecker/19-white-9-5", "45a:0"),
        ("everyday/brick", "45a:0"),
        ("everyday/brick", "45as-15"),
        ("everyday/brick", "di:8"),
    ):
        assigning.assign([(material, Request(presets.load(preset), 0.35, read_at=read_at))])
        for name in ("Roughness", "Specular IOR Level", "Coat Weight"):
            kept = node.inputs[name].default_value
            update()
            icons.clear()
            pictures(material, 2)

            def drag(value: float, socket: Any = node.inputs[name]) -> None:
                for picture in icons._pictures.values():
                    picture.drawn = time.monotonic()
                socket.default_value = value
                update()

            times = [timed(partial(drag, 0.1 + 0.8 * i / STEPS)) for i in range(STEPS)]
            row(f"drag {name}, {preset.partition('/')[2]}, {read_at}", times[1:])
            node.inputs[name].default_value = kept
    thing.active_material = before


def pace() -> None:
    """Print how fast this core is now."""
    row("a million numbers in Python", [timed(lambda: sum(range(1_000_000))) for _ in range(20)])


def timed(work: Callable[[], object]) -> float:
    """Processor time in milliseconds."""
    start = time.process_time()
    work()
    return 1e3 * (time.process_time() - start)


def row(name: str, times: list[float]) -> None:
    """Print the cost of one piece of work."""
    print(f"{name:>46}  {min(times):8.2f}  ({statistics.median(times):.2f})", flush=True)


if __name__ == "__main__":
    main()
