# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`search`: find samples of library and presets by words or by color."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import TYPE_CHECKING

from ....core.errors import InputError
from ...support.shown_text import out, tell

if TYPE_CHECKING:
    from ....core.numerics.arrays import Array
    from ...samples.library import Entry

NAME = "search"
SUMMARY = "find samples of the library and presets, by words or by color"
DESCRIPTION = (
    "Print id and name of the samples that have all the words in name, collection or source; with "
    "--near the samples nearest to a color, with their ΔE00 from it; last, how many "
    "readings a set has. Columns are separated by tabs."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `search`."""
    parser.add_argument("words", nargs="*", metavar="WORD", help="words to look for")
    parser.add_argument(
        "--near",
        metavar="COLOR",
        help="'#rrggbb' in sRGB, or 'L,a,b' for D65 and 2°",
    )
    parser.add_argument(
        "--count", type=int, default=10, metavar="N", help="how many with --near; 10 without it"
    )
    parser.add_argument(
        "--folder", type=Path, metavar="DIR", help="another library than the user's own"
    )


def run(options: argparse.Namespace) -> int:
    """Print what was found; exit status 0, also where that is nothing."""
    from ...material import preferences
    from ...samples import library

    if bool(options.words) == (options.near is not None):
        msg = "Give either words or --near COLOR."
        raise InputError(msg)
    folder = options.folder or preferences.user_folder()
    for fault in library.contents(folder).faults:
        tell(f"warning: {fault}")
    if options.near is None:
        for entry in library.search(" ".join(options.words), folder):
            out(entry.id, entry.name, *_several(entry))
        return 0
    if options.count < 1:
        msg = f"--count is {options.count}; give 1 or more."
        raise InputError(msg)
    for entry, difference in library.nearest(_lab(options.near), options.count, folder):
        out(entry.id, entry.name, f"{difference:.2f}", *_several(entry))
    return 0


def _several(entry: Entry) -> tuple[str, ...]:
    """Give the last column, which only sets have."""
    return (f"{entry.readings} readings",) if entry.readings > 1 else ()


def _lab(color: str) -> Array:
    """Read what --near says as CIE L*a*b* for D65 and 2°."""
    import numpy as np

    from ...samples import swatches

    digits = re.fullmatch(r"#?([0-9a-f]{6})", color.strip(), re.IGNORECASE)
    if digits:
        return swatches.to_lab(np.array(list(bytes.fromhex(digits[1]))) / 255)
    try:
        lab = np.array([float(part) for part in color.split(",")])
    except ValueError:
        lab = np.array([])
    if lab.shape != (3,) or not np.isfinite(lab).all() or not 0 <= lab[0] <= 100:
        msg = f"--near is {color!r}; give '#rrggbb' or 'L,a,b' with L from 0 to 100."
        raise InputError(msg)
    return lab
