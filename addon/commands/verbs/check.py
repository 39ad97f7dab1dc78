# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`check`: measure again, and fail when a material no longer reads as it should."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...support.shown_text import tell
from .bake import (
    add_format_argument,
    add_surface_arguments,
    measure,
    tell_faults,
    wanted,
)

NAME = "check"
SUMMARY = "measure again, and fail when any ΔE00 exceeds a limit"
DESCRIPTION = (
    "Measure materials in Cycles and compare with the readings predicted from their spectra. Exit "
    "status 1 if any ΔE00 exceeds the limit, 2 if any material cannot be compared. The .blend "
    "itself is not changed."
)
_FAILED = 1


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `check`."""
    add_surface_arguments(parser)
    parser.add_argument(
        "--max-delta-e",
        type=float,
        default=1.0,
        metavar="ΔE00",
        help="the largest difference that passes (1.0)",
    )
    parser.add_argument("--output", type=Path, metavar="BASE", help="also write the readings")
    add_format_argument(parser)


def run(options: argparse.Namespace) -> int:
    """Measure and compare; exit status 0 or 1, or 2 where a material could not be compared."""
    from ....core.errors import InputError
    from ... import api
    from ...readings import writers

    if not options.max_delta_e >= 0:
        msg = f"--max-delta-e is {options.max_delta_e}; give 0 or more."
        raise InputError(msg)
    if options.output is not None:
        writers.check(options.output)
    result = measure(options, wanted(options))
    compared = [entry for entry in result.entries if entry.delta_e_00 is not None]
    if not compared and not result.faults:
        names = ", ".join(entry.material for entry in result.entries[:5])
        msg = f"None of {names} stores a spectrum to compare with; assign one first."
        raise InputError(msg)
    if options.output is not None:
        api.write(result, options.output, options.format or writers.FORMATS)
    failed = [entry for entry in compared if (entry.delta_e_00 or 0) > options.max_delta_e]
    for entry in failed:
        reason = f" ({'; '.join(entry.warnings)})" if entry.warnings else ""
        at = "" if len(result.instruments) == 1 else f" at {entry.instrument}"
        tell(f"material {entry.material!r} differs by ΔE00 {entry.delta_e_00:.2f}{at}{reason}")
    largest = result.largest_delta_e
    what = "materials" if result.each == 1 else "readings"
    tell(
        f"{len(failed)} of {len(compared)} {what} exceed ΔE00 {options.max_delta_e:g}"
        + ("" if largest is None else f"; the largest is {largest:.4f}")
    )
    # What could not be compared weighs more: nobody knows whether it would have passed.
    return tell_faults(result) or (_FAILED if failed else 0)
