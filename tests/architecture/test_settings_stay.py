# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing that ships, and no tool, resets the add-ons of the Blender that it runs in."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("addon", "core", "tools")
RESETTING = {"read_factory_settings", "read_factory_userpref", "disable_all", "reset_all"}
"""Each sets the enabled add-ons anew, and Blender deletes the wheels that none of them needs."""


def resetting(text):
    """Lines at which the add-ons are reset; a change of the application template does it too."""
    return [
        node.lineno
        for node in ast.walk(ast.parse(text))
        if (isinstance(node, ast.Attribute) and node.attr in RESETTING)
        or (isinstance(node, ast.keyword) and node.arg == "app_template")
    ]


def test_nothing_resets_the_add_ons():
    files = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]
    assert len(files) > 100
    found = {
        str(path.relative_to(ROOT)): resetting(path.read_text(encoding="utf-8")) for path in files
    }
    assert {name: lines for name, lines in found.items() if lines} == {}


@pytest.mark.parametrize(
    "line", ["bpy.ops.wm.read_factory_settings(use_empty=True)", "read_homefile(app_template='x')"]
)
def test_the_search_finds_what_it_looks_for(line):
    assert resetting(line) == [1]
