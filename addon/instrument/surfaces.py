# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of surfaces: of materials as flat samples, and of spots where they lie.

Both are predicted and compared by `bake`; what differs is what Cycles sees.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..blender import working_space
from ..readings.document import Reading, Readings
from . import arrangement, bake, gloss, spot_measure
from .spot import Spot

Surface = tuple[str, Any] | Spot
"""Name of the object it was asked for by, or an empty string, and the material; or a spot."""


def pairs(surfaces: Sequence[Surface]) -> list[tuple[str, Any]]:
    """Give the name of each surface's object, or an empty string, and its material."""
    return [each.surface if isinstance(each, Spot) else each for each in surfaces]


def read(
    surfaces: Sequence[Surface],
    with_measurement: bool = True,
    progress: Callable[[int, int], None] | None = None,
    read_at: Sequence[str] = (),
    with_gloss: bool = False,
) -> Readings:
    """Predict the readings of surfaces and measure them in Cycles.

    Parameters
    ----------
    surfaces
        Materials, measured as flat samples, and spots.
    with_measurement, progress, read_at, with_gloss
        As in `bake.bake`.

    Raises
    ------
    DomainError, OutputError, CancelledError
        As in `bake.bake`.
    """
    read_at = tuple(dict.fromkeys(read_at))
    spots = [surface for surface in surfaces if isinstance(surface, Spot)]
    if not spots or not with_measurement:
        return bake.bake(pairs(surfaces), with_measurement, progress, read_at, with_gloss)
    each = max(1, len(read_at))
    prepared = bake.prepare(pairs(spots), read_at)
    wanted = arrangements(spots, prepared, with_gloss)
    on_spots = iter(compare(prepared, spot_measure.measure(spots, wanted, progress)))
    flat = [surface for surface in surfaces if not isinstance(surface, Spot)]
    on_flat = iter(bake.bake(flat, True, progress, read_at, with_gloss).entries if flat else ())
    entries = [
        next(on_spots if isinstance(surface, Spot) else on_flat)
        for surface in surfaces
        for _ in range(each)
    ]
    return bake.document_of(entries, each)


def arrangements(
    spots: Sequence[Spot], prepared: Sequence[bake.Prepared], with_gloss: bool = False
) -> list[list[arrangement.Arrangement]]:
    """Give the renders of each spot's instruments; `prepared` are of these spots."""
    each = len(prepared) // max(1, len(spots))
    meters = [gloss.arrangement(angle) for angle in gloss.ANGLES] if with_gloss else []
    return [
        [arrangement.of(item.read_at) for item in prepared[row : row + each]] + meters
        for row in range(0, len(prepared), each)
    ]


def compare(
    prepared: Sequence[bake.Prepared], results: Sequence[spot_measure.SpotResult]
) -> list[Reading]:
    """Predict the readings of spots and put beside them what was measured.

    Parameters
    ----------
    prepared
        Of the spots, as `bake.prepare` gave them.
    results
        One a spot, measured with what `arrangements` gave.
    """
    each, space, found = len(prepared) // max(1, len(results)), working_space.current(), []
    for row, item in enumerate(prepared):
        result, number = results[row // each], row % each
        entry = bake.reading(item, result.values(number), space, result.fault)
        to_lab = bake.to_lab(item, space)
        meters = zip(gloss.ANGLES, range(each, len(result.seen)), strict=False)
        units = [gloss.units(result.values(at)[0], angle, space) for angle, at in meters]
        found.append(
            replace(
                entry,
                warnings=(*entry.warnings, *result.warnings(number, to_lab)),
                gloss=() if result.fault else gloss.told(np.array(units)),
                spot=result.read(number, to_lab),
            )
        )
    return found


def digest(
    surfaces: Sequence[Surface],
    with_measurement: bool,
    read_at: Sequence[str] = (),
    with_gloss: bool = False,
) -> str:
    """Tell bakes apart, as `bake.digest` does, and by where spots are."""
    found = bake.digest(pairs(surfaces), with_measurement, read_at, with_gloss)
    spots = [surface.told() for surface in surfaces if isinstance(surface, Spot)]
    return hashlib.sha256(repr((found, spots)).encode()).hexdigest()[:16] if spots else found
