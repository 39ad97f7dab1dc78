# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that come in: measurements, and materials of other .blend files."""

from pathlib import Path
from runpy import run_path

import bpy
from driver import area, over, press, scene, window
from stage import OPS, PACKAGE, empty_file, green_file, ours, state, wall

ROOT = Path(__file__).resolve().parents[2]

BANDS = range(400, 701, 20)
PLASTER = "\n".join(
    [
        "name," + ",".join(f"R{nm} nm" for nm in BANDS),
        "Plaster," + ",".join(f"{0.6 + (nm - 400) / 2000:.3f}" for nm in BANDS),
        "Loess," + ",".join(f"{0.8 + (nm - 400) / 4000:.3f}" for nm in BANDS),
    ]
)
"""Invented numbers."""


def _library():
    library = ours("addon.samples.library")
    return sorted(
        entry.name
        for entry in library.contents(ours("addon.material.preferences").user_folder()).entries
    )


def _drop(where, **options):
    """Call what Blender calls when files are dropped on an editor."""
    path = Path(bpy.app.tempdir) / "plaster.csv"
    path.write_text(PLASTER, encoding="utf-8")
    with over(area(where)):
        OPS.import_samples(
            "INVOKE_DEFAULT", directory=str(path.parent), files=[{"name": path.name}], **options
        )


@scene
def a_dropped_file(found):
    """Drop a file on the properties editor: leave the dialog, then agree."""
    yield from empty_file()
    handler = bpy.types.ROUGHSPECTRA_FH_import
    for kind in ("PROPERTIES", "TEXT_EDITOR"):
        with over(area(kind)):
            found[kind] = bool(handler.poll_drop(bpy.context))
    before = _library()
    _drop("PROPERTIES")
    yield 1.0
    yield from press("ESC")
    yield 0.5
    found["left"] = [state(), _library() == before]
    _drop("PROPERTIES")
    yield 1.0
    yield from press("RET")
    yield 1.0
    found["agreed"] = state()
    found["added"] = [name for name in _library() if name not in before]
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = state()


@scene
def a_file_from_the_menu(found):
    """Choose a file in the file browser of File ▸ Import."""
    yield from empty_file()
    path = Path(bpy.app.tempdir) / "chosen.csv"
    path.write_text(PLASTER.replace("Plaster", "Lime").replace("Loess", "Loam"), encoding="utf-8")
    with over(area("TEXT_EDITOR")):
        OPS.import_samples("INVOKE_DEFAULT")
    yield lambda: _browser() is not None
    yield 0.5
    browser = _browser()
    found["options"] = browser.spaces.active.active_operator.bl_idname
    browser.spaces.active.params.directory = str(path.parent).encode()
    browser.spaces.active.params.filename = path.name
    yield 1.0
    holder = next(w for w in bpy.data.window_managers[0].windows if browser in w.screen.areas[:])
    with bpy.context.temp_override(window=holder, area=browser):
        bpy.ops.file.execute()
    yield 1.5
    before = _library()
    yield from press("RET")
    yield 1.0
    found["added"] = [name for name in _library() if name not in before]
    found["material"] = state()


def _browser():
    for each in bpy.data.window_managers[0].windows:
        for found in each.screen.areas:
            if found.type == "FILE_BROWSER":
                return found
    return None


@scene
def other_files(found):
    """Save and reload, append, link, override, and make local, with the panel in sight."""
    yield from green_file()
    before, name_of_it = state(), wall().name
    path = str(Path(bpy.app.tempdir) / "wall.blend")
    for name, act in (
        ("saved", lambda: bpy.ops.wm.save_as_mainfile(filepath=path)),
        ("reloaded", lambda: bpy.ops.wm.open_mainfile(filepath=path)),
    ):
        with bpy.context.temp_override(window=window()):
            act()
        yield 1.0
        found[name] = state() == before
    for name, link in (("appended", False), ("linked", True)):
        yield from _bring(path, name_of_it, link)
        found[name] = state()["kind"]
    yield from _bring(path, name_of_it, link=True)
    override = wall().override_create(remap_local_usages=True)
    bpy.data.objects["Wall"].active_material = override
    yield 1.0
    found["overridden"] = state()["kind"]
    override.rough_spectra.sigma = 0.2
    yield 0.5
    found["override"] = state()["color"] == before["color"]
    yield from _bring(path, name_of_it, link=True)
    with over(area("PROPERTIES")):
        bpy.data.objects["Wall"].select_set(True)
        bpy.ops.object.make_local(type="SELECT_OBDATA_MATERIAL")
    yield 1.0
    found["local"] = [wall().library is None, state()["kind"]]


def _bring(path, material, link):
    yield from empty_file()
    with bpy.data.libraries.load(path, link=link) as (_, wanted):
        wanted.materials = [material]
    bpy.data.objects["Wall"].data.materials.append(wanted.materials[0])
    yield 1.0


@scene
def submitting_what_is_not_saved(found):
    """Submit to Flamenco after an edit, and again once that is saved."""
    yield from green_file()
    path = str(Path(bpy.app.tempdir) / "shot.blend")
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.save_as_mainfile(filepath=path)
    yield 1.0  # the window takes note of a save with its next events
    preferences = bpy.context.preferences
    ours_of = preferences.addons[PACKAGE].preferences
    before = preferences.system.use_online_access
    stand_in = run_path(str(ROOT / "tools" / "checks" / "flamenco_stand_in.py"))
    script = ROOT / "farm" / "flamenco" / "rough_spectra.js"
    manager = stand_in["Manager"]({"rough-spectra": script})
    with stand_in["serving"](manager) as address:
        preferences.system.use_online_access = True
        ours_of.flamenco_manager = address
        with over(area("PROPERTIES")):
            OPS.assign_preset("EXEC_DEFAULT", True, preset="everyday/brick")  # with an undo step
        yield 0.5
        found["edited"] = [bpy.data.is_dirty, _submit(), manager.asked[:], len(manager.jobs)]
        with bpy.context.temp_override(window=window()):
            bpy.ops.wm.save_mainfile()
        yield 0.5
        found["saved"] = [bpy.data.is_dirty, _submit(), len(manager.jobs)]
        found["file"] = manager.jobs[0]["settings"]["blendfile"] == path
    ours_of.flamenco_manager = ""
    preferences.system.use_online_access = before


def _submit():
    try:
        with over(area("PROPERTIES")):
            return sorted(OPS.submit_to_flamenco("EXEC_DEFAULT"))
    except RuntimeError as error:
        return str(error).strip()
