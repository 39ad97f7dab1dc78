# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Zip files whose bytes depend on nothing but their content."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Mapping
from pathlib import Path

# The earliest moment a zip file can state; any fixed one would do.
EPOCH = (1980, 1, 1, 0, 0, 0)
REGULAR_FILE_MODE = 0o100644 << 16
MADE_ON_UNIX = 3


def read(path: Path) -> dict[str, bytes]:
    """Return the files of a zip by name, folders left out."""
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}


def write(path: Path, files: Mapping[str, bytes]) -> None:
    """Write a zip in the order of `files`, beside its target first and renamed when whole."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with zipfile.ZipFile(part, "w") as archive:
            for name, content in files.items():
                entry = zipfile.ZipInfo(name, EPOCH)
                entry.compress_type = zipfile.ZIP_DEFLATED
                entry.create_system = MADE_ON_UNIX
                entry.external_attr = REGULAR_FILE_MODE
                archive.writestr(entry, content, compresslevel=9)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
