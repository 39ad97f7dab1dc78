# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Save the open .blend from the command line, whole or not at all.

Blender 4.5 and 5.2 report success and put a truncated file in place of the old one when the disk
is full and the file is compressed. So it is saved beside its target, looked at, and only then
renamed.
"""

from __future__ import annotations

import errno
import os
import shutil
import struct
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

import bpy

from ...core.errors import InputError, OutputError
from ..support import atomic_files, permissions

_NAME = b"BLENDER"
_HEAD = len(_NAME) + 1
_LAST_BLOCK = b"ENDB"
_BLOCK_HEAD, _OLD_BLOCK_HEAD = 32, 24
"""Bytes; the last block is nothing but its head."""

_ZSTD_MAGIC = bytes.fromhex("28b52ffd")
_ZSTD_SEEK_TABLE_MAGIC = 0x8F92EAB1
_SEEK_TABLE_FOOT = struct.Struct("<IBI")
"""Number of frames, flags, magic number: the "Zstandard Seekable Format" (contrib of zstd)."""
_HAS_CHECKSUMS = 0x80
_SKIPPED_HEAD = 8

_BLENDER_SAYS = "Error: "
_SYSTEM_SAYS = frozenset(map(os.strerror, (0, *errno.errorcode)))


def destination(output: Path | None, option: str = "--output") -> Path:
    """Give the file that `save` will replace: a link is followed, and stays one.

    `option` is what names another place on the command line.

    Raises
    ------
    InputError
        If the open file has no name yet and none is given.
    OutputError
        If what is there may not be replaced.
    """
    if output is None and not bpy.data.filepath:
        msg = f"The open file has no name; say where to save it with {option} FILE."
        raise InputError(msg)
    path = Path(bpy.data.filepath) if output is None else output.absolute()
    try:
        return permissions.check(path)
    except OutputError as error:
        msg = f"{str(error).rstrip('.')}, with {option}."
        raise OutputError(msg) from None
    except OSError as error:
        raise _cannot_save(path, error, option) from error


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
        _save_to(part, path)
        permissions.adopt(part, path)
        _keep_older(path)
        part.replace(path)
    except (RuntimeError, OSError) as error:
        raise _cannot_save(path, error) from error
    finally:
        if part is not None:
            part.unlink(missing_ok=True)
    return path


def save_among(files: atomic_files.AtomicFiles, output: Path | None, option: str) -> Path:
    """Save the open file as `save` does, but let it appear with the others of a publication.

    `option` as in `destination`.

    Raises
    ------
    InputError, OutputError
        As in `save`; none of the files has appeared then.
    """
    path = destination(output, option)
    try:
        part = files.stage(path)
        _save_to(part, path)
        _keep_older(path)
    except OutputError as error:  # the folder cannot be written
        raise OutputError(f"{str(error).rstrip('.')}, with {option}.") from error
    except (RuntimeError, OSError) as error:
        raise _cannot_save(path, error, option) from error
    return path


def _save_to(part: Path, path: Path) -> None:
    """Save beside the file that is to be replaced, and look whether all of it is there.

    Raises
    ------
    RuntimeError, OSError
        As Blender and the system say, or if the disk is full.
    """
    part.unlink()  # Blender would keep the empty file as an older version
    with _private():
        bpy.ops.wm.save_as_mainfile(
            filepath=str(part), copy=True, check_existing=False, **_compression(path)
        )
    if not is_whole(part):
        raise OSError("the disk is full")


def is_whole(path: Path) -> bool:
    """Whether a .blend, compressed or not, has all that was written to it, to its end."""
    with path.open("rb") as file:
        os.fsync(file.fileno())
        size = file.seek(0, os.SEEK_END)
        file.seek(0)
        head = file.read(_HEAD)
        if head.startswith(_ZSTD_MAGIC):
            return _is_whole_zstd(file, size)
        # Since 5.0 the length of the file's head follows its name, and blocks have longer ones.
        last = _BLOCK_HEAD if head[len(_NAME) :].isdigit() else _OLD_BLOCK_HEAD
        file.seek(max(0, size - last))
        return file.read().startswith(_LAST_BLOCK)


def _is_whole_zstd(file: BinaryIO, size: int) -> bool:
    """Whether the frames that the table at the end lists make up the file.

    Where only some of the writes failed, the table is there and a frame is not.
    """
    file.seek(max(0, size - _SEEK_TABLE_FOOT.size))
    foot = file.read()
    if len(foot) < _SEEK_TABLE_FOOT.size:
        return False
    count, flags, magic = _SEEK_TABLE_FOOT.unpack(foot)
    entry = struct.Struct("<III" if flags & _HAS_CHECKSUMS else "<II")
    length = _SKIPPED_HEAD + count * entry.size + _SEEK_TABLE_FOOT.size
    if magic != _ZSTD_SEEK_TABLE_MAGIC or length > size:
        return False
    file.seek(size - length + _SKIPPED_HEAD)
    frames = sum(fields[0] for fields in entry.iter_unpack(file.read(count * entry.size)))
    return bool(frames + length == size)


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


def _compression(path: Path) -> dict[str, bool]:
    """Keep a file compressed or not, as Blender does; a new one is as the open one."""
    for known in (path, Path(bpy.data.filepath)):
        if known.is_file():
            with known.open("rb") as file:
                return {"compress": file.read(len(_ZSTD_MAGIC)) == _ZSTD_MAGIC}
    return {}


@contextmanager
def _private() -> Iterator[None]:
    """Let nobody else read a file before it has the permissions of the one it replaces."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


def _cannot_save(
    path: Path, error: RuntimeError | OSError, option: str = "--output"
) -> OutputError:
    reason = " ".join((getattr(error, "strerror", None) or str(error)).split())
    if isinstance(error, RuntimeError) and reason.removeprefix(_BLENDER_SAYS) in _SYSTEM_SAYS:
        # Blender quotes what the system said last, which by then is of something else.
        reason = "Blender could not write all of it; the disk may be full"
    return OutputError(
        f"{path} cannot be saved ({reason}); nothing was changed. Free the disk, or choose another "
        f"place with {option}."
    )
