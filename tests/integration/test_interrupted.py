# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes that are stopped or killed, and what a terminal shows meanwhile."""

import json
import os
import re
import select
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import bpy
import pytest
from rough_spectra.addon.blender import background_job

from tests.integration.support import COMMAND, SECONDS, contents, rgb_material

MANY = 1100
"""Materials for two renders, since one holds 1,024."""

posix = pytest.mark.skipif(sys.platform == "win32", reason="signals and terminals of POSIX")
pytestmark = posix


@pytest.fixture(scope="session")
def many(tmp_path_factory, extension):
    """A .blend with spectra enough for a bake of some seconds."""
    from rough_spectra.addon.matching.solve import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.samples import presets

    bpy.ops.wm.read_factory_settings(use_empty=True)
    # These lie outside Rec.709 at some σ, where no color of Cycles reads like them.
    outside = ("16 Yellow", "18 Cyan")
    samples = [
        sample for sample in presets.load_all("colorchecker") if not sample.name.endswith(outside)
    ]
    materials = [rgb_material(f"m{number:04d}") for number in range(MANY)]
    derive.assign(
        [
            (material, Request(samples[i % 22], 0.001 * (i % 700)))
            for i, material in enumerate(materials)
        ]
    )
    path = tmp_path_factory.mktemp("many") / "many.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return path


@pytest.fixture(scope="session")
def predicted(many, tmp_path_factory):
    """The files of a bake of all of them; merging its JSON writes them all again, and at once."""
    from rough_spectra.addon.commands import command_line

    base = tmp_path_factory.mktemp("predicted") / "x"
    words = ["bake", "--blend", str(many), "--predicted-only", "--output", str(base)]
    assert command_line.main(words) == 0
    return base.with_name("x.json")


@pytest.fixture
def temporary(tmp_path):
    folder = tmp_path / "temporary"
    folder.mkdir()
    return folder


@pytest.fixture
def start(environment, temporary):
    """Start a command line in a process group of its own, as a shell does."""
    started = []

    def start(*words, **options):
        process = subprocess.Popen(
            [*COMMAND, *map(str, words)],
            env=environment | {"TMPDIR": str(temporary)},
            start_new_session=True,
            # A job that a script put in the background inherits SIGINT ignored.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            **({"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE} | options),
        )
        started.append(process)
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.wait()
        if process.stderr:
            process.stderr.close()


def wait_for(condition):
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.005)
    raise AssertionError(f"nothing happened for {SECONDS} s")


def workers(temporary):
    """Processes of second Blenders that work in this folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdecimal():
            try:
                words = (entry / "cmdline").read_bytes()
            except OSError:
                continue
            if str(temporary).encode() in words and b"worker.py" in words:
                found.append(int(entry.name))
    return found


linux = pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")


def old_outputs(folder):
    folder.mkdir()
    for ending in ("json", "predicted.csv", "measured.csv", "predicted.spectral.exr"):
        (folder / f"x.{ending}").write_bytes(b"old " + ending.encode())
    return contents(folder)


@linux
@pytest.mark.parametrize("group", [False, True], ids=["process", "terminal"])
def test_interrupt_while_measuring_says_so_and_leaves_nothing(
    group, many, start, temporary, tmp_path
):
    """A terminal's Ctrl-C reaches the second Blender too."""
    before = old_outputs(tmp_path / "out")
    process = start("bake", "--blend", many, "--output", tmp_path / "out" / "x")
    wait_for(lambda: workers(temporary))
    time.sleep(0.5)
    if group:
        os.killpg(process.pid, signal.SIGINT)
    else:
        process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=SECONDS)
    assert process.returncode == 130
    assert "Traceback" not in err.decode()
    last = err.decode().splitlines()[-1]
    assert last.startswith("rough_spectra bake: ")
    assert "nterrupted; nothing was written." in last
    assert contents(tmp_path / "out") == before
    assert not workers(temporary)
    assert not list(temporary.glob("rough-spectra-*"))


@linux
def test_kill_while_measuring_leaves_the_old_outputs_and_no_process(
    many, start, temporary, tmp_path
):
    before = old_outputs(tmp_path / "out")
    process = start("bake", "--blend", many, "--output", tmp_path / "out" / "x")
    wait_for(lambda: list(temporary.glob("rough-spectra-*/progress")))
    process.kill()
    process.wait()
    wait_for(lambda: not workers(temporary))
    assert contents(tmp_path / "out") == before


@linux
@pytest.mark.parametrize("group", [False, True], ids=["alone", "both"])
def test_kill_amid_a_long_render_leaves_no_process_and_no_folder(group, start, temporary, tmp_path):
    """Alone, its second Blender ends and tidies up; together, the next job does."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.world = bpy.data.worlds.new("World")
    bpy.ops.object.camera_add()
    scene.camera = bpy.context.object
    path = tmp_path / "long.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    words = ("--bands", "3", "--samples", "1000000", "--no-comparison")
    process = start("spectral", "--blend", path, "-o", tmp_path / "x.exr", *words)
    wait_for(lambda: list(temporary.glob("rough-spectra-*/progress")))
    background_job.sweep(temporary)
    [folder] = temporary.glob("rough-spectra-*")
    if group:
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()
    wait_for(lambda: not workers(temporary))
    if group:
        background_job.sweep(temporary)
    assert not folder.exists()
    # An empty one of its own stays where any Blender is killed.
    blenders = [each for each in temporary.iterdir() if not any(each.iterdir())]
    assert [*temporary.iterdir()] == blenders
    assert len(blenders) <= 1 + group
    assert not (tmp_path / "x.exr").exists()


# The first part appears when writing begins, the last just before the files get their names.
@pytest.mark.parametrize("parts", [1, 4])
def test_kill_while_writing_leaves_each_file_old_or_new(parts, predicted, main, start, tmp_path):
    new = contents(predicted.parent)
    assert len(new) == 4
    out = tmp_path / "out"
    out.mkdir()
    for name in new:
        (out / name).write_bytes(b"old")
    process = start("merge", predicted, "--output", out / "x")
    wait_for(lambda: len(list(out.glob(".*.part"))) >= parts or process.poll() is not None)
    process.kill()
    process.wait()
    assert parts > 1 or process.returncode == -signal.SIGKILL
    found = contents(out)
    for name in new:
        assert found[name] in (b"old", new[name])
    assert main("merge", predicted, "--output", out / "x").status == 0
    assert {name: contents(out)[name] for name in new} == new


def test_interrupt_while_writing_leaves_no_parts(predicted, start, tmp_path):
    out = tmp_path / "out"
    before = old_outputs(out)
    process = start("merge", predicted, "--output", out / "x")
    wait_for(lambda: list(out.glob(".*.part")))
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=SECONDS)
    assert process.returncode == 130
    assert err.decode().splitlines()[-1].startswith("rough_spectra merge: Interrupted")
    assert contents(out) == before


def test_kill_while_saving_leaves_the_old_blend_or_the_new(many, start, tmp_path):
    blend = Path(shutil.copy(many, tmp_path / "scene.blend"))
    before = blend.read_bytes()
    words = ("--preset", "14", "--material", "m0000", "--sigma", "3")
    process = start("assign", "--blend", blend, *words)
    wait_for(lambda: list(tmp_path.glob(".scene.blend.*")) or process.poll() is not None)
    process.kill()
    process.wait()
    assert process.returncode == -signal.SIGKILL
    assert blend.read_bytes() == before
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    assert len(bpy.data.materials) == MANY


def test_terminal_shows_rate_and_remaining_time_on_one_line(many, start, tmp_path):
    screen, side = os.openpty()
    base = tmp_path / "x"
    process = start("bake", "--blend", many, "--output", base, "--format", "csv", stderr=side)
    os.close(side)
    began, text = time.monotonic(), b""
    try:
        while time.monotonic() - began < SECONDS:
            if not select.select([screen], [], [], 0.5)[0]:
                continue
            try:
                piece = os.read(screen, 65536)
            except OSError:  # the other end is closed
                break
            if not piece:
                break
            text += piece
    finally:
        os.close(screen)
    assert process.wait(SECONDS) == 0
    shown = text.decode()
    lines = shown.split("\r\x1b[K")
    assert lines[1] == "measuring: starting Blender"
    counts = [
        re.fullmatch(r"measuring: (\d+) of (\d+) materials(, [\d.]+/s, \d+ s left)?", line)
        for line in lines[1:-1]
        if "starting" not in line and line
    ]
    assert counts
    assert all(counts), lines
    assert any(match[3] for match in counts)
    assert {int(match[2]) for match in counts} == {MANY}
    numbers = [int(match[1]) for match in counts]
    assert numbers == sorted(numbers)
    # The line is cleared, and what is left is the result.
    assert lines[-1].startswith(f"{MANY} readings at 45a:0, largest ΔE00 ")
    assert shown.count("\n") == 1
    document = json.loads((tmp_path / "x.json").read_bytes())
    assert document["largest_delta_e_00"] <= 0.05
    assert len(document["readings"]) == MANY
