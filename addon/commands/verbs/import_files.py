# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`import`: add the samples of measurement files to the library."""

from __future__ import annotations

import argparse
from pathlib import Path

from ....core.errors import InputError
from ...support.shown_text import inform, out, tell
from . import assign

NAME = "import"
SUMMARY = "add the samples of measurement files to the library"
DESCRIPTION = (
    "Add the samples of measurement files to the user's library, all of them or none. What was "
    "added is printed on standard output, what to know of it on standard error."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `import`."""
    parser.add_argument(
        "files", type=Path, nargs="+", metavar="FILE", help="measurement files of any format"
    )
    parser.add_argument(
        "--collection", default="", metavar="NAME", help="where to add; without it each file's name"
    )
    parser.add_argument(
        "--folder", type=Path, metavar="DIR", help="another library than the user's own"
    )
    assign.add_white_arguments(parser)
    parser.add_argument(
        "--keep-going",
        action="store_true",
        help="add the other files' samples when one cannot be used; the exit status is 2 even so",
    )


def run(options: argparse.Namespace) -> int:
    """Read all, then add all; exit status 0, or 2 where a file was left out."""
    from ...material import preferences
    from ...samples import importing

    batch = importing.read(options.files)
    if batch.refused and not options.keep_going:
        raise InputError(batch.refused[0])
    found = importing.relative_to(batch.found, options.white, options.white_factor)
    told = ((each.path, sentence) for each in found for sentence in each.sentences)
    for path, sentence in dict.fromkeys(told):  # what is so of all samples of a file is said once
        tell(f"warning: {path}: {sentence}")
    folder = options.folder or preferences.user_folder()
    added = importing.add(found, options.collection, folder) if found else []
    for each_added in added:
        for sample_id in each_added.ids:
            out(sample_id)
    for sentence in batch.refused:
        tell(f"rough_spectra import: {sentence}")
    inform(f"{importing.summary(added)}, {folder}")
    return 2 if batch.refused else 0
