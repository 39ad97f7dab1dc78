# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measurement files on their way into the library: read all, then add all."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...core.errors import InputError
from . import gloss_of_set, library_files, quality, readers, sets, stated_white
from .library_files import Added
from .sample import Sample


@dataclass(frozen=True)
class Found:
    """One sample of a file, and all that a user should see before it is used."""

    path: Path
    sample: Sample
    judged: tuple[str, ...]

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is not as it should be, or not as in the file."""
        return (*self.sample.altered, *self.judged)

    @property
    def sentences(self) -> tuple[str, ...]:
        """Warnings, and what else the reader has to tell."""
        remark = stated_white.remark(self.sample)
        others = sets.sentences(self.sample)
        gloss = gloss_of_set.sentences(self.sample)
        notes = (*self.sample.notes, *others, *gloss)
        return (*notes, *((remark,) if remark else ()), *self.warnings)


@dataclass(frozen=True)
class Batch:
    """Several files, read.

    Parameters
    ----------
    found
        Their samples, in the order of the files.
    refused
        A sentence for each file that cannot be used.
    """

    found: tuple[Found, ...]
    refused: tuple[str, ...]


def read(paths: Iterable[str | os.PathLike[str]]) -> Batch:
    """Read and judge measurement files; one that cannot be used does not hinder the others."""
    found: list[Found] = []
    refused = []
    for path in dict.fromkeys(map(Path, paths)):
        try:
            samples = readers.read(path)
        except InputError as error:
            refused.append(str(error))
            continue
        for sample, judged in zip(samples, quality.check(samples), strict=True):
            found.append(Found(path, sample, judged))
    return Batch(tuple(found), tuple(refused))


def relative_to(found: Iterable[Found], white: str | None, factor: object) -> list[Found]:
    """Give the same samples, relative to a white that the user states.

    Parameters
    ----------
    found
        What was read.
    white, factor
        As `stated_white.fields` takes them; None leaves what the files say.

    Raises
    ------
    InputError
        If they cannot be used.
    """
    return [replace(each, sample=stated_white.given(each.sample, white, factor)) for each in found]


def common_name(found: Iterable[Found]) -> str:
    """Name a collection for the samples of several files: as their folder, or the first one's."""
    first = next(iter(found))
    return library_files.collection_name(first.path.resolve().parent.name or first.path.stem)


def add(found: Sequence[Found], collection: str, folder: Path) -> list[Added]:
    """Add samples to the library, all of them or none.

    Parameters
    ----------
    found
        The samples.
    collection
        Where to add them; if empty, each file's samples go to a collection of the file's name.
    folder
        Of the library.

    Raises
    ------
    InputError, OutputError
        See `library_files.add_all`; nothing was changed.
    """
    sorted_in: dict[str, list[Sample]] = {}
    for each in found:
        name = collection or library_files.collection_name(each.path.stem)
        sorted_in.setdefault(name, []).append(each.sample)
    return library_files.add_all(sorted_in, folder)


def summary(added: Sequence[Added]) -> str:
    """Say in one line what became of the samples."""
    count = sum(len(each.names) for each in added)
    parts = [f"{count} {'sample' if count == 1 else 'samples'} added to the library"]
    for each in added:
        if each.wanted:
            parts.append(
                f"collection {each.wanted!r} is called {each.collection!r} there, as presets have "
                "its name"
            )
    present = sum(len(each.present) for each in added)
    if present:
        parts.append(f"{present} already there")
    renamed = [pair for each in added for pair in each.renamed]
    if renamed:
        old, new = renamed[0]
        more = f" and {len(renamed) - 1} more" if len(renamed) > 1 else ""
        parts.append(f"{old!r} is called {new!r} there, as its name was taken{more}")
    return "; ".join(parts)
