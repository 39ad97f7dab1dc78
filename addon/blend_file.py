# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Save the open .blend from the command line, whole or not at all.

Blender 4.5 and 5.2 report success and put a truncated file in place of the old one when the disk
is full. So the file is saved beside its target, looked at, and only then renamed.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy

from ..core.errors import InputError, OutputError
from . import permissions

_ZSTD_MAGIC = bytes.fromhex("28b52ffd")
_ZSTD_SEEK_TABLE_MAGIC = bytes.fromhex("b1ea928f")
_LAST_BLOCK = b"ENDB"
_LONGEST_BLOCK_HEAD = 32  # bytes; the last block is nothing but its head


def destination(output: Path | None) -> Path:
    """Give the file that `save` will replace: a link is followed, and stays one.

    Raises
    ------
    InputError
        If the open file has no name yet and none is given.
    OutputError
        If what is there may not be replaced.
    """
    if output is None and not bpy.data.filepath:
        msg = "The open file has no name; say where to save it with --output FILE."
        raise InputError(msg)
    path = Path(bpy.data.filepath) if output is None else output.absolute()
    try:
        return permissions.check(path)
    except OutputError as error:
        msg = f"{str(error).rstrip('.')}, with --output."
        raise OutputError(msg) from None
    except OSError as error:
        raise _cannot_save(path, error) from error


def save(output: Path | None) -> Path:
    """Save the open file, in place or elsewhere; to Blender it keeps the name it had.

    Older versions are kept beside it, as many as Blender's preferences say.

    Raises
    ------
    InputError
        If the file has no name yet and none is given.
    OutputError
        If it cannot be written; the old file is as it was then.
    """
    path = destination(output)
    part: Path | None = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent)
        os.close(handle)
        part = Path(name)
        part.unlink()  # Blender would keep the empty file as an older version
        with _private():
            bpy.ops.wm.save_as_mainfile(filepath=name, copy=True, check_existing=False)
        if not is_whole(part):
            raise OSError("the disk is full")
        permissions.adopt(part, path)
        _keep_older(path)
        part.replace(path)
    except (RuntimeError, OSError) as error:
        raise _cannot_save(path, error) from error
    finally:
        if part is not None:
            part.unlink(missing_ok=True)
    return path


def is_whole(path: Path) -> bool:
    """Whether a .blend, compressed or not, has its end."""
    with path.open("rb") as file:
        head = file.read(len(_ZSTD_MAGIC))
        file.seek(max(0, path.stat().st_size - _LONGEST_BLOCK_HEAD))
        tail = file.read()
        os.fsync(file.fileno())
    if head == _ZSTD_MAGIC:
        return tail.endswith(_ZSTD_SEEK_TABLE_MAGIC)
    return _LAST_BLOCK in tail


def _keep_older(path: Path) -> None:
    """Keep scene.blend as scene.blend1, that as scene.blend2 and so on."""
    versions = bpy.context.preferences.filepaths.save_version
    if not versions or not path.is_file():
        return
    for number in range(versions, 1, -1):
        younger = path.with_name(f"{path.name}{number - 1}")
        if younger.is_file():
            younger.replace(path.with_name(f"{path.name}{number}"))
    backup = path.with_name(f"{path.name}1")
    backup.unlink(missing_ok=True)
    try:
        # A link, so that there is no moment without a file at the path itself.
        os.link(path, backup)
    except OSError:
        shutil.copy2(path, backup)


@contextmanager
def _private() -> Iterator[None]:
    """Let nobody else read a file before it has the permissions of the one it replaces."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


def _cannot_save(path: Path, error: RuntimeError | OSError) -> OutputError:
    reason = " ".join((getattr(error, "strerror", None) or str(error)).split())
    return OutputError(
        f"{path} cannot be saved ({reason}); nothing was changed. Free the disk, or choose another "
        "place with --output."
    )
