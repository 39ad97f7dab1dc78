# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mitsuba 3: named BSDFs with spectra, for `<include>` in a scene.

Mitsuba has no Oren-Nayar. `diffuse` is Lambert's law; the diffuse lobe of `principled` bends
grazing light by its roughness. Each material gets the one that comes closer.
"""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import escape

from ....core.lobes import DISNEY, LAMBERT
from ..entry import Entry
from ..names import about, creator, number, points
from ..spaces import SPECTRA

NAME = "mitsuba"
TITLE = "Mitsuba 3"
PLACE = 40
ENDING = "mitsuba.xml"
LOBES = (LAMBERT, DISNEY)
SPACES = (SPECTRA,)


def content(entries: Sequence[Entry]) -> bytes:
    """Give the scene, which holds BSDFs and nothing else."""
    lines = [f"<!-- made by {creator()} -->", '<scene version="3.0.0">']
    for entry in entries:
        lines += _lines(entry)
    return "\n".join([*lines, "</scene>", ""]).encode()


def _lines(entry: Entry) -> list[str]:
    # A comment ends at two hyphens.
    said = escape(about(entry)).replace("--", "- -")
    pairs = ", ".join(
        f"{number(nm)}:{number(value)}"
        for nm, value in zip(*points(entry, entry.color), strict=True)
    )
    is_rough = entry.lobe is DISNEY
    kind, color = ("principled", "base_color") if is_rough else ("diffuse", "reflectance")
    rest = [
        f'      <float name="roughness" value="{number(entry.roughness)}" />',
        '      <float name="specular" value="0" />',
    ]
    return [
        f"  <!-- {said} -->",
        f'  <bsdf type="twosided" id="{entry.identifier}">',
        f'    <bsdf type="{kind}">',
        f'      <spectrum name="{color}" value="{pairs}" />',
        *(rest if is_rough else []),
        "    </bsdf>",
        "  </bsdf>",
    ]
