# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One material as one renderer is to show it."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.lobes import Lobe
from ...core.numerics.arrays import Array
from ..matching.request import Request


@dataclass(frozen=True, eq=False)
class Wanted:
    """What a material is to be, wherever it is shown.

    Parameters
    ----------
    name
        Of the material.
    request
        With a settled model, without scene and gloss.
    warnings
        Sentences about what of the material is left behind.
    """

    name: str
    request: Request
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Entry:
    """A material, solved for a renderer's lobe.

    Parameters
    ----------
    target
        Name of the renderer, one of `targets.NAMES`.
    name, identifier
        Of the material, as in Blender and as in the file.
    request
        What it was made from.
    space
        What the color is in, a name of `spaces`.
    lobe
        The renderer's lobe that came closest.
    color
        Within 0 to 1: RGB, shape (3,), or one a band, shape (bands,).
    roughness
        In the lobe's own unit.
    reading, albedo
        r(λ) at the virtual instrument and ρ(λ) of a facet, each of shape (bands,).
    delta_e_instrument
        ΔE00 predicted between the spectrum's reading and the lobe's, at the virtual instrument.
    delta_e_mean, delta_e_95
        Mean and 95th percentile over the hemisphere below 80°.
    warnings
        Sentences about what could not be met or is left behind.
    """

    target: str
    name: str
    identifier: str
    request: Request
    space: str
    lobe: Lobe
    color: Array
    roughness: float
    reading: Array
    albedo: Array
    delta_e_instrument: float
    delta_e_mean: float
    delta_e_95: float
    warnings: tuple[str, ...] = ()

    @property
    def wavelengths(self) -> Array:
        """Nanometers of `reading`, `albedo` and a spectral color, shape (bands,)."""
        return self.request.sample.wavelengths
