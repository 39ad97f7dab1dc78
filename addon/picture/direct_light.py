# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether direct light is to be rendered apart, which is exact and takes renders of its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ...core.bands import IN_A_PASS, Bands

_COST = 0.5
"""What a render without bounces takes of one with, about."""


class Choice(NamedTuple):
    """What was decided.

    Parameters
    ----------
    bands
        Those to render.
    apart
        Whether direct light has renders of its own.
    is_all
        Whether there is no other light: then nothing is rendered in bands.
    words
        Why, for who left it to us; empty otherwise.
    """

    bands: Bands
    apart: bool
    is_all: bool
    words: str


def decide(
    scene: Any, asked: bool | None, lamps: int, is_counted: bool, choose: Callable[[bool], Bands]
) -> Choice:
    """Decide, from what is predicted; nothing is rendered.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`.
    asked
        What was asked for, or None where it is for us to say.
    lamps
        Different spectra of light, each of which is a render more.
    is_counted
        Whether a number of bands was asked for.
    choose
        Gives the bands, with direct light apart or not.
    """
    if asked is not None:
        return Choice(choose(asked), asked, False, "")
    if scene.cycles.use_denoising:  # which parts of a picture cannot have
        return Choice(choose(False), False, False, "")
    if not bounces(scene.cycles):
        return Choice(choose(True), True, True, "there is no other, so every color is exact")
    together = choose(False)
    if is_counted:
        return Choice(together, False, False, "")
    apart = choose(True)
    renders = [len(each.wavelengths) // IN_A_PASS for each in (together, apart)]
    cheaper = renders[1] + _COST * lamps < renders[0]
    if not apart.enough or (together.enough and not cheaper):
        return Choice(together, False, False, "")
    if not together.enough:
        words = "bands alone are not within the tolerance"
    else:
        words = f"as bands alone need {renders[0]} renders"
    return Choice(apart, True, False, words)


def bounces(cycles: Any) -> bool:
    """Whether light may meet more than one surface."""
    kinds = ("diffuse_bounces", "glossy_bounces", "transmission_bounces", "volume_bounces")
    return cycles.max_bounces > 0 and any(getattr(cycles, kind) > 0 for kind in kinds)
