# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of one roughness each, their materials, and what was read of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....core.errors import DomainError
from ....core.numerics.arrays import Array
from ...samples.sample import Sample

_SAME_NM = 0.01
"""Wavelengths of two readings that are so near are the same."""


@dataclass(frozen=True)
class Material:
    """One material: what was read of it smooth, and on the surface.

    Attributes
    ----------
    name
        What tables call it.
    smooth
        Readings without roughness, or albedos; there may be none.
    rough
        Readings of the rough surface, one or more.
    """

    name: str
    smooth: tuple[Sample, ...]
    rough: tuple[Sample, ...]

    @property
    def albedo(self) -> Array | None:
        """Mean of the smooth readings, shape (bands,); None without one."""
        if not self.smooth:
            return None
        return np.asarray(np.mean([sample.reflectance for sample in self.smooth], axis=0))


@dataclass(frozen=True)
class Surface:
    """One roughness.

    Attributes
    ----------
    name
        What tables call it.
    sigma
        As known from elsewhere, radians; None where it is not.
    materials
        Of the surface, one or more.
    """

    name: str
    sigma: float | None
    materials: tuple[Material, ...]


def check(surface: Surface) -> None:
    """Refuse readings that cannot be held against each other.

    Raises
    ------
    DomainError
        Naming the samples.
    """
    for material in surface.materials:
        first, *others = (*material.smooth, *material.rough)
        for other in others:
            alike = first.wavelengths.shape == other.wavelengths.shape and np.allclose(
                first.wavelengths, other.wavelengths, rtol=0, atol=_SAME_NM
            )
            if not alike:
                msg = (
                    f"{first.name!r} and {other.name!r} are of one material and stand at other "
                    "wavelengths; export both alike."
                )
                raise DomainError(msg)
        for sample in material.rough:
            if sample.kind != "reading":
                msg = (
                    f"{sample.name!r} of the rough surface {surface.name!r} is of the kind "
                    f"{sample.kind!r}; give what an instrument read."
                )
                raise DomainError(msg)
