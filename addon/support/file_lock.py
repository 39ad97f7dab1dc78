# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let one process at a time change the files of a folder."""

from __future__ import annotations

import errno
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from ...core.errors import OutputError
from .user_files import is_regular

NAME = ".lock"
"""Stays in the folder: if the last user deleted it, the next two could lock different files."""

_WAIT = 10.0
_PAUSE = 0.02
"""Seconds."""
_UNSUPPORTED = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL}


@contextmanager
def locked(folder: Path, wait: float = _WAIT) -> Iterator[None]:
    """Hold the folder's lock for the block. The system frees it when the process dies.

    Parameters
    ----------
    folder
        Made if it is not there.
    wait
        Seconds to wait for another process.

    Raises
    ------
    OutputError
        If the folder cannot be written, or another process keeps the lock.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = folder / NAME
        if lock.exists() and not is_regular(lock):
            msg = f"{lock} is no regular file; remove it, or choose another folder."
            raise OutputError(msg)
        handle = lock.open("ab")
    except OSError as error:
        msg = f"{folder} cannot be written ({error.strerror or error}); choose another folder."
        raise OutputError(msg) from error
    with handle:
        if not hold(handle, wait):
            msg = f"{folder} is being changed by another program; try again when it is done."
            raise OutputError(msg)
        yield  # closing the handle frees the lock


def hold(handle: IO[bytes], wait: float) -> bool:
    """Lock an open file until it is closed; False if another process keeps it for `wait` seconds.

    The system frees it when the process dies.
    """
    end = time.monotonic() + wait
    while not _try_to_lock(handle):
        if time.monotonic() > end:
            return False
        time.sleep(_PAUSE)
    return True


def is_left(path: Path) -> bool:
    """Whether the process that held a file is surely gone: False also where there are no locks.

    Raises
    ------
    OSError
        If there is no such file, or it cannot be opened.
    """
    with path.open("rb+") as handle:
        try:
            _lock(handle)
        except OSError:
            return False
    return True


def _lock(handle: IO[bytes]) -> None:
    if sys.platform == "win32":
        import msvcrt

        handle.seek(0)
        msvcrt.locking(handle.fileno(), msvcrt.LK_NBLCK, 1)
    else:
        import fcntl

        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _try_to_lock(handle: IO[bytes]) -> bool:
    try:
        _lock(handle)
    except OSError as error:
        # Some network drives have no locks. Files are still replaced whole.
        return error.errno in _UNSUPPORTED
    return True
