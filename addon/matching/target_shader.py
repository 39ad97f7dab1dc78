# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be known of a node that can be made to read like a sample."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class TargetShader:
    """One target shader.

    Attributes
    ----------
    name
        What code and files call it; the command line does in small letters.
    title, description
        What the panel calls it, as Blender does, and its tooltip, which Blender ends with a period.
    number
        What a .blend stores for it: never changed, and never given to another. 0 is taken by the
        shader that is there.
    lobe
        What it shows of light, and so what color and roughness are solved for: "diffuse" is
        `core.cycles.lobe`, the only one that `solve` knows.
    is_default
        Whether it is made where a material has none. One of them is.
    """

    name: str
    title: str
    description: str
    number: int
    lobe: str = "diffuse"
    is_default: bool = False
