# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two samples are apart, as measured and as the albedos behind: their intrinsic color.

Two surfaces of one paint read different colors if one is rougher. What an instrument compares is
surfaces; what S. Zuffi and I. Gagliardi's report of 2007 calls the "intrinsic" color, that due to
colorants and pigments, is in the albedos.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...core import instruments, interreflection
from ...core.color import chromaticity, color_difference
from ...core.errors import DomainError
from ...core.models import TARGET
from ...core.numerics.arrays import Array
from ..colorimetry import tristimulus
from . import solve, surface_spectra
from .request import AUTO, Request

Lab = tuple[float, float, float]


@dataclass(frozen=True)
class Apart:
    """How far one color is from another.

    Attributes
    ----------
    first, second
        CIE L*, a*, b*.
    delta_e_00
        CIEDE2000.
    delta_l, delta_a, delta_b
        Second less first.
    delta_ab
        Distance in the a*b* plane.
    shift
        The same once the second has the luminance of the first: what is left when one is only
        darker. NaN where just the second is black.
    """

    first: Lab
    second: Lab
    delta_e_00: float
    delta_l: float
    delta_a: float
    delta_b: float
    delta_ab: float
    shift: float


@dataclass(frozen=True)
class Comparison:
    """Two samples beside each other.

    Attributes
    ----------
    measured
        Between the readings at one instrument: as printed where that is what was measured, else
        predicted.
    albedos
        Between the albedos: the same surfaces without their roughness.
    roughness
        For each of the two, from its albedo to its reading: what its roughness does to the color.
    interreflection
        For each of the two, the share of its reading's luminance that met more than one facet.
    model, illuminant, observer, read_at
        What it was computed with.
    warnings
        What to know of the two, sentences.
    """

    measured: Apart
    albedos: Apart
    roughness: tuple[Apart, Apart]
    interreflection: tuple[float, float]
    model: str
    illuminant: str
    observer: int
    warnings: tuple[str, ...]
    read_at: str = instruments.DEFAULT


def compare(first: Request, second: Request) -> Comparison:
    """Compare two samples, each with its roughness.

    Parameters
    ----------
    first, second
        With the same model, illuminant, observer and virtual instrument; the wavelengths may
        differ. "auto" stands for `core.models.TARGET`: where one is rougher, the bounces must be
        the same.

    Raises
    ------
    DomainError
        If a setting differs, or a spectrum does not cover the visible range.
    """
    pair = [_settled(request) for request in (first, second)]
    one, other = pair
    for label, name in (
        *(("model", "model"), ("illuminant", "illuminant")),
        *(("observer", "observer"), ("virtual instrument", "read_at")),
    ):
        if getattr(one, name) != getattr(other, name):
            msg = (
                f"The {label} is {getattr(one, name)} of one and {getattr(other, name)} of the "
                "other sample; compare them with the same."
            )
            raise DomainError(msg)
    colors, shares, warnings = [], [], []
    for request in pair:
        sample = request.sample
        with surface_spectra.naming(sample):
            weights = tristimulus.weights(sample.wavelengths, request.illuminant, request.observer)
        [seen], [rho] = surface_spectra.readings_and_albedos([request])
        # Relative to the white of its own wavelengths, so that a gray is gray on every grid.
        white = weights.sum(axis=0)
        colors.append((seen @ weights / white, rho @ weights / white))
        # Beyond white facets the models say nothing; the albedo is in proportion there.
        shares.append(
            interreflection.overall_share(
                np.minimum(rho, 1), request.sigma, weights[:, 1], request.model, request.read_at
            )
        )
        warnings += [f"{sample.name}: {sentence}" for sentence in solve.remarks(request)]
    (seen_1, rho_1), (seen_2, rho_2) = colors
    return Comparison(
        measured=_apart(seen_1, seen_2),
        albedos=_apart(rho_1, rho_2),
        roughness=(_apart(rho_1, seen_1), _apart(rho_2, seen_2)),
        interreflection=(float(shares[0]), float(shares[1])),
        model=one.model,
        illuminant=one.illuminant,
        observer=one.observer,
        read_at=one.read_at,
        warnings=tuple(warnings),
    )


def _settled(request: Request) -> Request:
    """Leave the scene out, which has lights of its own, and no model to choose."""
    model = TARGET if request.model == AUTO else request.model
    return replace(request, model=model, scene=None, flat=False)


def _apart(first: Array, second: Array) -> Apart:
    """Compare two colors, X, Y and Z relative to white."""
    white = np.ones(3)
    lab_1, lab_2 = color_difference.xyz_to_lab(np.stack((first, second)), white)
    delta_l, delta_a, delta_b = (lab_2 - lab_1).tolist()
    return Apart(
        first=tuple(lab_1.tolist()),
        second=tuple(lab_2.tolist()),
        delta_e_00=float(color_difference.delta_e(lab_1, lab_2)),
        delta_l=delta_l,
        delta_a=delta_a,
        delta_b=delta_b,
        delta_ab=float(chromaticity.ab_distance(lab_1, lab_2)),
        shift=float(chromaticity.shift(first, second, white)),
    )
