# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The methods of the chart that need no peer: our rungs, and variants that people use.

Each is written as its users would write it in numpy. A method for any angle takes one spectrum and
many geometries: (albedo (bands,), angles (3, n), σ) -> (n, bands or 3). A method for 45°/0° takes
many spectra: (albedo (n, bands), σ) -> (n, bands or 3).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from core import (
    ladder,
    models,
    oren_nayar,
    reading,
)
from tools.chart.chart_work import Array

ForAnyAngle = Callable[[Array, Array, Any], Array]
ForReading = Callable[[Array, Any], Array]

RUNG, NAIVE, PEER = "rung", "naive", "peer"
CALL, RAY = "a call from Python", "a traced ray"


@dataclass(frozen=True)
class Method:
    """One point of the chart.

    Attributes
    ----------
    label
        What the chart calls it.
    group
        `RUNG`, `NAIVE` or `PEER`.
    angles, reading
        The method for any angle and for 45°/0°, None where it has none.
    ends_in
        "bands", or "RGB" or "XYZ" where it gives colors only.
    timed
        How many spectra and geometries to time at once, None for all.
    about
        What it computes.
    overhead
        `CALL` or `RAY` where the cost is mostly that and not the formula.
    """

    label: str
    group: str
    angles: ForAnyAngle | None
    reading: ForReading | None
    about: str
    ends_in: str = "bands"
    timed: int | None = None
    overhead: str = ""


def qualitative(albedo: Array, angles: Array, sigma: Any, constant: float = 0.33) -> Array:
    """ρ (A + B max(0, cos Δφ) sin α tan β)."""
    light, view, azimuth = angles
    s2 = sigma**2
    a = 1 - 0.5 * s2 / (s2 + constant)
    b = 0.45 * s2 / (s2 + 0.09)
    alpha, beta = np.maximum(light, view), np.minimum(light, view)
    factor = a + b * np.maximum(0, np.cos(azimuth)) * np.sin(alpha) * np.tan(beta)
    return np.asarray(factor[:, np.newaxis] * albedo)


def lambert_as_read(albedo: Array, angles: Array, sigma: Any) -> Array:
    """Show the 45°/0° reading everywhere: what a color picked from a chart amounts to."""
    seen = reading.from_albedo(albedo, np.asarray(sigma, albedo.dtype), "reference")
    return np.tile(seen, (angles.shape[1], 1))


def mixed_constants(albedo: Array, angles: Array, sigma: Any) -> Array:
    """Put 0.57 for 0.33 into the published model."""
    f1, f2 = oren_nayar.factors(*_three(angles), np.asarray(sigma, albedo.dtype)[np.newaxis])
    s2 = sigma**2
    f1 = f1 + 0.5 * s2 / (s2 + 0.33) - 0.5 * s2 / (s2 + 0.57)
    return np.asarray(np.stack((f1, f2), axis=-1).astype(albedo.dtype) @ _basis(albedo))


def geometric(albedo: Array, angles: Array, sigma: Any) -> Array:
    """F1 ρ + F2 ρ² / (1 - g ρ): later bounces as a geometric series."""
    f1, f2 = oren_nayar.factors(*_three(angles), np.asarray(sigma, albedo.dtype)[np.newaxis])
    later = albedo * albedo / (1 - bounce_ratio(sigma) * albedo)
    basis = np.stack((albedo, later)).astype(albedo.dtype)
    return np.asarray(np.stack((f1, f2), axis=-1) @ basis)


def bounce_ratio(sigma: Any) -> Any:
    """Ratio of that series which conserves energy at 45°/0°."""
    s2 = sigma**2
    return 1 - 0.34 * (s2 + 0.33) / (s2 + 0.13)


def geometric_reading(albedo: Array, sigma: Any) -> Array:
    """Sum that series at 45°/0°."""
    f1, f2 = (float(factor) for factor in reading.coefficients(float(sigma)))
    return np.asarray(albedo * (f1 + f2 * albedo / (1 - float(bounce_ratio(sigma)) * albedo)))


def mixed_constants_reading(albedo: Array, sigma: Any) -> Array:
    """Put 0.57 for 0.33 into the two-bounce reading."""
    s2 = float(sigma) ** 2
    return np.asarray(albedo * (1 - 0.5 * s2 / (s2 + 0.57) + 0.17 * s2 / (s2 + 0.13) * albedo))


def qualitative_reading(albedo: Array, sigma: Any) -> Array:
    """Give A ρ with 0.57: the qualitative model where light or view is along the normal."""
    s2 = float(sigma) ** 2
    return np.asarray(albedo * (1 - 0.5 * s2 / (s2 + 0.57)))


def band_by_band(albedo: Array, angles: Array, sigma: Any) -> Array:
    """Call the published model once a band."""
    out = np.empty((angles.shape[1], albedo.size), albedo.dtype)
    for band in range(albedo.size):
        out[:, band] = oren_nayar.reflectance(albedo[band : band + 1], *_three(angles), sigma)[:, 0]
    return out


def band_by_band_reading(albedo: Array, sigma: Any) -> Array:
    """Call the two-bounce reading once a band."""
    out = np.empty_like(albedo)
    for band in range(albedo.shape[1]):
        out[:, band] = reading.from_albedo(albedo[:, band : band + 1], sigma)[:, 0]
    return out


def in_rgb(matrix: Array, *, exact: bool) -> tuple[ForAnyAngle, ForReading]:
    """Two-bounce with colors in place of spectra: F1 RGB(ρ) + F2 times a second color.

    Parameters
    ----------
    matrix
        Weights that turn a spectrum into linear RGB, shape (bands, 3).
    exact
        Whether the second color is RGB(ρ²), as it should be, or RGB(ρ)².
    """

    def colors(albedo: Array) -> tuple[Array, Array]:
        weights = matrix.astype(albedo.dtype)
        first = albedo @ weights
        return first, (albedo * albedo) @ weights if exact else first * first

    def angles(albedo: Array, directions: Array, sigma: Any) -> Array:
        f1, f2 = oren_nayar.factors(
            *_three(directions), np.asarray(sigma, albedo.dtype)[np.newaxis]
        )
        return np.asarray(np.stack((f1, f2), axis=-1) @ np.stack(colors(albedo)))

    def ring(albedo: Array, sigma: Any) -> Array:
        f1, f2 = (float(factor) for factor in reading.coefficients(float(sigma)))
        first, second = colors(albedo)
        return np.asarray(f1 * first + f2 * second)

    return angles, ring


def methods(matrix: Array, to_xyz: Callable[[Array], Array]) -> dict[str, Method]:
    """All of them by key.

    Parameters
    ----------
    matrix
        Spectrum to linear RGB, shape (bands, 3).
    to_xyz
        Converts spectra (n, bands) to XYZ one at a time, the slow way.
    """
    exact_angles, exact_reading = in_rgb(matrix, exact=True)
    squared_angles, squared_reading = in_rgb(matrix, exact=False)

    def one_by_one(albedo: Array, angles: Array, sigma: Any) -> Array:
        return to_xyz(oren_nayar.reflectance(albedo, *_three(angles), sigma))

    def one_by_one_reading(albedo: Array, sigma: Any) -> Array:
        return to_xyz(reading.from_albedo(albedo, sigma))

    return {
        **_ladder(),
        "lambert-as-read": Method(
            "Lambert, 45°/0° color",
            RUNG,
            lambert_as_read,
            None,
            "the reading at 45°/0°, shown at every angle",
        ),
        "two-colors": Method(
            "two-bounce, two colors",
            RUNG,
            exact_angles,
            exact_reading,
            "F1 RGB(ρ) + F2 RGB(ρ²): the two-bounce color under one light",
            "RGB",
        ),
        "rgb-squared": Method(
            "RGB(ρ)² for RGB(ρ²)",
            NAIVE,
            squared_angles,
            squared_reading,
            "two-bounce on RGB albedos, as an RGB renderer would",
            "RGB",
        ),
        "qualitative": Method(
            "qualitative model",
            NAIVE,
            qualitative,
            None,
            "the paper's simplification: A and B only, no interreflection",
        ),
        "qualitative-57": Method(
            "qualitative, 0.57",
            NAIVE,
            lambda albedo, angles, sigma: qualitative(albedo, angles, sigma, 0.57),
            qualitative_reading,
            "the same with 0.57 for 0.33, meant to make up for interreflection",
        ),
        "mixed-57": Method(
            "0.57 mixed in",
            NAIVE,
            mixed_constants,
            mixed_constants_reading,
            "the published model with the qualitative model's 0.57: interreflection twice",
        ),
        "geometric": Method(
            "geometric closure",
            NAIVE,
            geometric,
            geometric_reading,
            "F1 ρ + F2 ρ²/(1 - g ρ): later bounces as a geometric series, no fit",
        ),
        "band-loop": Method(
            "band by band",
            NAIVE,
            band_by_band,
            band_by_band_reading,
            "two-bounce, called once a band",
        ),
        "sd-to-xyz": Method(
            "sd_to_XYZ one by one",
            NAIVE,
            one_by_one,
            one_by_one_reading,
            "two-bounce, then colour-science's sd_to_XYZ for each spectrum",
            "XYZ",
            timed=32,
            overhead=CALL,
        ),
    }


def _ladder() -> dict[str, Method]:
    """Give the rungs of `core.ladder`."""
    about = {
        "lambert": "r = ρ: roughness ignored",
        "first-order": "F1 ρ of the published model",
        "two-bounce": "F1 ρ + F2 ρ²: the published model",
        "closure": "V-grooves, all bounces in one square root, tabulated",
        "reference": "the V-cavity solved; against itself, the error is that to twice the nodes",
        "surface": "random rough surfaces, all bounces, traced and tabulated",
    }

    def rung(model: str) -> Method:
        def angles(albedo: Array, directions: Array, sigma: Any) -> Array:
            return ladder.reflectance(model, albedo, *_three(directions), sigma)

        def ring(albedo: Array, sigma: Any) -> Array:
            if model == "lambert":
                return albedo.copy()
            return reading.from_albedo(albedo, sigma, model)

        label = "Lambert, albedo" if model == "lambert" else model
        timed = 64 if model == "reference" else None
        return Method(
            label,
            RUNG,
            angles,
            ring,
            about.get(model) or models.find(model).description,
            timed=timed,
        )

    return {model: rung(model) for model in models.NAMES}


def _three(angles: Array) -> tuple[Array, Array, Array]:
    """θi, θr and Δφ."""
    light, view, azimuth = angles
    return light, view, azimuth


def _basis(albedo: Array) -> Array:
    return np.stack((albedo, albedo * albedo))
