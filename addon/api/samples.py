# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples: read, found, and what their readings tell of roughness and gloss."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from math import isfinite
from pathlib import Path

from ...core.cycles.gloss_estimate import GlossEstimate
from ...core.errors import DomainError
from ...core.estimate import RELATIVE, Estimate
from ...core.gloss import Gloss
from ...core.gloss_readings import GlossReadings
from ..matching import roughness
from ..material import preferences
from ..samples import gloss_of_set, library, readers
from ..samples import palette as palette_files
from ..samples import presets as preset_files
from ..samples.palette import Row
from ..samples.sample import Sample


def read(
    path: str | os.PathLike[str], region: tuple[int, int, int, int] | None = None
) -> list[Sample]:
    r"""Return all samples of a measurement file, in the file's order.

    Parameters
    ----------
    path
        Any file; its format follows from its content.
    region
        Of a spectral image, the rectangle of pixels whose mean is the sample: x, y, width, height,
        counted from the top left. None takes the whole image; other files have no regions.

    Returns
    -------
    At least one sample. A `Sample` has, among others, `name`; `wavelengths` in nanometers and
    `values` as fractions, both of shape (bands,); and `kind`, "reading", "albedo" or "emissivity".

    Raises
    ------
    InputError
        The file cannot be opened, no format recognizes it, or the one that does finds a fault.

    Examples
    --------
    >>> _ = Path("paper.csv").write_text("nm,Paper\n400,0.61\n500,0.70\n600,0.72\n700,0.73\n")
    >>> [paper] = read("paper.csv")
    >>> paper.name, paper.kind, paper.values.tolist()
    ('Paper', 'reading', [0.61, 0.7, 0.72, 0.73])
    """
    return readers.read(path, region)


def presets(collection: str | None = None) -> list[str]:
    """Return the ids of the presets that come with the extension, sorted.

    Parameters
    ----------
    collection
        "colorchecker" or "everyday"; None for all.

    Raises
    ------
    InputError
        There is no such collection.

    Examples
    --------
    >>> presets("colorchecker")[:2]
    ['colorchecker/01-dark-skin', 'colorchecker/02-light-skin']
    """
    return preset_files.names() if collection is None else preset_files.names_of(collection)


def find(name: str) -> Sample:
    """Return the preset, or the sample of the user's library, that is called so.

    Parameters
    ----------
    name
        Of a preset: its id, its name, the color's name or its number, in any case
        ("colorchecker/14-green", "14 green", "Green", "14"). Of the library: its id
        ("walls/plaster"), or its name where no preset is called so.

    Raises
    ------
    InputError
        Nothing is called so, or several are, or its file has a fault.

    Examples
    --------
    >>> find("14 green").name
    'ColorChecker 14 Green'
    """
    return library.load(name, preferences.user_folder())


def nearest(
    lab: Sequence[float], count: int = 10, *, illuminant: str = "D65", observer: int = 2
) -> list[tuple[str, float]]:
    """Return the ids of the samples, presets and library, whose colors come nearest to one.

    Parameters
    ----------
    lab
        CIE L*a*b*.
    count
        How many at most.
    illuminant, observer
        What it was computed for.

    Returns
    -------
    Each id, for `find`, and ΔE00 from the color, the nearest first.

    Raises
    ------
    DomainError
        Illuminant or observer is not known, or `lab` is not three numbers.

    Examples
    --------
    >>> [(name, difference), *_] = nearest((42.16, 19.14, 18.67), 3)
    >>> name, round(difference, 1)
    ('everyday/brick', 0.0)
    """
    light = palette_files.checked_light(illuminant, observer)
    if len(lab) != 3 or not all(map(isfinite, lab)):
        raise DomainError(f"The color is {lab!r}; give L*, a* and b*.")
    found = library.nearest(lab, count, preferences.user_folder(), *light)
    return [(entry.id, difference) for entry, difference in found]


def palette(path: str | os.PathLike[str]) -> list[Row]:
    r"""Return the colors of a table of your own, in its order.

    Parameters
    ----------
    path
        A name and L*, a* and b*, or a name and ``#rrggbb``, in each row, with commas, semicolons or
        tabs; or any file of spectra. Lines such as ``# illuminant: D50`` and ``# observer: 10`` say
        what L*a*b* is for; D65 and 2° otherwise.

    Returns
    -------
    Each has `name`, `lab`, `illuminant`, `observer`, and its `sample` where it has a spectrum.

    Raises
    ------
    InputError
        The file cannot be opened, or a row is no color.

    Examples
    --------
    >>> _ = Path("own.csv").write_text("# illuminant: D50\nname,L,a,b\nHouse red,43,21,20\n")
    >>> [red] = palette("own.csv")
    >>> red.name, red.lab, red.illuminant, red.observer
    ('House red', (43.0, 21.0, 20.0), 'D50', 2)
    >>> name, difference = nearest(red.lab, illuminant=red.illuminant)[0]
    """
    return list(palette_files.read(Path(path)))


def estimate(
    materials: Iterable[tuple[Sample | Sequence[Sample] | None, Sample | Sequence[Sample]]],
    *,
    model: str | None = None,
    repeatability: float = RELATIVE,
) -> Estimate:
    r"""Estimate the roughness σ that rough surfaces share, from what was read of them.

    Parameters
    ----------
    materials
        Of each material what was read of a smooth surface (or its albedo, or None), and what was
        read of the rough one. A list holds readings of several instruments or angles; a sample
        with `others` counts as all of its readings that tell σ.
    model
        One of `core.models.NAMES` that knows roughness; None takes the usual one.
    repeatability
        Standard deviation of repeated readings, as a share of the reading.

    Returns
    -------
    Its `is_told` says whether the readings tell σ, and `reason` why they don't, or what limits it.
    `sigma` is in radians, NaN where it can't be told; `interval` is what noise leaves open, 95 %;
    `by_model` is σ by each model, and `spread` its range; `albedo`, `residuals` and `notes`.

    Raises
    ------
    DomainError
        The samples cannot be used together, or the model does not know roughness.

    Examples
    --------
    >>> columns = [(400, 0.61, 0.53), (500, 0.50, 0.42), (600, 0.32, 0.26), (700, 0.43, 0.35)]
    >>> rows = "".join(f"{nm},{smooth},{rough}\n" for nm, smooth, rough in columns)
    >>> _ = Path("card.csv").write_text("nm,Card,Sanded\n" + rows)
    >>> card, sanded = read("card.csv")
    >>> found = estimate([(card, sanded)])
    >>> found.is_told, radians(25) < found.sigma < radians(45)
    (True, True)
    >>> estimate([(None, sanded)]).reason.partition(":")[0]
    "σ can't be told from one reading"
    """
    given = [(smooth, rough) for smooth, rough in materials]
    if model is None:
        return roughness.of_samples(given, relative=repeatability)
    return roughness.of_samples(given, model, repeatability)


def gloss_readings(sample: Sample) -> GlossReadings | None:
    r"""Tell what a sample's set says of its gloss: SCI less SCE, and gloss units.

    Parameters
    ----------
    sample
        With `others` and `gloss`, as files of spheres and gloss meters give them.

    Returns
    -------
    None where it has neither. `sphere` has `reflectance`, the mean of the difference, with its
    `lowest` and `highest`, and `doubt`, why it may be no gloss; `units` are the gloss units by
    angle; `told` gives what each says: `reflectance` into its window, `f0`, the least reflectance
    at the normal, and `index`.

    Examples
    --------
    >>> text = "name,Gloss 60,400 nm,500 nm,600 nm,700 nm\n"
    >>> text += "Tile (SCI),50,0.14,0.24,0.34,0.44\nTile (SCE),50,0.10,0.20,0.30,0.40\n"
    >>> _ = Path("tile.csv").write_text(text)
    >>> [tile] = read("tile.csv")
    >>> tile.name, [reading.specular for reading in tile.readings]
    ('Tile', ['SCE', 'SCI'])
    >>> found = gloss_readings(tile)
    >>> [(each.angle, round(each.f0, 3)) for each in found.told]
    [(8.0, 0.04), (60.0, 0.015)]
    """
    return gloss_of_set.of_sample(sample)


def estimate_gloss(
    sample: Sample, level: float | None = None, gloss: Gloss | None = None
) -> GlossEstimate:
    r"""Find the gloss of a Principled BSDF that reads what a sample's set says of it.

    Parameters
    ----------
    sample
        A set with SCI and SCE, with gloss units at 20, 60 or 85° beside any reading, or with both.
    level
        Specular IOR Level where it is known; without it, 0.5 is taken where the set has one of the
        two alone.
    gloss
        IOR, coat and tints; those of a new node without it.

    Returns
    -------
    `gloss`, with `level` and `roughness`; `misfit`, the largest relative difference of what it
    reads; and `level_is_known`, whether the level was found.

    Raises
    ------
    DomainError
        The set says nothing of gloss, or that there is none.

    Examples
    --------
    >>> text = "name,Gloss 60,400 nm,500 nm,600 nm,700 nm\n"
    >>> text += "Tile (SCI),38.2,0.33,0.33,0.33,0.33\nTile (SCE),38.2,0.309,0.309,0.309,0.309\n"
    >>> _ = Path("tile.csv").write_text(text)
    >>> [tile] = read("tile.csv")
    >>> found = estimate_gloss(tile)
    >>> round(found.gloss.level, 1), round(found.gloss.roughness, 1), found.level_is_known
    (0.5, 0.2, True)
    """
    return gloss_of_set.estimate(sample, level, gloss)
