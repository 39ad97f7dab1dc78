# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as PNG: with the standard library alone, so that equal pixels are equal bytes."""

from __future__ import annotations

import struct
import zlib

import numpy as np
import numpy.typing as npt


def encode(pixels: npt.NDArray[np.uint8]) -> bytes:
    """Return the file of 8-bit red, green and blue, shape (rows, columns, 3), first row on top."""
    rows, columns, _ = pixels.shape
    # Each row is the difference to the one above (filter 2): areas of one color pack to nothing.
    above = np.zeros_like(pixels)
    above[1:] = pixels[:-1]
    lines = np.full((rows, 1 + 3 * columns), 2, np.uint8)
    lines[:, 1:] = (pixels - above).reshape(rows, -1)
    chunks = (
        (b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(lines.tobytes(), 9)),
        (b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*chunk) for chunk in chunks)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
