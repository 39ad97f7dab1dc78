# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write materials for other renderers, all files or none."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import bpy

from ...core.errors import DomainError, MaterialError, OutputError
from ..support import atomic_files
from . import materials as of_file
from . import solve, targets
from .entry import Entry, Wanted


@dataclass(frozen=True, eq=False)
class Exported:
    """What an export wrote.

    Parameters
    ----------
    files
        Paths, one a target.
    entries
        Each material for each target, target by target.
    faults
        Sentences, one for each material that could not be exported.
    """

    files: tuple[Path, ...]
    entries: tuple[Entry, ...]
    faults: tuple[str, ...] = ()

    def of(self, target: str) -> list[Entry]:
        """Give the entries of one target."""
        return [entry for entry in self.entries if entry.target == target]

    @property
    def warnings(self) -> list[str]:
        """Sentences, each with its material, and each once."""
        said = [f"{entry.name}: {each}" for entry in self.entries for each in entry.warnings]
        return list(dict.fromkeys(said))


def materials(found: Iterable[Any], base: Path, names: Sequence[str] = targets.NAMES) -> Exported:
    """Write what materials of the open file store; one that cannot be used is a fault of its own.

    Raises
    ------
    MaterialError
        None of them can be used.
    DomainError, OutputError
        As `write`.
    """
    check(base, names)
    wanted, faults = of_file.wanted(found)
    if faults and not wanted:
        raise MaterialError(faults[0])
    return replace(write(wanted, base, names), faults=tuple(faults))


def usable() -> tuple[str, ...]:
    """Give the targets that this Blender can write: some need what not every one is built with."""
    return tuple(name for name in targets.NAMES if not _missing(targets.find(name)))


def check(base: Path, names: Iterable[str]) -> None:
    """Refuse what `write` would, before anything is solved.

    Raises
    ------
    DomainError
        A target is not known.
    OutputError
        No file can come from the base name, one that is there may not be replaced, or this Blender
        was built without what a target needs.
    """
    atomic_files.check_base(base)
    for target in map(targets.find, names):
        if _missing(target):
            msg = (
                f"This Blender was built without what {target.TITLE} needs; name the other "
                "targets, or take a Blender from blender.org."
            )
            raise OutputError(msg)
        atomic_files.check_target(_path(base, target))


def write(wanted: Sequence[Wanted], base: Path, names: Sequence[str] = targets.NAMES) -> Exported:
    """Solve materials for each target and write its file.

    Parameters
    ----------
    wanted
        At least one.
    base
        Folder and base name; endings are added to the name.
    names
        Of the targets.

    Raises
    ------
    DomainError
        A target is not known, nothing is to be written, or a spectrum has no color.
    OutputError
        A file cannot be written; none was touched then.
    """
    check(base, names)
    if not wanted:
        msg = "There is no material to export; assign a spectrum first."
        raise DomainError(msg)
    entries: list[Entry] = []
    paths: list[Path] = []
    with atomic_files.publication() as files:
        for name in dict.fromkeys(names):
            target = targets.find(name)
            made = solve.solved(wanted, target)
            path, content = _path(base, target), target.content(made)
            if isinstance(content, bytes):
                files.write(path, content)
            else:
                _let_write(content, files.stage(path), path)
            entries += made
            paths.append(path)
    return Exported(tuple(paths), tuple(entries))


def _let_write(content: targets.Written, part: Path, path: Path) -> None:
    try:
        content(part)
    except OSError as error:
        msg = f"{path} cannot be written: {error.strerror}; free the disk or choose another place."
        raise OutputError(msg) from error


def _missing(target: targets.Target) -> str:
    option: str = getattr(target, "NEEDS", "")
    return option if option and not getattr(bpy.app.build_options, option) else ""


def _path(base: Path, target: targets.Target) -> Path:
    return base.with_name(f"{base.name}.{target.ENDING}")
