# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an image of readings is to the rest: pixels with an axis of bands, a few lines at a time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ...core.errors import InputError

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array

Pixels = npt.NDArray[np.float32]

LARGEST_SIDE = 2**16  # pixels


class BandImage(ABC):
    """An image that is open for reading.

    Attributes
    ----------
    path
        Of its file.
    width, height
        In pixels.
    wavelengths
        Nanometers of its bands in the order of the file, shape (bands,); empty where the bands are
        linear red, green and blue of Rec.709.
    names
        What the file calls the bands.
    lines
        Read a multiple of as many lines at once: they are stored together.
    notes
        Sentences on what was taken for granted.
    """

    def __init__(self, path: Path, width: int, height: int) -> None:
        self.path = path
        self.width, self.height = width, height
        self.wavelengths: Array = np.empty(0)
        self.names: tuple[str, ...] = ()
        self.lines = 1
        self.notes: tuple[str, ...] = ()
        if not (0 < width <= LARGEST_SIDE and 0 < height <= LARGEST_SIDE):
            raise self.fault(f"has {width} × {height} pixels; it needs at least one and at most "
                             f"{LARGEST_SIDE} a side")  # fmt: skip

    @abstractmethod
    def take(self, bands: Sequence[int]) -> None:
        """Read these bands from now on, in the order of the file."""

    @abstractmethod
    def read(self, first: int, last: int) -> Pixels:
        """Read lines from `first` up to, but without, `last`, shape (pixels, bands taken).

        Raises
        ------
        InputError
            If the file is damaged or ends early.
        """

    @abstractmethod
    def close(self) -> None:
        """Let the file go."""

    def fault(self, said: str) -> InputError:
        """Make an error that names the file."""
        return fault(self.path, said)


def fault(path: Path, said: str) -> InputError:
    """Make an error of a sentence that begins with the file's name."""
    return InputError(f"{path} {said}.")
