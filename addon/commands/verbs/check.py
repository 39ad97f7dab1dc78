# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`check`: measure again, and fail when a material no longer reads as it should."""

from __future__ import annotations

import argparse
from pathlib import Path

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
    from ..judgement import check_limit, judge
    from ..result import add

    check_limit(options.max_delta_e)
    if options.output is not None:
        writers.check(options.output)
    result = measure(options, wanted(options))
    if result.largest_delta_e is None and not result.faults:
        names = ", ".join(entry.material for entry in result.entries[:5])
        msg = f"None of {names} stores a spectrum to compare with; assign one first."
        raise InputError(msg)
    if options.output is not None:
        written = api.write(result, options.output, options.format or writers.FORMATS)
        add(options, files=written)
    failed = judge(result, options.max_delta_e, options)
    # What could not be compared weighs more: nobody knows whether it would have passed.
    return tell_faults(result) or failed
