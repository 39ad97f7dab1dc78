# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`job`: one task of a render farm's job: a verb over many scenes, or over parts of them."""

from __future__ import annotations

import argparse
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...support.shown_text import heard, inform, tell
from ..work_list import share

if TYPE_CHECKING:
    from ..work_list import Unit

NAME = "job"
SUMMARY = "one task of a render farm's job: a verb over many .blend files, or parts of them"
DESCRIPTION = (
    "Do a verb for every scene of a list in this one process: with --shards for parts of each, "
    "with --task I/N only every N-th of them, from the I-th on. bake and merge get what they need "
    "to find each other's files below --output. What fails does not stop the others; it is named "
    "again at the end, and the exit status is the gravest of all."
)

_INTERRUPTED = 130


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `job`."""
    parser.add_argument(
        "words",
        nargs="+",
        metavar="WORD",
        help="after --, the verb and its options, also as one text; {name} and {file} in them "
        "stand for each scene's name and path",
    )
    parser.add_argument(
        "--files",
        nargs="+",
        default=[],
        metavar="PATH",
        help=".blend files, folders with all below, or texts with a path a line; without any the "
        "verb is done once",
    )
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="of bake, check and merge")
    parser.add_argument(
        "--task", type=share, default=(1, 1), metavar="I/N", help="which task of how many this is"
    )
    parser.add_argument(
        "--shards", type=int, default=1, metavar="S", help="parts that each scene is baked in; 1"
    )


def run(options: argparse.Namespace) -> int:
    """Do the task; exit status 0, or the gravest of its units."""
    from ....core.errors import InputError
    from .. import work_list
    from ..result import add

    words = shlex.split(options.words[0]) if len(options.words) == 1 else options.words
    if not words or words[0] == NAME:
        raise InputError("Name a verb after --, such as 'bake'; a job cannot hold a job.")
    if options.shards < 1:
        raise InputError(f"--shards is {options.shards}; give 1 or more.")
    if options.shards > 1 and words[0] not in ("bake", "merge"):
        raise InputError(f"--shards is for bake and merge; leave it out for {words[0]}.")
    every = work_list.units(options.files, options.shards, whole=words[0] != "bake")
    index, count = options.task
    mine = every[index - 1 :: count]
    done: list[dict[str, Any]] = []
    for number, unit in enumerate(mine):
        _tell_place(number, len(mine), unit)
        status, error, result = options.call(unit.words(words, options.output))
        done.append({"unit": str(unit), "status": status, "error": error, "result": result})
        if status == _INTERRUPTED:
            break
    heard().share = (0.0, 1.0)
    failed = [each for each in done if each["status"]]
    add(options, units=done, of=len(every), failed=len(failed))
    if not failed:
        inform(f"{len(done)} of {len(every)} units of the job done by this task, none failed")
        return 0
    worst = max(failed, key=lambda each: each["status"])
    reason = worst["error"] or "a ΔE00 exceeds the limit, as named above"
    tell(
        f"rough_spectra job: {len(failed)} of {len(mine)} units failed; {worst['unit']} ended "
        f"with status {worst['status']}: {reason}"
    )
    return int(worst["status"])


def _tell_place(number: int, count: int, unit: Unit) -> None:
    """Say which unit begins, and let its progress be that of the task."""
    said = heard()
    said.share = (number / count, (number + 1) / count)
    inform(f"unit {number + 1} of {count}: {unit}")
