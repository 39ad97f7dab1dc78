# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The channels of all renders of a picture, on the disk: of 36 bands in memory it is full."""

from __future__ import annotations

import tempfile

import numpy as np

from ...core.errors import OutputError
from ...core.numerics.arrays import Array

_IN_A_RENDER = 3
_BYTES = 4
"""Of a channel of a pixel, in single precision, as Cycles has them."""


class Channels:
    """Channels in a file without a name, which goes with this object or the process.

    Parameters
    ----------
    rows, columns
        Of the picture.

    Raises
    ------
    OutputError
        If temporary files cannot be written.
    """

    def __init__(self, rows: int, columns: int) -> None:
        self.rows, self.columns = rows, columns
        self._renders = 0
        try:
            self._file = tempfile.TemporaryFile(prefix="rough-spectra-")  # noqa: SIM115
        except OSError as error:
            raise _full(error) from error

    def add(self, pixels: Array) -> None:
        """Add a render, shape (rows, columns, 3), from the bottom up.

        Raises
        ------
        OutputError
            If the disk is full.
        """
        try:
            self._file.seek(self._renders * self.rows * self._line)
            self._file.write(np.ascontiguousarray(pixels, np.float32).data)
            self._file.flush()
        except OSError as error:
            raise _full(error) from error
        self._renders += 1

    def at(self, column: int, row: int) -> Array:
        """Give all channels of a pixel, counted from the bottom left, shape (channels,)."""
        place = (row * self.columns + column) * _IN_A_RENDER * _BYTES
        return self._read(place, _IN_A_RENDER).ravel()

    def lines(self, first: int, last: int) -> Array:
        """Give those of rows from `first` up to `last`, shape (rows, columns, channels)."""
        count = (last - first) * self.columns * _IN_A_RENDER
        renders = self._read(first * self._line, count)
        shape = (self._renders, last - first, self.columns, _IN_A_RENDER)
        return np.concatenate(renders.reshape(shape), axis=-1)

    @property
    def _line(self) -> int:
        return self.columns * _IN_A_RENDER * _BYTES

    def _read(self, place: int, count: int) -> Array:
        """Read so many numbers from the same place of each render."""
        found = np.empty((self._renders, count), np.float32)
        for number, numbers in enumerate(found):
            self._file.seek(number * self.rows * self._line + place)
            numbers[:] = np.frombuffer(self._file.read(count * _BYTES), np.float32)
        return found


def _full(error: OSError) -> OutputError:
    reason = error.strerror or "is the disk full?"
    return OutputError(
        f"The picture's spectra cannot be kept in {tempfile.gettempdir()} ({reason}); free the "
        "disk, or let TMPDIR name another one."
    )
