# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The header of an OpenEXR file, without a C++ library.

A measurement comes from anywhere, and a broken image must not end Blender: here every length is
checked before it is used. Read are scanline images of one part, not compressed or with ZIP or ZIPS,
which spectral images are written with; all else is refused by its name.

Source: "OpenEXR File Layout", https://openexr.com/en/latest/OpenEXRFileLayout.html.
"""

from __future__ import annotations

import struct

import numpy as np

from .document import Document, quote
from .exr_image import Channel, Image
from .exr_pixels import LINES, runs

MAGIC = b"\x76\x2f\x31\x01"

_KINDS = {
    0x200: "tiled",
    0x800: "a deep image",
    0x1000: "of several parts",
}
_PIXEL_TYPES: dict[int, np.dtype[np.generic]] = {
    0: np.dtype("<u4"),
    1: np.dtype("<f2"),
    2: np.dtype("<f4"),
}
_COMPRESSIONS = ["none", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB"]

_USED = ("channels", "compression", "dataWindow")

_LARGEST_SIDE = 2**16  # pixels
_MOST_RUNS = 64  # changes of the pixels' type from channel to channel; there are one or two
# An even color packs a hundredfold, noise hardly. Beyond both of these nobody has measured.
_LARGEST_PACKED = 64  # times the file's size
_LARGEST_ALWAYS = 48 * 2**20  # bytes


def open_image(document: Document) -> Image:
    """Read the header, and refuse what cannot be read or cannot be true.

    Raises
    ------
    InputError
        The header ends early or contradicts itself, the image is of a kind that is not read, or it
        would unpack to far more than its file could hold.
    """
    attributes, end = _attributes(document)
    kinds = [name for bit, name in _KINDS.items() if document.data[5] << 8 & bit]
    if kinds:
        raise document.error(
            "", f"the image is {' and '.join(kinds)}; save it as one part of scanlines"
        )
    channels = _channels(document, _attribute(document, attributes, "channels", 1))
    code = _attribute(document, attributes, "compression", 1)[0]
    name = _COMPRESSIONS[code] if code < len(_COMPRESSIONS) else f"number {code}"
    if name not in LINES:
        raise document.error(
            "attribute 'compression'",
            f"its pixels are packed with {name}; save the image with ZIP, ZIPS or unpacked",
        )
    box = struct.unpack_from("<4i", _attribute(document, attributes, "dataWindow", 16))
    width, height = box[2] - box[0] + 1, box[3] - box[1] + 1
    if not (0 < width <= _LARGEST_SIDE and 0 < height <= _LARGEST_SIDE):
        raise document.error("attribute 'dataWindow'", f"it cannot be {width} x {height} pixels")
    most = max(_LARGEST_ALWAYS, _LARGEST_PACKED * len(document.data))
    image = Image(document, width, height, box[1], channels, name, end)
    if image.line_size * height > most or len(runs(channels)) > _MOST_RUNS:
        raise document.error(
            "attribute 'dataWindow'",
            f"{width} x {height} pixels of {len(channels)} channels are more than a file of this "
            "size is read for; save a part of the image",
        )
    if end + 8 * -(-height // LINES[name]) > len(document.data):
        raise document.error("", "the file ends in its table of lines; save the image again")
    return image


def _attributes(document: Document) -> tuple[dict[str, bytes], int]:
    """Return the values of the attributes that are used, and where the header ends."""
    data, at = document.data, 8
    attributes: dict[str, bytes] = {}
    while at < len(data) and data[at]:
        name, at = _word(document, at)
        _, at = _word(document, at)  # the type; each attribute that is used has one type only
        if at + 4 > len(data):
            raise _cut(document)
        (size,) = struct.unpack_from("<i", data, at)
        at += 4
        if size < 0 or at + size > len(data):
            raise _cut(document)
        if name in _USED:
            attributes.setdefault(name, data[at : at + size])
        at += size
    if at >= len(data):
        raise _cut(document)
    return attributes, at + 1


def _attribute(document: Document, attributes: dict[str, bytes], name: str, least: int) -> bytes:
    value = attributes.get(name, b"")
    if len(value) < least:
        raise document.error(f"attribute {name!r}", "it is missing; save the image again")
    return value


def _channels(document: Document, listed: bytes) -> tuple[Channel, ...]:
    channels = []
    at = 0
    while at < len(listed) and listed[at]:
        end = listed.find(b"\0", at)
        if end < 0 or end + 17 > len(listed):
            raise _cut(document)
        name = listed[at:end].decode("latin-1")
        code, x, y = struct.unpack_from("<i4x2i", listed, end + 1)
        form = _PIXEL_TYPES.get(code)
        if form is None:
            raise document.error(f"channel {quote(name)}", f"pixels of the type {code} are unknown")
        channels.append(Channel(name, form, (x, y)))
        at = end + 17
    if any(channel.sampling != (1, 1) for channel in channels):
        raise document.error("", "some channels have fewer pixels than others; save all of them")
    return tuple(channels)


def _word(document: Document, at: int) -> tuple[str, int]:
    """Return the text at a place, and where it ends."""
    end = document.data.find(b"\0", at, at + 256)
    if end < 0:
        raise _cut(document)
    return document.data[at:end].decode("latin-1"), end + 1


def _cut(document: Document) -> Exception:
    return document.error("", "the header of the image is broken or cut off; save it again")
