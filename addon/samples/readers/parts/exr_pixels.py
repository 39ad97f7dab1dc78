# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pixels of an OpenEXR image, unpacked a piece at a time.

Sixteen lines that are packed together may have megabytes while their file has a few kB, so neither
a chunk nor a line is ever whole in memory. Packing moves all even bytes of a chunk before all odd
ones: two streams run through a large chunk side by side, the second one half of it ahead.

Source: "OpenEXR File Layout", https://openexr.com/en/latest/OpenEXRFileLayout.html.
"""

from __future__ import annotations

import itertools
import struct
import zlib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .exr_image import Channel, Image

Bytes = NDArray[np.uint8]

LINES = {"none": 1, "ZIPS": 1, "ZIP": 16}
"""In one chunk, by the compression."""

_PIECE = 2**16  # bytes that are unpacked at a time; a multiple of four
_BLOCK = 2**16  # bytes that become floats at a time


class Run(NamedTuple):
    """Channels that follow each other and have pixels of one type."""

    first: int
    channels: int
    form: np.dtype[np.generic]


def runs(channels: Iterable[Channel]) -> list[Run]:
    """Return the channels by the types of their pixels."""
    found = []
    first = 0
    for form, group in itertools.groupby(channels, key=lambda channel: channel.form):
        count = len(list(group))
        found.append(Run(first, count, form))
        first += count
    return found


def blocks(image: Image, first: int, count: int) -> Iterator[tuple[int, NDArray[np.float32]]]:
    """Yield all pixels of `count` lines below `first`, in blocks of some lines and channels.

    Yields
    ------
    tuple
        The index of the block's first channel, and its pixels, shape (lines, channels, width).

    Raises
    ------
    InputError
        A chunk of lines is missing or broken.
    """
    supply = _Supply(_bytes(image, first, count))
    width = image.width
    at_once = _BLOCK // image.line_size
    # Whole lines together if several fit, else a line in parts.
    spans = [runs(image.channels)] if at_once else _parts(image)
    for top in range(0, count, max(at_once, 1)):
        lines = min(max(at_once, 1), count - top)
        for span in spans:
            size = sum(run.channels * run.form.itemsize for run in span) * width
            raw = supply.take(lines * size).reshape(lines, size)
            at = 0
            for run in span:
                end = at + run.channels * width * run.form.itemsize
                part = np.ascontiguousarray(raw[:, at:end]).view(run.form)
                yield run.first, part.reshape(lines, run.channels, width).astype(np.float32)
                at = end


def _parts(image: Image) -> list[list[Run]]:
    """Return the channels of a long line in runs that fit a block."""
    parts = []
    for run in runs(image.channels):
        step = max(1, _BLOCK // (image.width * run.form.itemsize))
        for first in range(0, run.channels, step):
            count = min(step, run.channels - first)
            parts.append([Run(run.first + first, count, run.form)])
    return parts


class _Supply:
    """Bytes that come in pieces of any size, and leave in those that are asked for."""

    def __init__(self, pieces: Iterator[Bytes]) -> None:
        self._pieces = pieces
        self._left = np.empty(0, np.uint8)

    def take(self, count: int) -> Bytes:
        if self._left.size >= count:
            taken, self._left = self._left[:count], self._left[count:]
            return taken
        taken = np.empty(count, np.uint8)
        filled = 0
        while filled < count:
            if not self._left.size:
                self._left = next(self._pieces)
            piece = self._left[: count - filled]
            taken[filled : filled + piece.size] = piece
            self._left = self._left[piece.size :]
            filled += piece.size
        return taken


def _bytes(image: Image, first: int, count: int) -> Iterator[Bytes]:
    """Yield the bytes of some lines."""
    step, line = LINES[image.compression], image.line_size
    packed_in_all = 0
    for chunk in range(first // step, (first + count - 1) // step + 1):
        begin = chunk * step
        size = min(step, image.height - begin) * line
        packed = _packed(image, chunk, begin)
        packed_in_all += len(packed)
        # Chunks may claim to overlap: each of them would unpack the rest of the file.
        if packed_in_all > len(image.document.data):
            raise _broken(image, begin)
        skipped, end = max(first - begin, 0) * line, min(first + count - begin, step) * line
        at = 0
        for piece in _unpacked(packed, size, image.compression):
            at += piece.size
            if at > size:
                break
            low = max(skipped - at + piece.size, 0)
            high = piece.size - max(at - end, 0)
            if low < high:
                yield piece[low:high]
        if at != size:
            raise _broken(image, begin)


def _packed(image: Image, chunk: int, begin: int) -> memoryview:
    """Return a chunk as it is in the file."""
    data = image.document.data
    (at,) = struct.unpack_from("<Q", data, image.chunks + 8 * chunk)
    if image.chunks <= at <= len(data) - 8:
        y, length = struct.unpack_from("<2i", data, at)
        if y == image.top + begin and 0 <= length <= len(data) - at - 8:
            return memoryview(data)[at + 8 : at + 8 + length]
    raise image.document.error(
        f"line {begin + 1} of the image", "the line is missing; save the whole image again"
    )


def _broken(image: Image, begin: int) -> Exception:
    return image.document.error(
        f"line {begin + 1} of the image", "its pixels are broken; save the image again"
    )


def _unpacked(packed: memoryview, size: int, compression: str) -> Iterator[Bytes]:
    """Yield the bytes of a chunk in their order: `size` in all, unless the chunk is broken."""
    if len(packed) == size:  # what packing would not make smaller is stored as it is
        yield np.frombuffer(packed, np.uint8)
        return
    if compression == "none":
        return
    half = (size + 1) // 2
    try:
        if size <= _PIECE:
            steps = zlib.decompressobj().decompress(packed, size + 1)
            if len(steps) == size:
                both = _summed(steps, 0x80)
                yield _woven(both[:half], both[half:])
            return
        even, odd = _Steps(packed), _Steps(packed)
        for start in range(0, half, _PIECE):
            odd.take(min(_PIECE, half - start))
        for start in range(0, half, _PIECE):
            count = min(_PIECE, half - start)
            last = start + count == half
            woven = _woven(even.take(count), odd.take(count - size % 2 if last else count))
            if last and odd.take(1).size:
                return
            yield woven
    except zlib.error:
        return


def _woven(even: Bytes, odd: Bytes) -> Bytes:
    pixels = np.empty(even.size + odd.size, np.uint8)
    if even.size - odd.size in (0, 1):  # else the chunk ends early, and is refused for its size
        pixels[0::2], pixels[1::2] = even, odd
    return pixels


class _Steps:
    """Deflated differences from byte to byte, as bytes."""

    def __init__(self, packed: memoryview) -> None:
        self._inflate = zlib.decompressobj()
        self._packed = packed
        self._at = 0
        self._last = 0x80  # so that the first is no difference

    def take(self, count: int) -> Bytes:
        """Return the next bytes; fewer at the end.

        Raises
        ------
        zlib.error
            They are not deflated.
        """
        inflate = self._inflate
        parts = []
        while count and not inflate.eof:
            tail: bytes | memoryview = inflate.unconsumed_tail
            if not tail:
                tail = self._packed[self._at : self._at + _PIECE]
                self._at += len(tail)
            part = inflate.decompress(tail, count)
            if not part and not tail:
                break
            parts.append(part)
            count -= len(part)
        found = _summed(b"".join(parts), self._last)
        self._last = int(found[-1]) if found.size else self._last
        return found


def _summed(steps: bytes, last: int) -> Bytes:
    """Return the running sum of differences, which are 128 too large, modulo 256."""
    found = np.frombuffer(steps, np.uint8) ^ np.uint8(0x80)
    if found.size:
        found[0] = (int(found[0]) + last) & 0xFF
        np.add.accumulate(found, dtype=np.uint8, out=found)
    return found
