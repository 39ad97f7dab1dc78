# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What runs in a second Blender while the window stays in use."""

import importlib
import subprocess
from pathlib import Path

import bpy
import other_extension
from driver import area, click, find, grab, middle, move, over, press, scene, window
from stage import OPS, PACKAGE, empty_file, green_file, ours, state, wall

_started = []


class Watched(subprocess.Popen):
    """A process that is remembered, whatever becomes of the one who started it."""

    def __init__(self, *args, **options):
        super().__init__(*args, **options)
        _started.append(self)


subprocess.Popen = Watched


def children():
    """Give the second Blenders that run."""
    return [process for process in _started if process.poll() is None]


def jobs():
    """Folders of jobs under way."""
    return list(Path(bpy.app.tempdir).parent.glob("rough-spectra-*/job.json"))


def _measured():
    material = wall()
    found = None if material is None else ours("addon.material.last_measurement").get(material)
    return None if found is None else [found.delta_e, found.current]


def _start():
    """Click Measure."""
    yield from click(*(yield from find(area("PROPERTIES"), "rough_spectra.measure", 0.3)))
    yield lambda: bool(jobs())


def _ended():
    return not jobs()


def _watch_result():
    """Note each time that the panel draws what was measured."""
    panel, drawn = ours("addon.interface.panels.boxes.measurement"), []
    draw = panel._draw_measured

    def watched(*arguments):
        drawn.append(True)
        draw(*arguments)

    panel._draw_measured = watched
    return drawn


@scene
def measuring(found):
    """Measure to the end, and look around in the panel meanwhile."""
    yield from green_file()
    yield from _start()
    found["modal"] = [op.bl_idname for op in window().modal_operators]
    yield from move(*middle(area("TEXT_EDITOR")))
    # No long way over the panel: the measurement may well come to its end meanwhile.
    yield from move(*middle(area("PROPERTIES")))
    found["still_running"] = bool(jobs())
    grab("measuring")
    yield from move(*middle(area("TEXT_EDITOR")))
    yield 0.3
    drawn = _watch_result()
    yield _ended
    yield 0.5
    found["shown"] = bool(drawn)
    found["measured"] = _measured()
    found["modal_after"] = [op.bl_idname for op in window().modal_operators]
    yield from move(*middle(area("PROPERTIES")))
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = _measured()
    found["state_then"] = state()["kind"]
    yield from press("Z", ctrl=True, shift=True)
    yield 0.5
    found["redone"] = _measured()


@scene
def stopping_a_measurement(found):
    """Press ESC while it runs."""
    yield from green_file()
    before = state()
    yield from _start()
    found["ran"] = bool(children())
    yield from press("ESC")
    yield 0.5
    found["left"] = [len(children()), len(jobs()), _measured()]
    found["same"] = state() == before
    found["modal"] = [op.bl_idname for op in window().modal_operators]


@scene
def undo_while_measuring(found):
    """Change sigma, measure, and undo the change while it is measured."""
    yield from green_file()
    x, y = yield from find(area("PROPERTIES"), "sigma")
    yield from click(x, y)
    yield from press("A", ctrl=True)
    for key, letter in (("FOUR", "4"), ("FIVE", "5")):
        yield from press(key, letter)
    yield from press("RET")
    yield 0.5
    found["entered"] = state()["sigma"]
    yield from _start()
    yield from move(*middle(area("PROPERTIES")))
    yield from press("Z", ctrl=True)
    yield 0.3
    found["undone"] = state()["sigma"]
    found["running"] = bool(jobs())
    yield _ended
    yield 0.5
    found["measured"] = _measured()


@scene
def another_file_while_measuring(found):
    """Open another file while it is measured."""
    yield from green_file()
    yield from _start()
    found["ran"] = bool(children())
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    yield 1.0
    found["left"] = [len(children()), len(jobs())]
    found["modal"] = [op.bl_idname for op in window().modal_operators]


def _status(shown):
    """Follow what is written into the status bars; nothing tells what stands there."""
    kind = bpy.types.WorkSpace
    write = kind.status_text_set

    def noted(workspace, text):
        shown[workspace.name] = text
        write(workspace, text)

    kind.status_text_set = noted
    return write


@scene
def switched_off_while_measuring(found):
    """Disable the extension while it is measured, in another workspace than it began in."""
    yield from green_file()
    shown = {}
    write = _status(shown)
    first = window().workspace
    try:
        yield from _start()
        yield lambda: bool(shown)
        with bpy.context.temp_override(window=window()):
            bpy.ops.workspace.duplicate()
        yield lambda: len(shown) == 2
        found["ran"] = [len(children()), len(jobs()), len(shown)]
        bpy.ops.preferences.addon_disable(module=PACKAGE)
        yield 0.5
        # Blender frees the operator at once, but takes its empty place out of the list, where a
        # script meets None, only when the next event comes.
        yield from move(*middle(area("TEXT_EDITOR")))
        found["left"] = [len(children()), len(jobs()), [text for text in shown.values() if text]]
        found["modal"] = [op.bl_idname for op in window().modal_operators]
    finally:
        bpy.types.WorkSpace.status_text_set = write
        window().workspace = first
        bpy.ops.preferences.addon_enable(module=PACKAGE)
    yield from green_file()
    yield from _start()
    yield _ended
    yield 0.5
    found["measured_again"] = _measured()


@scene
def failing_to_measure(found):
    """Ask for what a second Blender cannot do."""
    yield from green_file()
    measure = ours("addon.instrument.measure")
    broken = measure.Geometry((("not an angle", 0.0),), 0.0)
    job = measure.Measurement([wall()], [broken])
    yield job.poll
    try:
        job.result()
    except ours("core.errors").OwnFaultError as error:
        found["said"] = str(error)
    job.close()
    for log in Path(bpy.app.tempdir).parent.glob("rough-spectra-*.log"):
        found["log"] = log.read_text(encoding="utf-8").splitlines()
        log.unlink()


@scene
def stopping_a_bake(found):
    """Press ESC while readings are baked."""
    yield from green_file()
    base = Path(bpy.app.tempdir) / "stopped"
    with over(area("TEXT_EDITOR")):
        OPS.bake("EXEC_DEFAULT", filepath=str(base))
    yield lambda: bool(jobs())
    found["ran"] = bool(children())
    yield from press("ESC")
    yield 0.5
    found["left"] = [len(children()), len(jobs()), len(list(base.parent.glob("stopped*")))]


@scene
def baking(found):
    """Bake to the end."""
    yield from green_file()
    base = Path(bpy.app.tempdir) / "whole"
    with over(area("TEXT_EDITOR")):
        OPS.bake("EXEC_DEFAULT", filepath=str(base))
    yield lambda: bool(jobs())
    yield _ended
    yield 0.5
    found["files"] = sorted(path.name for path in base.parent.glob("whole*"))


@scene
def stopping_an_asset_library(found):
    """Press ESC while previews are rendered."""
    yield from green_file()
    folder = Path(bpy.app.tempdir) / "assets"
    folder.mkdir(exist_ok=True)
    before = len(bpy.context.preferences.filepaths.asset_libraries)
    with over(area("TEXT_EDITOR")):
        OPS.build_assets("EXEC_DEFAULT", directory=str(folder), collection="colorchecker")
    yield lambda: bool(jobs())
    found["ran"] = bool(children())
    yield from press("ESC")
    yield 0.5
    after = len(bpy.context.preferences.filepaths.asset_libraries)
    found["left"] = [len(children()), len(jobs()), len(list(folder.iterdir())), after - before]


SEVEN = "\n".join(["nm,Slate", *(f"{nm},{0.2 + nm / 4000:.4f}" for nm in range(380, 745, 7))])
"""A grid for which nothing is tabulated, so that colour-science has to be there; invented."""


@scene
def wheels_of_extensions(found):
    """Build asset libraries, with somebody else's extension installed that has a wheel."""
    yield from empty_file()
    folder = Path(bpy.app.tempdir) / "wheels"
    folder.mkdir()
    bpy.ops.extensions.package_install_files(
        filepath=str(other_extension.build(folder)), repo="user_default", enable_on_install=True
    )
    found["before"] = _wheels()
    (folder / "seven.csv").write_text(SEVEN, encoding="utf-8")
    with over(area("TEXT_EDITOR")):
        OPS.import_samples("EXEC_DEFAULT", filepath=str(folder / "seven.csv"), collection="seven")
    library = ours("addon.samples.library")
    # As the panel does: the drop list shows what is known.
    library.contents(ours("addon.material.preferences").user_folder())
    for collection in ("everyday", "seven"):
        with over(area("TEXT_EDITOR")):
            OPS.build_assets(
                "EXEC_DEFAULT",
                directory=str(folder / "library"),
                collection=collection,
                sigmas="20",
                read_at="de:8",
                add_to_preferences=False,
            )
        while not _ended():  # longer than one step of a scene may take
            yield 0.5
    found["files"] = sorted(path.name for path in (folder / "library").glob("*.blend"))
    with bpy.data.libraries.load(
        str(folder / "library" / "rough-spectra-seven.blend"), assets_only=True
    ) as (there, wanted):
        wanted.materials = there.materials
    found["read_at"] = [material.rough_spectra.read_at for material in wanted.materials]
    found["after"] = _wheels()
    importlib.invalidate_caches()
    found["imported"] = importlib.import_module(other_extension.MODULE).ANSWER
    found["ours"] = importlib.machinery.PathFinder.find_spec("colour") is not None


def _wheels():
    """Name what Blender unpacked of the wheels of all extensions."""
    folder = Path(bpy.utils.user_resource("EXTENSIONS"))
    return sorted(path.name for path in folder.glob(".local/lib/*/site-packages/*.dist-info"))
