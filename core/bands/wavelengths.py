# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which wavelengths tell most of what surfaces show under some lamps.

One after the other the wavelength is taken that leaves least (forward selection); then each in turn
is put where it serves best beside the others, until none moves. All follows from one matrix of
products, which is eliminated a wavelength at a time (Schur complements): no fit is done anew.
"""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array

_DAMPING = 1e-6
"""Of the squares, as a share of their mean: what is known better than this is noise."""
_SWEEPS = 4
"""Most times that each is put anew."""


class Selection:
    """Forward selection, one wavelength after the other.

    Parameters
    ----------
    transport
        What reaches pixels at each wavelength, shape (rows, wavelengths).
    targets
        What it is to tell, each an own column of weights, shape (targets, rows).
    importance
        What a square of each row counts for each target, shape (targets, rows).
    """

    def __init__(self, transport: Array, targets: Array, importance: Array) -> None:
        weighted = transport.T * importance[:, np.newaxis]
        square = weighted @ transport
        count = square.shape[-1]
        mean = np.maximum(np.trace(square, axis1=1, axis2=2) / count, np.finfo(float).tiny)
        self._square = square + _DAMPING * mean[:, np.newaxis, np.newaxis] * np.eye(count)
        self._right = np.einsum("tcr,tr->tc", weighted, targets)
        self.found: list[int] = []

    def add(self, count: int) -> None:
        """Take more wavelengths, then put each where it serves best."""
        for _ in range(count):
            self.found.append(int(np.argmax(self._gains(self.found))))
        for _ in range(_SWEEPS):
            before = list(self.found)
            for place in range(len(self.found)):
                others = self.found[:place] + self.found[place + 1 :]
                self.found[place] = int(np.argmax(self._gains(others)))
            if before == self.found:
                break

    def _gains(self, taken: list[int]) -> Array:
        """By how much the squares shrink with each wavelength beside those that are taken."""
        square, right = self._square, self._right
        own = np.diagonal(square, axis1=1, axis2=2)
        if not taken:
            return np.asarray((right**2 / own).sum(axis=0))
        across = square[:, taken]
        solved = np.linalg.solve(square[:, taken][:, :, taken], across)
        left = own - np.einsum("tkc,tkc->tc", across, solved)
        missed = right - np.einsum("tkc,tk->tc", solved, right[:, taken])
        gains = (missed**2 / np.maximum(left, 1e-12 * own)).sum(axis=0)
        gains[taken] = -np.inf
        return np.asarray(gains)
