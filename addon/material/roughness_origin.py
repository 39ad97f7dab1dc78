# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose a material's roughness is: the user's, the sample's own, or nobody's, which is a guess."""

from __future__ import annotations

from typing import Any

from . import snapshot

GUESS = "Roughness is a guess"
"""In so few words it stands in the closed panel."""


def is_sigma_set(material: Any) -> bool:
    """Whether a material's σ is the user's, and not the one that its sample came with.

    So is that of a material of an earlier version, of which nobody knows.
    """
    group = material.rough_spectra
    own = snapshot.entered_degrees(group.own_sigma)
    return own < 0 or own != snapshot.sigma_degrees(group)


def is_guess(material: Any) -> bool:
    """Whether neither the user nor the sample says how rough it is; cheap to ask while drawing."""
    group = material.rough_spectra
    return not group.sigma_source and group.own_sigma == 0.0 and not is_sigma_set(material)


def told(material: Any) -> str:
    """Say where the roughness of a material with a spectrum comes from."""
    group = material.rough_spectra
    if is_guess(material):
        return "a guess, as the sample states none"
    own = snapshot.entered_degrees(group.own_sigma)
    if own < 0 or not is_sigma_set(material):
        return str(group.sigma_source)
    if not group.sigma_source and own == 0:
        return "you; the sample states none"
    about = f" ({group.sigma_source})" if group.sigma_source else ""
    return f"you; the sample's own is {own:g}°{about}"
