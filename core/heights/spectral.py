# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random surfaces whose heights are Gaussian: white noise, filtered by a power spectrum.

A filter that follows from the period's own waves makes the surface periodic without a seam. Slopes
are linear in the heights, so they are Gaussian, too: exactly the slope law "gaussian" of
`core.vcavity`, with Rdq = tan σ.
"""

from __future__ import annotations

import numpy as np

from ..errors import DomainError
from ..numerics.arrays import Array
from .field import HeightField, check_grid, check_slope


def gaussian(
    sigma: float,
    correlation_length: float = 1.0,
    *,
    cells: int = 512,
    correlation_cells: float = 8.0,
    seed: int = 0,
) -> HeightField:
    """Make a surface of one scale, with the autocorrelation exp(-d²/ℓ²) at the distance d.

    Parameters
    ----------
    sigma
        Radians; Rdq of the facets is tan σ.
    correlation_length
        ℓ, in any unit of length: where the autocorrelation has fallen to 1/e.
    cells
        Of the grid, a side.
    correlation_cells
        Cells in ℓ. With 8, facets follow the surface they sample: their slopes lose 0.4 % of
        it, before they are stretched to σ.
    seed
        Another surface of the same kind for each number.

    Raises
    ------
    DomainError
        If σ, the length or the grid make no surface.

    Examples
    --------
    >>> surface = gaussian(np.radians(30), 0.1, cells=64)
    >>> round(float(np.degrees(np.arctan(surface.rdq))), 6), round(surface.period[0], 6)
    (30.0, 0.8)
    """
    check_grid(cells, correlation_cells)
    # The filter is the root of the spectrum: the Fourier transform of exp(-d²/ℓ²).
    filtering = np.exp(-(_wave_number(cells, correlation_cells) ** 2) / 8)
    return _filtered(filtering, sigma, correlation_length / correlation_cells, seed)


def multiscale(
    sigma: float,
    correlation_length: float = 1.0,
    *,
    hurst: float = 0.8,
    finest: float = 8.0,
    cells: int = 512,
    correlation_cells: float | None = None,
    seed: int = 0,
) -> HeightField:
    """Make a self-affine surface: power law from the correlation length down to the grid.

    The power spectrum is (1 + (kℓ)²)^-(1 + H), as measured on fractured, worn and cast surfaces
    (B. N. J. Persson et al., J. Phys.: Condens. Matter 17 (2005) R1), cut off below a wavelength.

    Parameters
    ----------
    sigma, correlation_length, cells, correlation_cells, seed
        As of `gaussian`; ℓ is where the power law begins, an eighth of the grid if not given.
    hurst
        H, 0 to 1: the smaller, the more of the slope is in the fine scales.
    finest
        Wavelength in cells at which the filter has fallen to 1/e.

    Raises
    ------
    DomainError
        If σ, a length, H or the grid make no surface.

    Examples
    --------
    >>> surface = multiscale(np.radians(30), cells=128, correlation_cells=32)
    >>> round(float(np.degrees(np.arctan(surface.rdq))), 6), round(surface.period[0], 6)
    (30.0, 4.0)
    """
    correlation_cells = cells / 8 if correlation_cells is None else correlation_cells
    check_grid(cells, correlation_cells)
    if not 0 < hurst <= 1:
        raise DomainError(f"The Hurst exponent is {hurst:g}; give more than 0, up to 1.")
    if not 2 <= finest <= correlation_cells:
        msg = f"The finest wavelength is {finest:g} cells; give 2 to {correlation_cells:g}."
        raise DomainError(msg)
    waves = _wave_number(cells, correlation_cells)
    cut = waves / correlation_cells * finest / (2 * np.pi)
    filtering = (1 + waves**2) ** (-(1 + hurst) / 2) * np.exp(-(cut**2))
    return _filtered(filtering, sigma, correlation_length / correlation_cells, seed)


def _wave_number(cells: int, correlation_cells: float) -> Array:
    """kℓ of every wave of the period, in the order of numpy's real Fourier transform."""
    along = 2 * np.pi * correlation_cells
    return np.asarray(
        np.hypot(along * np.fft.fftfreq(cells)[:, np.newaxis], along * np.fft.rfftfreq(cells))
    )


def _filtered(filtering: Array, sigma: float, spacing: float, seed: int) -> HeightField:
    check_slope(sigma)
    if not (np.isfinite(spacing) and spacing > 0):
        raise DomainError("The correlation length is not above 0; give a length.")
    cells = filtering.shape[0]
    noise = np.random.default_rng(seed).standard_normal((cells, cells))
    spectrum = np.fft.rfft2(noise) * filtering
    spectrum[0, 0] = 0  # the mean height means nothing
    heights = np.fft.irfft2(spectrum, s=(cells, cells))
    return HeightField(heights, (spacing, spacing)).of_slope(sigma)
