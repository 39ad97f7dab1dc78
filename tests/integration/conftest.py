# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A small .blend, baked once, and ways to run the command line: as a process, or in this one."""

import json
import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import bpy
import pytest

from tests.integration.support import (
    COMMAND,
    ODD_NAME,
    ROOT,
    SECONDS,
    Bake,
    Result,
    checkered_and_glowing,
    contents,
    rgb_material,
    spectrum_csv,
)


@pytest.fixture(autouse=True)
def empty_blender(empty_file):
    """Every test begins with an empty file."""


@pytest.fixture(scope="session")
def environment(tmp_path_factory):
    """Settings and temporary files of child processes, away from everything else."""
    user, temporary = tmp_path_factory.mktemp("user"), tmp_path_factory.mktemp("temporary")
    return os.environ | {
        "BLENDER_USER_RESOURCES": str(user),
        "TMPDIR": str(temporary),
        "PYTHONDONTWRITEBYTECODE": "1",
    }


@pytest.fixture
def run(environment):
    """Run the command line as a process of its own."""

    def run(*words, before=None, **extra) -> Result:
        done = subprocess.run(
            [*COMMAND, *map(str, words)],
            env=environment | extra,
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=SECONDS,
            preexec_fn=before,
            check=False,
        )
        return Result(done.returncode, done.stderr, done.stdout)

    return run


@pytest.fixture
def blender(environment):
    """Run lines in a fresh Blender and give the JSON that they print last."""

    def blender(lines, **extra):
        code = START.format(root=str(ROOT)) + textwrap.dedent(lines)
        done = subprocess.run(
            [sys.executable, "-c", code],
            env=environment | extra,
            capture_output=True,
            text=True,
            timeout=SECONDS,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout.splitlines()[-1])

    return blender


START = """
import importlib, json, sys, time
sys.path.insert(0, {root!r})
import bpy
from tools.run.run_command_line import load_extension
"""


@pytest.fixture
def main(capfd):
    """Run the command line in this process: the same code, without the second to start Blender."""
    from rough_spectra.addon.commands import command_line

    def main(*words) -> Result:
        capfd.readouterr()
        status = command_line.main([str(word) for word in words])
        out, err = capfd.readouterr()
        return Result(status, err, out)

    return main


@pytest.fixture(scope="session")
def scene_file(tmp_path_factory, extension):
    """A .blend with spectra on two wavelength grids, hand-made materials and objects."""
    from rough_spectra.addon.matching.solve import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.samples import presets, readers

    bpy.ops.wm.read_factory_settings(use_empty=True)
    folder = tmp_path_factory.mktemp("scene")
    measured = readers.read(spectrum_csv(folder / "paper.csv", "paper"))[0]
    pairs = [
        (rgb_material("Alpha"), Request(presets.load("14"), 0.35)),
        (rgb_material("Beta"), Request(presets.load("5"), 0.0, illuminant="A", observer=10)),
        (rgb_material(ODD_NAME), Request(measured, 0.5)),
        (rgb_material("Delta"), Request(presets.load("20"), 0.1)),
    ]
    derive.assign(pairs)
    rgb_material("Plain", (0.2, 0.4, 0.6))
    checkered_and_glowing("Patterned")
    for name, slots in (("Panel", ["Alpha", "Plain"]), ("Bare", [])):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2), (0, 2, 3)])
        for number, slot in enumerate(slots):
            mesh.materials.append(bpy.data.materials[slot])
            mesh.polygons[number].material_index = number
        thing = bpy.data.objects.new(name, mesh)
        thing.location.x = 0 if slots else -5
        bpy.context.collection.objects.link(thing)
    path = folder / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return path


@pytest.fixture
def scene(scene_file, tmp_path):
    """A copy of the scene that a test may spoil."""
    return Path(shutil.copy(scene_file, tmp_path / "scene.blend"))


@pytest.fixture(scope="session")
def baked(scene_file, environment, tmp_path_factory, extension):
    """All spectra of the scene and the surface of an object, baked by a process of its own."""
    base = tmp_path_factory.mktemp("baked") / "chart"
    words = ["bake", "--blend", str(scene_file), "--output", str(base), "--object", "Panel"]
    for name in ("Alpha", "Beta", ODD_NAME, "Delta", "Patterned"):
        words += ["--material", name]
    done = subprocess.run(
        [*COMMAND, *words],
        env=environment,
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=SECONDS,
        check=True,
    )
    return Bake(base, contents(base.parent), Result(done.returncode, done.stderr, done.stdout))
