# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""MaterialX 1.39: an OpenPBR surface without gloss, whose diffuse is EON, energy-compensated.

Colors are linear Rec.709; one that lies outside of it is in ACEScg, and says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import quoteattr

from ....core.lobes import EON
from ..entry import Entry
from ..names import about, creator, number, numbers
from ..spaces import ACESCG, REC709

NAME = "materialx"
TITLE = "MaterialX"
PLACE = 10
ENDING = "mtlx"
LOBES = (EON,)
SPACES = (REC709, ACESCG)


def content(entries: Sequence[Entry]) -> bytes:
    """Give the document: a surface and a material for each entry."""
    made = quoteattr(f"made by {creator()}")
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<materialx version="1.39" colorspace="lin_rec709" doc={made}>',
    ]
    for entry in entries:
        lines += _lines(entry)
    return "\n".join([*lines, "</materialx>", ""]).encode()


def _lines(entry: Entry) -> list[str]:
    surface = f"{entry.identifier}_surface"
    title, doc = quoteattr(entry.name), quoteattr(about(entry))
    inputs = (
        ("base_weight", "float", "1", ""),
        ("base_color", "color3", numbers(entry.color, ", "), f' colorspace="{entry.space}"'),
        ("base_diffuse_roughness", "float", number(entry.roughness), ""),
        ("specular_weight", "float", "0", ""),
    )
    return [
        f'  <open_pbr_surface name="{surface}" type="surfaceshader">',
        *(
            f'    <input name="{name}" type="{kind}" value="{value}"{space} />'
            for name, kind, value, space in inputs
        ),
        "  </open_pbr_surface>",
        f'  <surfacematerial name="{entry.identifier}" type="material" uiname={title} doc={doc}>',
        f'    <input name="surfaceshader" type="surfaceshader" nodename="{surface}" />',
        "  </surfacematerial>",
    ]
