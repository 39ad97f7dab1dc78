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
from ..samples.sample import Sample
from . import catalogs

CHOSEN = "Chosen for the asset library, not measured."


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
        Of the material, such as ``"Brick σ 20°"``.
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
    chosen: Iterable[Chosen], sigma_degrees: Sequence[float], longest_name: int
) -> list[Asset]:
    """Cross samples with roughnesses.

    Parameters
    ----------
    chosen
        The samples.
    sigma_degrees
        Every sample gets each of them; without any, each keeps its own.
    longest_name
        Bytes that the name of a material may have.

    Raises
    ------
    InputError
        Nothing was chosen, σ is out of range, or a sample without σ has to keep its own.
    """
    for degrees in sigma_degrees:
        if msg := limits.sigma_fault(degrees):
            raise InputError(msg)
    made: list[Asset] = []
    taken: set[str] = set()
    for item in chosen:
        for degrees in dict.fromkeys(sigma_degrees) or [_own_sigma(item.sample)]:
            sample = item.sample
            if degrees != sample.sigma_degrees:
                sample = replace(sample, sigma_degrees=float(degrees), sigma_source=CHOSEN)
            name = _name(sample.name, f" σ {degrees:g}°", taken, longest_name)
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
    return sample.sigma_degrees


def _name(sample: str, ending: str, taken: set[str], longest: int) -> str:
    """Give a name that fits and is not taken; σ stays, for it tells materials apart."""
    number = 1
    while True:
        tail = ending if number == 1 else f" ({number}){ending}"
        room = longest - len(tail.encode())
        name = sample.encode()[:room].decode(errors="ignore").rstrip() + tail
        if name not in taken:
            return name
        number += 1
