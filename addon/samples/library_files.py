# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Change the files of a user library: add, remove, rename.

A collection is one file ``<collection>.json``. Each change reads the file again while it holds the
folder's lock, and writes it beside and renames it: two Blenders lose nothing to each other, and a
killed one leaves all old files or, at the next look at the folder, all new ones.
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ...core.errors import InputError
from ..support import atomic_files, journal
from ..support.file_lock import locked
from ..support.user_files import LARGEST
from . import presets
from .readers import Document, open_document
from .readers.formats import library
from .sample import Sample

_LONGEST = 80  # characters of a collection's name or an id
_MOST_BYTES = 200  # of a collection's name: file names end at 255
_NOT_IN_NAMES = re.compile(
    "[\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff" r'<>:"/\\|?*]+'
)
_ESCAPED = re.compile("[\x7f-\x9f\u2028\u2029\ufeff]")
"""Characters that JSON takes as they are, and other readers of text for something else."""
_DEVICES = re.compile(
    r"(con|prn|aux|nul|clock\$|conin\$|conout\$|com[\d¹²³]|lpt[\d¹²³])(?= *(?:\.|$))", re.IGNORECASE
)


@dataclass(frozen=True)
class Added:
    """What became of samples that were to be added.

    Parameters
    ----------
    ids
        Of each sample in the library, in their order, also of those that were there before.
    names
        Of the samples that are new, as the library calls them.
    present
        Names of those that were there already, with the same spectrum, and were not added again.
    renamed
        Old and new name of those whose name another sample has.
    collection
        Where they are.
    wanted
        Where they were to be added, if presets have a collection of that name; else empty.
    """

    ids: tuple[str, ...]
    names: tuple[str, ...]
    present: tuple[str, ...]
    renamed: tuple[tuple[str, str], ...]
    collection: str
    wanted: str = ""


def add(samples: Sequence[Sample], collection: str, folder: Path) -> Added:
    """Add samples to a collection, which is made if it is not there. See `add_all`."""
    return add_all({collection: samples}, folder)[0]


def add_all(collections: Mapping[str, Sequence[Sample]], folder: Path) -> list[Added]:
    """Add samples to several collections, all of them or none. Never overwrites a sample.

    A collection that is called as one of presets gets a number: its samples could not be told from
    theirs, and would not be listed.

    Parameters
    ----------
    collections
        Samples by the name of the collection.
    folder
        Of the library; made if it is not there.

    Raises
    ------
    InputError
        A name cannot be a file's, or a file that is there has a fault; nothing was changed.
    OutputError
        A file cannot be written; nothing was changed.
    """
    found = []
    with locked(folder), atomic_files.publication() as files:
        _sweep(folder)
        taken = _taken(folder)
        opened: dict[str, tuple[Path, dict[str, Any], list[Sample]]] = {}
        changed: list[str] = []
        for name, samples in collections.items():
            _check_collection(name, folder)
            free = _free_collection(name, taken)
            key = _folded(free)
            if key not in opened:
                path = _path(folder, free)
                opened[key] = (path, *(_opened(path) if path.is_file() else (_empty(), [])))
            path, fields, known = opened[key]
            added = _merge(fields, known, samples, path.stem)
            if added.names and key not in changed:
                changed.append(key)
            found.append(added if free == name else replace(added, wanted=name))
        for key in changed:
            path, fields, _ = opened[key]
            files.write(path, _checked(path, fields))
    return found


def remove(entries: Iterable[str], folder: Path) -> None:
    """Take samples out of their collections; a collection without samples goes too.

    Raises
    ------
    InputError
        An id is not in the library, or its file has a fault; nothing was changed.
    OutputError
        A file cannot be written; nothing was changed.
    """
    with locked(folder), atomic_files.publication() as files:
        _sweep(folder)
        for path, wanted in _by_file(entries, folder).items():
            fields, samples = _opened(path)
            known = _ids(fields["samples"], samples)
            _check_known(wanted, known, path)
            pairs = zip(fields["samples"], known, strict=True)
            kept = [record for record, slug in pairs if slug not in wanted]
            if kept:
                files.write(path, _checked(path, fields | {"samples": kept}))
            else:
                files.remove(path)


def rename(entry: str, name: str, folder: Path) -> str:
    """Give a sample another name, and return its new id.

    Raises
    ------
    InputError
        The id is not in the library, the name is empty or another sample's, or the file has a
        fault; nothing was changed.
    OutputError
        The file cannot be written; nothing was changed.
    """
    if not name.strip():
        msg = f"{folder}: a sample needs a name; {entry!r} keeps its own."
        raise InputError(msg)
    with locked(folder), atomic_files.publication() as files:
        _sweep(folder)
        [(path, wanted)] = _by_file([entry], folder).items()
        fields, samples = _opened(path)
        known = _ids(fields["samples"], samples)
        _check_known(wanted, known, path)
        [slug] = wanted
        at = known.index(slug)
        if any(sample.name == name for i, sample in enumerate(samples) if i != at):
            msg = f"{path}: another sample is called {name!r}; choose another name."
            raise InputError(msg)
        new = _free(slug_of(name), set(known) - {slug}, "-", {})
        fields["samples"][at] |= {"name": name, "id": new}
        files.write(path, _checked(path, fields))
    return f"{path.stem}/{new}"


def ids(fields: dict[str, Any], samples: Sequence[Sample], collection: str) -> list[str]:
    """Return the id of each sample of a library file, all different: ``collection/slug``."""
    return [f"{collection}/{slug}" for slug in _ids(fields["samples"], samples)]


def slug_of(name: str) -> str:
    """Return a name in lower case with hyphens for all that is no letter or digit."""
    return re.sub(r"[\W_]+", "-", name.casefold()).strip("-")[:_LONGEST] or "sample"


def collection_name(text: str) -> str:
    """Return the text as it can be a collection's name, which is a file's on every system."""
    name = _NOT_IN_NAMES.sub("-", unicodedata.normalize("NFC", text)).strip(" .-")
    name = _short(name).rstrip(" .-")
    device = _DEVICES.match(name)
    if device:  # Windows takes "con.x.json" for the console, too
        name = _short(f"{device[1]}-{name[device.end(1) :]}").rstrip(" .")
    return name or "samples"


def _short(name: str) -> str:
    return name.encode()[:_MOST_BYTES].decode(errors="ignore")[:_LONGEST]


def _check_collection(name: str, folder: Path) -> None:
    if name != collection_name(name):
        msg = (
            f"{folder}: a collection cannot be called {name!r}, because no file can; call it "
            f"{collection_name(name)!r}."
        )
        raise InputError(msg)


def _taken(folder: Path) -> set[str]:
    """Return the names of presets' collections, bundled and in folders of the library."""
    folders = (path.name for path in folder.iterdir() if path.is_dir())
    return {_folded(name) for name in (*presets.collections(), *folders)}


def _free_collection(name: str, taken: set[str]) -> str:
    """Return the name, or with the first number that no collection of presets has.

    There may be a library file of that name: it has been given the number before.
    """
    free, number = name, 2
    while _folded(free) in taken:
        free, number = f"{name} {number}", number + 1
    return free


def _folded(name: str) -> str:
    """Return what is equal of names that some system takes for those of one file."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).casefold())


def _path(folder: Path, collection: str) -> Path:
    wanted = _folded(f"{collection}.json")
    # Some systems take "Walls.json" and "walls.json" for the same file, so the library does.
    same = [path for path in sorted(folder.glob("*.json")) if _folded(path.name) == wanted]
    return same[0] if same else folder / f"{collection}.json"


def _by_file(entries: Iterable[str], folder: Path) -> dict[Path, set[str]]:
    found: dict[Path, set[str]] = {}
    for entry in entries:
        collection, _, slug = entry.rpartition("/")
        path = folder / f"{collection}.json"
        if not collection or Path(collection).name != collection or not path.is_file():
            msg = f"{folder}: there is no sample {entry!r} in a library file here; check its id."
            raise InputError(msg)
        found.setdefault(path, set()).add(slug)
    return found


def _check_known(wanted: set[str], known: list[str], path: Path) -> None:
    missing = wanted - set(known)
    if missing:
        msg = f"{path}: there is no sample {min(missing)!r}; it may have been removed elsewhere."
        raise InputError(msg)


def _opened(path: Path) -> tuple[dict[str, Any], list[Sample]]:
    """Read a library file as what it holds, unknown fields too, and as samples."""
    document: Document = open_document(path)
    if not library.sniff(document):
        raise document.error(
            "", "it is no Rough Spectra library, and is left as it is; use another collection"
        )
    fields = library.parse(document)
    return fields, library.samples(document, fields)


def _empty() -> dict[str, Any]:
    return {"format": library.FORMAT, "schema": library.SCHEMA, "samples": []}


def _ids(records: list[dict[str, Any]], samples: Sequence[Sample]) -> list[str]:
    """Return the slug of each sample; a file written by hand may lack them or repeat them."""
    taken: set[str] = set()
    counters: dict[str, int] = {}
    found = []
    for record, sample in zip(records, samples, strict=True):
        given = record.get("id")
        slug = slug_of(given if isinstance(given, str) and given else sample.name)
        slug = _free(slug, taken, "-", counters)
        taken.add(slug)
        found.append(slug)
    return found


def _merge(
    fields: dict[str, Any], old: list[Sample], samples: Sequence[Sample], collection: str
) -> Added:
    """Append to `fields`, and to its samples, what is not in it yet."""
    slugs = _ids(fields["samples"], old)
    taken_slugs, taken_names = set(slugs), {sample.name for sample in old}
    counters: tuple[dict[str, int], dict[str, int]] = ({}, {})
    places: dict[tuple[object, ...], list[tuple[str, str]]] = {}
    for sample, slug in zip(old, slugs, strict=True):
        places.setdefault(_identity(sample), []).append((sample.name, slug))
    found, names, present, renamed = [], [], [], []
    for sample in samples:
        same = places.setdefault(_identity(sample), [])
        slug = next((slug for name, slug in same if _is_name(name, sample.name)), "")
        if slug:
            present.append(sample.name)
        else:
            name = _free(sample.name, taken_names, " ", counters[0])
            slug = _free(slug_of(name), taken_slugs, "-", counters[1])
            if name != sample.name:
                renamed.append((sample.name, name))
            taken_names.add(name)
            taken_slugs.add(slug)
            same.append((name, slug))
            names.append(name)
            old.append(sample if name == sample.name else replace(sample, name=name))
            fields["samples"].append({"id": slug} | library.record(sample) | {"name": name})
        found.append(f"{collection}/{slug}")
    return Added(tuple(found), tuple(names), tuple(present), tuple(renamed), collection)


def _identity(sample: Sample) -> tuple[object, ...]:
    spectrum = sample.wavelengths.tobytes(), sample.values.tobytes()
    alone = (*spectrum, sample.kind, sample.instrument, sample.scale)
    return (*alone, sample.gloss, tuple(map(_identity, sample.others)))


def _is_name(stored: str, name: str) -> bool:
    """Return whether a stored name is this one, or this one with the number that made it free."""
    return stored == name or (stored.startswith(f"{name} ") and stored[len(name) + 1 :].isdecimal())


def _free(name: str, taken: set[str], separator: str, counters: dict[str, int]) -> str:
    """Return the name, or with the next number that nobody has; `counters` keeps that quick."""
    if name not in taken:
        return name
    number = counters.get(name, 2)
    while f"{name}{separator}{number}" in taken:
        number += 1
    counters[name] = number + 1
    return f"{name}{separator}{number}"


def _checked(path: Path, fields: dict[str, Any]) -> bytes:
    """Return the file, once it reads back as what it was written from.

    One name that makes a file unreadable would take all the other samples of it along.

    Raises
    ------
    InputError
        A sample cannot be kept; nothing was written.
    """
    data = _to_bytes(fields)
    if len(data) > LARGEST:
        msg = (
            f"{path}: with these samples it would have {len(data) / 2**20:.0f} MB, more than the "
            f"{LARGEST // 2**20} MB that are read; add them to another collection."
        )
        raise InputError(msg)
    document = Document(path, data)
    read = library.parse(document)
    library.samples(document, read)
    for wanted, found in zip(fields["samples"], read["samples"], strict=True):
        # Fields of others may hold NaN, which is not equal to itself.
        if wanted != found and _dump(wanted) != _dump(found):
            name = str(wanted.get("name"))[:_LONGEST]
            msg = f"{path}: the sample {name!r} does not read back as it is; give it a plain name."
            raise InputError(msg)
    return data


def _dump(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)  # floats by repr: to the last bit


def _to_bytes(fields: dict[str, Any]) -> bytes:
    """Return the file: one sample a line, so that a change shows as the lines it is in."""
    head = [f"{_dump(key)}: {_dump(value)}" for key, value in fields.items() if key != "samples"]
    lines = ",\n".join(map(_dump, fields["samples"]))
    text = "{\n" + ",\n".join([*head, f'"samples": [\n{lines}\n]']) + "\n}\n"
    text = _ESCAPED.sub(lambda found: f"\\u{ord(found[0]):04x}", text)
    # Half a surrogate pair has no UTF-8; its escape is what JSON writes for it.
    return text.encode("utf-8", errors="backslashreplace")


def _sweep(folder: Path) -> None:
    """Mend what a killed process left half written. Nobody else writes: the lock is held."""
    journal.finish(folder)
    for path in folder.glob(".*.part"):
        path.unlink(missing_ok=True)
