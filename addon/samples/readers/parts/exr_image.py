# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An OpenEXR image's channels and size, as its header states them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .document import Document


class Channel(NamedTuple):
    """A channel's name, the type of its pixels, and its subsampling in x and y."""

    name: str
    form: np.dtype[np.generic]
    sampling: tuple[int, int]


@dataclass(frozen=True)
class Image:
    """The header of an image, checked against the size of its file."""

    document: Document
    width: int
    height: int
    top: int
    channels: tuple[Channel, ...]
    compression: str
    chunks: int

    @property
    def line_size(self) -> int:
        """Bytes of a line."""
        return self.width * sum(channel.form.itemsize for channel in self.channels)
