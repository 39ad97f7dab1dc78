# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done with Rough Spectra again and again, as tasks for `caches.py` to measure.

Each function prepares a task in a folder that is its own, and gives what runs it. A task can run
any number of times, and costs the same each time: values that a user would not meet again, such as
σ under a slider, are others each time. `COLD` tasks forget everything first.
"""

from __future__ import annotations

import itertools
import time
import types
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
Run = Callable[[], object]

STEPS = 12
SIDES = (
    ("sheet", 280),
    ("swatches", 96),
    ("ball", 88),
    ("spectrum", 200),
    ("angles", 200),
    ("polar", 200),
)
"""Figures and their sides in pixels; the first two are what the panel shows."""
PRESET = "colorchecker/14-green"
MATERIALS = 100
ONE_BY_ONE = 25
SAMPLES = 200


class Nothing:
    """A layout that draws nothing, and whose parts are itself."""

    def __getattr__(self, _name: str) -> Callable[..., Nothing]:
        return lambda *_values, **_options: self


def _sigmas(count: int) -> Iterator[list[float]]:
    """Give roughnesses as from a slider, others each time."""
    for run in itertools.count(1):
        yield [0.1 + 0.9 * (i + run * 0.618 % 1) / count for i in range(count)]


def _plane() -> Any:
    """Make a scene of a plane, two lights of different color, and a camera."""
    import bpy

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    thing = _put("Wall", bpy.data.meshes.new("Wall"))
    thing.data.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    thing.data.materials.append(None)
    for kind, place, energy, kelvin in (
        ("AREA", (1.5, -1.0, 2.0), 150.0, 2856.0),
        ("SUN", (-2.0, 2.0, 3.0), 1.0, 6500.0),
    ):
        light = bpy.data.lights.new(kind, kind)
        light.energy, light.use_temperature, light.temperature = energy, True, kelvin
        _put(kind, light).location = place
    scene.camera = _put("Camera", bpy.data.cameras.new("Camera"))
    scene.camera.location = (0.0, 0.0, 6.0)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    bpy.context.view_layer.update()
    return thing


def _put(name: str, data: Any) -> Any:
    import bpy

    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def _new(name: str) -> Any:
    import bpy

    material = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    return material


def _green() -> Any:
    from rough_spectra.addon.samples import presets

    return presets.load(PRESET)


def _fine(low: float = 0.1, high: float = 0.8, step: int = 1, **options: Any) -> Any:
    """Make a sample with a step in the visible range."""
    from rough_spectra.addon.samples.sample import Sample

    nm = np.arange(380, 781, step, dtype=np.float64)
    values = low + (high - low) / (1 + np.exp((580 - nm) / 20))
    options = {"kind": "reading", "instrument": "45a:0"} | options
    return Sample(f"{low} to {high}", nm, values, **options)


def _pictures(material: Any, figures: int, wider: int = 0) -> None:
    """Ask for pictures, as drawing does, and make them."""
    import bpy
    from rough_spectra.addon.material import snapshot
    from rough_spectra.addon.preview import icons, theme

    basis = (snapshot.of(material), theme.current(bpy.context.preferences))
    for figure, side in SIDES[:figures]:
        icons._pending[icons._Wish(material.session_uid, figure, side + max(wider, -50))] = basis
    icons._work()


def _drag(
    sample: Any, scene: bool = False, figures: int = 3, model: str = "auto", read_at: str = "45a:0"
) -> Run:
    """Drag σ of a material with visible pictures, in a panel that is drawn again at each step."""
    import bpy
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.preview import icons

    thing = _plane()
    material = thing.active_material = _new("Dragged")
    derive.assign([(material, Request(sample, 0.5, model, read_at=read_at))])
    if scene:
        assert bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    icons.clear()
    _pictures(material, figures)
    draw, sigmas = _drawer(), _sigmas(STEPS)

    def run() -> None:
        for sigma in next(sigmas):
            for picture in icons._pictures.values():
                picture.drawn = time.monotonic()
            material.rough_spectra.sigma = sigma
            draw(material)

    return run


def _shine(read_at: str) -> Run:
    """Drag the sockets of a gloss with a coat, of a color that can't have all of it."""
    import bpy
    from rough_spectra.addon.blender import surface
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.preview import icons

    thing = _plane()
    material = thing.active_material = _new("Shining")
    node: Any = surface.shader_node(material)
    node.inputs["Coat Weight"].default_value = 1.0
    derive.assign([(material, Request(_fine(0.03, 0.3, 10), 0.5, read_at=read_at))])
    icons.clear()
    _pictures(material, 3)
    draw, values = _drawer(), _sigmas(STEPS // 3)

    def run() -> None:
        for name in ("Roughness", "Specular IOR Level", "Coat Weight"):
            for value in next(values):
                for picture in icons._pictures.values():
                    picture.drawn = time.monotonic()
                node.inputs[name].default_value = value
                bpy.context.view_layer.update()
                draw(material)

    return run


def _edit(scene: bool, is_derived: bool = True) -> Run:
    """Drag the color of a material's node by hand: it is stale, and its pictures follow."""
    import bpy
    from rough_spectra.addon.blender import shader_nodes
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive

    thing = _plane()
    material = thing.active_material = _new("Edited")
    derive.assign([(material, Request(_fine(), 0.5))])
    if scene:
        assert bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    if not is_derived:
        material.rough_spectra.stamp = ""
    tree = material.node_tree
    node = next(n for n in tree.nodes if n.bl_idname.startswith("ShaderNodeBsdf"))
    draw, reds = _drawer(), _sigmas(STEPS)

    def run() -> None:
        for red in next(reds):
            shader_nodes.color_socket(node).default_value[0] = red / 2
            _pictures(material, 2)
            draw(material)

    return run


def _resize(_folder: Path) -> Run:
    """Drag the border of a panel: text is wrapped anew, and pictures have other sizes."""
    thing = _plane()
    material = thing.active_material = _materials(1)[0]
    draw, widths = _drawer(), itertools.cycle(range(200, 800, 7))

    def run() -> None:
        for _ in range(STEPS):
            width = next(widths)
            draw(material, width)
            _pictures(material, 2, width - 280)

    return run


def _drag_models(_folder: Path) -> Run:
    """Drag σ of one material by every model, of samples that each make another of them work."""
    samples = [_fine(), _fine(kind="albedo", step=10), _fine(0.95, 0.95, 10)]
    samples += [_fine(0.1, 0.6, 10, instrument="di:8"), _fine(0.03, 0.03, 10)]
    return _steps(samples)


def _steps(samples: list[Any]) -> Run:
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.matching import solve
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.core import models

    space, sigmas = working_space.current(), _sigmas(4)

    def run() -> None:
        for sigma in next(sigmas):
            for sample in samples:
                for model in ("auto", *models.NAMES):
                    solve.solve([Request(sample, sigma, model)], space)

    return run


def _materials(count: int) -> list[Any]:
    """Make materials that have spectra."""
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.samples import presets

    made = [_new(f"Paint {number}") for number in range(count)]
    samples = presets.load_all()
    derive.assign(
        [
            (material, Request(samples[i % len(samples)], 0.1 + 0.9 * i / count))
            for i, material in enumerate(made)
        ]
    )
    return made


def _assign_many(_folder: Path) -> Run:
    """Assign to many materials in one call, presets by name."""
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.samples import presets

    _plane()
    made, names, sigmas = _materials(MATERIALS), presets.names(), _sigmas(MATERIALS)

    def run() -> None:
        rows = zip(made, itertools.cycle(names), next(sigmas), strict=False)
        derive.assign([(one, Request(presets.load(name), s)) for one, name, s in rows])

    return run


def _assign_single(_folder: Path) -> Run:
    """Assign to one material after the other, as a script or the user does."""
    import bpy
    from rough_spectra.addon.samples import presets

    thing = _plane()
    made, names, sigmas = _materials(ONE_BY_ONE), presets.names(), _sigmas(ONE_BY_ONE)

    def run() -> None:
        rows = zip(made, itertools.cycle(names), next(sigmas), strict=False)
        for material, name, sigma in rows:
            thing.active_material = material
            bpy.ops.rough_spectra.assign_preset("EXEC_DEFAULT", preset=name, sigma=sigma)

    return run


def _first(_folder: Path) -> Run:
    """Assign and show a session's first material."""
    import bpy

    thing = _plane()
    thing.active_material = _new("First")
    forget = _forget()

    def run() -> None:
        forget()
        bpy.ops.rough_spectra.assign_preset("EXEC_DEFAULT", preset=PRESET, sigma=0.5)
        _pictures(thing.active_material, 2)
        draw = _drawer()
        draw(thing.active_material)

    return run


def _forget() -> Callable[[], None]:
    from rough_spectra.core.numerics import memoized

    return memoized.clear_all


def _drawer() -> Callable[..., None]:
    """Give what draws all panels of the Material tab."""
    import bpy
    from rough_spectra.addon.interface.panels import panels

    area = types.SimpleNamespace(type="PROPERTIES")
    names = ("scene", "view_layer", "preferences", "object", "selected_objects")
    real = {name: getattr(bpy.context, name) for name in names}
    tab: list[Any] = [cls for cls in panels.classes if cls.bl_space_type == area.type]
    page: Any = types.SimpleNamespace(layout=Nothing())

    def draw(material: Any, width: int = 420) -> None:
        region = types.SimpleNamespace(width=width)
        context: Any = types.SimpleNamespace(**real, material=material, region=region, area=area)
        for part in tab:
            if part.poll(context):
                part.draw(page, context)

    return draw


MEASURED, EDITED, TEXTURED, PLAIN = 0, 15, 25, -1


def _redraw(one: int | None = None, scene: bool = False) -> Run:
    """Draw the panels of materials that don't change: of one, or of all in turn."""
    import bpy
    from rough_spectra.addon.blender import shader_nodes
    from rough_spectra.addon.material import last_measurement

    thing = _plane()
    made = _materials(60)
    if scene:
        thing.active_material = made[0]
        assert bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    for material in made[:10]:
        last_measurement.note(
            material, last_measurement.fingerprint(material), (0.2, 0.3, 0.1), 1.0
        )
    for material in made[10:20]:
        tree = material.node_tree
        node = next(n for n in tree.nodes if n.bl_idname.startswith("ShaderNodeBsdf"))
        shader_nodes.color_socket(node).default_value[0] += 0.1
    for material in made[20:30]:
        tree = material.node_tree
        node = next(n for n in tree.nodes if n.bl_idname.startswith("ShaderNodeBsdf"))
        picture = tree.nodes.new("ShaderNodeTexImage")
        tree.links.new(picture.outputs[0], shader_nodes.color_socket(node))
    made += [_new(f"Plain {number}") for number in range(5)]
    draw = _drawer()

    def run() -> None:
        for material in made if one is None else [made[one]] * 60:
            draw(material)

    return run


def _import(folder: Path, is_first: bool = False) -> Run:
    """Read files of every format and add them to a library, then read, list and search that."""
    from rough_spectra.addon.samples import importing, library

    tables = [folder / "chart.txt", folder / "rows.csv"]
    _chart(tables[0])
    _rows(tables[1])
    left_out = {".md", ".hdr"}
    fixtures = [
        path
        for path in sorted((ROOT / "tests" / "fixtures").rglob("*"))
        if path.is_file() and path.suffix not in left_out and "fuzz" not in path.parts
    ]
    turns, forget = itertools.count(), _forget()

    def run() -> None:
        if is_first:
            forget()
        importing.read(fixtures)
        home = folder / f"library {next(turns)}"
        for table in tables:
            importing.add(importing.read([table]).found, table.stem, home)
            for entry in library.contents(home).entries[-50:]:
                library.load(entry.id, home)

    return run


def _list(folder: Path) -> Run:
    """List, search and pick from a library that doesn't change."""
    from rough_spectra.addon.samples import importing, library

    _chart(folder / "chart.txt")
    importing.add(importing.read([folder / "chart.txt"]).found, "Chart", folder / "home")

    def run() -> None:
        home = folder / "home"
        for text in ("", "red", "patch 1", "green"):
            for entry in library.search(text, home)[:5]:
                library.load(entry.id, home)
        library.cached(home)
        library.nearest((50, 20, 10), 10, home)

    return run


def _chart(path: Path) -> None:
    """Write a CGATS file of random reflectances."""
    bands = range(380, 731, 10)
    values = np.random.default_rng(1).uniform(0.05, 0.9, (SAMPLES, len(bands)))
    rows = (
        f'{number} "Patch {number}" M1 ' + " ".join(f"{value:.4f}" for value in row)
        for number, row in enumerate(values, 1)
    )
    fields = " ".join(f"SPECTRAL_NM{nm}" for nm in bands)
    text = [
        *("CGATS.17", f"NUMBER_OF_FIELDS {len(bands) + 3}", "BEGIN_DATA_FORMAT"),
        *(f"SAMPLE_ID SAMPLE_NAME MEASUREMENT_CONDITION {fields}", "END_DATA_FORMAT"),
        *(f"NUMBER_OF_SETS {SAMPLES}", "BEGIN_DATA", *rows, "END_DATA\n"),
    ]
    path.write_text("\n".join(text), encoding="utf-8")


def _rows(path: Path) -> None:
    """Write a table whose rows each say how they were measured."""
    bands = range(400, 701, 10)
    values = np.random.default_rng(2).uniform(0.05, 0.9, (SAMPLES, len(bands)))
    rows = (
        f"Patch {number},CM-700d,d/8,SCE,D65,10,8 mm," + ",".join(f"{value:.4f}" for value in row)
        for number, row in enumerate(values, 1)
    )
    keys = "Name,Instrument,Geometry,Specular,Illuminant,Observer,Aperture"
    text = [f"{keys},{','.join(map(str, bands))}", *rows, ""]
    path.write_text("\n".join(text), encoding="utf-8")


def _analyze(_folder: Path, is_first: bool = False) -> Run:
    """Analyze a scene with a sky, a little turned each time, and match its materials."""
    import bpy

    _plane()
    made = _materials(12)
    for number, material in enumerate(made):
        mesh = bpy.data.meshes.new("Square")
        mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
        mesh.materials.append(material)
        thing = _put("Square", mesh)
        thing.location = (0.8 * (number % 4 - 1.5), 0.8 * (number // 4 - 1), 0.3)
        thing.scale = (0.3, 0.3, 0.3)
    world = bpy.context.scene.world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    sky = world.node_tree.nodes.new("ShaderNodeTexSky")
    back = next(node for node in world.node_tree.nodes if node.type == "BACKGROUND")
    world.node_tree.links.new(sky.outputs[0], back.inputs["Color"])
    sigmas, forget, camera = _sigmas(len(made)), _forget(), bpy.context.scene.camera

    def run() -> None:
        if is_first:
            forget()
        camera.location.x += 0.001
        bpy.data.lights["SUN"].temperature += 1
        bpy.context.view_layer.update()
        for material, sigma in zip(made, next(sigmas), strict=True):
            material.rough_spectra.sigma = sigma
        assert bpy.ops.rough_spectra.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}

    return run


def _bake(folder: Path) -> Run:
    """Predict the readings of many materials and write them, without rendering."""
    from rough_spectra.addon.instrument import bake
    from rough_spectra.addon.readings import writers

    _plane()
    surfaces = [("", material) for material in _materials(MATERIALS)]

    def run() -> None:
        bake.digest(surfaces, False)
        writers.write(bake.compare(bake.prepare(surfaces), None), folder / "chart")

    return run


def _core(sigma_of: Callable[[list[float]], Any]) -> Run:
    """Turn albedo into readings and back, for every model and instrument."""
    from rough_spectra.core import models, reading

    albedo, sigmas = np.linspace(0.05, 0.9, 31), _sigmas(6)

    def run() -> None:
        for sigma in sigma_of(next(sigmas)):
            for model in models.NAMES:
                for instrument in reading.INSTRUMENTS:
                    read = reading.from_albedo(albedo, sigma, model, instrument)
                    reading.to_albedo(read, sigma, model, instrument)

    return run


def _tables(_folder: Path) -> Run:
    """Make everything that a session keeps of instruments and models, from nothing."""
    from rough_spectra.core import reading

    forget = _forget()

    def run() -> None:
        forget()
        for model in ("closure", "reference"):
            for instrument in ("45a:0", "di:8"):
                for sigma in (0.2, 0.6):
                    reading.from_albedo(np.linspace(0.05, 0.9, 31), sigma, model, instrument)

    return run


def _exact(is_turning: bool) -> Run:
    """Solve the V-cavity itself, as scripts do: σ after σ, in one direction or in others."""
    from rough_spectra.core import vcavity

    sigmas, turn = _sigmas(3), itertools.count()
    albedo = np.array([[0.3, 0.5, 0.8]])

    def run() -> None:
        azimuth = 0.5 + is_turning * 1e-4 * next(turn)
        for sigma in next(sigmas):
            vcavity.reflectance(albedo, sigma, 0.2, 0.4, azimuth)
            vcavity.reading_from_albedo(albedo, sigma)

    return run


def _emissivity(_folder: Path) -> Run:
    """Tell what three infrared samples emit, by either model."""
    from rough_spectra.addon.matching import emission
    from rough_spectra.addon.samples.sample import Sample
    from rough_spectra.core.emissivity import MODELS

    nm, sigmas = np.linspace(7500.0, 14500.0, 141), _sigmas(2)
    samples = [Sample("Sand", nm, np.full(nm.size, rho), "albedo") for rho in (0.1, 0.4, 0.8)]

    def run() -> None:
        for sigma in next(sigmas):
            for model in MODELS:
                for sample in samples:
                    emission.compute(sample, 0.7 * sigma, model=model)

    return run


def _hemisphere(_folder: Path) -> Run:
    """Match at all models and look at all angles, as a picture of the plots does."""
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.matching import solve
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.core import models

    samples, space, sigmas = [_fine(), _green()], working_space.current(), _sigmas(3)

    def run() -> None:
        for sigma in next(sigmas):
            for model in models.NAMES:
                for illuminant in ("D65", "A"):
                    solve.solve(
                        [Request(s, sigma, model, illuminant=illuminant) for s in samples], space
                    )

    return run


TASKS: dict[str, Callable[[Path], Run]] = {
    "drag σ, preset": lambda _folder: _drag(_green()),
    "drag σ, 401 bands": lambda _folder: _drag(_fine()),
    "drag σ, preset, in a scene": lambda _folder: _drag(_green(), scene=True),
    "drag σ, 401 bands, in a scene": lambda _folder: _drag(_fine(), scene=True),
    "drag σ, V-cavity, all plots": lambda _folder: _drag(_green(), figures=6, model="reference"),
    "drag σ, sphere, closure": lambda _folder: _drag(
        _fine(0.1, 0.6, 10, instrument="di:8"), model="closure"
    ),
    "drag σ, read at a sphere": lambda _folder: _drag(_fine(step=10), read_at="di:8"),
    "drag gloss, read at 45°/0°": lambda _folder: _shine("45a:0"),
    "drag gloss, read at a sphere": lambda _folder: _shine("di:8"),
    "solve by every model": _drag_models,
    "match for two lights": _hemisphere,
    "emissivity of samples": _emissivity,
    "assign to 100 at once": _assign_many,
    "assign to 25, one by one": _assign_single,
    "first of a session": _first,
    "edit a color by hand": lambda _folder: _edit(scene=False),
    "edit a color by hand, in a scene": lambda _folder: _edit(scene=True),
    "edit a color by hand, nothing derived": lambda _folder: _edit(scene=False, is_derived=False),
    "resize the panel": _resize,
    "redraw of many": lambda _folder: _redraw(),
    "redraw, measured": lambda _folder: _redraw(MEASURED),
    "redraw, measured, in a scene": lambda _folder: _redraw(MEASURED, scene=True),
    "redraw, edited by hand": lambda _folder: _redraw(EDITED),
    "redraw, textured": lambda _folder: _redraw(TEXTURED),
    "redraw, no spectrum": lambda _folder: _redraw(PLAIN),
    "import": _import,
    "first import of a session": lambda folder: _import(folder, is_first=True),
    "list and search": _list,
    "analyze a scene": _analyze,
    "first analysis of a session": lambda folder: _analyze(folder, is_first=True),
    "predict 100 readings": _bake,
    "readings at every instrument": lambda _folder: _core(lambda sigmas: sigmas[:2]),
    "readings, many σ at once": lambda _folder: _core(
        lambda sigmas: [np.array(sigmas)[:, np.newaxis]]
    ),
    "tables from nothing": _tables,
    "exact V-cavity, many σ": lambda _folder: _exact(is_turning=False),
    "exact V-cavity, many directions": lambda _folder: _exact(is_turning=True),
}
"""By their names in the manual."""

COLD = {
    "first of a session",
    "first import of a session",
    "first analysis of a session",
    "tables from nothing",
}
"""Those that forget everything first."""

DICTIONARIES = {
    "addon.blender.shader_nodes._layouts": ("assign to 100 at once", "drag σ, sphere, closure"),
    "addon.blender.surface._numbers": ("redraw, measured",),
    "addon.preview.drawing.lines._kept": ("drag σ, preset", "edit a color by hand"),
    "addon.samples.library._contents": ("list and search",),
    "addon.samples.library._files": ("import",),
}
"""Where caches are used that no function has, so that nobody counts their hits."""
