# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What samples emit as CSV: spectra that our own readers read back, and what follows in bands."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence

import numpy as np

from ..support.shown_text import ESCAPED, to_cell
from ..support.version import version
from .emission import Emissivity
from .writers.tables import csv_of, nanometers

HEMISPHERE = "hemisphere"
FACET = "facet"


def spectra(found: Sequence[Emissivity]) -> bytes:
    """Give a row a wavelength, a column a sample and direction; what a sample lacks stays empty."""
    every = np.unique(np.concatenate([each.wavelengths for each in found]))
    header, columns = ["wavelength (nm)"], []
    for each, name in zip(found, _names(found), strict=True):
        at = np.searchsorted(every, each.wavelengths)
        for what, values in (
            (FACET, each.facets),
            *zip(map(degrees, each.angles), each.directional, strict=True),
            (HEMISPHERE, each.hemispherical),
        ):
            header.append(to_cell(f"{name}, {what}"))
            column = [""] * every.size
            for place, value in zip(at.tolist(), values.tolist(), strict=True):
                column[place] = f"{value:.6f}"
            columns.append(column)
    comments = [
        *_comments(found),
        "kind: emissivity",
        "units: fraction (1 = black body)",
        "wavelength_unit: nm",
    ]
    wavelengths = [nanometers(nm) for nm in every.tolist()]
    return csv_of(comments, header, [list(row) for row in zip(wavelengths, *columns, strict=True)])


def bands(found: Sequence[Emissivity]) -> bytes:
    """Give a row a sample, band and direction."""
    header = ["sample", "sigma_deg", "model", "band", "from_nm", "to_nm", "temperature_K"]
    header += ["background_K", "direction_deg", "emissivity", "apparent_K"]
    rows = []
    for each, name in zip(found, _names(found), strict=True):
        for band in each.bands:
            about = [
                *(to_cell(name), f"{math.degrees(each.sigma):g}", each.model, to_cell(band.name)),
                *(nanometers(band.first), nanometers(band.last)),
                *(f"{each.temperature:g}", f"{each.background:g}"),
            ]
            for angle, value, kelvin in zip(
                each.angles, band.directional, band.apparent, strict=True
            ):
                seen = "" if math.isnan(kelvin) else f"{kelvin:.3f}"
                rows.append([*about, f"{math.degrees(angle):g}", f"{value:.6f}", seen])
            rows.append([*about, HEMISPHERE, f"{band.hemispherical:.6f}", ""])
    return csv_of(_comments(found), header, rows)


def degrees(angle: float) -> str:
    """Name a direction by its angle from the normal, radians."""
    return f"{math.degrees(angle):g}°"


def _comments(found: Sequence[Emissivity]) -> list[str]:
    sources = dict.fromkeys(each.source for each in found if each.source)
    return [
        f"creator: Rough Spectra {version()}",
        "quantity: emissivity of a rough surface, computed from the spectrum of a sample",
        *(f"of: {source}" for source in sources),
        f"cells: {ESCAPED} (names: \\x1b and the like, an apostrophe before = + - @ ')",
    ]


def _names(found: Sequence[Emissivity]) -> list[str]:
    """Names of the samples, with σ, and a number where two are alike."""
    names = [f"{each.sample} σ {math.degrees(each.sigma):g}°" for each in found]
    seen: Counter[str] = Counter()
    told = []
    for name in names:
        seen[name] += 1
        told.append(name if seen[name] == 1 else f"{name} ({seen[name]})")
    return told
