# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Second Blenders work in any temporary folder, whatever it is called."""

import ast
import tempfile
from pathlib import Path

import bpy
import pytest
from rough_spectra.addon.assets import build, plan
from rough_spectra.addon.instrument.measure import measure

from tests.integration.support import ROOT, rgb_material

HOME = Path("addon", "instrument", "worker.py")
"""The one place that tells Blender where a picture goes."""


@pytest.fixture(params=["{blend_name}", "a{b}{{c}}} #1 %d"])
def odd(request, tmp_path, monkeypatch):
    """A temporary folder whose name Blender takes for a template, unless it is told otherwise.

    The file is saved, so that there is a name to fill in.
    """
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    folder = tmp_path / request.param
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    yield folder
    assert list(folder.iterdir()) == []
    assert {path.name for path in tmp_path.iterdir()} <= {folder.name, "scene.blend", "library"}


def test_measuring(odd):
    color = (0.2, 0.4, 0.6)
    [[[mean, _]]] = measure([rgb_material("Plain", color)])
    assert mean == pytest.approx(color, abs=1e-5)


def test_building_an_asset_library(odd, tmp_path):
    built = build.build(plan.assets([plan.of_name("14")], [10], 63), tmp_path / "library")
    with bpy.data.libraries.load(str(built.blend), assets_only=True) as (_, wanted):
        wanted.materials = ["ColorChecker 14 Green σ 10°"]
    assert wanted.materials[0].preview.image_pixels_float[:].count(1.0) > 0


def test_nothing_else_says_where_a_picture_goes():
    """A path of Blender's own that takes templates is `RenderSettings.filepath`."""
    found = set()
    for folder in ("addon", "tools"):
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
                    # An operator's, which tells us a path, and an image's take no templates.
                    owner = node.value.id if isinstance(node.value, ast.Name) else ""
                    others = "self", "operator", "entry", "image"
                    if node.attr == "filepath" and owner not in others:
                        found.add(path.relative_to(ROOT))
    assert found == {HOME}
