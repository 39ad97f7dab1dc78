# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The user's library of samples, and the presets beside it: list, search, find the nearest color.

A library is a folder of plain files: collections (`readers.library`), and presets, loose or in
folders. What a file holds is kept while its time and size stay the same, so that asking again
costs one look at the folder. `library_files` changes the files.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ...core.color import color_difference
from ...core.errors import InputError, OutputError
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import kept, memoized
from ..support import journal
from . import (
    library_files,
    preset_index,
    presets,
    quality,
    readers,
    sets,
    swatches,
)
from .entry import Entry
from .library_files import (
    Added,
    add,
    add_all,
    remove,
    rename,
)
from .readers import open_document
from .readers.formats import library as library_reader
from .sample import Sample

__all__ = [
    "Added",
    "Contents",
    "Entry",
    "add",
    "add_all",
    "cached",
    "contents",
    "entries",
    "load",
    "nearest",
    "read_next",
    "remove",
    "rename",
    "search",
]

_Stamp = tuple[int, int, int]
"""Time, size and number of a file."""


_SEARCHES_KEPT = 16


@dataclass(frozen=True, eq=False)
class Contents:
    """Everything there is: the presets, then the library by file and order in the file.

    Parameters
    ----------
    entries
        Of all samples.
    faults
        A sentence for each file that could not be read; it stays as it is.
    """

    entries: tuple[Entry, ...]
    faults: tuple[str, ...]
    _samples: list[Sample | None]
    _haystacks: tuple[str, ...]
    _labs: dict[tuple[str, int], Array]
    _places: dict[str, int]
    _named: dict[str, list[int]]
    _found: dict[str, tuple[Entry, ...]] = field(default_factory=dict)

    def lab(self, illuminant: str, observer: int) -> Array:
        """Return CIE L*a*b* of all readings, shape (entries, 3); NaN of those without a color."""
        light = (illuminant, observer)
        if light not in self._labs:
            samples = [self.sample(number) for number in range(len(self.entries))]
            self._labs[light] = swatches.of_samples(samples, illuminant, observer)[1]
        return self._labs[light]

    def sample(self, number: int) -> Sample:
        """Return the sample of an entry; that of a preset is read when it is asked for.

        Raises
        ------
        InputError
            A preset's file has a fault.
        """
        found = self._samples[number]
        if found is None:
            found = self._samples[number] = presets.load(self.entries[number].path)
        return found


@dataclass(frozen=True, eq=False)
class _File:
    entries: tuple[Entry, ...] = ()
    samples: tuple[Sample | None, ...] = ()
    fault: str = ""


_files: dict[Path, tuple[_Stamp, _File]] = kept(__name__, "_files")
_contents: dict[Path, tuple[object, str, Contents]] = kept(__name__, "_contents")


def contents(folder: Path) -> Contents:
    """Return presets and library; from memory where no file has changed.

    Parameters
    ----------
    folder
        Of the library; an absent one counts as empty.
    """
    left = _finished(folder)
    stamps = tuple(_library_files(folder))
    known = _contents.get(folder)
    if known is not None and known[:2] == (stamps, left):
        return known[2]
    shipped = _presets()
    reserved = {entry.collection.casefold() for file in shipped for entry in file.entries}
    found, taken = [*shipped, _File(fault=left)], set[str]()
    for path, collection, stamp in stamps:
        if path not in _files or _files[path][0] != stamp:
            _files[path] = (stamp, _read(path, collection, is_preset=False))
        file = _files[path][1]
        here = {entry.id for entry in file.entries}
        if collection.casefold() in reserved or here & taken:
            # Which of two a mapping file means must not follow from the order of files.
            file = _File(fault=f"{path}: {collection!r} is taken by other samples; rename it.")
        taken |= here
        found.append(file)
    result = _joined(found)
    _contents[folder] = (stamps, left, result)
    return result


def cached(folder: Path) -> Contents | None:
    """Return what `contents` would from memory, or None where it would have to read files."""
    known = _contents.get(folder)
    if known is None or known[0] != tuple(_library_files(folder)):
        return None
    return known[2]


def read_next(folder: Path) -> bool:
    """Read one file that `contents` would have to read, so that none waits for all of them.

    Returns
    -------
    Whether there was one.
    """
    for path, collection, stamp in _library_files(folder):
        if path not in _files or _files[path][0] != stamp:
            _files[path] = (stamp, _read(path, collection, is_preset=False))
            return True
    return False


def entries(folder: Path) -> tuple[Entry, ...]:
    """Return the entries of presets and library."""
    return contents(folder).entries


def search(text: str, folder: Path) -> tuple[Entry, ...]:
    """Return the entries that have every word of the text in name, id, collection or source."""
    everything = contents(folder)
    words = text.casefold().split()
    if not words:
        return everything.entries
    # A list in a panel asks for the same again with each redraw.
    if text not in everything._found:
        found = list(range(len(everything.entries)))
        for word in words:
            found = [i for i in found if word in everything._haystacks[i]]
        if len(everything._found) >= _SEARCHES_KEPT:
            everything._found.clear()
        everything._found[text] = tuple(everything.entries[i] for i in found)
    return everything._found[text]


def nearest(
    lab: npt.ArrayLike, count: int, folder: Path, illuminant: str = "D65", observer: int = 2
) -> list[tuple[Entry, float]]:
    """Return the entries whose readings come nearest to a color, with their ΔE00 from it.

    Parameters
    ----------
    lab
        CIE L*a*b*; `swatches.to_lab` makes it of sRGB.
    count
        How many at most; those without a color are left out.
    illuminant, observer
        What it was computed for, and readings are.
    """
    everything = contents(folder)
    known = everything.lab(illuminant, observer)
    colored = np.flatnonzero(np.isfinite(known[:, 0]))
    wanted = np.broadcast_to(np.asarray(lab, np.float64), (colored.size, 3))
    differences = color_difference.delta_e(known[colored], wanted)
    order = np.argsort(differences, kind="stable")[: max(count, 0)]
    return [(everything.entries[colored[i]], float(differences[i])) for i in order]


def load(name: str, folder: Path) -> Sample:
    """Return a sample of library or presets.

    Parameters
    ----------
    name
        An id; anything that `presets.load` takes; or the name of one library sample, unless a
        preset is called so: what a mapping file means must not change with what others collect.

    Raises
    ------
    InputError
        Nothing is called so, or several are, or its file has a fault.
    """
    if "/" in name and name not in presets.names():
        everything = contents(folder)
        place = everything._places.get(name)
        if place is not None:
            return everything.sample(place)
    if not name.lower().endswith(".json") and not presets.is_called(name):
        # Without the presets' names that come closest: seeking them takes longer than all else.
        everything = contents(folder)
        named = everything._named.get(name, [])
        if len(named) == 1:
            return everything.sample(named[0])
    try:
        return presets.load(name)
    except InputError as error:
        everything = contents(folder)
        named = everything._named.get(name, [])
        if len(named) == 1:
            return everything.sample(named[0])
        if named:
            could = ", ".join(everything.entries[i].id for i in named[:5])
            msg = f"{folder}: sample {name!r} could be any of {could}; give the whole id."
            raise InputError(msg) from None
        if name.lower().endswith(".json") or not folder.is_dir():
            raise
        faults = "".join(f" ({fault.rstrip('.')})" for fault in everything.faults[:1])
        msg = f"{str(error).rstrip('.')}; nor has the library {folder} a sample called so{faults}."
        raise InputError(msg) from None


def _finished(folder: Path) -> str:
    """Complete what a killed process left half written, or give the sentence why that fails."""
    try:
        journal.finish(folder)
    except OutputError as error:
        return str(error)
    return ""


@memoized(maxsize=1)
def _presets() -> tuple[_File, ...]:
    indexed = preset_index.entries()
    if indexed is not None:
        return (_File(indexed, (None,) * len(indexed)),)
    return read_presets()


def read_presets() -> tuple[_File, ...]:
    """Read all presets, as `preset_index` spares it; each file's entries and samples."""
    paths = (presets.folder() / f"{name}.json" for name in presets.names())
    return tuple(_read(path, path.parent.name, is_preset=True) for path in paths)


def _library_files(folder: Path) -> Iterator[tuple[Path, str, _Stamp]]:
    """Find the files of a library, each with its collection and stamp, in a lasting order."""
    for path, entry in _listed(folder):
        if entry.is_dir():
            for inner, file in _listed(path):
                if inner.suffix.lower() == ".json" and file.is_file():
                    yield inner, path.name, _stamp(file)
        elif path.suffix.lower() == ".json" and entry.is_file():
            yield path, path.stem, _stamp(entry)


def _listed(folder: Path) -> list[tuple[Path, os.DirEntry[str]]]:
    try:
        with os.scandir(folder) as found:
            listed = sorted(found, key=lambda entry: entry.name)
    except OSError:
        return []
    return [(folder / e.name, e) for e in listed if not e.name.startswith(".")]


def _stamp(entry: os.DirEntry[str]) -> _Stamp:
    try:
        status = entry.stat()
    except OSError:  # removed a moment ago
        return (0, 0, 0)
    return (status.st_mtime_ns, status.st_size, status.st_ino)


def _read(path: Path, collection: str, is_preset: bool) -> _File:
    """Read one file of the library or a preset."""
    try:
        document = open_document(path)
        if library_reader.sniff(document):
            fields = library_reader.parse(document)
            samples = library_reader.samples(document, fields)
            ids = library_files.ids(fields, samples, collection)
        else:
            samples = readers.read(path)
            in_folder = path.stem if path.parent.name == collection else ""
            ids = [f"{collection}/{in_folder or library_files.slug_of(s.name)}" for s in samples]
    except InputError as error:
        return _File(fault=str(error))
    rgb, lab = swatches.of_samples(samples)
    found = []
    for i, warnings in enumerate(quality.check(samples)):
        sample, known = samples[i], bool(np.isfinite(lab[i, 0]))
        found.append(
            Entry(
                id=ids[i],
                name=sample.name,
                collection=collection,
                kind=sample.kind,
                instrument=sample.instrument,
                condition=sample.condition,
                device=sample.device,
                source=sample.source,
                sigma_degrees=sample.sigma_degrees,
                swatch=tuple(rgb[i].tolist()) if known else None,  # type: ignore[arg-type]
                lab=tuple(lab[i].tolist()) if known else None,  # type: ignore[arg-type]
                warnings=warnings,
                path=path,
                is_preset=is_preset,
                readings=sets.count(sample),
            )
        )
    return _File(tuple(found), tuple(samples))


def _joined(files: list[_File]) -> Contents:
    found = tuple(entry for file in files for entry in file.entries)
    nothing = (np.nan, np.nan, np.nan)
    places: dict[str, int] = {}
    named: dict[str, list[int]] = {}
    for i, entry in enumerate(found):
        places.setdefault(entry.id, i)
        if not entry.is_preset:
            named.setdefault(entry.name, []).append(i)
    return Contents(
        entries=found,
        faults=tuple(file.fault for file in files if file.fault),
        _samples=[sample for file in files for sample in file.samples],
        _haystacks=tuple(f"{e.name} {e.id} {e.source}".casefold() for e in found),
        _labs={("D65", 2): np.array([entry.lab or nothing for entry in found]).reshape(-1, 3)},
        _places=places,
        _named=named,
    )
