# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the pictures of a material show, read from it or taken from who has just derived it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..colorimetry.rgb_space import WorkingSpace
from ..material import settled
from ..material.changes import Derived, Solved
from ..material.snapshot import Snapshot
from .figures import data
from .figures.data import Data

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array
    from ..matching.assess import Differences
    from ..matching.request import Request


def collect(
    material: Any, space: WorkingSpace, flat: bool = False, known: Snapshot | None = None
) -> Data:
    """Compute what a material's figures show.

    Parameters
    ----------
    material
        A `bpy.types.Material` with a spectrum.
    space
        The working space that its node is in.
    flat
        Whether an engine shows it that ignores roughness.
    known
        The material's facts, for who has just read them.

    Raises
    ------
    MaterialError
        If the material has no spectrum that can be read, or its surface has an obstacle.
    DomainError
        If the spectrum does not cover the visible range.
    """
    shader = settled.shader(material, known)
    return _shown(settled.of(material).request, shader, space, flat)


def of_derived(done: Derived, solved: Solved) -> tuple[Data, Differences]:
    """Give the same of a material that was just derived, and its ΔE00, without reading it again.

    `settled.differences` would tell the same ΔE00.
    """
    request, solution, space = solved
    flat = done.known.flat
    shader = settled.shader(done.material, done.known)
    apart = solution.delta_e_instrument, solution.delta_e_mean, solution.delta_e_95
    if flat and solution.roughness > 0:  # what was matched is for an engine that knows roughness
        apart = settled.predicted(request, shader, space, flat)
    return _shown(request, shader, space, flat), apart


def _shown(request: Request, shader: tuple[Array, float], space: WorkingSpace, flat: bool) -> Data:
    color, roughness = shader
    rough, engine = (0.0, "Eevee") if flat else (roughness, "Cycles")
    return data.of_request(request, color, rough, space, engine)
