# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which white a reading is relative to, and what makes it relative to the perfect diffuser.

An instrument divides by what it got from a white plaque and multiplies by the value that the
plaque's certificate states. Where that value is of another geometry than the instrument's, the
scale is off by what the plaque departs from a perfect diffuser:

    reading relative to the perfect diffuser
        = value · (true reflectance factor of the plaque at the instrument's geometry)
                / (value of the certificate)

Sources: ASTM E259 and CIE 46, on white standards; T. A. Germer, "Full four-dimensional and
reciprocal Mueller matrix bidirectional reflectance distribution function of sintered
polytetrafluoroethylene", Applied Optics 56, 2017, measured at NIST.

Blender reads this at its start: nothing here may import numpy.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from .errors import DomainError
from .instruments import HEMISPHERE, Instrument, find


@dataclass(frozen=True)
class White:
    """What values are relative to.

    Attributes
    ----------
    name
        What code and files call it; of a certificate, its geometry.
    menu, description
        What the panel calls it, and its tooltip.
    number
        What a .blend stores for it: never changed, and never given to another.
    """

    name: str
    menu: str
    description: str
    number: int


PERFECT = "perfect"
"""Name of the perfect diffuser, which files mean that say nothing."""

REGISTRY: Mapping[str, White] = MappingProxyType(
    {
        white.name: white
        for white in (
            White(PERFECT, "Perfect Diffuser", "Values are reflectance factors as they stand", 0),
            White(
                "45:0",
                "45°/0° Certificate",
                "The instrument's white plaque was entered with its value at 45°/0°",
                1,
            ),
            White(
                "8:d",
                "8°/d Certificate",
                "The instrument's white plaque was entered with its value of a sphere, 8°/d",
                2,
            ),
        )
    }
)
"""Every white by its name."""

PTFE = "ptfe"
"""Name of the plaque of sintered PTFE (Spectralon, Zenith, Fluorilon and others)."""

STATED, UNKNOWN = "stated", "unknown"
"""What a menu of plaques has for one whose factor is stated, and for one that nobody knows."""

PTFE_FACTORS: Mapping[str, float] = MappingProxyType({"45:0": 1.0156, "8:d": 0.99})
"""Reflectance factor of sintered PTFE by geometry: as NIST measured it at 45°/0°, and as
certificates of a sphere say. Pieces differ by some thousandths, and a little with wavelength."""

FACTORS = (0.5, 2.0)
"""Smallest and largest factor that a plaque may have: beyond, it is a slip of the pen."""


def parse(text: str) -> str | None:
    """Give the name of the white that words mean; None if they mean none.

    Examples
    --------
    >>> parse("perfect diffuser"), parse("45°/0°"), parse("d/8"), parse("white")
    ('perfect', '45:0', '8:d', None)
    """
    words = re.sub(r"[°\s]", "", text.lower()).replace("/", ":")
    if words.startswith(PERFECT):
        return PERFECT
    if words in ("45:0", "0:45", "45a:0", "45x:0"):
        return "45:0"
    return "8:d" if words in ("8:d", "d:8", "8:di", "8:de", "di:8", "de:8", "8:h") else None


def geometry_of(instrument: str) -> str:
    """Give the geometry of an instrument as certificates have it; empty if they have it not.

    Examples
    --------
    >>> geometry_of("0:45a-iso"), geometry_of("de:8"), geometry_of("45as45"), geometry_of("45as15")
    ('45:0', '8:d', '45:0', '')
    """
    found: Instrument = find(instrument)
    if HEMISPHERE in (found.light, found.view):
        return "8:d"
    return "45:0" if {found.light.tilt, found.view.tilt} == {45.0, 0.0} else ""


def factor(white: str, instrument: str, stated: float | None = None, plaque: str = "") -> float:
    """Give what values are multiplied by to be relative to the perfect diffuser.

    Parameters
    ----------
    white
        A name of `REGISTRY`.
    instrument
        A name of `core.instruments.REGISTRY`.
    stated
        The plaque's true reflectance factor at this instrument's geometry over the value that its
        certificate states; None where that is not known.
    plaque
        `PTFE`, or empty where it is another or not known.

    Raises
    ------
    DomainError
        If it does not follow from these; see `fault`.

    Examples
    --------
    >>> round(factor("8:d", "45a:0", plaque=PTFE), 5)
    1.02586
    >>> factor("8:d", "di:8"), factor("45:0", "45a:0"), factor("8:d", "45a:0", 1.018)
    (1.0, 1.0, 1.018)
    """
    wrong = fault(white, instrument, stated, plaque)
    if wrong:
        msg = f"Relative to the white {white!r}: {wrong}."
        raise DomainError(msg)
    if stated is not None:
        return stated
    geometry = geometry_of(instrument)
    if white in (PERFECT, geometry):
        return 1.0
    return PTFE_FACTORS[geometry] / PTFE_FACTORS[white]


def fault(white: str, instrument: str, stated: float | None = None, plaque: str = "") -> str:
    """Say why the factor does not follow, as the end of a sentence; empty if it does.

    Parameters as of `factor`.

    Examples
    --------
    >>> fault("8:d", "di:8")
    ''
    >>> fault("8:d", "45a:0")
    "the white's certificate is of 8:d and the reading of 45a:0; give the factor between, or the \
plaque, such as ptfe"
    """
    if white not in REGISTRY:
        return f"the white is {white!r}; make it one of {', '.join(REGISTRY)}"
    if plaque not in ("", PTFE):
        return f"the plaque is {plaque!r}; make it {PTFE!r}, or give its factor"
    if stated is not None:
        if white == PERFECT and stated != 1:
            return f"the perfect diffuser has no factor, and it is {stated:g}; name another white"
        if plaque:
            return "both a plaque and its factor are given; leave one of them out"
        lowest, highest = FACTORS
        if not lowest <= stated <= highest:
            return (
                f"the white's factor is {stated:g}; it is the plaque's true value over that of its "
                "certificate, near 1"
            )
        return ""
    if white in (PERFECT, geometry_of(instrument)):
        return ""
    if not plaque:
        return (
            f"the white's certificate is of {white} and the reading of {instrument}; give the "
            f"factor between, or the plaque, such as {PTFE}"
        )
    if not geometry_of(instrument):
        return f"the factor of {plaque} at {instrument} is not known; give it"
    return ""
