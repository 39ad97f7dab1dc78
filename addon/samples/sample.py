# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One measured spectrum, as every reader returns it: visible or not, reflectance or emissivity.

A `Sample` that exists is valid: its wavelengths increase, its values are finite and could be
reflectance. Whatever breaks that is refused here in one sentence that names the file, the place and
the remedy, so that no later code has to ask again. What a surface cannot do but an instrument can
print, such as a little noise below 0, is kept as measured; `quality` names it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core import white_scale
from ...core.errors import InputError
from ...core.instruments import REGISTRY
from ...core.limits import EYE_NM

Kind = Literal["reading", "albedo", "emissivity"]
KINDS: tuple[str, ...] = get_args(Kind)
KINDS_NAMED = "'reading', 'albedo' or 'emissivity'"

COLORED: tuple[str, ...] = KINDS[:2]
"""Kinds that a color is made from."""

# Wavelengths below are taken for micrometers, not for nanometers: reflectance is not measured in
# the extreme ultraviolet, and in micrometers these are the visible and the infrared.
SHORTEST_NM = 20.0
LONGEST_NM = 1e6  # 1 mm: the far end of the infrared

DEEPEST_NOISE = -0.05
"""A reading below this is not noise around black. It holds where the eye sees, as do the limits
below: outside, detectors end in noise of any size, which no color sees."""
BRIGHTEST = 4.0
"""A reading above this is not reflectance: the strongest daylight fluorescent colors reach 3. Nor
is it an emissivity if most of a spectrum lies above."""

MOST_GLOSS_UNITS = 2100.0
"""A mirror that loses nothing has 2038 at 20°, where black glass, of 100, reflects 4.9 %."""


@dataclass(frozen=True, eq=False)
class Sample:
    """One spectrum with everything its file says about it.

    Parameters
    ----------
    name
        What the user calls the sample.
    wavelengths
        Nanometers, increasing, shape ``(bands,)``, at least two; kept as a read-only float64 array.
    values
        Fractions as measured, shape ``(bands,)``; kept as a read-only float64 array. Within the
        visible range between `DEEPEST_NOISE` and `BRIGHTEST`; see `reflectance` for computing.
    kind
        ``"reading"`` for the reflectance factor at the instrument's geometry, ``"albedo"`` for the
        reflectance of one facet, ``"emissivity"`` for that of the rough surface, seen from where
        the instrument looks. The latter has no color.
    quantity
        What the file calls it, such as ``"reflectance factor"``, ``"radiance factor"`` or
        ``"directional-hemispherical reflectance"``. Never a transmittance, an absorbance or an
        emission of light: readers refuse those.
    instrument
        Geometry that the reading is computed with, one of `core.instruments.REGISTRY`; the nearest
        one where the file's own is not among them, and a note says so.
    geometry
        Geometry in the words of the file.
    aperture
        In the words of the file, with its unit.
    specular
        ``"SCI"`` or ``"SCE"`` where a sphere's file says whether specular light is in the reading.
    sigma_degrees
        Roughness, or None where the file does not say.
    sigma_source
        Where the roughness comes from.
    source
        Citation, or the path of the file.
    license
        Terms of the data, an SPDX identifier where there is one.
    position
        Place in the file, such as ``"line 5"``.
    device
        The instrument's model.
    condition
        Measurement condition of ISO 13655, ``"M0"`` to ``"M3"``.
    illuminant, observer
        Of the file's own colorimetry; the observer is 2 or 10 (degrees).
    lab
        The file's own CIE L*, a*, b*.
    xyz
        The file's own tristimulus values, scaled so that the perfect white diffuser has Y = 1.
    notes
        Sentences that the reader wants the user to see.
    altered
        Sentences that say what is not as the file has it, such as ``"Two scans were averaged."``.
    white
        What the values are relative to, one of `core.white_scale.REGISTRY`.
    white_factor
        What `core.white_scale.factor` calls stated; None where it is not.
    plaque
        The white plaque by a name of `core.white_scale`, or empty.
    surface
        Which surface of a material that was made rough was read, in the words of the file:
        ``"smooth"`` and ``"rough"`` count.
    others
        Further readings of the same surface by other instruments, or of the smooth one of the same
        material: readings without others of their own, each with all that its file says of it.
    called
        What the file calls this reading, where the set of it has another name.
    gloss
        Gloss units by angle, pairs of degrees and units, by increasing angle; ISO 2813 has 20, 60
        and 85 degrees. What is matte has none.
    gloss_source
        Where the gloss, or that there is none, comes from.

    Raises
    ------
    InputError
        The spectrum cannot be used (see `check_spectrum`), or a field holds what no file of ours
        could keep.
    """

    name: str
    wavelengths: NDArray[np.float64]
    values: NDArray[np.float64]
    kind: Kind
    quantity: str = "reflectance factor"
    instrument: str = "45a:0"
    geometry: str = ""
    aperture: str = ""
    specular: str = ""
    sigma_degrees: float | None = None
    sigma_source: str = ""
    source: str = ""
    license: str = ""
    position: str = ""
    device: str = ""
    condition: str = ""
    illuminant: str = ""
    observer: int | None = None
    lab: tuple[float, float, float] | None = None
    xyz: tuple[float, float, float] | None = None
    notes: tuple[str, ...] = ()
    altered: tuple[str, ...] = ()
    white: str = white_scale.PERFECT
    white_factor: float | None = None
    plaque: str = ""
    surface: str = ""
    called: str = ""
    others: tuple[Sample, ...] = ()
    gloss: tuple[tuple[float, float], ...] = ()
    gloss_source: str = ""

    @property
    def readings(self) -> tuple[Sample, ...]:
        """All readings of the set: this one, which the color is made from, and the others."""
        return (self, *self.others)

    @property
    def scale(self) -> float:
        """What the values are multiplied by to be relative to the perfect diffuser."""
        return white_scale.factor(self.white, self.instrument, self.white_factor, self.plaque)

    @property
    def reflectance(self) -> NDArray[np.float64]:
        """The values to compute with, shape (bands,), relative to the perfect diffuser.

        Noise below 0 counts as 0, an albedo above 1 as 1. Of an emissivity it is what the surface
        does not emit, 1 - ε, from 0 to 1: by Kirchhoff's law what it reflects of light from all
        around. `quality` says so of every sample in which something counts as something else.
        """
        if self.kind == "emissivity":
            return np.clip(1.0 - self.values, 0.0, 1.0)
        scaled = self.values if self.scale == 1.0 else self.values * self.scale
        return np.clip(scaled, 0.0, 1.0 if self.kind == "albedo" else None)

    @property
    def has_color(self) -> bool:
        """Whether the eye sees any of it. What has no color serves for emissivity."""
        seen = self.wavelengths[0] <= EYE_NM[1] and self.wavelengths[-1] >= EYE_NM[0]
        return bool(seen) and self.kind in COLORED

    def taken_as(self, kind: Kind) -> Sample:
        """Return the sample as a user says it is, whatever its file says.

        Raises
        ------
        InputError
            The kind is not known, or one of the two is an emissivity: its values are of another
            quantity and not just of another surface.
        """
        if kind != self.kind and "emissivity" in (kind, self.kind):
            raise InputError(
                f"{self._where}: {self.name!r} holds {_HOLDS[self.kind]}, and cannot be taken as "
                f"{_HOLDS.get(kind, kind)}; leave the kind as the file says."
            )
        return self if kind == self.kind else replace(self, kind=kind)

    def __post_init__(self) -> None:
        where = self._where
        if self.kind not in KINDS:
            raise InputError(f"{where}: kind is {self.kind!r}; make it {KINDS_NAMED}.")
        if self.instrument not in REGISTRY:
            raise InputError(
                f"{where}: the instrument {self.instrument!r} is not known; make it one of: "
                f"{', '.join(REGISTRY)}."
            )
        wavelengths, values = check_spectrum(self.wavelengths, self.values, where)
        object.__setattr__(self, "wavelengths", wavelengths)
        object.__setattr__(self, "values", values)
        if self.kind == "emissivity" and float(np.median(values)) > BRIGHTEST:
            raise InputError(
                f"{where}: half of the emissivities are above {np.median(values):.4g}, and nothing "
                "emits more than 1; if they are percent, let the file say so."
            )
        self._check_statements(where)

    @property
    def _where(self) -> str:
        return ", ".join(part for part in (self.source or self.name, self.position) if part)

    def _check_statements(self, where: str) -> None:
        """Turn numbers into Python's own and sequences into tuples, as they are read back."""
        if not set(map(type, _texts_of(self))) <= {str}:
            for name in _TEXTS:
                if not isinstance(getattr(self, name), str):
                    raise InputError(f"{where}: the field {name!r} is no text; make it one.")
        for name in ("notes", "altered"):
            if getattr(self, name) != ():
                object.__setattr__(self, name, _sentences(where, name, getattr(self, name)))
        for name in ("lab", "xyz"):
            given = getattr(self, name)
            if given is not None:
                object.__setattr__(self, name, _finite(where, name, given, 3))
        if self.sigma_degrees is not None:
            [sigma] = _finite(where, "sigma_degrees", (self.sigma_degrees,), 1)
            object.__setattr__(self, "sigma_degrees", sigma)
        if self.observer is not None:
            [observer] = _finite(where, "observer", (self.observer,), 1)
            if not observer.is_integer():
                raise InputError(f"{where}: the observer is {observer:g}; make it 2 or 10.")
            object.__setattr__(self, "observer", int(observer))
        if self.white_factor is not None:
            [factor] = _finite(where, "white_factor", (self.white_factor,), 1)
            object.__setattr__(self, "white_factor", factor)
        fault = white_scale.fault(self.white, self.instrument, self.white_factor, self.plaque)
        if fault:
            raise InputError(f"{where}: {fault}.")
        if self.others or self.gloss:
            object.__setattr__(self, "others", _readings(where, self.others))
            object.__setattr__(self, "gloss", _gloss_units(where, self.gloss))


_HOLDS = {"reading": "a reading", "albedo": "an albedo", "emissivity": "emissivity"}

_TEXTS = (
    *("name", "quantity", "geometry", "aperture", "specular", "sigma_source", "source"),
    *("license", "position", "device", "condition", "illuminant", "white", "plaque"),
    *("surface", "called", "gloss_source"),
)
_texts_of = attrgetter(*_TEXTS)


def check_spectrum(
    wavelengths: ArrayLike,
    values: ArrayLike,
    where: str,
    place: Callable[[int], str] | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the spectrum as read-only float64 arrays, or say why it cannot be one.

    Parameters
    ----------
    wavelengths
        Nanometers, shape ``(bands,)``.
    values
        Fractions, shape ``(bands,)``.
    where
        File and place, as the sentence begins.
    place
        Names the place of band `i` in the file, such as ``"line 7"``; the default counts bands.

    Raises
    ------
    InputError
        Fewer than two bands; a wavelength or a value that is NaN or infinite; wavelengths that
        decrease, repeat or cannot be nanometers; a visible value below `DEEPEST_NOISE` or above
        `BRIGHTEST`.
    """
    place = place or (lambda band: f"band {band + 1}")
    nm = _read_only(wavelengths)
    fractions = _read_only(values)
    if nm.ndim != 1 or nm.shape != fractions.shape:
        raise InputError(
            f"{where}: {nm.size} wavelengths stand against {fractions.size} values; "
            "give one value a wavelength."
        )
    if nm.size < 2:
        count = "only one band" if nm.size else "no band"
        raise InputError(f"{where}: the spectrum has {count}; export at least two wavelengths.")
    # Comparisons are written so that NaN fails them; the order check covers NaN between the ends.
    if not (nm[0] >= SHORTEST_NM and nm[-1] <= LONGEST_NM and (nm[1:] > nm[:-1]).all()):
        raise InputError(f"{where}: {_fault_of_wavelengths(nm, place)}.")
    if not (fractions.min() >= 0.0 and fractions.max() <= 1.0):
        fault = _fault_of_values(nm, fractions, place)
        if fault:
            raise InputError(f"{where}: {fault}.")
    return nm, fractions


def _finite(where: str, name: str, given: Sequence[float], count: int) -> tuple[float, ...]:
    try:
        numbers = tuple(map(float, given))
    except (TypeError, ValueError, OverflowError):
        numbers = ()
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        what = "a number" if count == 1 else f"{count} numbers"
        raise InputError(f"{where}: the field {name!r} must be {what}; correct it or leave it out.")
    return numbers


def _sentences(where: str, name: str, given: Sequence[str]) -> tuple[str, ...]:
    if isinstance(given, str) or not all(isinstance(sentence, str) for sentence in given):
        raise InputError(f"{where}: the field {name!r} must be a sequence of texts; make it one.")
    return tuple(given)


def _readings(where: str, given: Sequence[Sample]) -> tuple[Sample, ...]:
    if not all(isinstance(other, Sample) for other in given):
        raise InputError(f"{where}: the field 'others' must be a sequence of samples; make it one.")
    for other in given:
        if other.kind != "reading" or other.others or other.gloss:
            raise InputError(
                f"{where}: {other.name!r} cannot be another reading of the same surface, as it is "
                "no reading or a set itself; give single readings."
            )
    return tuple(given)


def _gloss_units(where: str, given: Sequence[Sequence[float]]) -> tuple[tuple[float, float], ...]:
    if isinstance(given, str) or not all(isinstance(pair, Sequence) for pair in given):
        given = [()]
    pairs = [_finite(where, "gloss", pair, 2) for pair in given]
    for angle, units in pairs:
        if not (0.0 < angle < 90.0 and 0.0 <= units <= MOST_GLOSS_UNITS):
            raise InputError(
                f"{where}: {units:g} gloss units at {angle:g}° cannot be; give units from 0 to "
                f"{MOST_GLOSS_UNITS:g} at an angle between 0° and 90°."
            )
    if len({angle for angle, _ in pairs}) < len(pairs):
        raise InputError(f"{where}: an angle has gloss units twice; keep one of the two.")
    return tuple(sorted((angle, units) for angle, units in pairs))


def _read_only(numbers: ArrayLike) -> NDArray[np.float64]:
    array = np.asarray(numbers, dtype=np.float64)
    if array.flags.writeable:
        array = array.copy()
        array.flags.writeable = False
    return array


def _fault_of_wavelengths(nm: NDArray[np.float64], place: Callable[[int], str]) -> str:
    bad = np.flatnonzero(~np.isfinite(nm))
    if bad.size:
        band = int(bad[0])
        return (
            f"the wavelength at {place(band)} is {_number(nm[band])}; "
            "give each band its wavelength in nm"
        )
    steps = np.flatnonzero(nm[1:] <= nm[:-1])
    if steps.size:
        band = int(steps[0])
        first, second = _number(nm[band]), _number(nm[band + 1])
        if nm[band] == nm[band + 1]:
            return (
                f"the wavelength {first} nm stands twice, at {place(band)} and at "
                f"{place(band + 1)}; keep one of the two"
            )
        return (
            f"the wavelength {second} nm at {place(band + 1)} follows {first} nm at {place(band)}; "
            "sort the bands by increasing wavelength"
        )
    if nm[-1] < SHORTEST_NM and nm[0] > 0.0:
        return (
            f"the wavelengths, {_number(nm[0])} to {_number(nm[-1])}, look like micrometers; "
            "give them in nanometers, or state the unit µm where the format has a place for it"
        )
    band = 0 if nm[0] < SHORTEST_NM else nm.size - 1
    return (
        f"{_number(nm[band])} at {place(band)} cannot be a wavelength in nm; "
        "give wavelengths in nanometers"
    )


def _fault_of_values(
    nm: NDArray[np.float64], fractions: NDArray[np.float64], place: Callable[[int], str]
) -> str:
    """Say what makes the values no reflectance, or nothing."""

    def at(band: int) -> str:
        return f"the value at {_number(nm[band])} nm, {place(band)}, is {_number(fractions[band])}"

    bad = np.flatnonzero(~np.isfinite(fractions))
    if bad.size:
        return f"{at(int(bad[0]))}; measure again or leave the sample out"
    visible = (nm >= EYE_NM[0]) & (nm <= EYE_NM[1])
    bad = np.flatnonzero(visible & (fractions < DEEPEST_NOISE))
    if bad.size:
        return (
            f"{at(int(bad[0]))}, more below 0 than noise can be; reflectance starts at 0, so "
            "correct it or measure again"
        )
    bad = np.flatnonzero(visible & (fractions > BRIGHTEST))
    if bad.size:
        return (
            f"{at(int(bad[0]))}, more than {BRIGHTEST:g} times white; if the values are percent, "
            "let the column name or the file's unit option say so, and otherwise correct it"
        )
    return ""


def _number(value: float) -> str:
    return f"{float(value):.12g}".replace("nan", "NaN").replace("inf", "infinite")
