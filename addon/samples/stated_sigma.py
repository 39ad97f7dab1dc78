# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ as files and options state it: in degrees, or as the Rdq or Sdq that a profilometer printed.

`core.roughness` converts; here stands what may be stated, what contradicts itself, and the words
that keep a slope as the source of σ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from ...core import roughness
from ...core.limits import MATCHED_SIGMA, MATCHED_SIGMA_DEGREES

CLOSE_DEGREES = 0.5
"""Two statements of one σ may be so far apart: it is what rounding to whole degrees makes."""


_ROUNDING = 1e-9


class Names(NamedTuple):
    """What a file or an option calls the three."""

    degrees: str = "sigma_degrees"
    rdq: str = "rdq"
    sdq: str = "sdq"


FIELDS = Names()
"""Of presets and of the library's files."""


def largest(slope: str) -> float:
    """Give the largest Rdq ("rdq") or Sdq ("sdq") of a material."""
    give = roughness.rdq_from_sigma if slope == "rdq" else roughness.sdq_from_sigma
    return float(give(MATCHED_SIGMA)) * (1 + _ROUNDING)


@dataclass(frozen=True)
class StatedSigma:
    """What one place states of σ; None where it does not.

    Parameters
    ----------
    degrees
        σ itself.
    rdq, sdq
        Rms slope of a profile, and of an area: rise over run.
    """

    degrees: float | None = None
    rdq: float | None = None
    sdq: float | None = None

    def fault(self, names: Names = FIELDS) -> tuple[str, str]:
        """Give the name of what is wrong, and the end of a sentence; both empty if nothing.

        σ in degrees is left to `core.limits.sigma_fault`: files keep one that is too large.
        """
        for name, value, most, what in (
            (names.rdq, self.rdq, largest("rdq"), "a profile"),
            (names.sdq, self.sdq, largest("sdq"), "an area"),
        ):
            if value is None or 0 <= value <= most:
                continue
            beyond = (
                f"materials are matched up to {most:.4g}, which is σ = {MATCHED_SIGMA_DEGREES:g}°; "
                f"if the instrument printed degrees, give them as {names.degrees}"
            )
            slope = f"it is the rms slope of {what}, rise over run; give 0 or more"
            return name, f"{name} is {value:g}, and {beyond if value > most else slope}"
        given = [(name, degrees, told) for name, degrees, told in self._each(names)]
        for name, degrees, told in given[1:]:
            first, other, first_told = given[0]
            if not abs(degrees - other) <= CLOSE_DEGREES:
                return name, (
                    f"{first} and {name} contradict each other: {first_told} against {told}; "
                    "leave out the one that is wrong"
                )
        return "", ""

    @property
    def settled(self) -> float | None:
        """σ in degrees; as stated, else from Rdq, else from Sdq."""
        each = self._each(FIELDS)
        return each[0][1] if each else None

    @property
    def slope(self) -> str:
        """The slope in words, such as "Rdq 0.35 (19.3°)"; empty without one."""
        return next((told for name, _, told in self._each(FIELDS) if name != FIELDS.degrees), "")

    def source(self, about: str) -> str:
        """Give where σ comes from: the slope that was stated, and what else is known of it."""
        return ": ".join(filter(None, (self.slope, about)))

    def _each(self, names: Names) -> list[tuple[str, float, str]]:
        """Give the name of each that is stated, its σ in degrees, and its words."""
        found = []
        if self.degrees is not None:
            found.append((names.degrees, self.degrees, f"σ {self.degrees:g}°"))
        for name, word, value, convert in (
            (names.rdq, roughness.RDQ, self.rdq, roughness.sigma_from_rdq),
            (names.sdq, roughness.SDQ, self.sdq, roughness.sigma_from_sdq),
        ):
            if value is not None:
                degrees = _degrees(float(convert(value)))
                found.append((name, degrees, f"{word} {value:g} ({degrees:.1f}°)"))
        return found


def _degrees(sigma: float) -> float:
    # Within the last digit of the largest one, which the way through radians may exceed.
    return min(math.degrees(sigma), MATCHED_SIGMA_DEGREES)
