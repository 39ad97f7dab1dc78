# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""USD by Blender's own exporter: a square for each material, with a UsdPreviewSurface.

Its diffuse is Lambert's law below a gloss that an index of 1 takes away. Spectrum and σ are
attributes of each material, `rough_spectra:…`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from ....core.lobes import LAMBERT
from ..entry import Entry
from ..spaces import REC709

NAME = "usd"
TITLE = "USD"
PLACE = 20
ENDING = "usda"
LOBES = (LAMBERT,)
SPACES = (REC709,)
NEEDS = "usd"


def content(entries: Sequence[Entry]) -> Callable[[Path], None]:
    """Give what has the file written."""

    def write(path: Path) -> None:
        from .. import usd_job

        usd_job.write(entries, path)

    return write
