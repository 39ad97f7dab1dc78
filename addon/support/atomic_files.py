# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write result files whole or not at all.

Every file is written beside its target and takes its name only when all of them are complete. A
full disk, a kill or a crash leaves the old files as they were; a kill while the files of a folder
take their names leaves a journal, by which whoever writes there next gives the rest theirs.
"""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from ...core.errors import OutputError
from . import permissions
from .journal import (
    Journal,
    Step,
    finish,
    held,
    seen,
)
from .permissions import cannot_write

_NAME_SHARE = 50
"""Characters of a target's name in its temporary one, which may not exceed 255 bytes."""
_RANDOM_BYTES = 8
"""As many that no two processes ever make the same name."""
_PRIVATE = 0o600
"""Permissions of a file until it is whole."""


@dataclass(frozen=True)
class _Staged:
    """A target as it was named, and the file that is to be there."""

    target: Path
    part: Path


class AtomicFiles:
    """A set of files that appear together. Made by `publication`."""

    def __init__(self) -> None:
        self._staged: dict[Path, _Staged] = {}
        self._removed: list[Path] = []
        self._cleared: list[tuple[Path, Callable[[Path], bool]]] = []
        self._temporary: list[Path] = []
        self._journals: list[Journal] = []

    def stage(self, target: Path) -> Path:
        """Give the path to write to in place of `target`; a link is followed, and stays one.

        Raises
        ------
        OutputError
            If the folder cannot be written, or `target` may not be replaced.
        """
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            real = check_target(target)
            # Noted before it is there: an interrupt between the two would leave it behind.
            part = real.with_name(_temporary_name(real, "part"))
            self._temporary.append(part)
            os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, _PRIVATE))
        except OSError as error:
            raise cannot_write(target, error) from error
        self._staged[real] = _Staged(target, part)
        return part

    def write(self, target: Path, content: bytes | Iterable[bytes]) -> None:
        """Stage a whole file; pieces of one are written as they are made.

        Raises
        ------
        OutputError
            If the disk is full or the folder cannot be written.
        """
        part = self.stage(target)
        try:
            with part.open("wb") as file:
                file.writelines((content,) if isinstance(content, bytes) else content)
        except OSError as error:
            raise cannot_write(target, error) from error

    def remove(self, target: Path) -> None:
        """Let a file go when the others appear; of a link, the link alone."""
        self._removed.append(target)

    def clear(self, folder: Path, is_own: Callable[[Path], bool]) -> None:
        """Let all files of a folder go, when the others appear, that `is_own` says to be ours.

        Those that are written stay. It is asked when nobody else can publish there any more.
        """
        self._cleared.append((folder, is_own))

    def _finish(self) -> None:
        for real, staged in self._staged.items():
            try:
                with staged.part.open("rb") as written:
                    os.fsync(written.fileno())
                permissions.adopt(staged.part, real)
            except OSError as error:
                raise cannot_write(real, error) from error
        if len(self._staged) == 1 and not self._removed and not self._cleared:
            self._replace_one(*self._staged.items())
        else:
            self._replace_all()

    def _replace_one(self, only: tuple[Path, _Staged]) -> None:
        """Replace a single file, which needs no journal: a rename is done or not."""
        real, staged = only
        finish(staged.target.parent)
        check_target(staged.target)
        try:
            staged.part.replace(real)
        except OSError as error:
            raise cannot_write(real, error) from error

    def _replace_all(self) -> None:
        targets = [staged.target for staged in self._staged.values()] + self._removed
        folders = {target.parent.resolve() for target in targets}
        folders |= {folder.resolve() for folder, _ in self._cleared}
        with ExitStack() as stack:
            for folder in sorted(folders):  # in one order, so that no two wait for each other
                journal = stack.enter_context(held(folder))
                stack.callback(journal.turn_back)
                self._journals.append(journal)
            for folder, journal in zip(sorted(folders), self._journals, strict=True):
                steps = [*self._replacements(folder), *self._removals(folder)]
                if steps:
                    journal.begin(steps)
            for journal in self._journals:
                journal.carry_out()
            for journal in self._journals:
                journal.settle()

    def _replacements(self, folder: Path) -> Iterator[Step]:
        for real, staged in self._staged.items():
            if staged.target.parent.resolve() == folder:
                check_target(staged.target)
                old = self._keep_old(real)
                yield Step(staged.target.name, seen(real), staged.part.name, old)

    def _removals(self, folder: Path) -> Iterator[Step]:
        targets = [path for path in self._removed if path.parent.resolve() == folder]
        for place, is_own in self._cleared:
            if place.resolve() == folder:
                targets += [path for path in listed(folder) if is_own(path)]
        staged = [item.target for item in self._staged.values()]
        written = {path.name for path in staged if path.parent.resolve() == folder}
        for target in dict.fromkeys(targets):
            if target.name not in written and os.path.lexists(target):
                check_target(target)
                yield Step(target.name, seen(target), None, self._keep_old(target))

    def _keep_old(self, target: Path) -> str | None:
        """Give the file at `target` a second name, or None where there is none."""
        if not os.path.lexists(target):
            return None
        old = target.with_name(_temporary_name(target, "old.part"))
        self._temporary.append(old)
        try:
            os.link(target, old, follow_symlinks=not target.is_symlink())
        except (OSError, NotImplementedError):  # a file system without hard links
            try:
                shutil.copy2(target, old, follow_symlinks=False)
            except OSError as error:
                raise cannot_write(target, error) from error
        return old.name

    def _discard(self) -> None:
        if all(journal.is_settled for journal in self._journals):
            for path in self._temporary:
                path.unlink(missing_ok=True)


def check_target(target: Path) -> Path:
    """Refuse a file that may not be replaced, and give the one that the name means.

    Raises
    ------
    OutputError
        As `permissions.check`, or if the system does not tell.
    """
    try:
        return permissions.check(target)
    except OSError as error:
        raise cannot_write(target, error) from error


def check_base(base: Path) -> None:
    """Refuse a base name that no file can come from, before an hour of measuring is spent on it.

    Raises
    ------
    OutputError
        If the name is empty or its folder can neither be written nor made.
    """
    if base.name in ("", ".."):
        msg = f"'{base}' is a folder; add a base name for the files, as in '{base / 'readings'}'."
        raise OutputError(msg)
    folder = next(path for path in base.absolute().parents if path.exists())
    if not folder.is_dir():
        msg = f"{base} cannot be written: {folder} is a file; choose another folder."
        raise OutputError(msg)
    if not os.access(folder, os.W_OK):
        msg = f"{base} cannot be written: no permission in {folder}; choose another folder."
        raise OutputError(msg)


def listed(folder: Path) -> list[Path]:
    """Give what lies in a folder that is to be written.

    Raises
    ------
    OutputError
        If the folder cannot be read: what is ours in it cannot be told.
    """
    try:
        return sorted(folder.iterdir())
    except OSError as error:
        raise cannot_write(folder, error) from error


@contextmanager
def publication() -> Iterator[AtomicFiles]:
    """Collect files, and give them their names at the end of the block if nothing failed.

    Raises
    ------
    OutputError
        If a file cannot be written; no target was touched by then.
    """
    files = AtomicFiles()
    try:
        yield files
        files._finish()
    finally:
        files._discard()


def _temporary_name(target: Path, ending: str) -> str:
    return f".{target.name[:_NAME_SHARE]}.{secrets.token_hex(_RANDOM_BYTES)}.{ending}"
