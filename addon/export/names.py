# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names that every renderer takes, numbers as files hold them, and what is said of a material."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import Any

import numpy as np

from ...core.numerics import wavelength_grid
from ...core.numerics.arrays import Array
from ..support.shown_text import printable
from ..support.version import version
from .entry import Entry

RENDERERS_NM = (360.0, 830.0)
"""What spectral renderers sample; beyond its ends a spectrum counts as 0 there."""
_STEP = 5.0
"""Nanometers. Renderers join points by straight lines: of 10 nm they lose up to ΔE00 0.1."""


def identifiers(names: Iterable[str]) -> list[str]:
    """Give each name one of ASCII letters, digits and underscores, no two of them alike.

    Equal names give equal identifiers at each call, whatever comes after them.
    """
    found: list[str] = []
    taken: set[str] = set()
    for name in names:
        plain = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_") or "material"
        if plain[0].isdigit():
            plain = f"m_{plain}"  # of MaterialX, USD and others no name begins with a digit
        chosen, count = plain, 1
        while chosen.lower() in taken:
            count += 1
            chosen = f"{plain}_{count}"
        taken.add(chosen.lower())
        found.append(chosen)
    return found


def number(value: float) -> str:
    """Write a number with as many digits as renderers in single precision keep."""
    return f"{value:.8g}"


def numbers(values: Iterable[float], separator: str = " ") -> str:
    """Write several of them."""
    return separator.join(map(number, values))


def points(entry: Entry, values: Array) -> tuple[Array, Array]:
    """Give wavelengths and values as renderers are to join them, shape (points,).

    Ends are held to where renderers sample; between bands farther apart than 5 nm lie points of
    the cubic that colors are computed with.
    """
    bands = entry.wavelengths
    low, high = RENDERERS_NM
    kept = bands[(bands >= low) & (bands <= high)]
    inside = np.arange(math.ceil(bands[0] / _STEP) * _STEP, bands[-1], _STEP)
    between = inside[(inside >= low) & (inside <= high)]
    if kept.size > 1 and np.diff(kept).max() <= _STEP:
        between = kept
    wanted = np.unique(np.concatenate(([low], between, kept, [high])))
    held = wavelength_grid.resample(values, bands, wanted, method="cubic", ends="hold")
    return wanted, np.clip(held, 0.0, 1.0)


def creator() -> str:
    """Say who made a file."""
    return f"Rough Spectra {version()}"


def about(entry: Entry) -> str:
    """Say in a line what a material is made from, and how far off it is."""
    request = entry.request
    return printable(
        f"{entry.name}: {request.sample.name}, σ {math.degrees(request.sigma):.2f}°, model "
        f"{request.model}, under {request.illuminant}; ΔE00 {entry.delta_e_instrument:.3f} at "
        f"{request.read_at}, {entry.delta_e_mean:.2f} in the mean over the hemisphere"
    )


def facts(entry: Entry) -> dict[str, Any]:
    """Give spectrum, σ and where they come from, as plain values."""
    request = entry.request
    return {
        "name": entry.name,
        "sample": request.sample.name,
        "source": request.sample.source,
        "sigma_degrees": round(math.degrees(request.sigma), 5),
        "model": request.model,
        "illuminant": request.illuminant,
        "instrument": request.read_at,
        "wavelengths": [float(each) for each in entry.wavelengths],
        "reading": [round(float(each), 8) for each in entry.reading],
        "albedo": [round(float(each), 8) for each in entry.albedo],
    }
