# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What rough surfaces emit by their own heat."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from math import radians
from pathlib import Path

from ...core.emissivity import MODEL as EMISSIVITY_MODEL
from ...core.emissivity import Filter
from ...core.errors import DomainError
from ..matching import emission
from ..preview import emission_files
from ..readings.emission import Emissivity
from ..samples import filter_response
from ..samples.sample import Sample
from .checks import check_enabled


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
    check_enabled()
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


def _band_name(band: tuple[float, float] | Filter) -> str:
    if isinstance(band, Filter):
        return "filter"
    first, last = band
    return f"{first:g}-{last:g} nm"
