# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Solve color and roughness of materials for the lobes of a renderer. No Blender data here.

The reading at the virtual instrument is met exactly, band by band where the renderer has spectra
and in RGB where it has three channels; roughness, and the lobe where the renderer has
several, are those that come closest over the hemisphere.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from ...core import lobes
from ...core.color import color_difference
from ...core.lobes import Lobe
from ...core.numerics import direction_grid
from ...core.numerics.arrays import Array
from ..colorimetry import tristimulus
from ..matching import assess, solve, surface_spectra
from . import spaces
from .entry import Entry, Wanted
from .names import identifiers
from .targets import Target

_ENOUGH = 1e-4
"""Overshoot of a color that nobody sees."""
_CLOSER = 0.01
"""ΔE00 by which a lobe has to be closer than a simpler one."""


class _Met(NamedTuple):
    """A lobe with color and roughness.

    `apart` is ΔE00 over the hemisphere and `missed` at the instrument; `outside` is how far the
    color that would meet the reading lies outside of 0 to 1.
    """

    lobe: Lobe
    color: Array
    roughness: float
    apart: Array
    missed: float
    outside: float


def solved(wanted: Sequence[Wanted], target: Target) -> list[Entry]:
    """Solve materials for a renderer, in their order.

    Raises
    ------
    DomainError
        If a spectrum does not cover the visible range.
    """
    names = identifiers(each.name for each in wanted)
    return [_solved(each, name, target) for each, name in zip(wanted, names, strict=True)]


def _solved(wanted: Wanted, identifier: str, target: Target) -> Entry:
    request = wanted.request
    angles = direction_grid.hemisphere(solve.MATCH_GEOMETRIES)
    with surface_spectra.naming(request.sample):
        tristimulus.weights(request.sample.wavelengths)
    [read], [albedo] = surface_spectra.readings_and_albedos([request])
    spread = np.maximum(assess.in_directions(request, albedo, angles), 0)
    for space in target.SPACES:
        to_channels, perceive = _channels(wanted, space)
        reading, targets = to_channels(read), to_channels(spread)
        found = [
            _met(lobe, reading, targets, angles, perceive, request.read_at) for lobe in target.LOBES
        ]
        lobe, color, roughness, apart, missed, outside = _closest(found)
        if outside <= _ENOUGH:
            break
    warnings = [*wanted.warnings, *solve.remarks(request)]
    if outside > _ENOUGH:
        warnings.append(
            f"{request.sample.name!r} needs a color {outside:.4f} outside of what {target.TITLE} "
            f"can show; with the nearest the reading misses its target by ΔE00 {missed:.2f}."
        )
    return Entry(
        target=target.NAME,
        name=wanted.name,
        identifier=identifier,
        request=request,
        space=space,
        lobe=lobe,
        color=color,
        roughness=roughness,
        reading=read,
        albedo=albedo,
        delta_e_instrument=missed,
        delta_e_mean=float(apart.mean()),
        delta_e_95=float(np.percentile(apart, 95)),
        warnings=tuple(warnings),
    )


def _closest(found: list[_Met]) -> _Met:
    """Give the one with the least mean ΔE00; of such as are alike, the simpler one."""
    best = found[0]
    for each in found[1:]:
        if each.apart.mean() < best.apart.mean() - _CLOSER:
            best = each
    return best


def _channels(
    wanted: Wanted, space: str
) -> tuple[Callable[[Array], Array], Callable[[Array], Array]]:
    """Give how spectra become the renderer's channels, and these L*a*b*."""
    bands, illuminant = wanted.request.sample.wavelengths, wanted.request.illuminant
    if space == spaces.SPECTRA:
        weights = tristimulus.weights(bands, illuminant)
        white = weights.sum(axis=0)
        return np.asarray, lambda seen: color_difference.xyz_to_lab(seen @ weights, white)
    rgb = spaces.find(space)
    to_rgb = rgb.rgb_weights(bands, illuminant)
    return lambda spectra: spectra @ to_rgb, lambda seen: rgb.to_lab(seen, illuminant)


def _met(
    lobe: Lobe,
    reading: Array,
    targets: Array,
    angles: tuple[Array, Array, Array],
    perceive: Callable[[Array], Array],
    read_at: str,
) -> _Met:
    unclipped, roughness = lobes.match(lobe, reading, targets, angles, perceive, read_at)
    color = np.clip(unclipped, 0.0, 1.0)
    shown = lobe.reflectance(color, np.full(angles[0].size, roughness), *angles)
    at_instrument = lobes.reflected(color, lobe.at(roughness, read_at))
    apart = color_difference.delta_e(perceive(shown), perceive(targets))
    missed = color_difference.delta_e(perceive(at_instrument), perceive(reading))
    outside = float(np.abs(unclipped - color).max())
    return _Met(lobe, color, roughness, apart, float(missed), outside)
