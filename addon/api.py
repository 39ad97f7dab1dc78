# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts may rely on: names and arguments here change only with a note in the changelog.

From a file to files:

    read, find → request → assign → state, renew, keep → bake → write
    read, find → emissivity → write_emissivity
    materials → export, for other renderers
    spectral_picture → write_picture, picture_image; picture_verdict
    picture_lights → relight → write_picture; thermal_picture → write_thermal;
    infrared_picture → write_infrared

σ is in radians, wavelengths in nanometers, reflectance from 0 to 1, colors in the scene-linear RGB
of the open file. Whatever the caller can mend is a `RoughSpectraError` whose text says where and
how; nothing was changed or written then. The page "Scripts" of the manual tells how to import this
module, and has a whole script.

The examples are run as tests, with the names of this module, `bpy`, `Path` and `radians`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import replace
from math import degrees, isfinite, radians
from pathlib import Path
from typing import Any

import bpy

from ..core.cycles.gloss_estimate import GlossEstimate
from ..core.emissivity import MODEL as EMISSIVITY_MODEL
from ..core.emissivity import Filter
from ..core.errors import (
    CancelledError,
    DomainError,
    InputError,
    MaterialError,
    OutputError,
    RoughSpectraError,
)
from ..core.estimate import RELATIVE, Estimate
from ..core.gloss import Gloss
from ..core.gloss_readings import GlossReadings
from ..core.instruments import DEFAULT
from ..core.limits import SPOT_DIAMETER, TOLERANCE
from ..core.models import TARGET
from ..core.numerics.arrays import Array
from .blender import colors, working_space
from .export import kept
from .export import targets as export_targets
from .export import write as export_files
from .export.entry import Entry
from .export.kept import Loss
from .export.write import Exported
from .instrument import adjustment
from .instrument import gloss as instrument_gloss
from .instrument import spot as instrument_spot
from .instrument import surfaces as instrument_surfaces
from .instrument.adjustment import Adjusted
from .instrument.spot import Spot
from .laboratory import experiment, kinds
from .laboratory.experiment import Measured
from .laboratory.kinds import RoughSample
from .matching import compare as matching_compare
from .matching import emission, roughness
from .matching import metamerism as matching_metamerism
from .matching.assess import Differences
from .matching.compare import Apart, Comparison
from .matching.metamerism import LIGHTS, InLight
from .matching.request import AUTO, Request
from .matching.solution import Solution
from .material import changes, derive, preferences, selection, settled, storage
from .material import state as material_state
from .material.properties import SHADER_ITEMS
from .material.settled import Settled
from .material.state import State
from .picture import files as picture_files
from .picture import groups as picture_groups
from .picture import (
    infrared,
    infrared_file,
    infrared_wanted,
    thermal,
    thermal_file,
)
from .picture import pixel as picture_pixels
from .picture import relight as picture_relight
from .picture import render as picture_render
from .picture import verdict as picture_judgement
from .picture.infrared import InfraredPicture
from .picture.picture import SpectralPicture
from .picture.pixel import Pixel
from .picture.relight import Lights
from .picture.thermal import ThermalPicture
from .picture.verdict import Verdict
from .preview import emission_files
from .readings import writers
from .readings.document import Reading, Readings, SpotRead
from .readings.emission import Emissivity, InBand
from .samples import filter_response, gloss_of_set, library, light_source, readers, stated_white
from .samples import palette as palette_files
from .samples import presets as preset_files
from .samples.palette import Row
from .samples.sample import Kind, Sample
from .samples.stated_sigma import Names, StatedSigma
from .scene import chosen_light, light_spectra
from .textures import convert
from .textures import material as material_of_texture
from .textures.wanted import Made
from .textures.wanted import Wanted as _Wanted

__all__ = [
    "Adjusted",
    "Apart",
    "CancelledError",
    "Comparison",
    "Differences",
    "DomainError",
    "Emissivity",
    "Entry",
    "Estimate",
    "Exported",
    "Filter",
    "Gloss",
    "GlossEstimate",
    "GlossReadings",
    "InBand",
    "InLight",
    "InfraredPicture",
    "InputError",
    "Lights",
    "Loss",
    "Made",
    "MaterialError",
    "Measured",
    "OutputError",
    "Pixel",
    "Reading",
    "Readings",
    "Request",
    "RoughSample",
    "RoughSpectraError",
    "Row",
    "Sample",
    "Settled",
    "Solution",
    "SpectralPicture",
    "Spot",
    "SpotRead",
    "State",
    "ThermalPicture",
    "Verdict",
    "assign",
    "bake",
    "compare",
    "differences",
    "emissivity",
    "estimate",
    "estimate_gloss",
    "export",
    "export_losses",
    "find",
    "gloss",
    "gloss_readings",
    "infrared_picture",
    "keep",
    "make_texture",
    "match_by_measuring",
    "materials",
    "measure_rough",
    "measured_light",
    "metamerism",
    "nearest",
    "palette",
    "paused",
    "picture_image",
    "picture_lights",
    "picture_pixel",
    "picture_verdict",
    "presets",
    "read",
    "read_filter",
    "relight",
    "renew",
    "request",
    "rough_sample",
    "settle",
    "spectral_picture",
    "spots",
    "state",
    "texture_material",
    "thermal_picture",
    "write",
    "write_emissivity",
    "write_infrared",
    "write_picture",
    "write_thermal",
]


_SIGMA = Names("sigma")


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


def metamerism(
    first: Sample | Request, second: Sample | Request, lights: Sequence[str] = LIGHTS
) -> list[InLight]:
    """Tell how far two materials that match under D65 are apart in other lights.

    Parameters
    ----------
    first, second
        What is compared. A sample alone stands for `request(sample)`.
    lights
        Illuminants, as in `request`.

    Returns
    -------
    D65, then each of the lights: its name, `light`; `delta_e_00`, how far they are apart there; and
    `index`, the special metamerism index of CIE 15:2004 with the correction of ISO 18314-4:2024:
    the part of the difference that D65 does not show.

    Raises
    ------
    DomainError
        A light is not known, or a spectrum does not cover the visible range.

    Examples
    --------
    >>> _, lamp = metamerism(find("brick"), find("dark skin"), ["A"])
    >>> lamp.light, round(lamp.delta_e_00, 1), round(lamp.index, 1)
    ('A', 5.9, 0.9)
    """
    one, other = (request(x) if isinstance(x, Sample) else x for x in (first, second))
    return list(matching_metamerism.compare(one, other, lights))


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


def emissivity(
    sample: Sample,
    sigma: float | None = None,
    *,
    angles: Sequence[float] | None = None,
    temperature: float = 300.0,
    background: float = 0.0,
    bands: Sequence[tuple[float, float] | Filter] | None = None,
    model: str = EMISSIVITY_MODEL,
) -> Emissivity:
    """Tell what a rough surface emits, by Kirchhoff's law: by wavelength, direction and band.

    Parameters
    ----------
    sample
        Reading, albedo or emissivity, at any wavelengths. A reading and an emissivity are those of
        the rough surface.
    sigma
        Roughness σ, **radians**, 0 to π/2. None takes what the sample says, or else 0.
    angles
        Directions from the normal, **radians**, 0 to π/2; None takes 0, 30, 60 and 80°.
    temperature, background
        Of the surface, and of what surrounds it and is reflected, kelvin; 0 reflects nothing.
    bands
        First and last wavelength in nanometers, or what `read_filter` gave. None takes those of
        3 to 5 and 8 to 14 µm that the sample covers.
    model
        "reference" for the V-cavity, "surface" for a random surface, to σ = 65°.

    Returns
    -------
    `facets`, `hemispherical` and `directional` have one emissivity a band, the last of shape
    (angles, bands). `bands` has one `InBand` for each band: its means, `directional` and
    `hemispherical`, and `apparent`, the temperature that a radiometer tells in each direction.
    `warnings` are sentences.

    Raises
    ------
    DomainError
        An argument lies outside its range, a band is not covered, or the model loses light.

    Examples
    --------
    >>> warm = Sample("Sand", [7500, 10000, 14500], [0.1, 0.3, 0.1], "albedo")
    >>> found = emissivity(warm, radians(30), angles=[0], bands=[(8000, 14000)], background=250)
    >>> found.directional.round(3).tolist()
    [[0.918, 0.744, 0.918]]
    >>> [band] = found.bands
    >>> round(band.directional[0], 2), round(band.apparent[0], 1)
    (0.82, 292.5)
    """
    _check_enabled()
    if sigma is None:
        sigma = radians(sample.sigma_degrees or 0.0)
    named = None if bands is None else [(_band_name(band), band) for band in bands]
    return emission.compute(
        sample,
        sigma,
        angles=emission.ANGLES if angles is None else angles,
        temperature=temperature,
        background=background,
        bands=named,
        model=model,
    )


def read_filter(path: str | os.PathLike[str]) -> Filter:
    r"""Return a radiometer's response from a table with two columns, wavelength and response.

    Parameters
    ----------
    path
        Of a file with wavelengths in nanometers, or in micrometers where the column's name says so.

    Raises
    ------
    InputError
        The file cannot be opened, or holds no response.

    Examples
    --------
    >>> _ = Path("camera.csv").write_text("wavelength (um),response\n7.5,0\n10,1\n14,0\n")
    >>> read_filter("camera.csv").wavelengths.tolist()
    [7500.0, 10000.0, 14000.0]
    """
    return filter_response.read(path)


def write_emissivity(found: Iterable[Emissivity], base: str | os.PathLike[str]) -> list[Path]:
    """Write two tables and a picture of each sample, or nothing.

    Parameters
    ----------
    found
        What `emissivity` gave.
    base
        Folder and base name: "out/sand" becomes out/sand.csv with the spectra, out/sand.bands.csv
        with what follows in bands, and out/sand.png; of several samples out/sand.1.png and so on.

    Returns
    -------
    The files written.

    Raises
    ------
    DomainError
        There is nothing to write.
    OutputError
        A file cannot be written or replaced; none was touched.

    Examples
    --------
    >>> warm = Sample("Sand", [7500, 10000, 14500], [0.1, 0.3, 0.1], "albedo")
    >>> [path.name for path in write_emissivity([emissivity(warm, radians(30))], "out/sand")]
    ['sand.csv', 'sand.bands.csv', 'sand.png']
    """
    given = list(found)
    if not given:
        msg = "There is no emissivity to write; give what `emissivity` returned."
        raise DomainError(msg)
    return emission_files.write(given, Path(base))


def request(
    sample: Sample,
    sigma: float | None = None,
    *,
    kind: Kind | None = None,
    model: str = AUTO,
    illuminant: str = "D65",
    observer: int = 2,
    tolerance: float = TOLERANCE,
    rdq: float | None = None,
    sdq: float | None = None,
    white: str | None = None,
    white_factor: float | str | None = None,
    read_at: str = DEFAULT,
) -> Request:
    """Say what to make of a sample; what is left out is as on the command line.

    Parameters
    ----------
    sample
        What `read` or `find` gave, or a `Sample` of your own.
    sigma
        Roughness σ, **radians**, 0 to π/3. None takes what the sample says, or else 0.
    kind
        "reading" for the reflectance factor that an instrument printed of the rough surface,
        "albedo" for the reflectance of one facet. None takes what the sample says.
    model
        "auto", which is `core.models.TARGET`, or one of `core.models.NAMES`.
    illuminant
        Light under which the color is right: "D65", "A", "D50", "D55", "D75", "E", "F2", "F7",
        "F11" or "LED-B3".
    observer
        Of reports, 2 or 10 (degrees).
    tolerance
        Largest ΔE00 from the reference that "auto" accepts for a simpler model, 0.05 to 20.
    rdq, sdq
        Instead of σ, the rms slope of a profile or of an area as a profilometer prints it, rise
        over run: σ = atan(Rdq) = atan(Sdq/√2). It is kept with the material as the source of σ.
    white, white_factor
        What the values are relative to: "perfect" for the perfect diffuser, or the certificate of
        the instrument's white plaque, "45:0" or "8:d"; and the plaque's true reflectance factor at
        the instrument's geometry over the certificate's value, or "ptfe" for sintered PTFE. None
        takes what the sample says. The values stay as measured.
    read_at
        Virtual instrument that the material is to read right at, and is measured with: one of
        `core.instruments.REGISTRY`, such as "45a:0" or "di:8". The sample says itself which real
        instrument it was measured with.

    Raises
    ------
    DomainError
        A setting is none of these; or σ, Rdq and Sdq contradict each other.
    InputError
        The kind is neither, or the white's factor does not follow from what is stated.

    Examples
    --------
    >>> request(find("brick"), rdq=0.35).sample.sigma_source
    'Rdq 0.35 (19.3°)'
    >>> round(request(find("brick"), white="8:d", white_factor="ptfe").sample.scale, 4)
    1.0259
    >>> wanted = request(find("green"), sigma=radians(20), illuminant="D50")
    >>> wanted.model, wanted.illuminant, round(wanted.sigma, 3)
    ('auto', 'D50', 0.349)
    >>> request(find("green"), sigma=20)
    Traceback (most recent call last):
    rough_spectra.core.errors.DomainError: σ is 20 radians; give 0 to π/3, as math.radians(30) is.
    """
    if rdq is not None or sdq is not None:
        stated = StatedSigma(None if sigma is None else degrees(sigma), rdq, sdq)
        _, fault = stated.fault(_SIGMA)
        if fault:
            raise DomainError(f"Sample {sample.name!r}: {fault}.")
        source = stated.source("")
        sample = replace(sample, sigma_degrees=stated.settled, sigma_source=source)
    if sigma is None:
        sigma = radians(sample.sigma_degrees or 0.0)
    if kind is not None:
        sample = sample.taken_as(kind)
    sample = stated_white.given(sample, white, white_factor)
    return Request(
        sample,
        sigma,
        model,
        illuminant=illuminant,
        observer=observer,
        tolerance=tolerance,
        read_at=read_at,
    )


def compare(first: Sample | Request, second: Sample | Request) -> Comparison:
    """Tell how far two samples are apart, as measured and as the albedos behind.

    Parameters
    ----------
    first, second
        What is compared. A sample alone stands for `request(sample)`.

    Returns
    -------
    `measured` between what the virtual instrument reads, `albedos` between the albedos, and
    `roughness`, for each of the two what its roughness does: from its albedo to its reading. Each
    has `delta_e_00`; `delta_l`, `delta_a` and `delta_b`, second less first; `delta_ab`; and
    `shift`, the distance in a*b* once both have the luminance of the first. `interreflection` is
    the share of each one's reading that met more than one facet.

    Raises
    ------
    DomainError
        Model, illuminant, observer or virtual instrument differ, or a spectrum does not cover the
        visible range.

    Examples
    --------
    >>> green = find("green")
    >>> smooth, rough = (request(green, radians(degrees), kind="albedo") for degrees in (0, 45))
    >>> found = compare(smooth, rough)
    >>> round(found.measured.delta_e_00, 1), round(found.albedos.delta_e_00, 1)
    (7.9, 0.0)
    >>> round(found.measured.shift, 1), round(found.interreflection[1], 2)
    (3.0, 0.1)
    """
    pair = (request(what) if isinstance(what, Sample) else what for what in (first, second))
    return matching_compare.compare(*pair)


def assign(
    pairs: Iterable[tuple[bpy.types.Material, Sample | Request]],
    shader: str | Sequence[str] = "auto",
    gloss: str = "keep",
) -> list[Solution]:
    """Give materials measured spectra, all of them or none, and set their shader nodes.

    Parameters
    ----------
    pairs
        Each a material, and what it is to become. A sample alone stands for `request(sample)`.
    shader
        "auto" sets the Diffuse or Principled BSDF that is in use, or a new Diffuse BSDF;
        "diffuse" and "principled" ask for that node. One for all, or a list with one a pair.
    gloss
        "keep" leaves a Principled BSDF the gloss that it has, and solves the color below it;
        "none" removes it. A node that is made has none. "read" sets its level and roughness to what
        a sample's set says of gloss (see `estimate_gloss`), in a Principled BSDF; where it says
        nothing, it is as "keep".

    Returns
    -------
    What was matched, in the order of `pairs`: among others `color`, shape (3,); `roughness`;
    `delta_e_instrument` and `delta_e_mean`, the ΔE00 that remain at the virtual instrument and over
    all angles;
    and `warnings`, sentences that should be read.

    Raises
    ------
    MaterialError
        A material cannot be written, or is named twice; nothing was changed.
    DomainError
        A spectrum or a setting cannot be used; nothing was changed.

    Examples
    --------
    >>> wall, door = (bpy.data.materials.new(name) for name in ("Wall", "Door"))
    >>> pairs = [(wall, find("neutral 6.5")), (door, request(find("green"), 0.35))]
    >>> solutions = assign(pairs, gloss="none")
    >>> [[round(value, 2) for value in solution.color.tolist()] for solution in solutions]
    [[0.36, 0.36, 0.36], [0.06, 0.3, 0.06]]
    >>> [round(solution.roughness, 2) for solution in solutions]
    [0.0, 0.28]
    >>> [solution.delta_e_instrument < 0.001 for solution in solutions]
    [True, True]
    """
    wanted = [
        (_checked(material), request(what) if isinstance(what, Sample) else what)
        for material, what in pairs
    ]
    if gloss not in ("keep", "none", "read"):
        raise DomainError(f"gloss is {gloss!r}; make it 'keep', 'none' or 'read'.")
    shaders = [shader] * len(wanted) if isinstance(shader, str) else list(shader)
    if len(shaders) != len(wanted):
        raise DomainError(
            f"{len(shaders)} shaders stand beside {len(wanted)} pairs; give one each."
        )
    nodes = [_node(each) for each in shaders]
    return derive.assign(wanted, nodes, gloss != "none", from_readings=gloss == "read")


def match_by_measuring(
    material: bpy.types.Material,
    sample: Sample | Request | None = None,
    color: str = "",
    progress: Callable[[int, int], None] | None = None,
) -> Adjusted:
    """Set one color of a material so that what Cycles shows is the sample's reading.

    For what no formula tells: mixes, groups, sheen, layers, bump. Several colors are tried at once
    in a second Blender, up to five times, and this call waits for it. Nothing but that color is
    changed, and it is kept: it does not follow σ.

    Parameters
    ----------
    sample
        What it is to read; None for what the material stores.
    color
        Node and name of a socket, as in "Diffuse BSDF: Color"; a group's input; or an RGB node.
        Empty takes the one that is most likely meant.
    progress
        Called with measurements done and how many there are at most; may raise to stop.

    Returns
    -------
    `color` and `reading`, shape (3,); `delta_e` between reading and sample; `is_met`, whether
    that is at most 0.1; `measurements`; and a `sentence` for a person, which tells what can be had
    where the sample cannot.

    Raises
    ------
    MaterialError
        The material cannot be written, has no such color, or does not change with it; nothing was
        changed.
    OutputError
        The second Blender failed; nothing was changed.
    CancelledError
        On an interrupt from the keyboard; nothing was changed.

    Examples
    --------
    >>> velvet = bpy.data.materials.new("Velvet")
    >>> _ = assign([(velvet, find("green"))], "principled")
    >>> velvet.node_tree.nodes["Principled BSDF"].inputs["Sheen Weight"].default_value = 0.3
    >>> found = match_by_measuring(velvet)
    >>> found.is_met, state(velvet).kind
    (True, 'kept')
    """
    _checked(material)
    asked = storage.load(material) if sample is None else sample
    wanted = request(asked) if isinstance(asked, Sample) else asked
    return adjustment.adjust(material, wanted, colors.find(material, color), progress)


def materials() -> list[bpy.types.Material]:
    """Return all materials of the open file that store a spectrum, sorted by name.

    Examples
    --------
    >>> plain, wall = (bpy.data.materials.new(name) for name in ("Plain", "Wall"))
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [material.name for material in materials()]
    ['Wall']
    """
    _check_enabled()
    return selection.with_spectrum()


def renew(materials: Iterable[bpy.types.Material]) -> list[Solution]:
    """Derive color and roughness again from what the materials store, all of them or none.

    Edits of the shader node by hand are overwritten: `state` tells beforehand.

    Returns
    -------
    As of `assign`, in the order of `materials`.

    Raises
    ------
    MaterialError
        A material stores no spectrum or cannot be written; nothing was changed.
    DomainError
        A spectrum cannot be used; nothing was changed.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> with paused():
    ...     wall.rough_spectra.sigma = radians(40)
    >>> [solution] = renew([wall])
    >>> round(solution.roughness, 2)
    0.68
    """
    return derive.renew([_checked(material) for material in materials])


def paused() -> AbstractContextManager[None]:
    """Let no color follow while several settings are written; call `renew` afterwards.

    Without it every setting of `material.rough_spectra` is followed at once, at a few milliseconds
    each.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> with paused():
    ...     wall.rough_spectra.sigma = radians(30)
    ...     wall.rough_spectra.illuminant = "A"
    >>> state(wall).kind
    'stale'
    """
    return changes.paused()


def state(material: bpy.types.Material) -> State:
    """Tell whether color and roughness still follow from the spectrum, and if not, why.

    Only compares what is stored: cheap enough to draw with.

    Returns
    -------
    Its `kind` is "none" (no spectrum), "fresh", "stale", "kept" (edited by hand, and accepted),
    "error" or "linked"; `reasons` are sentences, most important first; `stamp` is what was
    derived, or None.

    Raises
    ------
    MaterialError
        This is no material.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> state(wall).kind
    'none'
    >>> _ = assign([(wall, find("neutral 6.5"))], shader="diffuse")
    >>> state(wall).kind
    'fresh'
    >>> node = wall.node_tree.nodes[state(wall).stamp.node]
    >>> node.inputs["Color"].default_value = (1, 0, 0, 1)
    >>> state(wall).kind, state(wall).reasons
    ('stale', ('color or roughness was edited by hand',))
    """
    return material_state.state(_checked(material))


def keep(material: bpy.types.Material) -> None:
    """Accept what the surface shows as edited by hand; the spectrum stays as it is.

    Raises
    ------
    MaterialError
        Nothing was derived from a spectrum yet, or the material is linked.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], shader="diffuse")
    >>> wall.node_tree.nodes[state(wall).stamp.node].inputs["Roughness"].default_value = 0.5
    >>> keep(wall)
    >>> state(wall).kind
    'kept'
    """
    storage.keep(_checked(material))


def settle(material: bpy.types.Material) -> Settled:
    """Return what a material is to become, as its settings are now.

    Returns
    -------
    Its `request` has the sample, σ in radians, and the model that holds in place of "auto";
    `model_reason` says why.

    Raises
    ------
    MaterialError
        The material has no spectrum that can be read.
    DomainError
        Its spectrum or a setting cannot be used.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> wanted = settle(wall).request
    >>> wanted.sample.name, wanted.model, round(wanted.sigma, 4)
    ('ColorChecker 21 Neutral 6.5 (.44 D)', 'surface', 0.5236)
    """
    return settled.of(_checked(material))


def differences(material: bpy.types.Material) -> Differences:
    """Tell how far the surface in Cycles is from its target, as predicted: nothing is rendered.

    Returns
    -------
    ΔE00 at the virtual instrument, and its mean and 95th percentile over all angles.

    Raises
    ------
    MaterialError, DomainError
        As of `settle`; or the surface shows what nobody predicts, such as gloss or a texture.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> instrument, mean, _ = differences(wall)
    >>> round(instrument, 2), round(mean, 1)
    (0.0, 0.8)
    """
    return settled.differences(_checked(material), working_space.current())


def spots(
    thing: bpy.types.Object,
    *,
    at: bpy.types.Object | None = None,
    vertex_group: str | None = None,
    diameter: float = SPOT_DIAMETER,
    keep_neighbors: bool = False,
) -> list[Spot]:
    """Say where on an object a virtual instrument is put down, for `bake`.

    Parameters
    ----------
    thing
        A mesh, or what Blender makes a mesh of, in the open scene.
    at
        An empty, or any object, whose z axis meets the surface at the spot and points to the
        instrument; azimuths count from its x axis.
    vertex_group
        The spot is in the middle of it. Without either there is one spot in the middle of each of
        the object's materials.
    diameter
        Of the spot, millimeters.
    keep_neighbors
        Whether other objects shade and light the spot; else they are hidden.

    Returns
    -------
    Each has, among others, its `material`, and `point` and `normal` in the scene.

    Raises
    ------
    MaterialError
        There is no such place, or it has no material; or the object's surface cannot be measured.
    DomainError
        The diameter is no length, or there are two places.

    Examples
    --------
    >>> import bmesh
    >>> shape, mesh = bmesh.new(), bpy.data.meshes.new("Ball")
    >>> _ = bmesh.ops.create_uvsphere(shape, u_segments=64, v_segments=32, radius=1)
    >>> shape.to_mesh(mesh)
    >>> ball, wall = bpy.data.objects.new("Ball", mesh), bpy.data.materials.new("Wall")
    >>> bpy.context.scene.collection.objects.link(ball)
    >>> mesh.materials.append(wall)
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [entry] = bake(spots(ball, diameter=4)).entries
    >>> [round(value, 2) for value in entry.measured.rgb], entry.delta_e_00 < 0.1
    ([0.36, 0.36, 0.36], True)
    >>> entry.spot.diameter, entry.spot.covered
    (4, 1.0)
    """
    _check_enabled()
    if not isinstance(thing, bpy.types.Object):
        raise MaterialError(f"{thing!r} is no object; give one of bpy.data.objects.")
    if at is not None and vertex_group is not None:
        raise DomainError("A spot has one place; give `at` or `vertex_group`, not both.")
    how = {"diameter": diameter, "is_alone": not keep_neighbors}
    if at is not None:
        return [instrument_spot.at_empty(thing, at, **how)]
    if vertex_group is not None:
        return [instrument_spot.at_group(thing, vertex_group, **how)]
    return instrument_spot.on_materials(thing, **how)


def bake(
    surfaces: Iterable[bpy.types.Material | tuple[str, bpy.types.Material] | Spot],
    measure: bool = True,
    progress: Callable[[int, int], None] | None = None,
    read_at: str | Iterable[str] | None = None,
    with_gloss: bool = False,
) -> Readings:
    """Predict the readings of materials at virtual instruments, and measure them in Cycles.

    Cycles renders in a second Blender, and this call waits for it. The open file is not changed.

    Parameters
    ----------
    surfaces
        Materials; or pairs of a name to tell them by, such as that of an object, and a material:
        they are measured as flat samples. Or what `spots` gave, measured on the object itself. What
        has no spectrum is measured and not predicted.
    measure
        Whether to measure; predictions alone need no second Blender.
    progress
        Called with renders done and renders in all.
    read_at
        Instruments instead of each material's own, one or several.
    with_gloss
        Whether to measure gloss units, too, as `gloss` does; they are in each reading's `gloss`.

    Returns
    -------
    Its `entries` have one `Reading` for each surface and instrument, in this order; each names its
    `instrument`: `predicted.values`, one a
    band; `measured.rgb`; `delta_e_00` between the two; `warnings`; and `fault`, why a prediction
    or a measurement is missing, which does not stop the others. `largest_delta_e` is the largest.
    A spot's reading has a `spot`: among others `spread_mean` and `spread_95`, ΔE00 from the reading
    over the spot, and `covered`, the share of the spot that the object fills.

    Raises
    ------
    MaterialError
        A surface is no material.
    DomainError
        An instrument is not known.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> [entry] = bake([wall]).entries
    >>> [round(value, 3) for value in entry.measured.rgb]
    [0.311, 0.31, 0.311]
    >>> entry.delta_e_00 < 0.01
    True
    """
    found: list[tuple[str, Any] | Spot] = []
    for surface in surfaces:
        if isinstance(surface, Spot):
            found.append(surface)
        else:
            name, material = surface if isinstance(surface, tuple) else ("", surface)
            found.append((name, _checked(material)))
    at = (read_at,) if isinstance(read_at, str) else tuple(read_at or ())
    return instrument_surfaces.read(found, measure, progress, at, with_gloss)


def gloss(
    materials: Iterable[bpy.types.Material],
    angles: Iterable[float] = (20, 60, 85),
    progress: Callable[[int, int], None] | None = None,
) -> Array:
    """Measure the gloss of materials with the virtual gloss meter of ISO 2813, in Cycles.

    Cycles renders in a second Blender, and this call waits for it. The open file is not changed.

    Parameters
    ----------
    materials
        Any materials, with a spectrum or without.
    angles
        Degrees: 20, 60 and 85.
    progress
        Called with renders done and renders in all.

    Returns
    -------
    Gloss units, shape (materials, angles): 100 is polished black glass of the index 1.567. Exact to
    0.1 for mirrors, to some 2 % for rough surfaces.

    Raises
    ------
    MaterialError
        One is no material.
    DomainError
        There is no gloss meter of an angle.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [[units]] = gloss([wall], [60])
    >>> bool(units < 2)  # matte: what the window sees of the diffuse light
    True
    """
    checked = [_checked(material) for material in materials]
    space = working_space.current()
    return instrument_gloss.measured(checked, space, tuple(angles), progress)


def write(
    readings: Readings,
    base: str | os.PathLike[str],
    formats: Iterable[str] = writers.FORMATS,
) -> list[Path]:
    """Write all files of a bake, or none; what an earlier bake wrote beside them goes.

    Parameters
    ----------
    readings
        What `bake` gave.
    base
        Folder and base name; endings are added: "out/chart" becomes out/chart.json,
        out/chart.predicted.csv and so on. Folders are made.
    formats
        Any of "csv", "cgats" and "exr", to be written beside the JSON document.

    Returns
    -------
    The files written.

    Raises
    ------
    DomainError
        A format is not known; nothing was written.
    OutputError
        A file cannot be written or replaced; none was touched.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [path.name for path in write(bake([wall], measure=False), "out/chart", ["csv"])]
    ['chart.predicted.csv', 'chart.json']
    """
    chosen = (formats,) if isinstance(formats, str) else tuple(formats)
    unknown = [name for name in chosen if name not in writers.FORMATS]
    if unknown:
        msg = f"The format {unknown[0]!r} is not known; choose of {', '.join(writers.FORMATS)}."
        raise DomainError(msg)
    return writers.write(readings, Path(base), chosen)


def export(
    materials: Iterable[bpy.types.Material],
    base: str | os.PathLike[str],
    targets: Iterable[str] = export_targets.NAMES,
) -> Exported:
    """Write materials for other renderers, each solved for the lobe of the renderer that shows it.

    The open file is not changed. What is written follows the spectra and their settings, is matte,
    and reads right at each material's virtual instrument.

    Parameters
    ----------
    materials
        With a spectrum. One whose data cannot be used is a fault in the result, and does not stop
        the others.
    base
        Folder and base name; endings are added: "out/chart" becomes out/chart.mtlx and so on.
    targets
        Any of "materialx", "usd", "gltf", "mitsuba", "pbrt" and "luxcore"; "usd" starts a second
        Blender, and this call waits for it.

    Returns
    -------
    Its `files`, one a target; `faults` and `warnings`, sentences; and `entries`, or `of(target)`
    alone, each with `color`, `roughness` in the renderer's unit, `delta_e_instrument`, and
    `delta_e_mean` and `delta_e_95` over the hemisphere.

    Raises
    ------
    MaterialError
        None of the materials has a spectrum that can be used.
    DomainError
        A target is not known, or there is no material.
    OutputError
        A file cannot be written or replaced, or the second Blender failed; none was touched.
    CancelledError
        On an interrupt from the keyboard; nothing was written.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> found = export([wall], "out/wall", ["materialx", "gltf"])
    >>> [path.name for path in found.files]
    ['wall.mtlx', 'wall.gltf']
    >>> [(each.lobe.name, round(each.roughness, 2)) for each in found.entries]
    [('eon', 0.47), ('lambert', 0.0)]
    >>> [round(each.delta_e_mean, 1) for each in found.entries]
    [0.7, 4.1]
    """
    chosen = (targets,) if isinstance(targets, str) else tuple(targets)
    return export_files.materials(map(_checked, materials), Path(base), chosen)


def export_losses(materials: Iterable[bpy.types.Material]) -> list[Loss]:
    """Tell what Blender's own exporters, glTF and USD, would make of materials, where it is seen.

    Nothing is exported: what they write is known, and what Cycles shows of it is predicted.

    Returns
    -------
    One for each material and exporter that end farther apart than the material's tolerance, with
    `exporter`, `delta_e_instrument`, `delta_e_mean` over the hemisphere, and a `sentence`.

    Raises
    ------
    MaterialError
        One is no material.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], "principled", "none")
    >>> gltf, usd = export_losses([wall])
    >>> gltf.exporter, round(gltf.delta_e_instrument, 1), round(gltf.delta_e_mean, 1)
    ('glTF', 2.3, 4.7)
    """
    return kept.losses(map(_checked, materials))


def rough_sample(
    kind: str,
    sigma: float | None = None,
    length: float | None = None,
    *,
    seed: int = 0,
    cells: int = kinds.CELLS,
    path: str | os.PathLike[str] | None = None,
) -> RoughSample:
    """Make a rough surface of facets, to be measured by `measure_rough`.

    Parameters
    ----------
    kind
        "gaussian" or "multiscale" (random heights), "grooves" or "grooves-oren-nayar" (V-grooves of
        either slope law), "grains" (packed spheres), or "map" (heights from a file).
    sigma
        Roughness σ, **radians**: the tangent is Rdq of the facets, or the width of the grooves'
        slope law. None leaves grains spheres, and a map as it was measured.
    length
        Correlation length, mean width of a groove, diameter of a grain, or length between two
        heights of a map that does not say it, in any unit; 1 if not given.
    seed
        Another surface of the same kind for each number.
    cells
        Of the mesh, a side; a map has its own.
    path
        Of a map: a 16-bit or float image, or a text of points x y z, of a matrix, or SDF.

    Returns
    -------
    Its `mesh` has `vertices`, `faces`, `period`, `rdq` and `sdq`; its `sigma` is the angle of Rdq.

    Raises
    ------
    DomainError
        The numbers make no such surface.
    InputError
        The file cannot be used, or has holes.

    Examples
    --------
    >>> sample = rough_sample("gaussian", radians(30), cells=64)
    >>> len(sample.mesh.faces), round(sample.mesh.rdq, 4), round(sample.mesh.sdq, 4)
    (8192, 0.5774, 0.8165)
    """
    where = None if path is None else Path(path)
    return kinds.make(kind, sigma, length, seed=seed, cells=cells, path=where)


def measure_rough(
    sample: RoughSample,
    albedos: Iterable[float],
    spot: float | None = None,
    *,
    seeds: int = experiment.SEEDS,
    samples: int = experiment.SAMPLES,
    progress: Callable[[int, int], None] | None = None,
) -> Measured:
    """Measure a rough surface in Cycles at 45°/0°, with all bounces between its facets.

    Cycles renders in a second Blender, and this call waits for it. The open file is not changed.

    Parameters
    ----------
    sample
        What `rough_sample` gave.
    albedos
        Of its Lambertian facets, 0 to 1; three are rendered at once.
    spot
        Diameter of what the instrument sees, in the unit of the sample's length. None takes half of
        what the surface repeats after.
    seeds, samples
        Renders with random numbers of their own, two or more, and rays a pixel in each; a picture
        that is finer for the sake of a small spot shares as many.
    progress
        Called with renders done and renders in all.

    Returns
    -------
    Arrays, one number an albedo: `reflectance`, the mean over all places of the spot, and `noise`,
    its standard error; `spread`, the standard deviation over places, free of noise; `spot_noise`,
    the standard error of a reading at one place.

    Raises
    ------
    DomainError
        A number is out of its range.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> sample = rough_sample("gaussian", radians(30), cells=64)
    >>> found = measure_rough(sample, [0.2, 0.8], seeds=2, samples=16)
    >>> [round(value, 2) for value in found.reflectance.tolist()]
    [0.17, 0.77]
    >>> bool((found.noise < 0.002).all()), bool((found.spread < 0.02).all())
    (True, True)
    """
    return experiment.measure(
        sample.mesh,
        list(albedos),
        spot,
        seeds=seeds,
        samples=samples,
        progress=progress,
    )


def make_texture(
    source: str | os.PathLike[str],
    target: str | os.PathLike[str],
    sigma: float,
    *,
    instrument: str = DEFAULT,
    illuminant: str = "D65",
    model: str = TARGET,
    holds: str = "albedo",
    scale: float | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Made:
    r"""Turn an image of what was read of a rough surface into a texture, in half floats.

    Parameters
    ----------
    source
        A spectral OpenEXR, an ENVI cube or its header, or red, green and blue.
    target
        The texture, an EXR in the working space of the open file.
    sigma
        Roughness σ, **radians**, 0 to π/3.
    instrument
        That the image was taken with.
    illuminant
        The light under which the texture is right; of RGB, the one that the image was taken for.
    model
        One of `core.models.NAMES`.
    holds
        "albedo" of the facets, or "color" that Cycles' Diffuse needs to read as was measured.
    scale
        Of an ENVI cube, the number that stands for a reflectance of 1; None takes the header's.
    progress
        Called with lines done and lines in all; may raise to stop.

    Returns
    -------
    Its `path`, `width` and `height`; the `roughness` that goes with it in Cycles; the `mean`
    reading as a `Sample`, None of RGB; the shares of pixels that are `infeasible` (they read more
    than white facets) and `outside` 0 to 1; and `notes`.

    Raises
    ------
    InputError
        The image cannot be read, has pixels that are not numbers, or lacks bands.
    OutputError
        The texture cannot be written.
    DomainError
        An argument is none of these.
    CancelledError
        On an interrupt from the keyboard. Nothing was written.

    Examples
    --------
    >>> header = "ENVI\nsamples = 2\nlines = 1\nbands = 4\ndata type = 1\ninterleave = bip\n"
    >>> header += "wavelength units = nm\nwavelength = {400, 500, 600, 700}\n"
    >>> _ = Path("wall.hdr").write_text(header + "reflectance scale factor = 200")
    >>> _ = Path("wall.img").write_bytes(bytes([100, 100, 100, 100, 40, 40, 40, 40]))
    >>> made = make_texture("wall.img", "wall.exr", radians(20), holds="color")
    >>> made.width, made.mean.values.round(2).tolist(), made.infeasible
    (2, [0.35, 0.35, 0.35, 0.35], 0.0)
    """
    _check_enabled()
    wanted = _Wanted(sigma, instrument, illuminant, model, holds, scale)
    conversion = convert.Conversion(Path(source), Path(target), wanted, working_space.current())
    return conversion.finish(progress)


def texture_material(made: Made, name: str = "") -> Any:
    """Make a material that shows a texture, so that each of its pixels reads what was measured.

    Parameters
    ----------
    made
        What `make_texture` gave, of colors.
    name
        Of the material; empty for that of the texture's file.

    Raises
    ------
    MaterialError
        There is a material of this name, or the texture holds albedo.

    Examples
    --------
    >>> from rough_spectra.addon.support import png
    >>> import numpy as np
    >>> _ = Path("scan.png").write_bytes(png.encode(np.full((2, 2, 3), 128, np.uint8)))
    >>> made = make_texture("scan.png", "scan.exr", radians(20), holds="color")
    >>> texture_material(made, "Wall").node_tree.nodes["Image Texture"].image.name
    'scan.exr'
    """
    _check_enabled()
    return material_of_texture.make(made, name)


def spectral_picture(
    scene: bpy.types.Scene | None = None,
    *,
    tolerance: float = TOLERANCE,
    bands: int | None = None,
    observer: int = 2,
    direct: bool | None = None,
    compare: bool = True,
    samples: int | None = None,
    percentage: int | None = None,
    lights: Mapping[str, str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> SpectralPicture:
    """Render a scene spectrally: as many ordinary renders as needed, with three bands in each.

    A second Blender renders a copy of the open file as it is now, and this call waits for it. The
    file, its settings and the last render are not changed. What comes after the render, such as
    compositing, is not done.

    Parameters
    ----------
    scene
        Rendered by Cycles; the active one if left out. Of its view layers the first counts that is
        rendered.
    tolerance
        ΔE00 within which 95 % of the picture shall be, as far as the number of bands decides it.
    bands
        A number of bands instead, a multiple of 3.
    observer
        2 or 10 degrees.
    direct
        Whether light that met one surface alone is rendered apart and is exact, at the cost of one
        more render for each spectrum of light. None chooses what needs fewer renders.
    compare
        Whether the ordinary picture is rendered, too, and compared.
    samples, percentage
        Of the renders, instead of the scene's own.
    lights
        By the names of lamps, worlds and materials that emit one color, the spectrum that it has:
        a CIE illuminant such as "F11", or the path of a TM-27 file (.spdx), of a table of
        wavelengths and power on any scale, or of a spectral image. Its luminance stays that of its
        color.
    progress
        Called with renders done and renders in all.

    Returns
    -------
    Its `rgb` is what a render would be: scene-linear RGB and alpha, shape (rows, columns, 4), from
    the bottom up; `xyz`; the `wavelengths` of the bands; the `predicted` error (`mean`, `usual`,
    which is 95 %, and `largest`), and whether it is `enough`; the `comparison` with the ordinary
    picture: `delta_e`, `mean`, `usual`, `largest`, and `where`; by which `rules` each material,
    lamp and world got its spectra; what stayed RGB (`untranslated`); `seconds`; and `spectra`,
    whose `at(column, row)` is a pixel's radiance per nanometer from 360 to 780 nm every 10 nm.

    Raises
    ------
    MaterialError
        The scene has another render engine, no camera, no light, or none that `lights` names.
    DomainError
        An argument is none of these.
    InputError
        A file of `lights` cannot be read.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> picture = spectral_picture(scene, bands=3, samples=1, compare=False)
    >>> picture.rgb.shape, len(picture.wavelengths), picture.untranslated
    ((8, 8, 4), 3, {})
    """
    _check_enabled()
    wanted = picture_render.Wanted(
        tolerance, bands, observer, direct, compare, samples, percentage, lights or {}
    )
    return picture_render.render(scene or bpy.context.scene, wanted, progress)


def picture_verdict(
    scene: bpy.types.Scene | None = None,
    *,
    tolerance: float = TOLERANCE,
    samples: int | None = None,
    percentage: int | None = None,
    lights: Mapping[str, str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Verdict:
    """Say whether RGB is enough for a scene, and if not, the least that is.

    A second Blender renders small pictures of a copy of the open file, and this call waits for it.

    Parameters
    ----------
    scene, lights, progress
        As for `spectral_picture`.
    tolerance
        ΔE00 within which 95 % of the picture shall be.
    samples, percentage
        Of the small pictures; 8, and what comes to 240 × 135 pixels, if left out.

    Returns
    -------
    Whether RGB is `enough`; the `sentence`; the `rungs`, from RGB as it is over the working space
    and the materials' match to passes of three bands, each with `kind`, `words`, `renders`,
    `mean`, `usual`, `largest` (ΔE00) and `seconds`; the `chosen` one, which is RGB within the
    tolerance, else the first that surely is, or None; the `comparison` of RGB with the spectral
    picture, in blocks of pixels; what stayed RGB (`untranslated`), and which part of the picture
    that has `touched`.

    Raises
    ------
    RoughSpectraError
        As of `spectral_picture`.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> picture_verdict(scene, samples=1).sentence
    'RGB is enough: 95 % of the picture within ΔE00 0.00, the tolerance is 1.'
    """
    _check_enabled()
    return picture_judgement.judge(
        scene or bpy.context.scene,
        progress,
        tolerance=tolerance,
        samples=samples,
        percentage=percentage,
        lights=lights,
    )


def picture_lights(
    scene: bpy.types.Scene | None = None,
    *,
    tolerance: float = TOLERANCE / 2,
    bands: int | None = None,
    samples: int | None = None,
    percentage: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Lights:
    """Render the light of each lamp apart, so that lamps can be changed without rendering.

    Parameters
    ----------
    scene, bands, samples, percentage, progress
        As for `spectral_picture`.
    tolerance
        ΔE00 within which 95 % of the picture shall be, in the scene's own light and in that of
        the usual illuminants.

    Returns
    -------
    Their `names`, `spectra`, `parts`, `alpha` and `wavelengths`, for `relight`.

    Raises
    ------
    RoughSpectraError
        As of `spectral_picture`; and where lamps cannot be told apart.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> lights = picture_lights(scene, bands=3, samples=1)
    >>> lights.names, lights.parts.shape, relight(lights, {"Gray": "A"}).rgb.shape
    (('Gray',), (1, 3, 8, 8), (8, 8, 4))
    """
    _check_enabled()
    wanted = picture_render.Wanted(
        tolerance, bands, plain=False, samples=samples, percentage=percentage, steady=True
    )
    return picture_groups.gather(scene or bpy.context.scene, wanted, progress)


def relight(
    lights: Lights,
    spectra: Mapping[str, str] | None = None,
    intensities: Mapping[str, float] | None = None,
    observer: int = 2,
) -> SpectralPicture:
    """Give the picture with other lamps, without rendering; see `picture_lights`.

    Parameters
    ----------
    lights
        What `picture_lights` gave.
    spectra
        By name, the CIE illuminant that a lamp becomes, or the path of a table.
    intensities
        By name, how many times as bright it is.
    observer
        2 or 10 degrees.

    Raises
    ------
    DomainError, InputError
        There is no such lamp or light, or the open file has another working space.

    Examples
    --------
    >>> import numpy as np
    >>> from rough_spectra.addon.colorimetry import illuminant_spectra
    >>> nm, day = illuminant_spectra.GRID, illuminant_spectra.cie("D65")
    >>> gray, parts = np.full((1, nm.size), 0.5), np.full((1, 3, 2, 2), 0.5, np.float32)
    >>> at = nm[[18, 36, 54]]
    >>> lights = Lights(("Lamp",), day[None], parts, np.ones((2, 2)), at, gray, "Linear Rec.709")
    >>> round(float(relight(lights, {"Lamp": "A"}, {"Lamp": 2.0}).xyz[0, 0, 1]), 3)
    1.0
    """
    _check_enabled()
    desk = picture_relight.Desk(lights, observer)
    picture_relight.set_all(desk, spectra or {}, intensities or {})
    return desk.picture()


def thermal_picture(
    scene: bpy.types.Scene | None = None,
    *,
    band: tuple[float, float] = thermal.BAND,
    parts: int = 3,
    ambient: float = thermal.AMBIENT,
    sky: float | None = None,
    emissivity: float = thermal.EMISSIVITY,
    materials: Mapping[str, Sample | float] | None = None,
    samples: int | None = None,
    percentage: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> ThermalPicture:
    """Render what a thermal camera sees of a scene.

    An object's temperature is its custom property `rough_spectra_temperature`, kelvin, or an
    attribute of this name of its vertices.

    Parameters
    ----------
    scene, samples, percentage, progress
        As for `spectral_picture`.
    band
        First and last wavelength of the camera, nanometers, from 700.
    parts
        Of the band, each with one emissivity a material, a multiple of 3: three a render.
    ambient
        Temperature of objects that have none, kelvin.
    sky
        That of what is seen where nothing is, kelvin; None for `ambient`.
    emissivity
        Of materials without infrared data.
    materials
        By name, a sample or an emissivity instead of what the material stores.

    Returns
    -------
    `radiance`, W m⁻² sr⁻¹ in the band, and `kelvin`, the temperature of a black body that sends
    as much, both of shape (rows, columns), from the bottom up; the `band`; the names of materials
    whose emissivity was `assumed`; and `temperatures`, by the names of objects.

    Raises
    ------
    RoughSpectraError
        An argument or a temperature is none, the scene has no camera, or the second Blender failed.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> round(float(thermal_picture(scene, sky=300.0, samples=1).kelvin.mean()), 2)
    300.0
    """
    _check_enabled()
    wanted = thermal.Wanted(
        band, parts, ambient, sky, emissivity, materials or {}, samples, percentage
    )
    return thermal.render(scene or bpy.context.scene, wanted, progress)


def write_thermal(picture: ThermalPicture, path: str | os.PathLike[str]) -> None:
    """Write a thermal picture as an EXR with the channels `radiance` and `kelvin`.

    Parameters
    ----------
    picture
        What `thermal_picture` gave.
    path
        Ends in .exr.

    Raises
    ------
    OutputError
        The file cannot be written.

    Examples
    --------
    >>> import numpy as np
    >>> warm = np.full((2, 3), 300.0)
    >>> write_thermal(ThermalPicture((8000.0, 14000.0), warm, warm, (), {}), "warm.exr")
    """
    _check_enabled()
    picture_files.check(Path(path))
    thermal_file.write(picture, Path(path))


def infrared_picture(
    scene: bpy.types.Scene | None = None,
    *,
    band: tuple[float, float] | Filter = infrared_wanted.BAND,
    parts: int = 3,
    lights: Mapping[str, str] | None = None,
    materials: Mapping[str, Sample | float] | None = None,
    samples: int | None = None,
    percentage: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> InfraredPicture:
    """Render what a camera sees of a scene in the infrared, by the light of its lamps.

    Parameters
    ----------
    scene, samples, percentage, progress
        As for `spectral_picture`.
    band
        First and last wavelength of the camera, nanometers, or a `Filter`.
    parts
        Of the band, in each of which lamps and surfaces have one number, a multiple of 3.
    lights
        By the names of lamps, worlds and materials that emit, a temperature such as "2856K" or the
        path of a table that reaches there, instead of what they have.
    materials
        By name, a sample or a reflectance instead of what the material stores.

    Returns
    -------
    `gray`, the mean radiance per nanometer, shape (rows, columns) from the bottom up, in units in
    which even light of luminance 1 has 1; `false_color`, that of the band's thirds; `parts`, that
    of each part; what materials and lamps were `told` to be; and by name, why materials were
    `assumed` to be as bright as to the eye, and lamps are `dark`.

    Raises
    ------
    RoughSpectraError
        An argument is none, the scene has no camera, nothing is known to shine there, or the second
        Blender failed.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine = "CYCLES"
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.world = bpy.data.worlds.new("Sky")
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> picture = infrared_picture(scene, band=(840.0, 860.0), lights={"Sky": "2856K"}, samples=1)
    >>> picture.told
    {"World 'Sky'": 'blackbody of 2856 K'}
    """
    _check_enabled()
    wanted = infrared_wanted.Wanted(band, parts, lights or {}, materials or {}, samples, percentage)
    return infrared.render(scene or bpy.context.scene, wanted, progress)


def write_infrared(
    picture: InfraredPicture, path: str | os.PathLike[str], *, false_color: bool = False
) -> None:
    """Write an infrared picture as an EXR, gray or in false color.

    Parameters
    ----------
    picture
        What `infrared_picture` gave.
    path
        Ends in .exr.
    false_color
        Whether red, green and blue are the thirds of the band, red the longest wavelengths.

    Raises
    ------
    OutputError
        The file cannot be written.

    Examples
    --------
    >>> import numpy as np
    >>> one = np.ones((2, 3))
    >>> picture = InfraredPicture((700.0, 1000.0), np.ones((2, 3, 3)), one, {}, {}, {}, ())
    >>> write_infrared(picture, "near.exr")
    """
    _check_enabled()
    picture_files.check(Path(path))
    infrared_file.write(picture, Path(path), false_color=false_color)


def write_picture(
    picture: SpectralPicture,
    path: str | os.PathLike[str],
    spectra: str | os.PathLike[str] | None = None,
    *,
    at_bands: bool = False,
) -> list[Path]:
    """Write a spectral picture as an EXR in the working space, and its map of ΔE00 beside it.

    Parameters
    ----------
    picture
        What `spectral_picture` gave, of the open file.
    path
        Ends in .exr; the map is called the same with `-delta-e`.
    spectra
        Of a spectral image, which ends in .spectral.exr, if that is wanted, too: radiance every
        10 nm, in channels such as S0.440,000000nm. Don't open it with Blender.
    at_bands
        Whether it holds the radiance at the bands' wavelengths instead.

    Returns
    -------
    What was written.

    Raises
    ------
    OutputError
        The files cannot be written; none is.

    Examples
    --------
    >>> import numpy as np
    >>> from rough_spectra.core.bands import Error
    >>> blank, error = np.zeros((2, 3, 4)), Error(0.0, 0.0, 0.0)
    >>> picture = SpectralPicture(
    ...     blank, blank[..., :3], 2, np.zeros(3), False, error, True, None, {}, {}, ()
    ... )
    >>> [path.name for path in write_picture(picture, "room.exr")]
    ['room.exr']
    """
    _check_enabled()
    beside = None if spectra is None else Path(spectra)
    return picture_files.write(picture, Path(path), beside, at_bands=at_bands)


def picture_image(picture: SpectralPicture, name: str = "Spectral") -> Any:
    """Put a spectral picture into a new image of the open file, which can be saved or used there.

    Parameters
    ----------
    picture
        What `spectral_picture` gave, of the open file.
    name
        Of the image.

    Examples
    --------
    >>> import numpy as np
    >>> from rough_spectra.core.bands import Error
    >>> blank, error = np.zeros((2, 3, 4)), Error(0.0, 0.0, 0.0)
    >>> picture = SpectralPicture(
    ...     blank, blank[..., :3], 2, np.zeros(3), False, error, True, None, {}, {}, ()
    ... )
    >>> picture_image(picture).size[:]
    (3, 2)
    """
    _check_enabled()
    return picture_files.image(picture, name)


def picture_pixel(picture: SpectralPicture, column: int, row: int) -> Pixel:
    """Read a pixel of a spectral picture.

    Parameters
    ----------
    picture
        What `spectral_picture` gave.
    column, row
        From the bottom left.

    Returns
    -------
    Its `wavelengths`, from 360 to 780 nm every 10 nm, and `radiance` per nanometer in the scene's
    units; `xyz` by the picture's observer; `lab` against white at a radiance of 1 under the scene's
    light; and `delta_e`, ΔE00 of the ordinary picture there, None without one.

    Raises
    ------
    DomainError
        There is no such pixel.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> scene.cycles.use_denoising = False
    >>> picture = spectral_picture(scene, bands=3, samples=1)
    >>> pixel = picture_pixel(picture, 4, 4)
    >>> pixel.radiance.shape, [round(abs(value), 1) for value in pixel.lab[1:]]
    ((43,), [0.0, 0.0])
    """
    _check_enabled()
    return picture_pixels.read(picture, column, row)


def measured_light(light: bpy.types.Light | bpy.types.World, path: str | os.PathLike[str]) -> None:
    r"""Let a lamp or a world have the spectrum of a file in spectral pictures; it is kept with it.

    A CIE illuminant needs no function: ``light.rough_spectra.spectrum = "F11"``, and "COLOR" for
    what fits its color.

    Parameters
    ----------
    light
        A lamp or a world.
    path
        A TM-27 file (.spdx), a table of wavelengths and power, or a spectral image.

    Raises
    ------
    InputError
        The file cannot be read, or nothing of this light is seen.
    MaterialError
        The light is linked from another file.

    Examples
    --------
    >>> _ = Path("lamp.csv").write_text("nm,W\n400,0.2\n500,0.5\n600,0.9\n700,1\n")
    >>> lamp = bpy.data.lights.new("Lamp", "POINT")
    >>> measured_light(lamp, "lamp.csv")
    >>> lamp.rough_spectra.spectrum, lamp.rough_spectra.sample_name
    ('MEASURED', 'lamp.csv')
    """
    _check_enabled()
    if not light.is_editable:
        msg = f"{light.name!r} is linked from another file; make it local first."
        raise MaterialError(msg)
    source = light_source.read(path)
    light_spectra.measured(source)  # refuses what nobody sees
    chosen_light.keep(light, source, str(path))


def _checked(material: Any) -> Any:
    """Give a material back, or say what it is instead."""
    _check_enabled()
    if not isinstance(material, bpy.types.Material):
        msg = f"{material!r} is no material; give one of bpy.data.materials."
        raise MaterialError(msg)
    return material


def _band_name(band: tuple[float, float] | Filter) -> str:
    if isinstance(band, Filter):
        return "filter"
    first, last = band
    return f"{first:g}-{last:g} nm"


def _node(shader: str) -> Any:
    """Give what the material's own setting calls a shader."""
    known = [identifier for identifier, *_ in SHADER_ITEMS]
    if shader.upper() not in known:
        choices = ", ".join(known).lower()
        raise DomainError(f"The shader {shader!r} is not known; choose one of {choices}.")
    return shader.upper()


def _check_enabled() -> None:
    if "rough_spectra" not in bpy.types.Material.bl_rna.properties:
        msg = (
            "Rough Spectra is not enabled in this Blender; enable it in the preferences, and start "
            "without --factory-startup."
        )
        raise RoughSpectraError(msg)
