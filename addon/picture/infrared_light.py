# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a lamp sends where no eye sees, of which its color tells nothing. No Blender data here."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...core.emissivity import planck
from ...core.errors import DomainError
from ...core.numerics.arrays import Array
from ..colorimetry import cie_tables, illuminant_spectra
from ..samples import light_source
from ..samples.light_source import LightSource

COLDEST, HOTTEST = 500.0, 50_000.0
"""Kelvin of a blackbody that is taken for a lamp."""

_FINE = 0.25
"""Nanometers at which a table is read where eyes see."""
_SEEN = 1e-3
"""Part of a lamp's power that has to be luminous for it to be scaled by that: less is a detector's
noise. A blackbody of 1500 K still has twice as much."""


class Light(NamedTuple):
    """What is known of a light.

    Parameters
    ----------
    words
        What it is.
    ends
        Nanometers between which it is known.
    sent
        Gives its radiance per nanometer at wavelengths, of a luminance Y of 1; of a light that is
        not seen, of a power of 1, as a light of 555 nm has with that luminance.
    """

    words: str
    ends: tuple[float, float]
    sent: Callable[[Array], Array]


def find(name: str) -> Light:
    """Give what is known of a light by its temperature, such as 2856K, or the path of its table.

    Raises
    ------
    DomainError
        If it is neither, or an illuminant of the CIE.
    InputError
        If the file cannot be read.
    """
    kelvin = re.fullmatch(r"(\d+(?:\.\d+)?) ?K?", name)
    if kelvin is not None:
        return blackbody(float(kelvin[1]))
    if name in cie_tables.ILLUMINANTS:
        msg = (
            f"CIE {name} is defined where eyes see, and tells nothing of the infrared; give a "
            "temperature, such as 2856K, or the file of a spectrum that reaches there."
        )
        raise DomainError(msg)
    path = Path(name)
    if not path.exists():
        msg = f"{name!r} is neither a file nor a temperature such as 2856K; check the name."
        raise DomainError(msg)
    return measured(light_source.read(path))


def blackbody(kelvin: float) -> Light:
    """Give a blackbody's light.

    Raises
    ------
    DomainError
        If it is colder or hotter than a lamp.
    """
    if not COLDEST <= kelvin <= HOTTEST:
        msg = f"A lamp of {kelvin:g} K is none; give kelvin, {COLDEST:g} to {HOTTEST:g}."
        raise DomainError(msg)
    luminance = illuminant_spectra.to_xyz(planck.radiance(illuminant_spectra.GRID, kelvin))[1]

    def sent(nm: Array) -> Array:
        return planck.radiance(nm, kelvin) / luminance

    return Light(f"blackbody of {kelvin:.0f} K", (0.0, math.inf), sent)


def measured(source: LightSource) -> Light:
    """Give the light that was measured, known between the ends of its table alone."""
    nm, power = source.wavelengths, source.power
    fine = np.arange(cie_tables.GRID[0], cie_tables.GRID[-1], _FINE)
    eye = np.interp(fine, cie_tables.GRID, cie_tables.observer(2)[:, 1])
    luminance = float(eye @ np.interp(fine, nm, power, 0, 0)) * _FINE
    total = float(np.sum((power[1:] + power[:-1]) / 2 * np.diff(nm)))
    is_seen = luminance > _SEEN * total
    scale = luminance if is_seen else total
    words = f"measured: {source.name}" + ("" if is_seen else ", by its power, as it is not seen")

    def sent(at: Array) -> Array:
        return np.asarray(np.interp(at, nm, power, 0, 0) / scale)

    return Light(words, (float(nm[0]), float(nm[-1])), sent)
