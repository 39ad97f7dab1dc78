# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write result files whole or not at all.

Every file is written beside its target and takes its name only when all of them are complete. A
full disk, a kill or a crash leaves the old files as they were.
"""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..core.errors import OutputError
from . import permissions

_NAME_SHARE = 50
"""Characters of a target's name in its temporary one, which may not exceed 255 bytes."""
_RANDOM_BYTES = 8
"""As many that no two processes ever make the same name."""
_PRIVATE = 0o600
"""Permissions of a file until it is whole."""


class Publication:
    """A set of files that appear together. Made by `publication`."""

    def __init__(self) -> None:
        self._staged: dict[Path, Path] = {}
        self._kept: list[Path] = []
        self._parts: list[Path] = []

    def stage(self, target: Path) -> Path:
        """Give the path to write to in place of `target`; a link is followed, and stays one.

        Raises
        ------
        OutputError
            If the folder cannot be written, or `target` may not be replaced.
        """
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            target = check_target(target)
            # Noted before it is there: an interrupt between the two would leave it behind.
            name = f".{target.name[:_NAME_SHARE]}.{secrets.token_hex(_RANDOM_BYTES)}.part"
            part = target.with_name(name)
            self._parts.append(part)
            os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, _PRIVATE))
        except OSError as error:
            raise _cannot_write(target, error) from error
        self._staged[target] = part
        return part

    def write(self, target: Path, content: bytes) -> None:
        """Stage a whole file.

        Raises
        ------
        OutputError
            If the disk is full or the folder cannot be written.
        """
        part = self.stage(target)
        try:
            part.write_bytes(content)
        except OSError as error:
            raise _cannot_write(target, error) from error

    def _finish(self) -> None:
        for target, part in self._staged.items():
            try:
                with part.open("rb") as written:
                    os.fsync(written.fileno())
                permissions.adopt(part, target)
            except OSError as error:
                raise _cannot_write(target, error) from error
        done: list[tuple[Path, Path | None]] = []
        for target, part in self._staged.items():
            try:
                done.append((target, self._keep_old(target)))
                part.replace(target)
            except OSError as error:
                for earlier, old in done:
                    _bring_back(earlier, old)
                raise _cannot_write(target, error) from error

    def _keep_old(self, target: Path) -> Path | None:
        """Give the file at `target` a second name, or None where there is none."""
        if not target.is_file():
            return None
        old = self._staged[target].with_suffix(".old.part")
        self._kept.append(old)
        try:
            os.link(target, old)
        except OSError:  # a file system without hard links
            shutil.copy2(target, old)
        return old

    def _discard(self) -> None:
        for part in (*self._parts, *self._kept):
            part.unlink(missing_ok=True)


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
        raise _cannot_write(target, error) from error


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


@contextmanager
def publication() -> Iterator[Publication]:
    """Collect files, and give them their names at the end of the block if nothing failed.

    Raises
    ------
    OutputError
        If a file cannot be written; no target was touched by then.
    """
    files = Publication()
    try:
        yield files
        files._finish()
    finally:
        files._discard()


def _bring_back(target: Path, old: Path | None) -> None:
    """Undo a replacement, because a later one of the same set failed."""
    if old is not None:
        old.replace(target)
    elif target.is_file():
        target.unlink()


def _cannot_write(target: Path, error: OSError) -> OutputError:
    return OutputError(
        f"{target} cannot be written ({error.strerror or error}); nothing was changed. Free the "
        "disk or choose another place."
    )
