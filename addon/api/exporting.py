# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials for other renderers."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import bpy

from ..export import kept
from ..export import targets as export_targets
from ..export import write as export_files
from ..export.kept import Loss
from ..export.write import Exported
from .checks import checked


def export(
    materials: Iterable[bpy.types.Material],
    base: str | os.PathLike[str],
    targets: Iterable[str] = export_targets.NAMES,
) -> Exported:
    """Write materials for other renderers, each solved for the lobe of the renderer that shows it.

    The open file is not changed. What is written follows the spectra and their settings, is matte,
    and reads right at each material's virtual instrument.

    Parameters
    ----------
    materials
        With a spectrum. One whose data cannot be used is a fault in the result, and does not stop
        the others.
    base
        Folder and base name; endings are added: "out/chart" becomes out/chart.mtlx and so on.
    targets
        Any of "materialx", "usd", "gltf", "mitsuba", "pbrt" and "luxcore"; "usd" starts a second
        Blender, and this call waits for it.

    Returns
    -------
    Its `files`, one a target; `faults` and `warnings`, sentences; and `entries`, or `of(target)`
    alone, each with `color`, `roughness` in the renderer's unit, `delta_e_instrument`, and
    `delta_e_mean` and `delta_e_95` over the hemisphere.

    Raises
    ------
    MaterialError
        None of the materials has a spectrum that can be used.
    DomainError
        A target is not known, or there is no material.
    OutputError
        A file cannot be written or replaced, or the second Blender failed; none was touched.
    CancelledError
        On an interrupt from the keyboard; nothing was written.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> found = export([wall], "out/wall", ["materialx", "gltf"])
    >>> [path.name for path in found.files]
    ['wall.mtlx', 'wall.gltf']
    >>> [(each.lobe.name, round(each.roughness, 2)) for each in found.entries]
    [('eon', 0.47), ('lambert', 0.0)]
    >>> [round(each.delta_e_mean, 1) for each in found.entries]
    [0.7, 4.1]
    """
    chosen = (targets,) if isinstance(targets, str) else tuple(targets)
    return export_files.materials(map(checked, materials), Path(base), chosen)


def export_losses(materials: Iterable[bpy.types.Material]) -> list[Loss]:
    """Tell what Blender's own exporters, glTF and USD, would make of materials, where it is seen.

    Nothing is exported: what they write is known, and what Cycles shows of it is predicted.

    Returns
    -------
    One for each material and exporter that end farther apart than the material's tolerance, with
    `exporter`, `delta_e_instrument`, `delta_e_mean` over the hemisphere, and a `sentence`.

    Raises
    ------
    MaterialError
        One is no material.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], "principled", "none")
    >>> gltf, usd = export_losses([wall])
    >>> gltf.exporter, round(gltf.delta_e_instrument, 1), round(gltf.delta_e_mean, 1)
    ('glTF', 2.3, 4.7)
    """
    return kept.losses(map(checked, materials))
