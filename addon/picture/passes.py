# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The renders of a spectral picture: which bands, and what each color of the scene is in them.

A render has three channels. In most of them each is a band, a wavelength at which reflectances are
taken. Where direct light is to be exact there is one more render a lamp, without indirect light,
whose channels are X, Y and Z: a reflectance is then its mean under that lamp, as X, Y or Z sees it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core import bands
from ...core.bands import Bands
from ...core.cycles import gloss_reading, matching
from ...core.errors import MaterialError
from ...core.numerics.arrays import Array
from ..colorimetry import illuminant_spectra, rgb_spectra
from ..colorimetry.rgb_space import WorkingSpace
from ..matching import glossy
from .colors import Colors, Measured, Shining
from .places import Place

_SEEN = 48
"""Surfaces that bands are chosen for, at most, spread over those there are."""
_ANY = np.array(((0.5, 0.5, 0.5), (0.6, 0.2, 0.2), (0.2, 0.6, 0.2), (0.2, 0.2, 0.6)))
"""What a texture is taken for when bands are chosen: some of the colors that it may have."""
_ALIKE = 1e-6
"""Relative difference below which two lamps have the same spectrum."""


@dataclass(frozen=True, eq=False)
class Pass:
    """A render.

    Parameters
    ----------
    taken
        From a reflectance at `GRID` to the channels, shape (wavelengths, 3).
    lamps
        What each lamp of `Lamps` sends in the channels, shape (lamps, 3).
    to_xyz
        From the channels to X, Y and Z, shape (3, 3).
    direct
        Whether it is of direct light alone.
    from_rgb
        From a surface's red, green and blue to the channels, shape (3, 3), where these are
        themselves colors; None where it goes by their spectra.
    """

    taken: Array
    lamps: Array
    to_xyz: Array
    direct: bool = False
    from_rgb: Array | None = None


@dataclass(frozen=True, eq=False)
class Lamps:
    """Different spectra of light.

    Parameters
    ----------
    spectra
        At `GRID`, shape (lamps, wavelengths); a little below 0 beside a line.
    of
        For each of `Colors.shining` its number, or None: then the last three stand for red, green
        and blue of Rec.709.
    """

    spectra: Array
    of: tuple[int | None, ...]

    @property
    def white(self) -> Array:
        """XYZ of all together by the 2° observer, with a Y of 1."""
        return self.white_by(2)

    def white_by(self, observer: int) -> Array:
        """XYZ of all together by the observer of 2 or 10 degrees, with a Y of 1."""
        xyz = self.spectra.sum(axis=0) @ illuminant_spectra.observer(observer)
        return np.asarray(xyz / xyz[1])


def lamps_of(found: Colors, space: WorkingSpace) -> Lamps:
    """Gather the spectra of what shines.

    Raises
    ------
    MaterialError
        If nothing does.
    """
    if not found.shining:
        msg = "Nothing in the scene sheds light; add a lamp, or give the world a color."
        raise MaterialError(msg)
    spectra: list[Array] = []
    numbers: list[int | None] = []
    for each in found.shining:
        if each.spectrum is None:
            numbers.append(None)
            continue
        alike = [np.abs(each.spectrum - s).max() <= _ALIKE * s.max() for s in spectra]
        if True not in alike:
            spectra.append(each.spectrum)
        numbers.append([*alike, True].index(True))
    if None in numbers:
        spectra += list(np.maximum(rgb_spectra.lights(space), 0))
    return Lamps(np.stack(spectra), tuple(numbers))


def surfaces_of(found: Colors, space: WorkingSpace) -> Array:
    """Albedos that stand for all of the scene's, 0 to 1, at `GRID`: shape (surfaces, values)."""
    by_rgb = rgb_spectra.reflectances(space)
    albedos = [each.reading for each in found.measured]
    albedos += [each.rgb @ by_rgb for each in found.colored if each.rgb is not None]
    if not albedos or any(each.rgb is None for each in found.colored):
        albedos += list(_ANY @ by_rgb)
    albedos.append(np.full(illuminant_spectra.GRID.size, 0.5))
    picked = np.unique(np.linspace(0, len(albedos) - 1, _SEEN).astype(int))
    return np.asarray(np.clip(np.stack(albedos)[picked], 0, 1))


def choose(
    found: Colors, lamps: Lamps, space: WorkingSpace, tolerance: float, **more: Any
) -> Bands:
    """Choose bands for what was found; further arguments as of `core.bands.choose`."""
    observer = more.pop("observer", 2)
    return bands.choose(
        illuminant_spectra.GRID,
        surfaces_of(found, space),
        lamps.spectra,
        illuminant_spectra.observer(observer),
        tolerance,
        **more,
    )


def of_bands(chosen: Bands) -> list[Pass]:
    """Put bands into renders, three each."""
    grid = illuminant_spectra.GRID
    found = []
    for start in range(0, len(chosen.wavelengths), bands.IN_A_PASS):
        part = slice(start, start + bands.IN_A_PASS)
        taken = (grid[:, np.newaxis] == chosen.wavelengths[part]).astype(float)
        found.append(Pass(taken, chosen.lights[:, part], chosen.weights[part]))
    return found


def of_direct(lamps: Lamps, observer: int) -> list[Pass]:
    """Give a render for the direct light of each lamp, in X, Y and Z."""
    step = illuminant_spectra.GRID[1] - illuminant_spectra.GRID[0]
    functions = illuminant_spectra.observer(observer) * step
    found = []
    for number, spectrum in enumerate(lamps.spectra):
        seen = spectrum[:, np.newaxis] * functions
        sent = np.zeros((len(lamps.spectra), 3))
        sent[number] = np.maximum(seen.sum(axis=0), 0)
        taken = np.divide(seen, sent[number], out=np.zeros_like(seen), where=sent[number] > 0)
        found.append(Pass(taken, sent, np.eye(3), direct=True))
    return found


def edits(
    found: Colors, lamps: Lamps, passes: list[Pass], space: WorkingSpace
) -> list[dict[str, Any]]:
    """Say what the worker has to set: a color or a 3 × 3 matrix for each of the renders."""
    by_rgb = rgb_spectra.reflectances(space)
    to_rec709 = rgb_spectra.to_rec709(space)
    # From red, green and blue of a surface to the channels.
    mixing = [by_rgb @ p.taken if p.from_rgb is None else p.from_rgb for p in passes]
    told = [
        edit(each.place, "colors", [matched(each, by_rgb, one.taken) for one in passes])
        for each in found.measured
    ]
    for colored in found.colored:
        if colored.rgb is None:
            told.append(edit(colored.place, "matrices", [mix.T for mix in mixing]))
        else:
            values = [np.maximum(colored.rgb @ mix, 0) for mix in mixing]
            told.append(edit(colored.place, "colors", values))
    for shining, number in zip(found.shining, lamps.of, strict=True):
        told.append(_of_light(shining, number, passes, to_rec709))
    return told


def _of_light(
    shining: Shining, number: int | None, passes: list[Pass], to_rec709: Array
) -> dict[str, Any]:
    if number is not None:
        values = [shining.strength * each.lamps[number] for each in passes]
        return edit(shining.place, "colors", values) | {"picked": shining.picked}
    matrices = [each.lamps[-3:].T @ (to_rec709 * shining.strength) for each in passes]
    return edit(shining.place, "matrices", matrices)


def matched(each: Measured, by_rgb: Array, taken: Array) -> Array:
    """Color that reads in the channels as the spectrum does there, under the gloss as it is.

    Parameters
    ----------
    each
        A surface.
    by_rgb
        Spectra of the working space's red, green and blue, as `rgb_spectra.reflectances` gives.
    taken
        As of `Pass`.
    """
    wanted = each.reading @ taken
    if each.gloss is not None:
        tints = (each.gloss.tint, each.gloss.coat_tint)
        tint, coat_tint = (tuple(np.maximum(np.array(t) @ by_rgb @ taken, 0)) for t in tints)
        gloss = each.gloss._replace(tint=tint, coat_tint=coat_tint)
        there = gloss_reading.at_instrument(gloss, each.read_at)
        wanted, _ = glossy.share_below(there, wanted)
    color = matching.color_for_reading(np.maximum(wanted, 0), each.roughness, each.read_at)
    return np.clip(color, 0, 1)


def edit(place: Place, what: str, values: Sequence[Array]) -> dict[str, Any]:
    """Say what the worker has to set in a place: "colors" or "matrices", one for each render."""
    return {
        "of": list(place.of),
        "node": place.node,
        "socket": place.socket,
        "attribute": place.attribute,
        what: [np.asarray(value).tolist() for value in values],
    }
