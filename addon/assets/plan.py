# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which materials an asset library gets: samples times roughnesses, each with a name of its own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import radians
from pathlib import Path

from ...core import limits
from ...core.errors import InputError
from ..samples import presets, readers
from ..samples.sample import COLORED, Sample
from ..samples.stated_sigma import Names, StatedSigma
from . import catalogs

CHOSEN = "Chosen for the asset library, not measured."
_NAMES = Names("σ", "Rdq", "Sdq")


@dataclass(frozen=True)
class Chosen:
    """A sample for the library.

    Parameters
    ----------
    sample
        What was measured.
    catalog
        Title of its catalog.
    """

    sample: Sample
    catalog: str


@dataclass(frozen=True)
class Asset:
    """One material of the library.

    Parameters
    ----------
    name
        Of the material, such as ``"Brick σ 20°"``; of a sample that keeps its own σ, ``"Brick"``.
    sample
        What it is made from.
    sigma
        Roughness, radians.
    catalog
        Title of its catalog.
    """

    name: str
    sample: Sample
    sigma: float
    catalog: str


def of_all(library: Path) -> list[Chosen]:
    """Choose all samples that have a color: presets and the user's library.

    Parameters
    ----------
    library
        Folder of the user's library.

    Raises
    ------
    InputError
        A preset has a fault.
    """
    from ..samples import library as user_library

    return [
        Chosen(user_library.load(entry.id, library), catalogs.title(entry.id.rpartition("/")[0]))
        for entry in user_library.entries(library)
        if entry.kind in COLORED and entry.lab is not None
    ]


def of_collection(collection: str, library: Path | None = None) -> list[Chosen]:
    """Choose all samples of a collection of presets, or of the user's library.

    Parameters
    ----------
    collection
        Such as ``"colorchecker"``.
    library
        Folder of the user's library.

    Raises
    ------
    InputError
        There is no such collection, or a file has a fault.
    """
    title = catalogs.title(collection)
    if library is None or collection in presets.collections():
        return [Chosen(sample, title) for sample in presets.load_all(collection)]
    from ..samples import library as user_library

    ids = [entry.id for entry in user_library.entries(library)]
    found = [name for name in ids if name.rpartition("/")[0] == collection]
    if not found:
        known = dict.fromkeys(name.rpartition("/")[0] for name in ids)
        msg = f"There is no collection {collection!r}; take one of: {', '.join(known)}."
        raise InputError(msg)
    return [Chosen(user_library.load(name, library), title) for name in found]


def of_name(name: str, library: Path | None = None) -> Chosen:
    """Choose one sample of the presets, or of the user's library, by any of its names.

    Raises
    ------
    InputError
        Nothing is called so, or several are.
    """
    if library is None:
        sample, collection = presets.load(name), presets.path_of(name).parent.name
        return Chosen(sample, catalogs.title(collection))
    from ..samples import library as user_library

    sample = user_library.load(name, library)
    # The library finds by other names than ids, too, and tells no id of what it found.
    ids = [entry.id for entry in user_library.entries(library) if entry.name == sample.name]
    collection = ids[0].rpartition("/")[0] if ids else "Other"
    return Chosen(sample, catalogs.title(collection))


def of_file(path: Path) -> list[Chosen]:
    """Choose all samples of a measurement file.

    Raises
    ------
    InputError
        The file cannot be read.
    """
    return [Chosen(sample, catalogs.title(path.stem)) for sample in readers.read(path)]


def assets(
    chosen: Iterable[Chosen], sigmas: Sequence[float | StatedSigma], longest_name: int
) -> list[Asset]:
    """Cross samples with roughnesses.

    Parameters
    ----------
    chosen
        The samples.
    sigmas
        Degrees, or as a profilometer states them. Every sample gets each; without any, each keeps
        its own.
    longest_name
        Bytes that the name of a material may have.

    Raises
    ------
    InputError
        Nothing was chosen, σ is out of range, or a sample without σ has to keep its own.
    """
    stated: dict[float | None, StatedSigma] = {}
    for given in sigmas:
        sigma = given if isinstance(given, StatedSigma) else StatedSigma(float(given))
        if msg := _fault(sigma):
            raise InputError(msg)
        stated.setdefault(sigma.settled, sigma)
    made: list[Asset] = []
    taken: set[str] = set()
    for item in chosen:
        for sigma in stated.values() or [StatedSigma(_own_sigma(item.sample))]:
            sample, degrees = item.sample, sigma.settled or 0.0
            if degrees != sample.sigma_degrees or sigma.slope:
                about = sigma.source("given for the asset library.") if sigma.slope else CHOSEN
                sample = replace(sample, sigma_degrees=degrees, sigma_source=about)
            ending = f" σ {degrees:g}°" if stated else ""
            name = _name(sample.name, ending, taken, longest_name)
            taken.add(name)
            made.append(Asset(name, sample, radians(degrees), item.catalog))
    if not made:
        msg = "No sample was chosen for the asset library; name a collection, samples or files."
        raise InputError(msg)
    return made


def _own_sigma(sample: Sample) -> float:
    if sample.sigma_degrees is None:
        msg = f"{sample.source or 'Sample'}, {sample.name!r}: it has no σ of its own; say which."
        raise InputError(msg)
    if fault := limits.sigma_fault(sample.sigma_degrees):
        raise InputError(f"{sample.source or 'Sample'}, {sample.name!r}: {fault}")
    return sample.sigma_degrees


def _fault(sigma: StatedSigma) -> str:
    """Say what is wrong with a σ that is to be given; empty if nothing."""
    _, fault = sigma.fault(_NAMES)
    return f"{fault}." if fault else limits.sigma_fault(sigma.settled or 0.0)


def _name(sample: str, ending: str, taken: set[str], longest: int) -> str:
    """Give a name that fits and is not taken; an ending with σ stays: it tells materials apart."""
    number = 1
    while True:
        tail = ending if number == 1 else f" ({number}){ending}"
        room = longest - len(tail.encode())
        name = sample.encode()[:room].decode(errors="ignore").rstrip() + tail
        if name not in taken:
            return name
        number += 1
