# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`validate`: say everything that is wrong with preset files."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...support.shown_text import inform, tell

NAME = "validate"
SUMMARY = "say everything that is wrong with preset files"
DESCRIPTION = (
    "Check preset files: every fault is one line with file, field and remedy. Exit status 2 if "
    "there is any. What to know of a spectrum that can be used is said too, as a remark."
)
_UNUSABLE = 2


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `validate`."""
    parser.add_argument(
        "files",
        type=Path,
        nargs="+",
        metavar="FILE",
        help="preset files, or folders of them",
    )


def run(options: argparse.Namespace) -> int:
    """Check all files; exit status 0 or 2."""
    from ....core.errors import InputError
    from ...samples import preset_validation

    files = [path for given in options.files for path in _presets(given)]
    if not files:
        msg = f"{options.files[0]}: there is no .json file in this folder; name preset files."
        raise InputError(msg)
    faults = 0
    for path in files:
        verdict = preset_validation.validate(path)
        faults += len(verdict.faults)
        for sentence in verdict.faults:
            tell(sentence)
        for sentence in verdict.remarks:
            tell(f"remark: {sentence}")
    inform(f"{len(files)} presets, {faults} faults")
    return _UNUSABLE if faults else 0


def _presets(given: Path) -> list[Path]:
    """Give a file itself, and the presets in a folder; the schema beside them is none."""
    if not given.is_dir():
        return [given]
    return sorted(path for path in given.rglob("*.json") if path.name != "schema.json")
