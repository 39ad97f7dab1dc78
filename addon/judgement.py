# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare what a file says of its own color with its own spectrum."""

from __future__ import annotations

import numpy as np

from . import colorimetry
from .sample import Sample

DISAGREEMENT = 0.5
"""ΔE00 above which a file contradicts itself: fifty times what rounding and interpolation do."""


def own_color_difference(sample: Sample) -> float | None:
    """ΔE00 between the file's own Lab and the spectrum, under the file's illuminant and observer.

    None where the file has no Lab, or does not say for which light. Many files that seem to
    disagree do not: their Lab is for D50 and 2°, and was read as D65 and 10°.
    """
    if (
        sample.lab is None
        or sample.illuminant not in colorimetry.ILLUMINANTS
        or sample.observer not in colorimetry.OBSERVERS
    ):
        return None
    computed = colorimetry.spectrum_to_lab(
        sample.values, sample.wavelengths, sample.illuminant, sample.observer
    )
    return float(colorimetry.delta_e(computed, np.array(sample.lab)))


def contradiction(sample: Sample) -> str:
    """Say that the file's own color is not that of its spectrum; empty where it is."""
    difference = own_color_difference(sample)
    if difference is None or difference <= DISAGREEMENT:
        return ""
    return (
        f"{sample.name!r}: the Lab in the file differs from its own spectrum by ΔE00 "
        f"{difference:.2f} ({sample.illuminant}, {sample.observer}°); the spectrum is used, so "
        "check which of the two is meant."
    )
