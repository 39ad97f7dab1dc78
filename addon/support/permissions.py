# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which file a name means, whether it may be replaced, and whose the new one is.

A file that is written beside its target and renamed would replace what the system protects from
writing, would turn a link into a file, and would belong to nobody that the old one did.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from ...core.errors import OutputError

_ANY_WRITE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
_PLAIN = 0o777
"""Bits that a result may have: it is no program that runs as somebody else."""


def real_path(target: Path) -> Path:
    """Give the file that a name means: a symbolic link is followed, and stays one."""
    return Path(os.path.realpath(target)) if target.is_symlink() else target


def check(target: Path) -> Path:
    """Refuse what may not be replaced, as Blender does; nothing need be there.

    Root may write anywhere, but not what nobody may write: that is protected on purpose.

    Returns
    -------
    The file that `target` means.

    Raises
    ------
    OutputError
        If it is a folder, a device, a pipe, write-protected, or a link to nothing.
    OSError
        If the system does not tell.
    """
    real = real_path(target)
    try:
        mode = real.stat().st_mode
    except FileNotFoundError:
        if target.is_symlink():
            msg = f"{target} is a link to a file that is not there; choose another name."
            raise OutputError(msg) from None
        return real
    if stat.S_ISDIR(mode):
        msg = f"{target} is a folder; choose a file name."
        raise OutputError(msg)
    if not stat.S_ISREG(mode):
        msg = f"{target} is a device or a pipe; choose another name."
        raise OutputError(msg)
    if not mode & _ANY_WRITE or not os.access(real, os.W_OK):
        msg = f"{target} is write-protected; permit writing, or choose another place."
        raise OutputError(msg)
    return real


def adopt(part: Path, target: Path) -> None:
    """Give a new file the owner, group and mode of the one that it will replace, where we may.

    Without an old one it gets those of any new file.

    Raises
    ------
    OSError
        If the system refuses the mode.
    """
    try:
        old = target.stat()
    except FileNotFoundError:
        part.chmod(0o666 & ~_umask())
        return
    mode = old.st_mode & _PLAIN
    new = part.stat()
    if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid) and not _give(part, old):
        # What its group was allowed must not go to ours.
        mode = mode & ~stat.S_IRWXG | (mode & stat.S_IRWXO) << 3
    part.chmod(mode)


def cannot_write(target: Path, error: OSError) -> OutputError:
    """Give the sentence for a file that the system refuses."""
    return OutputError(
        f"{target} cannot be written ({error.strerror or error}); nothing was changed. Free the "
        "disk or choose another place."
    )


def _give(part: Path, old: os.stat_result) -> bool:
    """Give owner and group, or the group alone; False if the group cannot be given."""
    if not hasattr(os, "chown"):
        return True  # Windows has no groups to tell apart
    for owner in (old.st_uid, -1):
        try:
            os.chown(part, owner, old.st_gid)
        except OSError:  # only root may, and some file systems have no owners
            continue
        return True
    return False


def _umask() -> int:
    """Temporary files are private; results get the permissions of any new file."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
