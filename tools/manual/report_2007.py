# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of docs/report-2007.md: what the 2007 report computes, and what it leads to.

`report_2007_tables.py` makes tables and files of them.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.samples import presets
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core import models, reading, vcavity
from rough_spectra.core.color import chromaticity, color_difference

Array = NDArray[np.float64]

SIGMA = np.pi / 4
"""Roughness of the report's example."""
GREEN = 13
"""Place of patch #14 among the presets."""
REPORTED = 3.83
"""The report's distance in the a*b* plane."""
OBSERVERS = (2, 10)
MODELS = ("first-order", "two-bounce", "closure", "reference")
BEYOND_FIRST = MODELS[1:]

DATA_SETS = {"Ohta": "ColorChecker N Ohta", "BabelColor": "BabelColor Average"}
"""Measured charts of 24 patches, as colour-science calls them; its third one is the first again."""


@dataclass(frozen=True)
class Row:
    """What roughness does to the color of one patch, read at 45°/0°.

    Attributes
    ----------
    srgb, srgb_reading
        As a screen shows them under D65: the albedo, and a color that is as light and has the a*
        and b* of the reading.
    k
        Luminance of the reading over that of the albedo.
    L, a, b, L_reading, a_reading, b_reading
        CIELAB of the albedo and of the reading.
    ab
        Distance of the two in the a*b* plane.
    ab_darkening
        The same from the albedo to the albedo scaled by k: no change but of luminance.
    ab_interreflection
        From there on to the reading: no change but of the spectrum's shape.
    ab_equal
        From the albedo to the reading scaled by 1/k: the luminance held equal.
    de00, de00_equal
        CIEDE2000 of the steps `ab` and `ab_equal`.
    duv_equal
        Distance in the CIE 1976 u'v' diagram, to which luminance does not matter.
    de00_from_reference
        CIEDE2000 from the reading that the reference predicts.
    """

    patch: str
    observer: int
    model: str
    srgb: str
    srgb_reading: str
    k: float
    L: float
    a: float
    b: float
    L_reading: float
    a_reading: float
    b_reading: float
    ab: float
    ab_darkening: float
    ab_interreflection: float
    ab_equal: float
    de00: float
    de00_equal: float
    duv_equal: float
    de00_from_reference: float


def predict(albedo: Array, sigma: float, model: str) -> Array:
    """Give the 45°/0° readings (..., bands) of one of `MODELS`."""
    if model == "reference":
        return vcavity.reading_from_albedo(albedo, sigma)
    return reading.from_albedo(albedo, sigma, model)


def uv(xyz: Array) -> Array:
    """CIE 1976 u', v' of XYZ (..., 3)."""
    denominator = xyz @ np.array([1.0, 15.0, 3.0])
    return np.stack((4 * xyz[..., 0] / denominator, 9 * xyz[..., 1] / denominator), axis=-1)


@lru_cache(maxsize=1)
def chart() -> tuple[list[Sample], Array, Array]:
    """Give the 24 patches, their wavelengths (bands,) and albedos (24, bands)."""
    samples = presets.load_all("colorchecker")
    return samples, samples[0].wavelengths, np.array([sample.values for sample in samples])


def rows() -> list[Row]:
    """Give a row for each patch, observer and model, under D65 at σ = π/4."""
    samples, wavelengths, albedo = chart()
    names = [sample.name.removeprefix("ColorChecker ") for sample in samples]
    screen = [_hex(xyz) for xyz in albedo @ tristimulus.weights(wavelengths)]
    found = []
    for observer in OBSERVERS:
        weights = tristimulus.weights(wavelengths, "D65", observer)
        white = weights.sum(axis=0)
        before = albedo @ weights
        lab = color_difference.xyz_to_lab(before, white)
        target = predict(albedo, SIGMA, "reference") @ weights
        for model in MODELS:
            after = predict(albedo, SIGMA, model) @ weights
            k = after[:, 1:2] / before[:, 1:2]
            lab_after, lab_darkened, lab_equal, lab_target = (
                color_difference.xyz_to_lab(xyz, white)
                for xyz in (after, k * before, after / k, target)
            )
            columns = (
                k[:, 0],
                *lab.T,
                *lab_after.T,
                chromaticity.ab_distance(lab, lab_after),
                chromaticity.ab_distance(lab, lab_darkened),
                chromaticity.ab_distance(lab_darkened, lab_after),
                chromaticity.ab_distance(lab, lab_equal),
                color_difference.delta_e(lab, lab_after),
                color_difference.delta_e(lab, lab_equal),
                np.linalg.norm(uv(before) - uv(after), axis=-1),
                color_difference.delta_e(lab_target, lab_after),
            )
            table = np.stack(columns, axis=-1).tolist()
            leveled = _screen_of_lab(np.column_stack((lab[:, :1], lab_after[:, 1:])))
            found += [
                Row(name, observer, model, color, other, *numbers)
                for name, numbers, color, other in zip(names, table, screen, leveled, strict=True)
            ]
    return found


@dataclass(frozen=True)
class Variation:
    """Patch #14 with one assumption changed: a*b* distances for the 2° and the 10° observer."""

    changed: str
    ab_2: float
    ab_10: float
    ab_equal_2: float
    ab_equal_10: float


def variations() -> list[Variation]:
    """Change one assumption of patch #14 at a time, to see what 3.83 could come from."""
    _, wavelengths, patches = chart()
    albedo = patches[GREEN]
    average = colour().SDS_COLOURCHECKERS["BabelColor Average"]["green"]
    coarse = (wavelengths >= 400) & (wavelengths <= 700) & (wavelengths % 10 == 0)
    behind = reading.to_albedo(albedo, SIGMA)
    lighter = _scale_that_gives(REPORTED, albedo, wavelengths)
    return [
        _variation("as above: Ohta's spectrum, D65", albedo, wavelengths),
        _variation(
            "another measured chart: BabelColor's average",
            np.asarray(average.values),
            np.asarray(average.wavelengths),
        ),
        _variation("400 to 700 nm by 10 nm only", albedo[coarse], wavelengths[coarse]),
        _variation("illuminant D50 in place of D65", albedo, wavelengths, "D50"),
        _variation("spectrum taken as the reading, albedo computed", behind, wavelengths),
        _variation("albedo 10 % higher in every band", 1.1 * albedo, wavelengths),
        _variation(
            f"albedo {lighter - 1:.0%} higher in every band".replace("%", " %"),
            lighter * albedo,
            wavelengths,
        ),
    ]


@dataclass(frozen=True)
class Candidate:
    """A patch that the report's example may be, read by one data set and observer."""

    number: int
    patch: str
    data_set: str
    observer: int
    ab: float
    ab_equal: float


def candidates() -> list[Candidate]:
    """Give every patch of every data set for every observer, nearest to the report's first."""
    found = []
    for short, name in DATA_SETS.items():
        for number, (patch, sd) in enumerate(colour().SDS_COLOURCHECKERS[name].items(), 1):
            albedo, bands = np.asarray(sd.values), np.asarray(sd.wavelengths)
            for observer in OBSERVERS:
                distances = _distances(albedo, bands, "D65", observer)
                found.append(Candidate(number, patch, short, observer, *distances))
    return sorted(found, key=lambda candidate: abs(candidate.ab - REPORTED))


def _variation(
    changed: str, albedo: Array, wavelengths: Array, illuminant: str = "D65"
) -> Variation:
    pairs = np.array([_distances(albedo, wavelengths, illuminant, o) for o in OBSERVERS])
    return Variation(changed, *pairs.T.ravel().tolist())


def _distances(
    albedo: Array, wavelengths: Array, illuminant: str, observer: int
) -> tuple[float, float]:
    """Distance in the a*b* plane of the two-bounce reading: as it is, at equal luminance."""
    weights = tristimulus.weights(wavelengths, illuminant, observer)
    before, after = albedo @ weights, predict(albedo, SIGMA, "two-bounce") @ weights
    lab, as_is, equal = color_difference.xyz_to_lab(
        np.stack((before, after, after * before[1] / after[1])), weights.sum(axis=0)
    )
    return float(chromaticity.ab_distance(lab, as_is)), float(chromaticity.ab_distance(lab, equal))


def _scale_that_gives(distance: float, albedo: Array, wavelengths: Array) -> float:
    """Factor on the albedo at which the 10° observer sees `distance`, by bisection."""
    low, high = 1.0, 1.5
    for _ in range(40):
        middle = (low + high) / 2
        found, _equal = _distances(middle * albedo, wavelengths, "D65", 10)
        low, high = (middle, high) if found > distance else (low, middle)
    return low


def _screen_of_lab(lab: Array) -> list[str]:
    """Show L*a*b* (colors, 3) of whichever observer as if they were those of the 2° one."""
    white = colour().XYZ_to_xy(tristimulus.white("D65"))
    return [_hex(xyz) for xyz in colour().Lab_to_XYZ(lab, white)]


def _hex(xyz: Array) -> str:
    encoded = np.clip(colour().XYZ_to_sRGB(xyz), 0, 1)
    return "#" + "".join(f"{round(255 * float(part)):02x}" for part in encoded)


def largest_sigma(peak: float, model: str) -> float:
    """Largest σ in degrees at which white facets still reach a peak reading; NaN if none does."""
    if model == "two-bounce":
        return float(np.degrees(reading.sigma_max(peak)))
    white = white_curve(model)
    # Energy is conserved to rounding by the closure.
    reached = np.flatnonzero(white >= peak - 1e-12)
    return float(reached.max() / 100) if reached.size else float("nan")


@lru_cache(maxsize=4)
def white_curve(model: str) -> Array:
    """Give the reading of white facets at σ = 0, 0.01 … to where the model holds."""
    end = round(models.find(model).largest_sigma)
    sigma = np.radians(np.linspace(0, end, 100 * end + 1))
    if model == "reference":
        return vcavity.reading_from_albedo(np.ones((sigma.size, 1)), sigma)[:, 0]
    return reading.white_reading(sigma, model)
