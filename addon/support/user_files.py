# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read files that a user named, and nothing else: a pipe or a device would be waited for."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from ...core.errors import InputError

LARGEST = 256 * 2**20
"""Bytes; a table of 100,000 spectra takes about 30 MB."""


def read(path: str | os.PathLike[str], largest: int = LARGEST) -> bytes:
    """Read a file whole.

    Parameters
    ----------
    path
        As the user gave it: messages repeat it.
    largest
        Bytes that are read at most.

    Raises
    ------
    InputError
        It is missing, a folder, something else than a file, larger than that, or the system
        refuses to read it.
    """
    file = Path(path)
    name = str(file).replace("\0", "\\0")
    try:
        status = file.stat()
        if stat.S_ISDIR(status.st_mode):
            raise InputError(f"{name}: this is a folder; choose a file in it.")
        if not is_regular(file):
            raise InputError(f"{name}: this is no regular file; copy its content into one.")
        if status.st_size > largest:
            raise InputError(
                f"{name}: the file has {status.st_size / 2**20:.0f} MB, more than the "
                f"{largest // 2**20} MB that are read; split it."
            )
        return file.read_bytes()
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(f"{name}: there is no such file; check its name and folder.") from None
    except PermissionError:
        raise InputError(f"{name}: no permission to read it; change the file's rights.") from None
    except (OSError, ValueError) as error:
        # ValueError: a name with a null character in it.
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{name}: it cannot be read ({reason}); check the name.") from error


def is_regular(path: Path) -> bool:
    """Return whether opening the path waits for nobody: no pipe, no device, no socket.

    Raises
    ------
    OSError
        There is nothing, or looking is denied.
    """
    return stat.S_ISREG(path.stat().st_mode)
