# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tensor files, named arrays one after the other, as RGL publishes measured BRDFs in.

Little-endian: ``tensor_file`` and a zero, a version of two bytes, the number of fields, and for
each its name, dimensions, type, place and shape.

Source: `python/visualize.py` of rgl-epfl/brdf-loader.
"""

from __future__ import annotations

import math
import struct

import numpy as np
from numpy.typing import NDArray

from .document import Document, quote

MAGIC = b"tensor_file\0"

_VERSION = (1, 0)
_TYPES = ("u1", "i1", "<u2", "<i2", "<u4", "<i4", "<u8", "<i8", "<f2", "<f4", "<f8")
"""By their number in the file, from 1 on."""
_MOST_FIELDS, _MOST_DIMENSIONS = 64, 8


def fields(document: Document) -> dict[str, NDArray[np.generic]]:
    """Return the arrays of a file by name, as views of its bytes.

    Raises
    ------
    InputError
        The version is another, or a field's type, shape or place is impossible.
    """
    data = document.data
    at = len(MAGIC)
    version = struct.unpack("<BB", _bytes(document, at, 2))
    if version != _VERSION:
        raise document.error(
            f"byte {at + 1}",
            f"the tensor file is of version {version[0]}.{version[1]}, and 1.0 is read; save it as "
            "that",
        )
    (count,) = struct.unpack("<I", _bytes(document, at + 2, 4))
    if not 0 < count <= _MOST_FIELDS:
        raise _damaged(document, at + 3, f"it states {count} fields")
    at += 6
    found: dict[str, NDArray[np.generic]] = {}
    for _ in range(count):
        (length,) = struct.unpack("<H", _bytes(document, at, 2))
        name = _bytes(document, at + 2, length).decode("utf-8", errors="replace")
        at += 2 + length
        dimensions, kind, offset = struct.unpack("<HBQ", _bytes(document, at, 11))
        if dimensions > _MOST_DIMENSIONS or not 0 < kind <= len(_TYPES):
            raise _damaged(document, at + 1, f"the field {quote(name)} has no known type or shape")
        shape = struct.unpack(f"<{dimensions}Q", _bytes(document, at + 11, 8 * dimensions))
        at += 11 + 8 * dimensions
        size = math.prod(shape)  # of Python's integers, which do not overflow
        kept = np.dtype(_TYPES[kind - 1])
        if offset + size * kept.itemsize > len(data):
            raise _damaged(document, at, f"the field {quote(name)} goes on behind the end")
        if size:
            found[name] = np.frombuffer(data, kept, size, offset).reshape(shape)
    return found


def _bytes(document: Document, at: int, length: int) -> bytes:
    found = document.data[at : at + length]
    if len(found) < length:
        raise _damaged(document, len(document.data), "the file ends early")
    return found


def _damaged(document: Document, at: int, what: str) -> Exception:
    return document.error(f"byte {at}", f"{what}; copy or download the file again")
