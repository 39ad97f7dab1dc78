# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spectral picture from the Render tab: rendered, stopped, and read where the mouse clicks."""

import contextlib
import dataclasses
import os
import subprocess
from pathlib import Path

import bpy
import numpy as np
from driver import area, click, find, middle, move, over, press, scene, window
from scenes_background import children, jobs
from stage import OPS, empty_file, ours, undo_step

COLUMNS, ROWS = 96, 72
PATCHES = ("red", "green", "blue", "yellow", "white 9.5")


def _grab(name):
    """Save what the screen shows, for the manual."""
    folder = os.environ.get("ROUGH_SPECTRA_GRAB")
    if folder:
        subprocess.run(["import", "-window", "root", f"{folder}/{name}.png"], check=True)


def _panels(context, *opened):
    """Show our panels alone in a tab of the Properties editor, and these of them unfolded."""
    for cls in bpy.types.Panel.__subclasses__():
        in_tab = getattr(cls, "bl_context", "") == context and getattr(cls, "bl_label", "")
        if in_tab and cls.is_registered and "rough_spectra" not in cls.__module__:
            cls.poll = classmethod(lambda _cls, _context: False)
    for cls in reversed(opened):
        bpy.utils.unregister_class(cls)
    for cls in opened:
        cls.bl_options = set()
        bpy.utils.register_class(cls)


def _room(beside="IMAGE_EDITOR"):
    """A room of measured patches, a lamp with the spectrum of a fluorescent tube, and a camera."""
    yield from empty_file(beside)
    bpy.data.objects.remove(bpy.data.objects["Wall"])
    api = ours("addon.api")
    walls = {
        "red": [(-1, 1, 0), (-1, -1, 0), (-1, -1, 2), (-1, 1, 2)],
        "green": [(1, -1, 0), (1, 1, 0), (1, 1, 2), (1, -1, 2)],
        "blue": [(-1, 1, 0), (-1, 1, 2), (1, 1, 2), (1, 1, 0)],
        "white 9.5": [(-1, -1, 0), (-1, 1, 0), (1, 1, 0), (1, -1, 0)],
        "yellow": [(-0.4, 0.3, 0), (0.4, 0.3, 0), (0.4, 0.3, 0.9), (-0.4, 0.3, 0.9)],
    }
    scene = bpy.context.scene
    for name, corners in walls.items():
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
        material = bpy.data.materials.new(name.title())
        mesh.materials.append(material)
        scene.collection.objects.link(bpy.data.objects.new(name.title(), mesh))
        api.assign([(material, api.request(api.find(name), 0.0))], gloss="none")
    light = bpy.data.lights.new("Tube", "AREA")
    light.energy, light.size = 60, 0.8
    light.rough_spectra.spectrum = "F11"
    light.use_temperature, light.temperature = True, 4000
    tube = bpy.data.objects.new("Tube", light)
    tube.location = (0, -0.2, 1.9)
    scene.collection.objects.link(tube)
    camera = bpy.data.cameras.new("Camera")
    camera.angle = 0.9
    scene.camera = bpy.data.objects.new("Camera", camera)
    scene.camera.location, scene.camera.rotation_euler = (0, -3.0, 1), (1.5708, 0, 0)
    scene.collection.objects.link(scene.camera)
    scene.render.resolution_x, scene.render.resolution_y = COLUMNS, ROWS
    scene.cycles.samples, scene.cycles.use_denoising = 12, False
    scene.rough_spectra.by, scene.rough_spectra.renders = "RENDERS", 2
    undo_step("Room")
    panels = ours("addon.interface.panels.pictures")
    area("PROPERTIES").spaces.active.context = "RENDER"
    cameras = ours("addon.interface.panels.cameras")
    lamps = ours("addon.interface.panels.lamps")
    _panels("render", *panels.classes[:2], *lamps.classes, *cameras.classes)
    yield 0.5


def _images():
    return sorted(image.name for image in bpy.data.images)


def _state():
    scene = bpy.context.scene
    return [
        *(scene.render.resolution_x, scene.render.resolution_percentage, scene.cycles.samples),
        *(scene.render.image_settings.file_format, scene.render.filepath),
        *(len(each) for each in (bpy.data.materials, bpy.data.objects, bpy.data.scenes)),
        [node.type for material in bpy.data.materials for node in material.node_tree.nodes],
    ]


def _start():
    """Press the first button that renders."""
    panel = area("PROPERTIES")
    yield from click(*(yield from find(panel, "rough_spectra.render_spectral", 0.5)))
    yield lambda: bool(jobs())


def _ended():
    return not jobs()


@scene
def rendering_a_spectral_picture(found):
    """Press the button, wait, look at the images; then click on a pixel, and undo."""
    yield from _room()
    before = _state()
    yield from _start()
    found["modal"] = [op.bl_idname for op in window().modal_operators]
    yield from move(*middle(area("IMAGE_EDITOR")))
    yield 2.0
    _grab("spectral-running")
    yield _ended
    yield 0.5
    images = ours("addon.picture.images")
    found["images"] = _images()
    found["same"] = _state() == before
    editor = area("IMAGE_EDITOR")
    found["shown"] = editor.spaces.active.image.name
    last = images.last()
    found["told"] = list(last.told)
    found["rules"] = {name: list(rules) for name, rules in last.picture.rules.items()}
    found["modal_after"] = [op.bl_idname for op in window().modal_operators]
    yield from move(*middle(editor))
    with over(editor):
        bpy.ops.image.view_all(fit_view=True)
    editor.spaces.active.show_region_ui = True
    yield 0.5
    sidebar = next(region for region in editor.regions if region.type == "UI")
    sidebar.active_panel_category = "Rough Spectra"
    yield 0.5
    yield from _pick(found, editor, images)
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = _images()


def _pick(found, editor, images):
    """Click on the yellow panel in the middle of the room."""
    with over(editor):
        OPS.pick_pixel("INVOKE_DEFAULT")
    yield 0.3
    found["picking"] = [op.bl_idname for op in window().modal_operators]
    region = next(region for region in editor.regions if region.type == "WINDOW")
    wanted = COLUMNS // 2, ROWS // 2 - 10
    at = [(place + 0.5) / size for place, size in zip(wanted, (COLUMNS, ROWS), strict=True)]
    x, y = region.view2d.view_to_region(*at, clip=False)
    yield from click(region.x + x, region.y + y)
    yield 0.5
    picked = images.picked()
    found["wanted"], found["picked"] = list(wanted), [picked.column, picked.row]
    found["lab"], found["delta_e"] = list(picked.lab), picked.delta_e
    _grab("spectral-picked")
    yield from press("ESC")
    yield 0.3
    found["picking_after"] = [op.bl_idname for op in window().modal_operators]
    editor.spaces.active.image = bpy.data.images[images.MAP]
    with over(editor):
        bpy.ops.image.view_all(fit_view=True)
    yield 0.5
    _grab("spectral-map")


def _windows():
    return list(bpy.context.window_manager.windows)


def _image_shown():
    """Names of the images that Image Editors show, and of how many windows."""
    spaces = [a.spaces.active for w in _windows() for a in w.screen.areas]
    shown = [s.image.name for s in spaces if s.type == "IMAGE_EDITOR" and s.image is not None]
    return [len(_windows()), *shown]


@scene
def asking_whether_rgb_is_enough(found):
    """Ask, do what is advised, and see the picture where F12 shows one: no editor is open."""
    yield from _room("TEXT_EDITOR")
    panel, scene = area("PROPERTIES"), bpy.context.scene
    scene.rough_spectra.tolerance = 0.4  # a wider space, matched, comes to half a ΔE00
    before = _state()
    yield from click(*(yield from find(panel, "rough_spectra.judge_picture", 0.5)))
    yield lambda: bool(jobs())
    yield 1.0
    _grab("verdict-running")
    yield _ended
    yield 0.5
    judged = ours("addon.picture.last_verdict").of(scene)
    found["sentence"], found["advised"] = judged.sentence, judged.advised.kind
    found["same"] = _state() == before
    _grab("verdict")
    scene.cycles.samples = 32  # so that Cycles says how far it is within a render
    yield 2.0
    yield from _start()
    shares = found["shares"] = []

    def ended():
        for progress in (job.with_name("progress") for job in jobs()):
            with contextlib.suppress(OSError):  # not there yet, or no more
                shares.append(progress.read_text(encoding="ascii").split()[0])
        return _ended()

    yield ended
    yield 1.0
    found["picture"] = _image_shown()
    found["images"] = _images()
    _grab("picture-window")
    yield from click(*(yield from find(panel, "rough_spectra.show_picture", 0.8)))
    yield 0.5
    found["map"] = _image_shown()
    for each in _windows()[1:]:
        with bpy.context.temp_override(window=each):
            bpy.ops.wm.window_close()
    yield 0.5
    panel.spaces.active.context = "RENDER"
    scene.render.engine = "BLENDER_WORKBENCH"
    yield 0.5
    _grab("picture-other-engine")
    yield from click(*(yield from find(panel, "rough_spectra.switch_to_cycles", 0.5)))
    yield 0.3
    found["engine"] = scene.render.engine


@scene
def stopping_a_spectral_picture(found):
    """Press ESC while it renders: nothing is left."""
    yield from _room()
    before = _state()
    yield from _start()
    yield 1.0
    found["ran"] = bool(children())
    yield from press("ESC")
    yield 0.5
    found["left"] = [len(children()), len(jobs()), _images()]
    found["folders"] = [path.name for path in Path(bpy.app.tempdir).parent.glob("rough-spectra-*")]
    found["same"] = _state() == before
    found["modal"] = [op.bl_idname for op in window().modal_operators]


@scene
def choosing_a_light_spectrum(found):
    """In the Light tab: what the panel offers, a file, and undo."""
    yield from _room()
    tube = bpy.data.objects["Tube"]
    bpy.context.view_layer.objects.active = tube
    tube.select_set(True)
    undo_step("Tube")
    panel = area("PROPERTIES")
    panel.tag_redraw()
    yield 0.5  # the tab is there once it was drawn
    panel.spaces.active.context = "DATA"
    _panels("data", ours("addon.interface.panels.lights").ROUGHSPECTRA_PT_light)
    yield 0.5
    yield from find(panel, "spectrum", 0.7)
    found["before"] = tube.data.rough_spectra.spectrum
    path = f"{bpy.app.tempdir}sodium.csv"
    Path(path).write_text("nm,W\n588.7,0\n589.2,40\n589.7,0\n", encoding="utf-8")
    with over(panel):
        OPS.open_light("EXEC_DEFAULT", True, filepath=path)
    yield 0.5
    group = bpy.data.lights["Tube"].rough_spectra
    found["chosen"] = [group.spectrum, group.sample_name]
    yield from find(panel, "rough_spectra.open_light", 0.7)
    _grab("spectral-light")
    yield from move(*middle(area("IMAGE_EDITOR")))
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = bpy.data.lights["Tube"].rough_spectra.spectrum


def _pixels(image):
    held = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(held)
    return held.reshape(image.size[1], image.size[0], 4)


def _drag(panel, relit, row):
    """Drag a lamp's slider; gives the intensity at each step, and its seconds."""
    x, y = yield from find(panel, f"intensity_{row}", 0.4)
    step, taken, seen = relit._step, [], []

    def timed():
        step()
        taken.append(relit.last().step_seconds)
        seen.append(relit.last().intensities[row])

    relit._step = timed
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    yield 0.05
    for _ in range(20):
        x += 4
        yield from move(x, y)
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x, y=y)
    yield 0.5
    relit._step = step
    return seen, taken


def _of_1080_rows(lights):
    """The same picture beside and above itself."""
    rows, columns = 1080 // ROWS, 1920 // COLUMNS
    parts = np.tile(lights.parts, (1, 1, rows, columns))
    alpha = np.tile(lights.alpha, (rows, columns))
    return dataclasses.replace(lights, parts=parts, alpha=alpha)


@scene
def dragging_a_lamp(found):
    """Render lamps apart, drag the slider of one, give it another spectrum, and reset."""
    yield from _room()
    light = bpy.data.lights.new("Lamp", "POINT")
    light.energy, light.use_temperature, light.temperature = 10, True, 2700
    lamp = bpy.data.objects.new("Lamp", light)
    lamp.location = (0.6, -0.6, 0.5)
    bpy.context.scene.collection.objects.link(lamp)
    undo_step("Lamp")
    before, panel = _state(), area("PROPERTIES")
    yield from click(*(yield from find(panel, "rough_spectra.render_lamps", 0.5)))
    yield lambda: bool(jobs())
    yield _ended
    yield 0.5
    relit = ours("addon.picture.relit")
    editor = area("IMAGE_EDITOR")
    found["shown"], found["names"] = editor.spaces.active.image.name, relit.last().lights.names
    found["same"] = _state() == before
    with over(editor):
        bpy.ops.image.view_all(fit_view=True)
    first = _pixels(editor.spaces.active.image)
    _grab("lamps-rendered")
    row = relit.last().lights.names.index("Lamp")
    found["steps"], found["seconds"] = yield from _drag(panel, relit, row)
    dragged = _pixels(editor.spaces.active.image)
    found["intensity"] = relit.last().intensities[row]
    api = ours("addon.api")
    truth = api.relight(relit.last().lights, intensities={"Lamp": found["intensity"]}).rgb
    found["off"] = float(abs(dragged - truth).max() / truth.max())
    found["changed"] = float(abs(dragged - first).max() / first.max())
    _grab("lamps-dragged")
    _, y = yield from find(panel, f"intensity_{row}", 0.4)
    yield from click(panel.x + int(0.85 * panel.width), y)
    yield 0.5
    _grab("lamps-menu")
    yield from press("DOWN_ARROW")
    yield from press("DOWN_ARROW")
    yield from press("RET")
    yield 0.5
    _grab("lamps-chosen")
    found["chosen"] = relit.last().chosen[row]
    yield from click(*(yield from find(panel, "rough_spectra.reset_lamps", 0.8)))
    yield 0.5
    found["reset"] = bool((_pixels(editor.spaces.active.image) == first).all())
    lights = relit.last().lights
    relit.put(relit.Relit(_of_1080_rows(lights), relit.last()._from_xyz))
    yield 1.0
    found["large_steps"], found["large"] = yield from _drag(panel, relit, row)
    with over(panel):
        OPS.change_lamp(lamp=row, spectrum="F11")
    yield 0.5
    found["large_spectrum"] = relit.last().step_seconds
    found["size"] = list(editor.spaces.active.image.size)
    yield from move(*middle(editor))
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = _images()
