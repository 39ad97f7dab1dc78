# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Work through large arrays in blocks that stay in the processor's cache.

A formula of ten numpy operations reads and writes its array ten times. On blocks of `ELEMENTS`
all but the first read and the last write happen in cache, and the temporaries stay small.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import prod

from .arrays import Array

ELEMENTS = 1 << 17
"""Elements of a block. By tools/benchmarks/block_size.py evaluation is fastest from 2^12 to 2^16
and inversion from 2^18 on; here neither loses more than a fifth. Below, calls cost; above, memory
does."""

Index = tuple[int | slice, ...]


def blocks(shape: tuple[int, ...], elements: int = ELEMENTS) -> Iterator[Index]:
    """Give indices that cut an array of this shape into blocks of at most `elements`.

    A block is never cut within the last axis unless that is the only one.

    Examples
    --------
    >>> list(blocks((5, 3), elements=6))
    [(slice(0, 2, None),), (slice(2, 4, None),), (slice(4, 6, None),)]
    """
    if prod(shape) <= elements:
        if prod(shape) > 0:
            yield ()
        return
    inner = prod(shape[1:])
    if len(shape) > 2 and inner > elements:
        for i in range(shape[0]):
            for rest in blocks(shape[1:], elements):
                yield (i, *rest)
        return
    step = max(1, elements // inner)
    for start in range(0, shape[0], step):
        yield (slice(start, start + step),)


def part(array: Array, index: Index, dimensions: int) -> Array:
    """Cut the block of an array that broadcasts to `dimensions` axes, without broadcasting it.

    Examples
    --------
    >>> row = np.arange(3)
    >>> part(row, (slice(0, 2),), dimensions=2).tolist()
    [[0, 1, 2]]
    >>> part(row[:, np.newaxis], (slice(0, 2),), dimensions=2).tolist()
    [[0], [1]]
    """
    if not index:
        return array
    aligned = array.reshape((1,) * (dimensions - array.ndim) + array.shape)
    own = tuple(
        which if aligned.shape[axis] > 1 else (0 if isinstance(which, int) else slice(None))
        for axis, which in enumerate(index)
    )
    return aligned[own]


def apply_in_blocks(formula: Callable[..., None], out: Array, *arrays: Array) -> None:
    """Fill `out` block by block: `formula(out, *arrays)` sees arrays that broadcast to its block.

    The formula writes its first argument in place and keeps no other large array.

    Examples
    --------
    >>> out = np.empty((2, 3))
    >>> def add(out, one, other):
    ...     np.add(one, other, out=out)
    >>> apply_in_blocks(add, out, np.array([[10.0], [20.0]]), np.arange(3.0))
    >>> out.tolist()
    [[10.0, 11.0, 12.0], [20.0, 21.0, 22.0]]
    """
    if out.size <= ELEMENTS:
        if out.size:
            formula(out, *arrays)
        return
    for index in blocks(out.shape):
        # A view even where the index is a single element of a one-dimensional array.
        formula(out[index], *(part(array, index, out.ndim) for array in arrays))
