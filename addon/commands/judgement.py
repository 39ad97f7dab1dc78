# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether readings are near enough to their predictions: what `check` and `merge` say of it."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from ...core.errors import InputError
from ..support.shown_text import inform, tell
from . import result

if TYPE_CHECKING:
    from ..readings.document import Readings

FAILED = 1


def check_limit(limit: float | None) -> None:
    """Refuse a limit that is none.

    Raises
    ------
    InputError
        If it is below 0 or no number.
    """
    if limit is not None and not limit >= 0:
        msg = f"--max-delta-e is {limit}; give 0 or more."
        raise InputError(msg)


def judge(readings: Readings, limit: float, options: argparse.Namespace) -> int:
    """Name every reading whose ΔE00 exceeds a limit; exit status 0 or 1."""
    compared = [entry for entry in readings.entries if entry.delta_e_00 is not None]
    failed = [entry for entry in compared if (entry.delta_e_00 or 0) > limit]
    for entry in failed:
        reason = f" ({'; '.join(entry.warnings)})" if entry.warnings else ""
        at = "" if len(readings.instruments) == 1 else f" at {entry.instrument}"
        tell(f"material {entry.material!r} differs by ΔE00 {entry.delta_e_00:.2f}{at}{reason}")
    largest = readings.largest_delta_e
    result.add(
        options,
        compared=len(compared),
        failed=[
            {"material": e.material, "instrument": e.instrument, "delta_e_00": e.delta_e_00}
            for e in failed
        ],
        largest_delta_e_00=largest,
    )
    what = "materials" if readings.each == 1 else "readings"
    inform(
        f"{len(failed)} of {len(compared)} {what} exceed ΔE00 {limit:g}"
        + ("" if largest is None else f"; the largest is {largest:.4f}")
    )
    return FAILED if failed else 0
