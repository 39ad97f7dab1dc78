# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What everybody does in the panel, with one click or drag each."""

import math
import time

import bpy
import driver
from driver import TICK, area, click, find, move, press, scene, window, write
from stage import empty_file, green_file, ours, state, undo_step, wall


@scene
def clicking_a_ball(found):
    """Click the last of the four balls, and undo."""
    yield from green_file()
    found["before"] = state()
    x, y = yield from find(area("PROPERTIES"), "rough_spectra.set_roughness", 0.9)
    yield from click(x, y)
    yield 0.5
    found["clicked"] = state()
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = state()


@scene
def dragging_gloss(found):
    """Drag the slider of a matte material, and undo."""
    yield from green_file()
    found["before"] = [state(), wall().rough_spectra.gloss]
    x, y = yield from find(area("PROPERTIES"), "gloss")
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    yield TICK
    found["dragged"] = []
    for step in range(1, 9):
        yield from move(x + 10 * step, y)
        found["dragged"].append([state(), wall().rough_spectra.gloss])
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x + 80, y=y)
    yield 0.5
    found["after"] = [state(), wall().rough_spectra.gloss]
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = [state(), wall().rough_spectra.gloss]


@scene
def pressing_the_remedy(found):
    """Edit the color by hand, and press the button beside the verdict."""
    yield from green_file()
    before = state()
    nodes = ours("addon.blender.shader_nodes")
    node = nodes.shader_node(wall())
    nodes.color_socket(node).default_value = (0.5, 0.1, 0.1, 1)
    undo_step("Edit")
    yield 1.0
    found["edited"] = state()["kind"]
    x, y = yield from find(area("PROPERTIES"), "rough_spectra.renew", 0.8)
    yield from click(x, y)
    yield 0.5
    found["same"] = state() == before


@scene
def sidebar_of_the_3d_view(found):
    """Choose a sample in its tab, and set the roughness there."""
    yield from empty_file("VIEW_3D")
    view = area("VIEW_3D")
    view.spaces.active.show_region_ui = True
    yield 1.0
    sidebar = next(region for region in view.regions if region.type == "UI")
    sidebar.active_panel_category = "Rough Spectra"
    yield 1.0
    found["category"] = sidebar.active_panel_category
    across = (sidebar.x - view.x + sidebar.width * 0.3) / view.width
    x, y = yield from find(view, "rough_spectra.choose_sample", across, "UI")
    yield from click(x, y)
    yield 1.0
    yield from write("foliage")
    yield 0.5
    yield from press("RET")
    yield 1.0
    found["chosen"] = state()
    x, y = yield from find(view, "rough_spectra.set_roughness", across, "UI")
    yield from click(x, y)
    yield 0.5
    found["set"] = state()


@scene
def grease_pencil(found):
    """Look for the panel of a stroke."""
    yield from empty_file()
    lines = bpy.data.grease_pencils.new("Lines")
    strokes = bpy.data.materials.new("Stroke")
    bpy.data.materials.create_gpencil_data(strokes)
    lines.materials.append(strokes)
    thing = bpy.data.objects.new("Lines", lines)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    yield 1.0
    try:
        yield from find(area("PROPERTIES"), "rough_spectra.choose_sample", 0.5)
        found["shown"] = True
    except LookupError:
        found["shown"] = False


@scene
def choosing_the_files_own(found):
    """Make brick rougher on the wall, and choose it for the next object: the first row is it."""
    yield from empty_file()
    with driver.over(area("PROPERTIES")):
        bpy.ops.rough_spectra.choose_sample("EXEC_DEFAULT", sample="everyday/brick")
    wall().rough_spectra.sigma, wall().rough_spectra.gloss = math.radians(40), 0.5
    other = bpy.data.objects.new("Other", wall_mesh())
    bpy.context.scene.collection.objects.link(other)
    bpy.data.objects["Wall"].select_set(False)
    other.select_set(True)
    bpy.context.view_layer.objects.active = other
    undo_step("Other")
    yield 1.0
    _, y = yield from find(area("PROPERTIES"), "rough_spectra.find_nearest", 0.95)
    yield from click(area("PROPERTIES").x + area("PROPERTIES").width // 2, y)
    yield 1.0
    yield from write("brick")
    yield 1.0
    driver.grab("files_own")
    yield from press("RET")
    yield 1.0
    made = bpy.data.objects["Other"].active_material
    found["same"] = made is not None and made == wall()
    found["materials"] = len(bpy.data.materials)
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = bpy.data.objects["Other"].active_material is None


def wall_mesh():
    """Give a mesh as the wall's, without a material."""
    mesh = bpy.data.objects["Wall"].data.copy()
    mesh.materials.clear()
    return mesh


@scene
def dragging_for_all(found):
    """Select three objects with a material each, drag Roughness and click a ball; undo both."""
    yield from green_file()
    names = ["Wall", "Second", "Third"]
    for name in names[1:]:
        thing = bpy.data.objects.new(name, wall_mesh())
        bpy.context.scene.collection.objects.link(thing)
        thing.active_material = wall().copy()
        thing.select_set(True)
    undo_step("Three")
    yield 1.0
    found["before"] = _all(names)
    x, y = yield from find(area("PROPERTIES"), "sigma_of_all")
    times = _timed()
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    yield TICK
    for step in range(1, 25):
        yield from move(x + 3 * step, y)
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x + 72, y=y)
    yield 0.5
    found["milliseconds"] = sorted(times)
    found["dragged"] = _all(names)
    driver.grab("for_all")
    x, y = yield from find(area("PROPERTIES"), "rough_spectra.set_roughness", 0.9)
    yield from click(x, y)
    yield 0.5
    found["clicked"] = _all(names)
    for step in ("ball undone", "drag undone"):
        yield from press("Z", ctrl=True)
        yield 0.5
        found[step] = _all(names)


def _all(names):
    """Give σ in degrees and the state of each object's material."""
    kind = ours("addon.material.state").state
    found = [bpy.data.objects[name].active_material for name in names]
    return [[round(math.degrees(m.rough_spectra.sigma), 2), kind(m).kind] for m in found]


def _timed():
    """Note how long each step takes from now on, in milliseconds."""
    together, times = ours("addon.material.together"), []
    real = together.set_sigma

    def timed(*arguments):
        begin = time.perf_counter()
        real(*arguments)
        times.append(1e3 * (time.perf_counter() - begin))

    together.set_sigma = timed
    return times


@scene
def asking_before_acescg(found):
    """Press Use ACEScg: it asks, ESC leaves the file as it is, and only the button changes it."""
    yield from empty_file()
    with driver.over(area("PROPERTIES")):
        bpy.ops.rough_spectra.choose_sample("EXEC_DEFAULT", sample="colorchecker/18-cyan")
    undo_step("Cyan")
    yield 1.5
    button = yield from find(area("PROPERTIES"), "rough_spectra.use_wide_gamut", 0.8)
    yield from click(*button)
    yield 1.0
    driver.grab("asking")
    found["asked"] = bpy.data.colorspace.working_space
    yield from press("ESC")
    yield 0.5
    found["escaped"] = bpy.data.colorspace.working_space
    yield from move(*button)
    yield from click(*button)
    yield 1.0
    yield from press("RET")
    yield 1.0
    found["confirmed"] = [bpy.data.colorspace.working_space, state()["kind"]]
    yield from press("Z", ctrl=True)
    yield 1.0
    found["undone"] = [bpy.data.colorspace.working_space, state()["kind"]]
