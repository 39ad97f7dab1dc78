# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators share: files chosen, lists drawn, and how they report."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import bpy

_CHARACTERS_A_LINE = 100


_SWATCH_WIDTH = 1.6
"""Of a color in a list, in heights of a button."""


def choose_files(operator: Any, context: Any, behind: str = "") -> set[str]:
    """Let the user choose where an operator writes; the .blend's name and `behind` come first."""
    if not operator.filepath:
        blend = Path(bpy.data.filepath or "untitled.blend")
        operator.filepath = str(blend.with_name(blend.stem + behind))
    context.window_manager.fileselect_add(operator)
    return {"RUNNING_MODAL"}


def open_file(operator: Any, context: Any) -> set[str]:
    """Let the user choose a file to read, at first beside the .blend, whose name is no such."""
    if not operator.filepath and bpy.data.filepath:
        operator.filepath = str(Path(bpy.data.filepath).parent) + os.sep
    context.window_manager.fileselect_add(operator)
    return {"RUNNING_MODAL"}


def draw_swatch(row: Any, item: Any, has_color: bool = True) -> None:
    """Draw the color of a list's item, as wide in every list, or leave its place empty."""
    swatch = row.row()
    swatch.ui_units_x = _SWATCH_WIDTH
    if has_color:
        swatch.prop(item, "swatch", text="")
    else:
        swatch.label(text="", icon="BLANK1")
    row.separator(factor=0.5)


def report_error(operator: Any, error: Exception | str) -> None:
    """Report what went wrong, in lines: Blender's popup lets a long one run out of the window."""
    sentence = str(error)
    if not bpy.app.background:
        # The space is for the status bar, which leaves out the end of a line.
        lines = textwrap.wrap(
            sentence, _CHARACTERS_A_LINE, break_long_words=False, break_on_hyphens=False
        )
        sentence = " \n".join(lines)
    operator.report({"ERROR"}, sentence)


def report_warnings(operator: Any, pairs: Iterable[tuple[Any, Any]]) -> None:
    """Report every warning of the solutions, with the material's name.

    What was altered when the file was read is told, too, but is no fault of the match. `pairs` are
    materials that store what was solved, and their solutions.
    """
    from ...material import storage

    for material, solution in pairs:
        altered = storage.load(material).sample.altered if solution.warnings else ()
        for warning in solution.warnings:
            level = "INFO" if warning in altered else "WARNING"
            operator.report({level}, f"{material.name}: {warning}")
