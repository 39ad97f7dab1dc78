# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`merge`: join the parts of a sharded bake, and judge them."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...support.shown_text import inform
from .bake import add_format_argument, tell_faults

NAME = "merge"
SUMMARY = "join the parts that bake --shard wrote"
DESCRIPTION = (
    "Join the parts of a bake into the files that one bake of everything would have written, byte "
    "for byte."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `merge`."""
    parser.add_argument("parts", type=Path, nargs="+", metavar="PART.json")
    parser.add_argument("--output", type=Path, required=True, metavar="BASE")
    add_format_argument(parser)
    parser.add_argument(
        "--max-delta-e",
        type=float,
        metavar="ΔE00",
        help="judge as check does: exit status 1 if any ΔE00 exceeds this",
    )


def run(options: argparse.Namespace) -> int:
    """Join, write and judge; exit status as that of one bake, or 1 where a ΔE00 is too large."""
    from ... import api
    from ...readings import document, json_document, writers
    from ...support import journal
    from ..judgement import check_limit, judge
    from ..progress import counted
    from ..result import add

    limit = getattr(options, "max_delta_e", None)
    check_limit(limit)
    writers.check(options.output)
    for folder in sorted({path.parent for path in options.parts}):
        journal.finish(folder)  # a document of a killed bake may wait for its name
    result = document.merge(json_document.from_json(path) for path in options.parts)
    written = api.write(result, options.output, options.format or writers.FORMATS)
    names = ", ".join(path.name for path in written)
    add(options, files=written, readings=len(result.entries))
    inform(f"{counted(len(result.entries), 'reading')}; wrote {names}")
    failed = 0 if limit is None else judge(result, limit, options)
    return tell_faults(result) or failed
