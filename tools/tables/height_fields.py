# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random surfaces as periodic height fields over a grid of spacing 1, for the tracer."""

from __future__ import annotations

import numpy as np

from core.numerics.arrays import Array


def gaussian(n: int, correlation: float, rdq: float, rng: np.random.Generator) -> Array:
    """Gaussian heights of autocorrelation exp(-d²/l²).

    Parameters
    ----------
    n
        Points a side.
    correlation
        Correlation length l, in cells.
    rdq
        rms slope of a profile, tan σ; the facets of the mesh have it exactly.
    rng
        Source of the noise.
    """
    kx, ky = np.meshgrid(np.fft.fftfreq(n), np.fft.rfftfreq(n), indexing="ij")
    squared = (2 * np.pi) ** 2 * (kx * kx + ky * ky)
    return with_slope(_shaped(n, np.exp(-squared * correlation**2 / 8), rng), rdq)


def power_law(
    n: int, exponent: float, band: tuple[float, float], rdq: float, rng: np.random.Generator
) -> Array:
    """Heights at many scales: a power spectrum that falls like k^-exponent between two lengths.

    Parameters
    ----------
    n, rdq, rng
        As in `gaussian`.
    exponent
        Of the spectrum over wave vectors; 2 + 2 · Hurst's exponent.
    band
        Shortest and longest wave, in cells; nothing outside.
    """
    kx, ky = np.meshgrid(np.fft.fftfreq(n), np.fft.rfftfreq(n), indexing="ij")
    k = np.hypot(kx, ky)
    inside = (k >= 1 / band[1]) & (k <= 1 / band[0])
    amplitude = np.where(inside, np.where(inside, k, 1.0) ** (-exponent / 2), 0.0)
    return with_slope(_shaped(n, amplitude, rng), rdq)


def grains(n: int, radius: float, fill: float, rng: np.random.Generator) -> Array:
    """Balls dropped onto a plane at random places, seen from above.

    Parameters
    ----------
    n
        Points a side.
    radius
        Of a ball, in cells.
    fill
        Sum of the balls' areas seen from above over that of the plane.
    rng
        Source of the places.
    """
    out = np.zeros((n, n))
    reach = int(np.ceil(radius))
    offsets = np.arange(-reach, reach + 1)
    for _ in range(int(fill * n * n / (np.pi * radius * radius))):
        x, y = rng.random(2) * n
        i, j = int(x), int(y)
        rows, columns = (i + offsets) % n, (j + offsets) % n
        squared = ((i + offsets - x) ** 2)[:, np.newaxis] + ((j + offsets - y) ** 2)[np.newaxis]
        cap = np.sqrt(np.maximum(radius * radius - squared, 0))
        patch = np.ix_(rows, columns)
        out[patch] = np.maximum(out[patch], cap)
    return out


def grooves(slopes: Array, n: int, half_width: int) -> Array:
    """V-grooves with level rims along the second axis, all of one width.

    Parameters
    ----------
    slopes
        Angles of the walls, radians, in order of place; repeated until the field is full.
    n
        Points a side.
    half_width
        Cells from rim to bottom; n is a multiple of twice as many.
    """
    depth = half_width * np.tan(np.resize(slopes, n // (2 * half_width)))
    shape = np.abs(np.arange(2 * half_width) - half_width) / half_width - 1
    profile = (depth[:, np.newaxis] * shape).ravel()
    return np.ascontiguousarray(np.repeat(profile[:, np.newaxis], n, axis=1))


def with_slope(heights: Array, rdq: float) -> Array:
    """Scale heights so that the mean square slope of the mesh's facets along an axis is rdq²."""
    return np.asarray(heights * (rdq / slope(heights)))


def slope(heights: Array) -> float:
    """Rdq of the mesh: the rms slope of its facets along an axis, mean of the two axes."""
    steps = (np.roll(heights, -1, axis) - heights for axis in (0, 1))
    return float(np.sqrt(np.mean([np.mean(step * step) for step in steps])))


def _shaped(n: int, amplitude: Array, rng: np.random.Generator) -> Array:
    noise = np.fft.rfft2(rng.standard_normal((n, n)))
    return np.asarray(np.fft.irfft2(noise * amplitude, s=(n, n)))
