# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`search`: find samples of library and presets by words, by color, or like a sample."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ....core.errors import DomainError, InputError
from ...support.shown_text import out, tell

if TYPE_CHECKING:
    from ...samples.library import Entry
    from ...samples.palette import Row

NAME = "search"
SUMMARY = "find samples of the library and presets, by words or by color"
DESCRIPTION = (
    "Print id and name of the samples that have all the words in name, collection or source; with "
    "--near, --like or --palette the samples nearest to a color, with their ΔE00 from it. With "
    "--lights, and a spectrum to compare with, then the special metamerism index (CIE 15:2004) for "
    "each light: how far they are apart there if they match in D65. Last, how many "
    "readings a set has. Columns are separated by tabs."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `search`."""
    parser.add_argument("words", nargs="*", metavar="WORD", help="words to look for")
    parser.add_argument(
        "--near",
        metavar="COLOR",
        help="'#rrggbb' in sRGB, or 'L,a,b' for --illuminant and --observer",
    )
    parser.add_argument(
        "--like", metavar="SAMPLE", help="a sample of the library or presets, by id or name"
    )
    parser.add_argument(
        "--palette",
        type=Path,
        metavar="FILE",
        help="a table of your own colors: a name and L*, a*, b* or #rrggbb in each row, or spectra",
    )
    parser.add_argument(
        "--row", metavar="NAME", help="which color of the palette; without it each of them"
    )
    parser.add_argument(
        "--lights",
        nargs="+",
        default=[],
        metavar="LIGHT",
        help="illuminants to compare spectra in, such as A F11 LED-B3",
    )
    parser.add_argument("--illuminant", default="D65", metavar="LIGHT", help="of L,a,b (D65)")
    parser.add_argument("--observer", default="2", metavar="DEGREES", help="of L,a,b: 2 or 10 (2)")
    parser.add_argument(
        "--count", type=int, default=10, metavar="N", help="how many of each; 10 without it"
    )
    parser.add_argument(
        "--folder", type=Path, metavar="DIR", help="another library than the user's own"
    )


def run(options: argparse.Namespace) -> int:
    """Print what was found; exit status 0, also where that is nothing."""
    from ...material import preferences
    from ...samples import library, palette

    asked = [bool(options.words), *(x is not None for x in _colors(options))]
    if sum(asked) != 1:
        msg = "Give either words, --near COLOR, --like SAMPLE or --palette FILE."
        raise InputError(msg)
    if options.row is not None and options.palette is None:
        msg = "--row is of a palette; give --palette FILE, too."
        raise InputError(msg)
    folder = options.folder or preferences.user_folder()
    for fault in library.contents(folder).faults:
        tell(f"warning: {fault}")
    if options.words:
        for entry in library.search(" ".join(options.words), folder):
            out(entry.id, entry.name, *_several(entry))
        return 0
    if options.count < 1:
        msg = f"--count is {options.count}; give 1 or more."
        raise InputError(msg)
    if options.palette is None:
        like = options.like
        row = _near(options) if like is None else palette.of_sample(library.load(like, folder))
        _tell(row, (), options, folder)
        return 0
    rows = palette.read(options.palette)
    for row in rows if options.row is None else [palette.find(rows, options.row)]:
        _tell(row, (row.name,), options, folder)
    return 0


def _colors(options: argparse.Namespace) -> tuple[object, ...]:
    return options.near, options.like, options.palette


def _tell(row: Row, first: Sequence[str], options: argparse.Namespace, folder: Path) -> None:
    """Print the samples nearest to a color, each after the first columns."""
    from ...samples import library

    if options.lights and row.sample is None:
        msg = f"--lights compare spectra, and {row.name or 'a color'!r} has none; leave it out."
        raise InputError(msg)
    light = row.illuminant, row.observer
    for entry, difference in library.nearest(row.lab, options.count, folder, *light):
        apart = _indices(row, entry, options.lights, folder)
        out(*first, entry.id, entry.name, f"{difference:.2f}", *apart, *_several(entry))


def _indices(row: Row, entry: Entry, lights: Sequence[str], folder: Path) -> list[str]:
    """Give a metamerism index for each light, as text."""
    from ...matching import metamerism
    from ...matching.request import Request
    from ...samples import library

    if not lights or row.sample is None:
        return []
    one, other = (
        Request(sample, math.radians(sample.sigma_degrees or 0.0))
        for sample in (row.sample, library.load(entry.id, folder))
    )
    return [f"{each.index:.2f}" for each in metamerism.compare(one, other, lights)[1:]]


def _several(entry: Entry) -> tuple[str, ...]:
    """Give the last column, which only sets have."""
    return (f"{entry.readings} readings",) if entry.readings > 1 else ()


def _near(options: argparse.Namespace) -> Row:
    """Read what --near says."""
    from ...samples import palette

    try:
        light = palette.checked_light(options.illuminant, options.observer)
    except DomainError as error:
        raise InputError(f"The {error}.") from None
    color = options.near
    lab = palette.of_text(color)
    if lab is None:
        msg = f"--near is {color!r}; give '#rrggbb' or 'L,a,b' with L from 0 to 100."
        raise InputError(msg)
    return palette.Row("", lab, *(("D65", 2) if palette.is_code(color) else light))
