# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Time things against each other on a machine that others use too. Standard library only.

All take turns, so that a disturbance hits each of them, and the shortest time of each counts:
nothing makes a computation faster than it is. Median and upper quartile say how far it is to be
trusted.
"""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable, Mapping, Sequence

SINGLE_THREAD = dict.fromkeys(
    ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"), "1"
)
"""Environment in which numpy stays on one core."""

_FEWEST = 3


def best_of_turns(
    works: Mapping[str, Callable[[], object]], seconds: float, most: int = 200
) -> dict[str, float]:
    """Run all in turns and give the shortest time of each, seconds; arguments as in `in_turns`."""
    return {name: min(times) for name, times in in_turns(works, seconds, most).items()}


def spread(times: Sequence[float]) -> list[float]:
    """Shortest, median and upper quartile of what `in_turns` gives of one work."""
    _, middle, upper = statistics.quantiles(times, n=4, method="inclusive")
    return [min(times), middle, upper]


def in_turns(
    works: Mapping[str, Callable[[], object]], seconds: float, most: int = 200
) -> dict[str, list[float]]:
    """Run all in turns and give every time of each, seconds.

    Parameters
    ----------
    works
        What to time, by name.
    seconds
        After how long no new turn begins; at least three are made. A work that has had more than
        its even share of them sits out, so that the quick ones get many turns.
    most
        How many turns at most.
    """
    for work in works.values():
        work()  # caches fill, tables get made
    times: dict[str, list[float]] = {name: [] for name in works}
    spent = dict.fromkeys(works, 0.0)
    share = seconds / len(works)
    end = time.perf_counter() + seconds
    for turn in range(most):
        if turn >= _FEWEST and time.perf_counter() > end:
            break
        for name, work in works.items():
            if turn >= _FEWEST and spent[name] > share:
                continue
            start = time.perf_counter()
            work()
            passed = time.perf_counter() - start
            spent[name] += passed
            times[name].append(passed)
    return times


def load() -> float:
    """Count the processes that wanted a core lately; NaN where the system does not tell."""
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
