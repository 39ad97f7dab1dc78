# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`analyze`: match materials to the lights and directions of their scene."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...support.shown_text import inform, tell

NAME = "analyze"
SUMMARY = "match materials to the lights and directions of their scene"
DESCRIPTION = (
    "Look through the scene's camera, find the lights and directions that meet each material with "
    "a measured spectrum, match it to them, print each light's share and ΔE00, and save the file."
)

_UNUSABLE = 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `analyze`."""
    parser.add_argument(
        "--material",
        action="append",
        default=[],
        metavar="NAME",
        help="a material, repeatable; without any, all in view that store a spectrum",
    )
    parser.add_argument("--scene", metavar="NAME", help="a scene other than the file's active one")
    parser.add_argument(
        "--overwrite-edits",
        action="store_true",
        help="match materials, too, whose color or roughness was edited by hand",
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="save here, not over the file")


def run(options: argparse.Namespace) -> int:
    """Analyze, match and save; exit status 0, or 2 where a damaged material was left out."""
    import bpy

    from ....core.errors import InputError
    from ...blender.blend_file import destination, save
    from ...material import selection, storage
    from ...scene import analysis, follow_scene
    from ..progress import counted
    from ..result import add

    destination(options.output)  # before the work that could not be saved
    scene = bpy.context.scene
    if options.scene is not None:
        scene = bpy.data.scenes.get(options.scene)
        if scene is None:
            msg = f"There is no scene {options.scene!r} in the file; check the name."
            raise InputError(msg)
    named = [selection.by_name(name) for name in options.material] or None
    with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        report = analysis.analyze(depsgraph, scene)
        chosen, left = follow_scene.choose(report, named, options.overwrite_edits)
        damaged = any(storage.fault(m, report.views[m]) for m in follow_scene.candidates(report))
        changes = follow_scene.follow(report, chosen)
    for sentence in (*report.warnings, follow_scene.unlit_sentence(report), *left):
        if sentence:
            tell(f"warning: {sentence}")
    for change in changes:
        for warning in change.solution.warnings:
            tell(f"warning: material {change.material.name!r}: {warning}")
    for line in follow_scene.table(report, changes):
        inform(line)
    path = save(options.output)
    add(options, saved=path, materials=[change.material.name for change in changes])
    inform(
        f"matched {counted(len(changes), 'material')} to scene {scene.name!r} in "
        f"{report.seconds:.2f} s; saved {path}"
    )
    return _UNUSABLE if damaged and named is None else 0
