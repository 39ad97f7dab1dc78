# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The colors of a scene's materials, lamps and world, with the spectra that they stand for."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ...core.gloss import Gloss
from ...core.numerics.arrays import Array
from .places import Place


@dataclass(frozen=True, eq=False)
class Measured:
    """A surface with a measured spectrum.

    Parameters
    ----------
    place
        Of its color.
    reading
        At the virtual instrument, at `illuminant_spectra.GRID`.
    roughness, read_at, gloss
        Cycles' diffuse roughness, the instrument, and what lies over the diffuse lobe.
    name
        By which its material is told.
    whole
        Its sample's wavelengths, whatever they are, and the reading there, shape (2, bands).
    """

    place: Place
    reading: Array
    roughness: float
    read_at: str
    gloss: Gloss | None
    name: str = ""
    whole: Array | None = None


@dataclass(frozen=True, eq=False)
class Colored:
    """A surface of which RGB is known; `rgb` is None where another node sets it.

    `name` is by which its material is told.
    """

    place: Place
    rgb: Array | None
    name: str = ""


@dataclass(frozen=True, eq=False)
class Shining:
    """What sends light.

    Parameters
    ----------
    place
        Of its color.
    spectrum
        At `GRID`, with a luminance of 1; None where another node sets the color.
    strength
        Luminance of the color, or by what a color of another node is multiplied, shape (3,).
    name, called
        By which it is told, such as "Light 'Sun'", and what the lamp, world or material is called.
    kelvin
        Temperature that is set for it, or None.
    picked
        Mean of its color's channels, by which Cycles picks it among other lamps; None where
        another node sets the color.
    """

    place: Place
    spectrum: Array | None
    strength: Array
    name: str = ""
    called: str = ""
    kelvin: float | None = None
    picked: float | None = None


@dataclass(eq=False)
class Colors:
    """All that was found.

    Parameters
    ----------
    measured, colored, shining
        Surfaces and lamps.
    reset
        Attributes and what they have to be in all renders, because `shining` has taken them over.
    told
        Names of materials, lamps and world, and the rules by which they got their spectra.
    untranslated
        Names, and what of them stays red, green and blue.
    """

    measured: list[Measured] = field(default_factory=list)
    colored: list[Colored] = field(default_factory=list)
    shining: list[Shining] = field(default_factory=list)
    reset: list[tuple[Place, Any]] = field(default_factory=list)
    told: dict[str, list[str]] = field(default_factory=dict)
    untranslated: dict[str, list[str]] = field(default_factory=dict)

    def tell(self, name: str, rule: str) -> None:
        """Note a rule once."""
        rules = self.told.setdefault(name, [])
        if rule not in rules:
            rules.append(rule)

    def leave(self, name: str, what: str) -> None:
        """Note what stays red, green and blue."""
        left = self.untranslated.setdefault(name, [])
        if what not in left:
            left.append(what)
