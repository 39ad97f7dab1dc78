# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectrum of each pixel, from the channels that were rendered. No Blender data here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.bands import restoring
from ...core.limits import E308_NM
from ...core.numerics.arrays import Array
from ..colorimetry import cie_tables, illuminant_spectra
from .channels import Channels
from .passes import Lamps, Pass

NM = np.arange(E308_NM[0], E308_NM[1] + 1, 10.0)
"""Wavelengths of a whole spectrum."""


@dataclass(frozen=True, eq=False)
class Spectra:
    """What was rendered, and how a spectrum comes from it.

    Radiances are per nanometer, in the scene's units: summed up with the observer they are the
    picture's XYZ, in which white is Y = 1.

    Parameters
    ----------
    channels
        Of all renders.
    to_grid
        From the channels to radiance at `NM`, each the mean around it, shape (channels, values).
    bands
        Nanometers of the bands.
    to_bands
        From the channels to radiance at `bands`, shape (channels, bands).
    """

    channels: Channels
    to_grid: Array
    bands: Array
    to_bands: Array

    def at(self, column: int, row: int) -> Array:
        """Radiance at `NM` in a pixel, counted from the bottom left, shape (values,)."""
        return np.asarray(self.channels.at(column, row).astype(np.float64) @ self.to_grid)


def observer(degrees: int) -> Array:
    """Color matching functions for sums over `NM`, (values, 3); spectra are lines in between."""
    fine = np.stack([np.interp(cie_tables.GRID, NM, unit) for unit in np.eye(NM.size)])
    return np.asarray(fine @ cie_tables.observer(degrees))


def of(
    channels: Channels,
    surfaces: Array,
    lamps: Lamps,
    passes: list[Pass],
    bands: Array,
    degrees: int,
) -> Spectra:
    """Find how spectra come from the channels of renders.

    Parameters
    ----------
    channels
        As in `Spectra`.
    surfaces
        Albedos that the scene has, at `illuminant_spectra.GRID`.
    lamps, passes, bands
        What was rendered.
    degrees
        Of the observer.
    """
    apart = any(each.direct for each in passes)
    rendered = [
        restoring.Channels(
            each.taken,
            each.lamps,
            each.to_xyz,
            "direct" if each.direct else "indirect" if apart else "all",
        )
        for each in passes
    ]
    grid = illuminant_spectra.GRID
    means = np.maximum(1 - np.abs(grid[:, np.newaxis] - NM) / (NM[1] - NM[0]), 0)
    there = (grid[:, np.newaxis] == bands).astype(float)
    return Spectra(
        channels,
        restoring.matrix(
            surfaces, lamps.spectra, rendered, means / means.sum(axis=0), observer(degrees)
        ),
        bands,
        restoring.matrix(surfaces, lamps.spectra, rendered, there),
    )
