# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which reading is of which surface, and what is known of its σ, for the verb `experiment`."""

from __future__ import annotations

import math
from pathlib import Path

from ...core.errors import InputError
from ...core.limits import MATCHED_SIGMA_DEGREES
from ..laboratory.trial.surfaces import Material, Surface
from ..samples.sample import COLORED, Sample
from ..samples.stated_sigma import Names, StatedSigma
from .estimation import FIELDS, SMOOTH, rows

_SIGMA = Names("sigma_deg")
_CLOSE_DEGREES = 1e-6


def read(path: Path) -> list[Surface]:
    """Read a table, CSV or JSON, with a row a reading.

    Raises
    ------
    InputError
        Naming file, row and remedy.
    """
    smooth: dict[str, list[Sample]] = {}
    rough: dict[str, dict[str, list[Sample]]] = {}
    sigma: dict[str, float] = {}
    for where, cells, sample in rows(path, (*FIELDS, *_SIGMA)):
        surface = cells["surface"]
        if not sample.has_color:
            msg = f"{where}: {sample.name!r} has no color; take a visible reading."
            raise InputError(msg)
        if surface != SMOOTH and sample.kind != COLORED[0]:
            msg = (
                f"{where}: {sample.name!r} is of the kind {sample.kind!r}, which roughness does "
                "not change; give what an instrument read of the rough surface."
            )
            raise InputError(msg)
        stated = _stated(where, cells)
        if stated is not None:
            if surface == SMOOTH:
                msg = f"{where}: a smooth surface has σ = 0; leave {' and '.join(_SIGMA)} empty."
                raise InputError(msg)
            if abs(sigma.setdefault(surface, stated) - stated) > _CLOSE_DEGREES:
                msg = (
                    f"{where}: σ of {surface!r} is {stated:g}° here and {sigma[surface]:g}° above; "
                    "give one, or call the surfaces differently."
                )
                raise InputError(msg)
        of = smooth if surface == SMOOTH else rough.setdefault(surface, {})
        of.setdefault(cells["material"], []).append(sample)
    if not rough:
        msg = f"{path} has no row of a rough surface; name its roughness in the column surface."
        raise InputError(msg)
    return [
        Surface(
            name,
            math.radians(sigma[name]) if name in sigma else None,
            tuple(
                Material(material or read_of[0].name, tuple(smooth.get(material, ())), (*read_of,))
                for material, read_of in of.items()
            ),
        )
        for name, of in rough.items()
    ]


def _stated(where: str, cells: dict[str, str]) -> float | None:
    """σ in degrees, however the row gives it."""
    numbers: list[float | None] = []
    for name in _SIGMA:
        try:
            numbers.append(float(cells[name]) if cells[name] else None)
        except ValueError:
            msg = f"{where}: {name} is {cells[name]!r}; give a number, or leave it empty."
            raise InputError(msg) from None
    given = StatedSigma(*numbers)
    if fault := given.fault(_SIGMA)[1]:
        raise InputError(f"{where}: {fault}.")
    settled = given.settled
    if settled is not None and not 0 <= settled <= MATCHED_SIGMA_DEGREES:
        msg = f"{where}: σ is {settled:g}°; give 0 to {MATCHED_SIGMA_DEGREES:g}."
        raise InputError(msg)
    return settled
