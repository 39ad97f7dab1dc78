# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of goniometers: a row a direction and wavelength, a BRDF or a reflectance factor.

A goniometer finds more directions than a sample holds. Those of 45°/0° and of multi-angle
instruments are read, the others counted in a note. Exchanging light and view changes nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from .....core.instruments import REGISTRY
from .....core.numerics.arrays import Array
from ...sample import Sample
from . import label_words, series, statements, tables
from .document import Document
from .scale import nanometers, scale
from .tables import Row
from .wavelengths_down import names_quantity

_BRDF = re.compile(r"b[rs]df\b.*|f_?r(?:_?11)?\s*(?:[\[(].*[\])])?", re.IGNORECASE)
_AZIMUTHS = {
    **dict.fromkeys(("phi", "phii", "lightazimuth", "incidentazimuth", "illuminationazimuth"), 0),
    **dict.fromkeys(("phir", "phiv", "phio", "phis", "viewazimuth", "viewingazimuth"), 1),
    **dict.fromkeys(("detectorazimuth", "reflectionazimuth", "observationazimuth"), 1),
}
"""0 for columns of the light's azimuth, 1 for the view's."""
_ANGLE_ERROR, _AZIMUTH_ERROR = 0.5, 1.0
"""Degrees that a direction may be off an instrument's."""
_MULTIPLIED = "The BRDF was multiplied by π, which gives the reflectance factor."
_SIDES = (
    "Azimuths are taken as those of directions that lead away from the surface: 180° apart is the "
    "side of the mirror direction."
)


class _Columns(NamedTuple):
    """Places in a row; None where there is no such column."""

    axis: int
    value: int
    light: int
    view: int
    azimuths: tuple[int, int] | None
    is_brdf: bool


def is_goniometer(header: list[str]) -> bool:
    """Return whether the names of columns are those of such a table.

    There is one column each of wavelengths, values and the angles of light and view, and the values
    are a BRDF or azimuths stand beside them; `long_tables` reads the others.
    """
    columns = _columns(header)
    return columns is not None and (columns.is_brdf or columns.azimuths is not None)


def read(
    document: Document,
    said: label_words.Comments,
    fields: dict[str, Any],
    header: list[str],
    line: int,
    table: Iterator[Row],
) -> list[Sample]:
    """Return the readings of the instruments whose directions are there; as others read.

    Raises
    ------
    InputError
        None is there, or what other tables raise.
    """
    columns = _columns(header)
    assert columns is not None, "ask `is_goniometer` first"
    wanted = [columns.axis, columns.value, columns.light, columns.view, *(columns.azimuths or ())]
    block = tables.numbers(document, table, header, wanted, decimal_comma=True, gaps=1)
    nm = nanometers(document, said, block.values[:, 0], [header[columns.axis]])
    label = header[columns.value]
    if columns.is_brdf:
        values = block.values[:, 1] * np.pi
    else:
        values = block.values[:, 1] / scale(document, said, f"line {line}", [label])
    light, view, apart = _directions(block.values[:, 2:])
    samples = []
    used = np.zeros(len(nm), dtype=bool)
    for name in _wanted():
        at = np.flatnonzero(_are_of(name, light, view, apart))
        if not at.size:
            continue
        used[at] = True
        bands, counts, means = _by_wavelength(nm[at], values[at])
        place = f"directions of {name}"
        found = series.bands(bands, means, f"{document.path}, {place}", "band {}".format)
        altered = [_MULTIPLIED] if columns.is_brdf else []
        if counts.max() > 1:
            altered.append(f"Up to {counts.max()} directions were averaged at each wavelength.")
        sample = statements.make(
            document,
            said,
            {**fields, "geometry": name},
            found._replace(altered=(*altered, *found.altered)),
            name=fields.get("name") or document.path.stem,
            position="",
            notes=(_SIDES,) if REGISTRY[name].aspecular is not None else (),
        )
        samples.append(sample)
    if not samples:
        raise document.error(
            "",
            "none of its directions is that of an instrument: light at 45° and view at 0°, or for "
            "views at other angles with columns for both azimuths, 'phi_i' and 'phi_r'; export the "
            "BRDF there, too",
        )
    return samples


def _columns(header: list[str]) -> _Columns | None:
    angles = {statements.field_of(label): i for i, label in enumerate(header)}
    axes = [i for i, label in enumerate(header) if label_words.is_wavelength(label)]
    brdf = [i for i, label in enumerate(header) if _BRDF.fullmatch(label.strip())]
    values = brdf or [i for i, label in enumerate(header) if names_quantity(label)]
    if len(axes) != 1 or len(values) != 1 or not {"lit", "view"} <= angles.keys():
        return None
    azimuths: dict[int, int] = {}
    for i, label in enumerate(header):
        which = _AZIMUTHS.get(re.sub(r"[^a-z]", "", re.sub(r"[\[(].*", "", label.lower())))
        if which is not None:
            azimuths.setdefault(which, i)
    both = (azimuths[0], azimuths[1]) if len(azimuths) == 2 else None
    return _Columns(axes[0], values[0], angles["lit"], angles["view"], both, bool(brdf))


def _directions(columns: Array) -> tuple[Array, Array, Array]:
    """Return the angles of light and view from the normal, and the azimuths between; degrees.

    A negative angle is one on the other side of the normal. What the azimuth is not known of is
    NaN.
    """
    light, view = columns[:, 0], columns[:, 1]
    if columns.shape[1] == 2:
        return np.abs(light), np.abs(view), np.full(len(light), np.nan)
    turned = columns[:, 3] - columns[:, 2] + 180.0 * ((light < 0) != (view < 0))
    return np.abs(light), np.abs(view), np.abs((turned + 180.0) % 360.0 - 180.0)


def _wanted() -> list[str]:
    """Return 45a:0 and the multi-angle instruments but 45as45, which looks along the normal."""
    return ["45a:0", *(i.name for i in REGISTRY.values() if i.aspecular not in (None, 45))]


def _are_of(name: str, light: Array, view: Array, apart: Array) -> Array:
    """Return which directions are those of an instrument, in either order of light and view."""
    instrument = REGISTRY[name]
    tilts = (instrument.light.tilt, instrument.view.tilt)
    ordered, exchanged = (
        (np.abs(light - one) <= _ANGLE_ERROR) & (np.abs(view - other) <= _ANGLE_ERROR)
        for one, other in (tilts, tilts[::-1])
    )
    found: Array = ordered | exchanged
    if 0.0 not in tilts:
        with np.errstate(invalid="ignore"):
            found &= np.abs(apart - instrument.azimuth) <= _AZIMUTH_ERROR
    return found


def _by_wavelength(nm: Array, values: Array) -> tuple[Array, Array, Array]:
    """Return increasing wavelengths, how many values each has, and their mean."""
    bands, at = np.unique(nm, return_inverse=True)
    counts = np.bincount(at.ravel())
    return bands, counts, np.bincount(at.ravel(), weights=values) / counts
