# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rename a set of files so that a kill between two renames leaves no half of it for good.

While a set takes its names, the folder holds a journal that lists all renames and removals. It is
locked, so that one process publishes at a time, and the system frees it when that process dies.
Whoever finds a journal that nobody holds carries out what it lists; what is done already is left
out. A file that somebody else changed in between is left as it is.

A line of the journal counts when it has its end, and the last one counts alone: before the first
everything is old, and a set that failed is turned back by a line that lists the way back.

A journal may come with a folder from anywhere. It names files of its own folder only, and touches
none whose size and time are not those that it says.
"""

from __future__ import annotations

import errno
import json
import os
import stat
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from io import FileIO
from pathlib import Path
from typing import Any

from ...core.errors import OutputError
from .file_lock import hold
from .permissions import cannot_write, real_path

NAME = ".rough-spectra.journal"

_WAIT = 10.0
_WAIT_OF_READERS = 0.5
"""Seconds for another process to publish; a reader finds every file whole meanwhile."""
_CLOCK = 2_000_000_000
"""Nanoseconds that a file system may round the time of a file by."""

Seen = tuple[int, int]
"""Size and time of a file, by which it is known again."""
_NEVER: Seen = (-1, -1)


@dataclass(frozen=True)
class Step:
    """What happens to one name of the folder.

    Parameters
    ----------
    name
        Of the target; if it is a link, a file beside the real one replaces that.
    was
        What has the name until then, or None where nothing has.
    part
        Name of the file beside the target that replaces it; None removes the target.
    old
        Name of a file beside the target that keeps the way back, if there was anything.
    """

    name: str
    was: Seen | None
    part: str | None
    old: str | None = None

    def target(self, folder: Path) -> Path:
        """Give the file that is replaced or removed: a link is followed or removed."""
        named = folder / self.name
        return named if self.part is None else real_path(named)


class Journal:
    """The journal of a folder while this process holds it. Made by `held`."""

    def __init__(self, folder: Path, file: FileIO) -> None:
        self._folder = folder
        self._file = file
        self._steps: list[Step] = []
        self._may_turn_back = False
        self.is_settled = False
        """Whether nothing is left to do, so that the journal and its parts may go."""

    def finish(self) -> None:
        """Carry out what a process that died has left.

        Raises
        ------
        OutputError
            If the journal is none, or a step fails.
        """
        self._file.seek(0)
        lines = self._file.read().split(b"\n")[:-1]
        if lines:
            self._steps = self._read(lines[-1])
            self._rename(is_own=False)
            self._tidy()
        self._file.truncate(0)
        self.is_settled = True

    def begin(self, steps: Sequence[Step]) -> None:
        """Say what is going to happen; from here on it happens, whoever does it.

        Raises
        ------
        OutputError
            If that cannot be written; nothing happens then.
        """
        line = f"{json.dumps([asdict(step) for step in steps])}\n".encode("ascii")
        end = self._file.seek(0, os.SEEK_END)
        try:
            if self._file.write(line) != len(line):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            os.fsync(self._file.fileno())
        except OSError as error:
            self._file.truncate(end)
            raise cannot_write(self._folder / NAME, error) from error
        self._steps, self._may_turn_back, self.is_settled = list(steps), True, False
        _sync(self._folder)

    def carry_out(self) -> None:
        """Do what `begin` said.

        Raises
        ------
        OutputError
            If a step fails; the others are to be turned back.
        """
        self._rename(is_own=True)

    def settle(self) -> None:
        """Let what was carried out stay for good."""
        self._may_turn_back = False
        self._tidy()
        self.is_settled = True

    def turn_back(self) -> None:
        """Undo what was carried out, unless that is settled or there was nothing to do.

        Raises
        ------
        OutputError
            If that fails; whoever publishes here next finds the journal.
        """
        if not self._may_turn_back:
            return
        try:
            self.begin([self._back(step) for step in self._steps])
            self._rename(is_own=False)
        except OutputError as error:
            msg = f"{self._folder} is left half written; write there again to mend that: {error}"
            raise OutputError(msg) from error
        self.settle()

    def _rename(self, is_own: bool) -> None:
        for step in self._steps:
            target = step.target(self._folder)
            try:
                if not _is_done(step, target):
                    if _is_same(seen(target), step.was):
                        _do(step, target)
                    elif is_own:
                        raise OSError("somebody else changed it")
            except OSError as error:
                raise cannot_write(target, error) from error
        _sync(self._folder)

    def _tidy(self) -> None:
        """Remove what is not needed any more; what stays has a name that nobody takes for ours."""
        for step in self._steps:
            for name in (step.part, step.old):
                if name is not None:
                    with suppress(OSError):
                        step.target(self._folder).with_name(name).unlink()

    def _back(self, step: Step) -> Step:
        target = step.target(self._folder)
        if not _is_done(step, target):
            return Step(step.name, _NEVER, step.part, step.old)
        return Step(step.name, seen(target), step.old)

    def _read(self, line: bytes) -> list[Step]:
        try:
            steps = [_step(fields) for fields in json.loads(line)]
        except (ValueError, TypeError, RecursionError) as error:
            path = self._folder / NAME
            msg = f"{path} lists no renames of ours ({error}); delete it."
            raise OutputError(msg) from error
        return steps


def seen(path: Path) -> Seen | None:
    """Give what a file is known again by, or None where there is none."""
    try:
        status = path.lstat()
    except FileNotFoundError:
        return None
    return status.st_size, status.st_mtime_ns


def finish(folder: Path) -> None:
    """Complete a set of files in this folder that a killed process left half renamed.

    Costs one look at the folder where there is none.

    Raises
    ------
    OutputError
        If the folder cannot be written.
    """
    if not os.path.lexists(folder / NAME):
        return
    file = _open(folder, _WAIT_OF_READERS)
    if file is not None:
        with file, _settled(folder, file):
            pass


@contextmanager
def held(folder: Path, wait: float = _WAIT) -> Iterator[Journal]:
    """Hold the journal of a folder for the block; what a killed process left is done by then.

    Raises
    ------
    OutputError
        If the folder cannot be written, or another process publishes there for too long.
    """
    file = _open(folder, wait)
    if file is None:
        msg = f"{folder} is being written by another program; try again when it is done."
        raise OutputError(msg)
    with file, _settled(folder, file) as journal:
        yield journal


@contextmanager
def _settled(folder: Path, file: FileIO) -> Iterator[Journal]:
    """Remove the journal at the end, unless something of it is still to be done."""
    journal = Journal(folder, file)
    try:
        journal.finish()
        yield journal
    finally:
        if journal.is_settled:
            if sys.platform == "win32":  # where no open file can be removed
                file.close()
            with suppress(FileNotFoundError, PermissionError):  # another process has it already
                (folder / NAME).unlink()


def _open(folder: Path, wait: float) -> FileIO | None:
    """Open and lock the journal; None if another process keeps it."""
    path = folder / NAME
    # A link or a pipe in its place is none of ours.
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND
    flags |= getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    flags |= getattr(os, "O_BINARY", 0)
    while True:
        try:
            file = FileIO(os.open(path, flags, 0o666), "r+b")
        except OSError as error:
            raise cannot_write(path, error) from error
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            file.close()
            msg = f"{path} is a device or a pipe; delete it."
            raise OutputError(msg)
        if not hold(file, wait):
            file.close()
            return None
        try:
            is_still = os.path.samestat(os.fstat(file.fileno()), path.lstat())
        except FileNotFoundError:  # its holder was done, and removed it
            is_still = False
        if is_still:
            return file
        file.close()


def _step(fields: dict[str, Any]) -> Step:
    name, was, part, old = (fields[key] for key in ("name", "was", "part", "old"))
    for given in (name, part, old):
        if given is not None and (os.path.basename(given) != given or given in ("", ".", "..")):
            raise ValueError(f"{given!r} is no file's name")
    for given in (part, old):
        if given is not None and not (given.startswith(".") and given.endswith(".part")):
            raise ValueError(f"{given!r} is not temporary")
    if was is not None:
        size, time = was
        was = int(size), int(time)
    return Step(str(name), was, part, old)


def _is_done(step: Step, target: Path) -> bool:
    if step.part is None:
        return seen(target) is None
    return seen(target.with_name(step.part)) is None


def _do(step: Step, target: Path) -> None:
    if step.part is None:
        target.unlink()
    else:
        target.with_name(step.part).replace(target)


def _is_same(found: Seen | None, was: Seen | None) -> bool:
    if found is None or was is None:
        return found is was
    return found[0] == was[0] and abs(found[1] - was[1]) <= _CLOCK


def _sync(folder: Path) -> None:
    """Have the names on the disk before what follows from them, where the system can."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:  # Windows opens no folders
        return
    try:
        os.fsync(handle)
    except OSError:  # nor does every file system write them when asked to
        pass
    finally:
        os.close(handle)
