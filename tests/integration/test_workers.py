# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts in second Blenders owe: they end with who asked, and run nobody's code."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import bpy
import pytest
from rough_spectra.addon.blender import second_blender
from rough_spectra.addon.instrument import measure, worker

from tests.integration.conftest import START
from tests.integration.support import ROOT, rgb_material

MEASURE = """
extension = load_extension()
extension.register()
from rough_spectra.addon.instrument import measure
measure.measure([bpy.data.materials.new("A")], [measure.RING_45_0] * 500)
"""
BUILD = """
extension = load_extension()
extension.register()
from pathlib import Path
from rough_spectra.addon.assets import build, plan
chosen = plan.of_collection("colorchecker")
build.build(plan.assets(chosen, range(0, 64, 8), 63), Path("library").absolute())
"""
"""Either takes a while; a worker that nobody stops leaves its results in its folder, for ever."""

SECONDS = 60.0


def processes(folder):
    """Processes whose command names a path in the folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdecimal():
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if any(word.startswith(bytes(folder)) for word in words):
                found.append(int(entry.name))
    return found


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
@pytest.mark.parametrize("task", [MEASURE, BUILD], ids=["measure", "build"])
def test_a_worker_whose_asker_was_killed_ends_and_removes_its_files(task, environment, tmp_path):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    code = START.format(root=str(ROOT)) + task
    asker = subprocess.Popen(
        [sys.executable, "-c", code],
        env=environment | {"TMPDIR": str(temporary)},
        cwd=tmp_path,
        stdout=subprocess.DEVNULL,
    )
    try:
        begun = time.monotonic()
        while not list(temporary.glob("rough-spectra-*/progress")):
            assert asker.poll() is None
            assert time.monotonic() < begun + SECONDS
            time.sleep(0.05)
        assert len(processes(temporary)) == 1
    finally:
        asker.kill()
        asker.wait()
    end = time.monotonic() + SECONDS
    while processes(temporary) and time.monotonic() < end:
        time.sleep(0.05)
    left = processes(temporary)
    for process in left:
        os.kill(process, signal.SIGKILL)
    assert left == []
    assert list(temporary.glob("rough-spectra-*")) == []


TRUSTING = """
import runpy, sys
import bpy
bpy.context.preferences.filepaths.use_scripts_auto_execute = True
runpy.run_path(sys.argv[1], run_name="__main__")
"""
"""Runs a worker where scripts are switched on, as in a Blender whose user trusts every file."""


@pytest.fixture
def traps(tmp_path):
    """Materials, a linked one among them, whose scripts leave a file; gives both."""
    marks = {name: tmp_path / name for name in ("text", "driver", "linked")}

    def driven(name, mark):
        material = rgb_material(name)
        shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_DIFFUSE")
        driver = shader.inputs["Roughness"].driver_add("default_value").driver
        driver.expression = f"open({str(mark)!r}, 'w').close() or 0.5"
        return material

    library = tmp_path / "library.blend"
    bpy.data.libraries.write(str(library), {driven("Linked", marks["linked"])}, fake_user=True)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    material = driven("Local", marks["driver"])
    text = bpy.data.texts.new("script.py")
    text.use_module = True  # "Register": it runs when the file is opened
    text.from_string(f"open({str(marks['text'])!r}, 'w').close()")
    material.node_tree.nodes.new("ShaderNodeScript").script = text
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.materials = ["Linked"]
    for mark in marks.values():
        mark.unlink(missing_ok=True)
    return [material, *wanted.materials], marks


def sprung(traps, script, monkeypatch):
    """Measure with a worker, and name the scripts that ran there."""
    materials, marks = traps
    command = [sys.executable, "-P", "-c", TRUSTING, str(script)]
    monkeypatch.setattr(second_blender, "_blender", lambda _worker: command)
    values = measure.measure(materials)
    assert values.shape == (1, 2, 2, 3)
    return {name for name, mark in marks.items() if mark.exists()}


def test_a_worker_runs_no_script_of_a_file(traps, monkeypatch):
    assert sprung(traps, Path(worker.__file__), monkeypatch) == set()


def test_the_scripts_would_run_in_a_worker_that_trusts_files(traps, monkeypatch, tmp_path):
    """Else the test above proves nothing."""
    text = Path(worker.__file__).read_text(encoding="utf-8")
    assert text.count("use_scripts=False") == 1
    trusting = tmp_path / "worker.py"
    trusting.write_text(text.replace(", use_scripts=False", ""), encoding="utf-8")
    assert sprung(traps, trusting, monkeypatch) == {"text", "driver", "linked"}
