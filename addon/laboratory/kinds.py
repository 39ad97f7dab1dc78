# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rough samples that can be made, and what each is made from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...core import heights
from ...core.errors import DomainError, InputError
from ...core.heights import HeightField, Mesh
from . import height_map

CELLS = 512
"""Of a grid of heights, a side, unless told otherwise."""

COARSEST, FINEST = 32, 2048
"""Cells a side that can be asked for; the finest have eight million facets, and need 3 GB."""

STRIPS_A_CELL = 2
"""Strips of grooves for each cell of a side: 1024 usually, which hold the slope law to 1e-4."""


@dataclass(frozen=True, eq=False)
class RoughSample:
    """A rough surface, ready to be measured or put into a scene.

    Attributes
    ----------
    kind
        One of `KINDS`.
    mesh
        One period of it.
    length
        What its size was given by; see `KINDS`.
    asked
        σ that was asked for, radians; None where the surface is as it came.
    seed
        Which surface of its kind.
    """

    kind: str
    mesh: Mesh
    length: float
    asked: float | None
    seed: int

    @property
    def sigma(self) -> float:
        """Angle of Rdq, radians: of the facets themselves, averaged over azimuth."""
        return float(np.arctan(self.mesh.rdq))

    @property
    def law(self) -> str | None:
        """Slope law of grooves; None of all else."""
        return _LAWS.get(self.kind)


class Kind(NamedTuple):
    """What a kind is called, and what its length and slope are."""

    title: str
    length: str
    slope: str
    needs_sigma: bool


KINDS = {
    "gaussian": Kind("Gaussian heights", "correlation length", "Rdq of the facets is tan σ", True),
    "multiscale": Kind(
        "heights of many scales", "correlation length", "Rdq of the facets is tan σ", True
    ),
    "grooves": Kind(
        "V-grooves, Gaussian slopes", "mean width of a groove", "width of the slope law", True
    ),
    "grooves-oren-nayar": Kind(
        "V-grooves, slope law of Oren and Nayar",
        "mean width of a groove",
        "width of the slope law",
        True,
    ),
    "grains": Kind("packed grains", "diameter", "without it spheres; with it flattened", False),
    "map": Kind(
        "heights from a file",
        "between two heights",
        "without it as measured; with it stretched",
        False,
    ),
}
"""All kinds."""


def make(
    kind: str,
    sigma: float | None = None,
    length: float | None = None,
    *,
    seed: int = 0,
    cells: int = CELLS,
    path: Path | None = None,
) -> RoughSample:
    """Make a rough sample.

    Parameters
    ----------
    kind
        One of `KINDS`.
    sigma
        Radians; what it is the slope of is in `KINDS`.
    length
        What sets the size, see `KINDS`, in any unit of length; 1 if not given. Of a map that says
        its own spacing, nothing but that.
    seed
        Another surface of the same kind for each number.
    cells
        Of the grid, a side; a map has its own.
    path
        Of a map.

    Raises
    ------
    DomainError
        If numbers make no such surface.
    InputError
        If the file of a map cannot be used, or is missing.
    """
    if kind not in KINDS:
        msg = f"The kind of sample {kind!r} is not known; choose one of: {', '.join(KINDS)}."
        raise DomainError(msg)
    if sigma is None and KINDS[kind].needs_sigma:
        raise DomainError(f"A sample of the kind {kind!r} needs a roughness; give σ.")
    if not COARSEST <= cells <= FINEST:
        raise DomainError(f"The grid has {cells} cells; give {COARSEST} to {FINEST}.")
    if length is not None and not (np.isfinite(length) and length > 0):
        raise DomainError(f"The {KINDS[kind].length} is {length:g}; give a length above 0.")
    if seed < 0:
        raise DomainError(f"The seed is {seed}; give 0 or more.")
    if kind == "map":
        return _of_map(path, sigma, length)
    size = 1.0 if length is None else length
    return RoughSample(kind, _MAKERS[kind](sigma, size, seed, cells), size, sigma, seed)


def _of_map(path: Path | None, sigma: float | None, length: float | None) -> RoughSample:
    if path is None:
        raise InputError("A map of heights needs a file; name an image or a profilometer's file.")
    field = height_map.read(path, length)
    if sigma is not None:
        field = field.of_slope(sigma)
    return RoughSample("map", heights.mesh_of_field(field), field.spacing[0], sigma, 0)


def _gaussian(sigma: float | None, length: float, seed: int, cells: int) -> Mesh:
    assert sigma is not None
    return _meshed(heights.gaussian(sigma, length, cells=cells, seed=seed))


def _multiscale(sigma: float | None, length: float, seed: int, cells: int) -> Mesh:
    assert sigma is not None
    return _meshed(heights.multiscale(sigma, length, cells=cells, seed=seed))


def _grains(sigma: float | None, length: float, seed: int, cells: int) -> Mesh:
    diameter_cells = cells / 16
    found = heights.grains(sigma, length, cells=cells, diameter_cells=diameter_cells, seed=seed)
    return _meshed(found)


def _grooves(law: str) -> Callable[[float | None, float, int, int], Mesh]:
    def make_grooves(sigma: float | None, length: float, seed: int, cells: int) -> Mesh:
        assert sigma is not None
        strips = STRIPS_A_CELL * cells
        walls = heights.grooves(sigma, law, period=length * strips, strips=strips, seed=seed)
        return heights.mesh_of_grooves(walls)

    return make_grooves


def _meshed(field: HeightField) -> Mesh:
    return heights.mesh_of_field(field)


_LAWS = {"grooves": "gaussian", "grooves-oren-nayar": "oren-nayar"}

_MAKERS = {
    "gaussian": _gaussian,
    "multiscale": _multiscale,
    "grains": _grains,
    **{kind: _grooves(law) for kind, law in _LAWS.items()},
}
