# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write pictures of a user interface as PNG with a palette: less than half the bytes."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np

_FREQUENT = 96  # colors that are kept to the bit: areas, letters, swatches
_COLORS = 256


def write(path: Path, pixels: Any) -> None:
    """Write 8-bit pixels, shape (rows, columns, 3), in the 256 colors that hold them best."""
    rows, columns, _ = pixels.shape
    keys = pixels.reshape(-1, 3).astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    found, places, counts = np.unique(keys, return_inverse=True, return_counts=True)
    colors = np.stack([found >> 16, found >> 8 & 255, found & 255], axis=1).astype(int)
    palette, nearest = _palette(colors, counts)
    lines = nearest[places].reshape(rows, columns).astype(np.uint8)
    header = struct.pack(">IIBBBBB", columns, rows, 8, 3, 0, 0, 0)
    chunks = (
        (b"IHDR", header),
        (b"PLTE", palette.astype(np.uint8).tobytes()),
        (b"IDAT", zlib.compress(b"".join(b"\0" + line.tobytes() for line in lines), 9)),
        (b"IEND", b""),
    )
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*chunk) for chunk in chunks))


def _palette(colors: Any, counts: Any) -> tuple[Any, Any]:
    """Take the most frequent colors, then again and again the one that is held worst."""
    chosen = list(np.argsort(-counts)[:_FREQUENT])
    apart = ((colors[:, None] - colors[chosen]) ** 2).sum(axis=-1)
    nearest, apart = apart.argmin(axis=1), apart.min(axis=1)
    while len(chosen) < _COLORS and apart.any():
        worst = int((apart * np.sqrt(counts)).argmax())
        further = ((colors - colors[worst]) ** 2).sum(axis=-1)
        nearest = np.where(further < apart, len(chosen), nearest)
        apart = np.minimum(apart, further)
        chosen.append(worst)
    return colors[chosen], nearest


def _chunk(kind: bytes, data: bytes) -> bytes:
    check = zlib.crc32(kind + data)
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)
