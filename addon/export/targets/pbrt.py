# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""pbrt-4: named materials with spectra, for `Include` in a scene. Its diffuse is Lambert's law."""

from __future__ import annotations

from collections.abc import Sequence

from ....core.lobes import LAMBERT
from ..entry import Entry
from ..names import about, creator, number, points
from ..spaces import SPECTRA

NAME = "pbrt"
TITLE = "pbrt-4"
PLACE = 50
ENDING = "pbrt"
LOBES = (LAMBERT,)
SPACES = (SPECTRA,)


def content(entries: Sequence[Entry]) -> bytes:
    """Give the fragment: a named material for each entry."""
    lines = [f"# made by {creator()}"]
    for entry in entries:
        pairs = zip(*points(entry, entry.color), strict=True)
        spectrum = " ".join(f"{number(nm)} {number(value)}" for nm, value in pairs)
        lines += [
            "",
            f"# {about(entry)}",
            f'MakeNamedMaterial "{entry.identifier}" "string type" "diffuse"',
            f'    "spectrum reflectance" [ {spectrum} ]',
        ]
    return "\n".join([*lines, ""]).encode()
