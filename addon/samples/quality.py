# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Say what a user should know of measured spectra, and what is done about it.

Nothing is altered here. Every sentence names what is there and what follows from it; a sample
without a sentence is one to use without a second thought.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np
import numpy.typing as npt

from ...core.color import color_difference
from ...core.errors import DomainError
from ...core.limits import COLOR_NM, EYE_NM, sigma_fault
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import memoized
from ..colorimetry import tristimulus
from . import sets
from .sample import Sample

DISAGREEMENT = 0.5
"""ΔE00 above which a file contradicts itself: fifty times what rounding and interpolation do."""

UV_EFFECT = 0.01
"""Difference between M0, M1 and M2 above which it is fluorescence and not repeatability, which is
a tenth of it."""

WIDEST_STEP = 20.0
"""Nanometers; the widest step for which ASTM E308 has weights."""

GAP = 2.5
"""A step this many times the median one is a hole in the table, not its grid."""

NO_COLOR = "it has no color, and no material can be made from it; it serves for emissivity."
"""How a sentence on a sample ends that the eye sees nothing of."""

_HARMLESS_STEP = 5.0  # nm; ASTM E308 calls its 5 nm weights equal to the 1 nm sum
_END_TOLERANCE = 1.0  # nm; spectrometers begin at 400.2
_PLATEAU = 3  # bands
_SHARP = 5  # units of the last digit; see `_saturation`
_LEFT_OUT = 0.1  # share of the color from which `tristimulus` refuses
_VALUES_AT_ONCE = 1_000_000  # 8 MB
_ROUNDING = 1e-6
_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f]")

_Found = Iterator[tuple[int, str]]
"""Position of a sample among those judged, and the sentence."""


def check(samples: Sequence[Sample]) -> list[tuple[str, ...]]:
    """Give the sentences for samples that were read together, one by one and beside each other.

    Returns
    -------
    The sentences of each sample, in the order of `samples`.
    """
    found = [list(sentences) for sentences in check_each(samples)]
    for i, sentence in _ultraviolet_effect(samples):
        found[i].append(sentence)
    for i, sample in enumerate(samples):
        fault = "" if sample.sigma_degrees is None else sigma_fault(sample.sigma_degrees)
        if fault:
            found[i].append(f"{sample.name!r} states a roughness that no material has: {fault}")
    for i, sentence in _other_readings(samples):
        found[i].append(sentence)
    return [tuple(sentences) for sentences in found]


def check_each(samples: Sequence[Sample]) -> list[tuple[str, ...]]:
    """Give the sentences that follow from each sample alone, in the order of `samples`."""
    if len(samples) == 1:
        return [_judge_one(samples[0])]
    return _judge_all(samples)


@memoized(maxsize=256)
def _judge_one(sample: Sample) -> tuple[str, ...]:
    """Judge a sample once: while a slider is dragged, it stays the same."""
    return _judge_all([sample])[0]


def _judge_all(samples: Sequence[Sample]) -> list[tuple[str, ...]]:
    found: list[list[str]] = [[] for _ in samples]
    for members in _groups(range(len(samples)), lambda i: samples[i].wavelengths.tobytes()):
        at_once = max(1, _VALUES_AT_ONCE // samples[members[0]].wavelengths.size)
        for start in range(0, len(members), at_once):
            part = members[start : start + at_once]
            for i, sentence in _judge_grid([samples[k] for k in part]):
                found[part[i]].append(f"{samples[part[i]].name!r} {sentence}")
    return [tuple(sentences) for sentences in found]


def _judge_grid(samples: Sequence[Sample]) -> _Found:
    """Judge samples that share their wavelengths."""
    nm = samples[0].wavelengths
    values = np.stack([sample.values for sample in samples])
    kinds = np.array([sample.kind for sample in samples])
    reflects = np.flatnonzero(kinds != "emissivity")
    for i, sentence in (
        *_contradiction([samples[k] for k in reflects], values[reflects]),
        *_beyond_white(nm, values[reflects], kinds[reflects] == "albedo"),
        *_noise(nm, values[reflects]),
        *_saturation(nm, values[reflects]),
        *((i, sentence) for sentence in (*_steps(nm), *_range(nm)) for i in range(reflects.size)),
    ):
        yield int(reflects[i]), sentence
    for i in np.flatnonzero(kinds == "emissivity"):
        yield from ((int(i), sentence) for sentence in _emissivity(nm, values[i]))
    for i, sample in enumerate(samples):
        if _CONTROL.search(sample.name):
            yield i, "has a control character in its name; give it another name in the library."
        if sample.specular.upper() == "SCI" and sample.kind == "reading":
            yield (
                i,
                "was measured with specular light included (SCI): gloss is in the reading, so a "
                "diffuse material made from it is too light; use the SCE reading if there is one.",
            )


def _contradiction(samples: Sequence[Sample], values: Array) -> _Found:
    differences = _own_differences(samples, values)
    for i in np.flatnonzero(differences > DISAGREEMENT):
        sample = samples[i]
        what = "XYZ" if sample.lab is None else "Lab"
        yield (
            int(i),
            f"has {what} in its file that differs from its own spectrum by ΔE00 "
            f"{differences[i]:.2f} ({sample.illuminant}, {sample.observer}°); the spectrum is "
            "used, so check which of the two is meant.",
        )


def _own_differences(samples: Sequence[Sample], values: Array) -> Array:
    """ΔE00 of each file's color from its spectrum, shape (samples,); NaN where it says none."""
    differences = np.full(len(samples), np.nan)
    known = [
        i
        for i, sample in enumerate(samples)
        if not (sample.lab is None and sample.xyz is None)
        and sample.illuminant in tristimulus.ILLUMINANTS
        and sample.observer in tristimulus.OBSERVERS
    ]
    for members in _groups(known, lambda i: (samples[i].illuminant, samples[i].observer)):
        first = samples[members[0]]
        try:
            matrix = tristimulus.weights(first.wavelengths, first.illuminant, first.observer or 2)
        except DomainError:
            continue  # too few visible bands: `_range` says so
        white = matrix.sum(axis=0)
        xyz = [samples[i].xyz or (0.0, 0.0, 0.0) for i in members]
        of_xyz = color_difference.xyz_to_lab(xyz, white).tolist()
        own = [samples[i].lab or other for i, other in zip(members, of_xyz, strict=True)]
        computed = color_difference.xyz_to_lab(values[members] @ matrix, white)
        differences[members] = color_difference.delta_e(computed, np.array(own))
    return differences


def _beyond_white(nm: Array, values: Array, is_albedo: npt.NDArray[np.bool_]) -> _Found:
    for i in np.flatnonzero(is_albedo & (values.max(axis=1) > 1)):
        peak = int(values[i].argmax())
        yield (
            int(i),
            f"has an albedo of {values[i, peak]:.6g} at {nm[peak]:g} nm, and no facet returns "
            "more light than reaches it; it is kept, and counts as 1 in computing.",
        )
    seen = _within(nm, EYE_NM)
    if not seen.any():
        return
    peaks = np.where(seen, values, -np.inf).argmax(axis=1)
    highest = values[np.arange(len(values)), peaks]
    for i in np.flatnonzero(~is_albedo & (highest > 1 + _ROUNDING)):
        yield (
            int(i),
            f"reads {highest[i]:.6g} at {nm[peaks[i]]:g} nm, more than white, as only "
            "fluorescence or gloss does; it is kept as measured, and holds only under light like "
            "the instrument's.",
        )


def _noise(nm: Array, values: Array) -> _Found:
    for i in np.flatnonzero(values.min(axis=1) < 0):
        count, lowest = int((values[i] < 0).sum()), int(values[i].argmin())
        bands = "one band" if count == 1 else f"{count} bands"
        yield (
            int(i),
            f"is below 0 in {bands}, down to {values[i, lowest]:.3g} at {nm[lowest]:g} nm, which "
            "is noise; it is kept as measured, and counts as 0 in computing.",
        )


def _emissivity(nm: Array, values: Array) -> Iterator[str]:
    yield f"holds emissivity, of {nm[0]:g} to {nm[-1]:g} nm: {NO_COLOR}"
    for outside, peak, limit in (
        (values > 1, int(values.argmax()), "above 1"),
        (values < 0, int(values.argmin()), "below 0"),
    ):
        count = int(outside.sum())
        if count:
            bands = "one band" if count == 1 else f"{count} bands"
            yield (
                f"is {limit} in {bands}, {values[peak]:.4g} at {nm[peak]:g} nm, which is noise "
                f"or a wrong temperature; it is kept, and counts as {limit[-1]} in computing."
            )


def _saturation(nm: Array, values: Array) -> _Found:
    """Find curves that are cut off: exactly level at their top, with a sharp edge beside it.

    A smooth curve p - kx² whose values are rounded to a last digit q can be level over three bands
    while k ≤ q, and then falls by at most 4 q beside them. Only a steeper edge is a cut.
    """
    seen = np.flatnonzero(_within(nm, EYE_NM))
    top = values[:, seen].max(axis=1, initial=-np.inf)
    for i in np.flatnonzero(top >= 1):
        level = values[i, seen] == top[i]
        if level.all():
            continue  # a white standard by definition, not a measurement
        edges = np.flatnonzero(np.diff(np.concatenate(([0], level.view(np.int8), [0]))))
        for begin, end in zip(edges[::2], edges[1::2], strict=True):
            beside = [values[i, seen[k]] for k in (begin - 1, end) if 0 <= k < seen.size]
            drop = top[i] - min(beside)
            if end - begin >= _PLATEAU and drop > _SHARP * _last_digit(values[i]):
                yield (
                    int(i),
                    f"stays at exactly {top[i]:g}, its largest value, from {nm[seen[begin]]:g} to "
                    f"{nm[seen[end - 1]]:g} nm, as a saturated detector or a cut-off table does; "
                    "it is kept, so measure again if you can.",
                )
                break


def _last_digit(values: Array) -> float:
    """Give the unit in the last decimal place of values from a table; 0 where they have no end."""
    for digits in range(1, 7):
        scaled = values * 10.0**digits
        if np.allclose(scaled, np.round(scaled), rtol=0, atol=1e-6):
            return float(10.0**-digits)
    return 0.0


def _steps(nm: Array) -> Iterator[str]:
    inside = (nm[1:] > COLOR_NM[0]) & (nm[:-1] < COLOR_NM[1])
    steps = np.diff(nm)[inside]
    if steps.size == 0:
        return  # no color at all, which `_range` says
    starts = nm[:-1][inside]
    is_gap = (steps > GAP * np.median(steps) * (1 + _ROUNDING)) & (steps > _HARMLESS_STEP)
    if is_gap.any():
        widest = int(np.where(is_gap, steps, 0).argmax())
        others = int(is_gap.sum()) - 1
        more = "" if others == 0 else f" (and {others} more)"
        yield (
            f"has a gap from {starts[widest]:g} to {starts[widest] + steps[widest]:g} nm{more}; "
            "colors interpolate over it."
        )
    widest_step = float(steps[~is_gap].max())
    if widest_step > WIDEST_STEP * (1 + _ROUNDING):
        yield (
            f"has bands as far as {widest_step:g} nm apart; its color follows from interpolation "
            "between them, so measure in steps of 20 nm or less where it matters."
        )


def _range(nm: Array) -> Iterator[str]:
    if nm[0] <= COLOR_NM[0] + _END_TOLERANCE and nm[-1] >= COLOR_NM[1] - _END_TOLERANCE:
        return
    if nm[0] > EYE_NM[1] or nm[-1] < EYE_NM[0]:
        yield f"covers {nm[0]:g} to {nm[-1]:g} nm, where the eye sees nothing: {NO_COLOR}"
        return
    held = tristimulus.held_share(nm)
    covers = (
        f"covers {nm[0]:g} to {nm[-1]:g} nm and not all of {COLOR_NM[0]:g} to {COLOR_NM[1]:g} nm"
    )
    if held > _LEFT_OUT:
        yield (
            f"{covers}, which leaves {held:.0%} of its color unmeasured: no material can be made "
            "from it."
        )
    else:
        yield f"{covers}; the end values are held beyond, which makes {held:.1%} of its color."


def _ultraviolet_effect(samples: Sequence[Sample]) -> _Found:
    """Compare samples of one name that were measured with and without ultraviolet light."""
    measured = [i for i, sample in enumerate(samples) if sample.condition in ("M0", "M1", "M2")]
    for members in _groups(measured, lambda i: _plain_name(samples[i])):
        of_condition = {samples[i].condition: i for i in reversed(members)}
        for one, two in combinations(sorted(of_condition), 2):
            pair = of_condition[one], of_condition[two]
            nm, difference = _largest_difference(samples[pair[0]], samples[pair[1]])
            if difference > UV_EFFECT:
                sentence = (
                    f"{_plain_name(samples[pair[0]])!r} differs by {difference:.3f} at {nm:g} nm "
                    f"between {one} and {two}, so it is fluorescent; each reading is kept, and "
                    "holds only under its own condition."
                )
                yield from ((i, sentence) for i in pair)


def _other_readings(samples: Sequence[Sample]) -> _Found:
    """Judge what else sets hold; that specular light is in one of them is what it is there for."""
    places = [(i, other) for i, sample in enumerate(samples) for other in sample.others]
    judged = _judge_all(
        [replace(o, name=f"{o.name} at {sets.label(o)}", specular="") for _, o in places]
    )
    for (i, _), sentences in zip(places, judged, strict=True):
        yield from ((i, sentence) for sentence in sentences)


def _plain_name(sample: Sample) -> str:
    """Return the name without the condition that readers add to tell two of them apart."""
    return sample.name.removesuffix(f"({sample.condition})").rstrip()


def _largest_difference(one: Sample, two: Sample) -> tuple[float, float]:
    """Wavelength and size of the largest difference in the visible range that both cover."""
    nm = one.wavelengths
    seen = _within(nm, EYE_NM) & _within(nm, (two.wavelengths[0], two.wavelengths[-1]))
    if not seen.any():
        return 0.0, 0.0
    other = np.interp(nm[seen], two.wavelengths, two.values)
    differences = np.abs(one.values[seen] - other)
    largest = int(differences.argmax())
    return float(nm[seen][largest]), float(differences[largest])


def _within(nm: Array, limits: tuple[float, float]) -> npt.NDArray[np.bool_]:
    return (nm >= limits[0]) & (nm <= limits[1])


def _groups(members: Iterable[int], key: Callable[[int], Hashable]) -> list[list[int]]:
    """Put together the members with equal keys, in the order of their first one."""
    found: dict[Hashable, list[int]] = {}
    for i in members:
        found.setdefault(key(i), []).append(i)
    return list(found.values())
