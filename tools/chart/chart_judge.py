# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far answers are from the reference: ΔE00 under D65 for the 2° observer, and reflectance.

Runs where colour-science is.
"""

from __future__ import annotations

import functools
import sys
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from tools.chart.chart_work import BANDS, Array, relative_error, summary
from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core.color import color_difference


def _without_warnings(convert: Callable[[Array], Array]) -> Callable[[Array], Array]:
    """Keep colour-science from telling on the console of every table that it aligns."""

    @functools.wraps(convert)
    def quiet(spectra: Array) -> Array:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return convert(spectra)

    return quiet


class Judge:
    """Turns answers into L*a*b* and compares them.

    Attributes
    ----------
    to_xyz, to_rgb
        Weights that turn spectra into XYZ and into linear sRGB, shape (bands, 3).
    """

    def __init__(self) -> None:
        weights = tristimulus.weights(BANDS)
        self._white = weights.sum(axis=0)
        xyz_to_rgb = np.asarray(colour().RGB_COLOURSPACES["sRGB"].matrix_XYZ_to_RGB).T
        self.to_xyz = weights
        self._to_xyz = {"bands": weights, "RGB": np.linalg.inv(xyz_to_rgb), "XYZ": np.eye(3)}
        self.to_rgb = weights @ xyz_to_rgb

    def lab(self, answer: Array, ends_in: str = "bands") -> Array:
        """L*a*b*; negative reflectance, which the published model can give, counts as black."""
        if ends_in == "bands":
            answer = np.maximum(answer, 0)
        xyz = np.maximum(np.asarray(answer, np.float64) @ self._to_xyz[ends_in], 0)
        return color_difference.xyz_to_lab(xyz, self._white)

    def delta_e(self, answer: Array, truth: Array, ends_in: str = "bands") -> Array:
        """ΔE00 between answers of any kind and spectra."""
        return self.from_lab(answer, self.lab(truth), ends_in)

    def from_lab(self, answer: Array, lab: Array, ends_in: str = "bands") -> Array:
        """ΔE00 between answers of any kind and L*a*b*."""
        return color_difference.delta_e(self.lab(answer, ends_in), lab)

    def errors(self, answer: Array, truth: Array, ends_in: str = "bands") -> dict[str, Any]:
        """Mean, 95th percentile and maximum of ΔE00 and, where there are bands, of reflectance."""
        in_bands = ends_in == "bands"
        return {
            "delta_e": summary(self.delta_e(answer, truth, ends_in)),
            "relative": relative_error(answer, truth) if in_bands else None,
        }


@_without_warnings
def one_by_one(spectra: Array) -> Array:
    """XYZ (Y = 1 for white) through colour-science's sd_to_XYZ, one spectrum after the other."""
    science = colour()
    observer = science.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    light = science.SDS_ILLUMINANTS["D65"]
    rows = [
        science.sd_to_XYZ(science.SpectralDistribution(values, BANDS), observer, light)
        for values in np.asarray(spectra, np.float64).reshape(-1, BANDS.size)
    ]
    return np.reshape(rows, (*spectra.shape[:-1], 3)) / 100


@_without_warnings
def all_at_once(spectra: Array) -> Array:
    """Convert all through colour-science's msds_to_XYZ after ASTM E308, shape (n, 3)."""
    science = colour()
    found = science.msds_to_XYZ(
        science.MultiSpectralDistributions(np.asarray(spectra, np.float64).T, BANDS),
        science.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"],
        science.SDS_ILLUMINANTS["D65"],
        method="ASTM E308",
    )
    return np.asarray(found) / 100


@_without_warnings
def integrated(spectra: Array) -> Array:
    """Convert all through colour-science's fast way: msds_to_XYZ of an array, by integration."""
    science = colour()
    found = science.msds_to_XYZ(
        np.asarray(spectra, np.float64),
        science.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"],
        science.SDS_ILLUMINANTS["D65"],
        method="Integration",
        shape=science.SpectralShape(BANDS[0], BANDS[-1], BANDS[1] - BANDS[0]),
    )
    return np.asarray(found) / 100
