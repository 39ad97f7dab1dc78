# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a table as text: few bytes of source, and no file to read."""

from __future__ import annotations

import base64
import zlib

import numpy as np

from ..numerics.arrays import Array


def pack(values: Array, steps: Array) -> str:
    """Write columns as multiples of their steps: 16-bit integers, deflated, in base 85.

    Examples
    --------
    >>> steps = np.array([0.5, 0.25])
    >>> unpack(pack(np.array([[1.0, 2.0], [1.5, -0.3]]), steps), (0.5, 0.25)).tolist()
    [[1.0, 2.0], [1.5, -0.25]]
    """
    integers = np.rint(values / steps).astype("<i2")
    # High and low bytes apart: the high ones of small columns are all alike.
    planes = integers.T.copy().view(np.uint8).reshape(-1, 2).T
    return base64.b85encode(zlib.compress(planes.tobytes(), 9)).decode("ascii")


def unpack(text: str, steps: tuple[float, ...]) -> Array:
    """Read what `pack` wrote: shape (rows, columns).

    Examples
    --------
    >>> unpack(pack(np.array([[1.0], [-2.0]]), np.array([0.5])), (0.5,)).tolist()
    [[1.0], [-2.0]]
    """
    planes = np.frombuffer(zlib.decompress(base64.b85decode(text)), np.uint8).reshape(2, -1)
    integers = planes.T.copy().view("<i2").reshape(len(steps), -1)
    return np.asarray(integers.T * np.array(steps))
