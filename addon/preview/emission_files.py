# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What samples emit, into files: two tables, and a picture of each sample."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..readings import emission_tables
from ..readings.emission import Emissivity
from ..support import atomic_files, png
from .figures import emission


def write(found: Sequence[Emissivity], base: Path) -> list[Path]:
    """Write BASE.csv, BASE.bands.csv and BASE.png, all of them or none.

    Of several samples the pictures are BASE.1.png and so on.

    Raises
    ------
    OutputError
        A file cannot be written or replaced; none was touched.
    """
    atomic_files.check_base(base)
    written = []

    def named(ending: str) -> Path:
        written.append(base.with_name(f"{base.name}.{ending}"))
        return written[-1]

    with atomic_files.publication() as files:
        files.write(named("csv"), emission_tables.spectra(found))
        if any(each.bands for each in found):
            files.write(named("bands.csv"), emission_tables.bands(found))
        for number, each in enumerate(found, start=1):
            ending = "png" if len(found) == 1 else f"{number}.png"
            files.write(named(ending), png.encode(emission.picture(each)))
    return written
