# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Instruments: from where they light a surface, and from where they look at it.

An instrument compares the flux it receives from a surface with the flux from a perfect white
diffuser under the same light. That makes its reading the mean of the reflectance factor over all
pairs of a direction of its source and one of its detector, each weighted with its projected solid
angle, cos θ dω; `core.instruments.quadrature` makes a quadrature of that.

An instrument is added by one record in `_INSTRUMENTS`. Everything that lists instruments follows:
readings by every model, the menu of the panel, what files may name, the words for geometries in
them, and the tables of the manual.

Where the angles come from: CIE 15:2004, section 5.2, for the annulus between cones of half-angle
40° and 50° and for detectors of half-angle 5° (ISO 13655 and ISO 5-4 use the same), around the
normal or around 8°; ASTM E2194 (15°, 45°, 110°), DIN 6175-2 (25°, 75°) and ASTM E2539 (-15°) for
aspecular angles. The size of the gloss trap is ours, see `TRAP`.

Blender reads this at its start: nothing here may import numpy.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from ..errors import DomainError

APERTURE = 5.0
"""Half-angle of every detector, of the source of 45x:0, and half the width of a ring; degrees."""

TRAP = 6.0
"""Half-angle of the gloss trap of de:8, seen from the surface, degrees. What is asked of it is that
a mirror show nothing to the detector, which the detector's cone and 1° more do; makers' sizes vary.
"""


@dataclass(frozen=True)
class Beam:
    """Directions that a source lights from, or that a detector looks from. Degrees.

    Attributes
    ----------
    tilt
        Between the normal and the axis, or the middle of a ring.
    half_angle
        Of the cone around the axis, or half the width of the ring; 0 for one direction.
    all_around
        Whether it is a ring: the same from every azimuth.
    """

    tilt: float = 0.0
    half_angle: float = 0.0
    all_around: bool = False

    @property
    def is_symmetric(self) -> bool:
        """Whether it looks the same from every azimuth."""
        return self.all_around or self.tilt == 0


NORMAL = Beam()
HEMISPHERE = Beam(45.0, 45.0, all_around=True)


@dataclass(frozen=True, eq=False)
class Instrument:
    """One instrument.

    Attributes
    ----------
    name
        What code and files call it: ASCII, influx, colon, efflux.
    title
        What a person calls it; up to a comma in the notes of readers.
    menu, description
        What the panel calls it, and its tooltip, which Blender ends with a period.
    number
        What a .blend stores for it: never changed, and never given to another.
    light, view
        Where it lights from, and looks from.
    azimuth
        Degrees between the two, where neither is symmetric about the normal.
    trap
        Half-angle, degrees, of a gloss trap in the mirror direction of the detector; 0 without.
    aspecular
        Degrees of the view from the mirror direction, positive toward the light; for instruments
        that files name by it.
    """

    name: str
    title: str
    menu: str
    description: str
    number: int
    light: Beam
    view: Beam
    azimuth: float = 0.0
    trap: float = 0.0
    aspecular: int | None = None


def find(name: str) -> Instrument:
    """Give the instrument of this name.

    Raises
    ------
    DomainError
        If there is none; the message lists the names.

    Examples
    --------
    >>> find("di:8").title
    'di:8°, sphere with specular included'
    >>> find("45as15").view.tilt, find("45as15").azimuth
    (30.0, 180.0)
    """
    if name not in REGISTRY:
        msg = f"Instrument {name!r} is not known; choose one of: {', '.join(REGISTRY)}."
        raise DomainError(msg)
    return REGISTRY[name]


def spoken(name: str) -> str:
    """Say an instrument in a sentence, as "at …": the default one as everybody calls it.

    Raises
    ------
    DomainError
        As in `find`.

    Examples
    --------
    >>> spoken("45a:0"), spoken("di:8")
    ('45°/0°', 'di:8° Sphere')
    """
    return "45°/0°" if name == DEFAULT else find(name).menu


def has_apertures(name: str) -> bool:
    """Whether an instrument lights from, or looks from, more than directions without width.

    Raises
    ------
    DomainError
        As in `find`.

    Examples
    --------
    >>> has_apertures("di:8"), has_apertures("45a:0")
    (True, False)
    """
    instrument = find(name)
    return bool(instrument.light.half_angle or instrument.view.half_angle)


def _multi_angle(aspecular: int, number: int) -> Instrument:
    """Make a view of light at 45°, from so far from its mirror direction."""
    # The mirror direction lies at -45°, on the far side of the normal.
    view = aspecular - 45
    title = f"45°:as{aspecular}°"
    where = "beyond" if aspecular < 0 else "from"
    return Instrument(
        name=f"45as{aspecular}",
        title=title,
        menu=title,
        description=f"Light at 45°, view {abs(aspecular)}° {where} the mirror direction",
        number=number,
        light=Beam(45.0),
        view=Beam(float(abs(view))),
        azimuth=180.0 if view < 0 else 0.0,
        aspecular=aspecular,
    )


_RING = Beam(45.0, all_around=True)
_WIDE_RING = Beam(45.0, APERTURE, all_around=True)
_CONE = Beam(0.0, APERTURE)
_DETECTOR = Beam(8.0, APERTURE)

_INSTRUMENTS = (
    Instrument(
        name="45a:0",
        title="45°a:0°, ideal",
        menu="45°a:0°",
        description="Ring light at 45°, view along the normal",
        number=0,
        light=_RING,
        view=NORMAL,
    ),
    Instrument(
        name="0:45a",
        title="0°:45°a, ideal",
        menu="0°:45°a",
        description="Light along the normal, view from a ring at 45°",
        number=1,
        light=NORMAL,
        view=_RING,
    ),
    Instrument(
        name="45x:0",
        title="45°x:0°, ideal",
        menu="45°x:0°",
        description="Light from one side at 45°, view along the normal",
        number=2,
        light=Beam(45.0),
        view=NORMAL,
    ),
    Instrument(
        name="45a:0-iso",
        title="45°a:0° with the apertures of ISO 13655",
        menu="45°a:0° with Apertures",
        description="As 45°a:0°, over the apertures of ISO 13655",
        number=3,
        light=_WIDE_RING,
        view=_CONE,
    ),
    Instrument(
        name="0:45a-iso",
        title="0°:45°a with the apertures of ISO 13655",
        menu="0°:45°a with Apertures",
        description="As 0°:45°a, over the apertures of ISO 13655",
        number=4,
        light=_CONE,
        view=_WIDE_RING,
    ),
    Instrument(
        name="45x:0-iso",
        title="45°x:0° with the apertures of ISO 13655",
        menu="45°x:0° with Apertures",
        description="As 45°x:0°, over the apertures of ISO 13655",
        number=5,
        light=Beam(45.0, APERTURE),
        view=_CONE,
    ),
    Instrument(
        name="di:8",
        title="di:8°, sphere with specular included",
        menu="di:8° Sphere",
        description="Light from a sphere, view at 8°, specular included",
        number=6,
        light=HEMISPHERE,
        view=_DETECTOR,
    ),
    Instrument(
        name="de:8",
        title="de:8°, sphere with specular excluded",
        menu="de:8° Sphere",
        description="Light from a sphere, view at 8°, specular excluded",
        number=7,
        light=HEMISPHERE,
        view=_DETECTOR,
        trap=TRAP,
    ),
    _multi_angle(-15, number=8),
    _multi_angle(15, number=9),
    _multi_angle(25, number=10),
    _multi_angle(45, number=11),
    _multi_angle(75, number=12),
    _multi_angle(110, number=13),
)

REGISTRY: Mapping[str, Instrument] = MappingProxyType(
    {instrument.name: instrument for instrument in _INSTRUMENTS}
)
"""Every instrument by its name."""

DEFAULT = _INSTRUMENTS[0].name
"""Meant wherever no instrument is named."""
