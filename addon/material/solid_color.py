# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The color that a material has in the viewport's solid shading, which shows no nodes."""

from __future__ import annotations

from typing import Any

import bpy

from ...core.numerics.arrays import Array

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
    """
    group, now = material.rough_spectra, tuple(material.diffuse_color)
    ours = tuple(group.solid_color)
    if not (_same(now, ours) or _same(now, _default())):
        return
    wanted = tuple(min(max(value, 0.0), 1.0) for value in reading.tolist())
    if not _same(wanted, now):
        material.diffuse_color = (*wanted, now[3])
    if not _same(wanted, ours):
        group.solid_color = wanted


def _same(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return all(abs(a - b) < _SAME for a, b in zip(one[:3], other[:3], strict=True))


def _default() -> tuple[float, ...]:
    """Give the color of a material that nobody gave one."""
    return tuple(bpy.types.Material.bl_rna.properties["diffuse_color"].default_array)
