# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Imports go down only, Blender is known above its wall only, and no files form a circle."""

from __future__ import annotations

import shutil
import subprocess
import sys
import textwrap

import pytest

from tests.architecture import house


def test_every_file_is_in_a_wing():
    outside = [path for path in house.files(house.ROOT).values() if house.wing_of(path) is None]
    assert outside == ["addon/__init__.py"]


def test_imports_go_down_only():
    assert house.upward(house.ROOT) == []


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ("core/reading.py", "from ..addon.samples import sample"),
        ("addon/samples/library.py", "def f():\n    from ..material import storage"),
        ("addon/preview/icons.py", "from ..scene import camera"),
        ("addon/readings/document.py", "import typing\nfrom ..colorimetry import srgb"),
    ],
)
def test_an_import_that_goes_up_or_across_is_found(broken, path, line):
    [fault] = house.upward(broken(path, line))
    assert fault.startswith(path)


def test_no_private_name_is_taken_from_another_wing():
    assert house.private(house.ROOT) == []


def test_a_private_name_is_found(broken):
    line = "from ...core import reading\nreading._evaluate"
    [fault] = house.private(broken("addon/api/upkeep.py", line))
    assert "(_evaluate)" in fault


def test_no_files_import_each_other_in_a_circle():
    assert house.circles(house.ROOT) == []


def test_a_circle_is_found_also_through_functions_and_packages(broken):
    line = "def f():\n    from ..matching import solve"
    [circle] = house.circles(broken("addon/matching/request.py", line))
    assert {"addon/matching/request.py", "addon/matching/solve.py"} <= set(circle)


def test_blender_is_known_above_its_wall_only():
    assert house.blender_below_the_wall(house.ROOT) == []


@pytest.mark.parametrize("line", ["import bpy.types", "def f():\n    from mathutils import Color"])
def test_blender_below_the_wall_is_found(broken, line):
    [fault] = house.blender_below_the_wall(broken("addon/matching/assess.py", line))
    assert "addon/matching/assess.py" in fault


PLAIN = """
    import importlib, importlib.abc, importlib.util, json, sys

    class Refuse(importlib.abc.MetaPathFinder):
        def find_spec(self, name, path=None, target=None):
            if name.partition(".")[0] in {refused!r}:
                raise ModuleNotFoundError(name + " is refused here")

    sys.meta_path.insert(0, Refuse())
    spec = importlib.util.spec_from_file_location(
        "rough_spectra", {root!r} + "/__init__.py", submodule_search_locations=[{root!r}]
    )
    sys.modules["rough_spectra"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sys.modules["rough_spectra"])
    faults = []
    for name in {names!r}:
        try:
            importlib.import_module("rough_spectra." + name)
        except ImportError as error:
            faults.append(name + ": " + str(error))
    print(json.dumps(faults))
"""


def below_the_wall(root):
    names = [name for name, path in house.files(root).items() if house.free_of_blender(path)]
    code = PLAIN.format(refused=set(house.BLENDERS_OWN), root=str(root), names=names)
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, check=True
    )
    return names, done.stdout.strip()


def test_every_module_below_the_wall_imports_in_plain_python():
    names, faults = below_the_wall(house.ROOT)
    assert len(names) > 100
    assert faults == "[]"


def test_a_module_that_reaches_blender_through_another_is_found(broken):
    root = broken("addon/support/version.py", "import bpy")
    shutil.copy(house.ROOT / "__init__.py", root)
    _, faults = below_the_wall(root)
    assert "bpy is refused here" in faults
