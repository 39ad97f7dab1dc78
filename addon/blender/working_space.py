# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene-linear space that the open .blend works in. Asking for its name needs no numpy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
from mathutils import Color

from ...core.numerics.memoized import memoized
from . import ocio

if TYPE_CHECKING:
    from ..colorimetry.rgb_space import WorkingSpace

DEFAULT_SPACE = "Linear Rec.709"
"""The working space before Blender 5.0, unless a custom OCIO configuration has another."""


_ASKED = (1.0, 2.0, 4.0)
"""A color that every working space has another XYZ for."""


def current() -> WorkingSpace:
    """Give the working space of the open file.

    Up to Blender 4.5 the name is that of the role in the OCIO configuration; from 5.0 the file
    says it.
    """
    units = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    columns = tuple(tuple(Color(unit).from_xyz_d65_to_scene_linear()) for unit in units)
    return _space(working_space_name(), columns, ocio.warning())


def _space(name: str, columns: tuple[tuple[float, ...], ...], warning: str) -> WorkingSpace:
    """Make the space of the columns of its matrix."""
    import numpy as np

    from ..colorimetry.rgb_space import WorkingSpace

    matrix = np.array(columns, np.float64).T
    matrix.setflags(write=False)
    return WorkingSpace(name=name, from_xyz=matrix, warning=warning)


def working_space_name() -> str:
    """Name of the open file's working space."""
    data = getattr(bpy.data, "colorspace", None)
    if data is None:
        return DEFAULT_SPACE
    if ocio.warning():
        return str(data.working_space)  # all spaces then have the XYZ of Rec.709
    return _space_of(*Color(_ASKED).from_scene_linear_to_xyz_d65())


@memoized(maxsize=16)
def _space_of(_x: float, _y: float, _z: float) -> str:
    """Name of the working space in which a color has this XYZ: asking for it takes Blender long."""
    return str(bpy.data.colorspace.working_space)
