# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""LuxCore: properties of rough matte materials, whose lobe is Oren-Nayar's qualitative model.

LuxCore renders in linear Rec.709. Its texture `irregulardata` holds the spectrum; LuxCore turns it
into RGB by a table of its own, and not under the material's light, so the color is given as RGB
and the texture is there for who wants it.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....core.lobes import QUALITATIVE
from ..entry import Entry
from ..names import about, creator, number, numbers, points
from ..spaces import REC709

NAME = "luxcore"
TITLE = "LuxCore"
PLACE = 60
ENDING = "luxcore.scn"
LOBES = (QUALITATIVE,)
SPACES = (REC709,)


def content(entries: Sequence[Entry]) -> bytes:
    """Give the properties: a material and a texture for each entry."""
    lines = [f"# made by {creator()}"]
    for entry in entries:
        wavelengths, values = points(entry, entry.reading)
        material = f"scene.materials.{entry.identifier}"
        texture = f"scene.textures.{entry.identifier}_spectrum"
        lines += [
            f"# {about(entry)}",
            f"{material}.type = roughmatte",
            f"{material}.kd = {numbers(entry.color)}",
            f"{material}.sigma = {number(entry.roughness)}",
            f"{texture}.type = irregulardata",
            f"{texture}.wavelengths = {numbers(wavelengths)}",
            f"{texture}.data = {numbers(values)}",
            f"{texture}.emission = 0",
        ]
    return "\n".join([*lines, ""]).encode()
