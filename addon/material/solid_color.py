# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The color that a material has in the viewport's solid shading, which shows no nodes."""

from __future__ import annotations

from typing import Any

import bpy

from ...core.numerics.arrays import Array
from . import derivation

_SAME = 1e-4
"""Of a color's numbers: what single precision and a screen cannot tell apart."""


def show(material: Any, reading: Array) -> None:
    """Let solid shading show what the material reads, unless the user gave it a color there.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    reading
        Scene-linear RGB, shape (3,), unclipped.

    Notes
    -----
    To be called before the stamp is replaced: asset libraries gave their materials the color that
    was derived, and what was dragged from one kept it whatever sample came.
    """
    group, now = material.rough_spectra, tuple(material.diffuse_color)
    ours = tuple(group.solid_color)
    if not (_same(now, ours) or _same(now, _default()) or _is_derived(material, now)):
        return
    wanted = tuple(min(max(value, 0.0), 1.0) for value in reading.tolist())
    if not _same(wanted, now):
        material.diffuse_color = (*wanted, now[3])
    if not _same(wanted, ours):
        group.solid_color = wanted


def _same(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return all(abs(a - b) < _SAME for a, b in zip(one[:3], other[:3], strict=True))


def _is_derived(material: Any, now: tuple[float, ...]) -> bool:
    stamp = derivation.get_stamp(material)
    return stamp is not None and _same(now, stamp.color)


def _default() -> tuple[float, ...]:
    """Give the color of a material that nobody gave one."""
    return tuple(bpy.types.Material.bl_rna.properties["diffuse_color"].default_array)
