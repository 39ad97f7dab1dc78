# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cost without a clock on the wall: in turns of fixed work in the same run, or in calls.

A test that allows seconds fails on a slower machine and passes on a faster one. A pace is what a
fixed piece of plain Python takes on the processor here and now, so a bound in paces holds on both.
"""

import sys
import time
from contextlib import contextmanager
from functools import cache

THERE = 0.018
"""Seconds of a pace on the machine of the manual's tables."""


@cache
def unit():
    """Seconds of the processor that a pace takes: the least of some."""
    return min(_turn() for _ in range(5))


def _turn():
    start = time.process_time()
    total = 0
    for number in range(200_000):
        total += number * number % 7
    return time.process_time() - start


def there(seconds):
    """Give what the machine of the manual's tables would have taken."""
    return seconds * THERE / unit()


@contextmanager
def at_most(paces):
    """Fail if what is inside keeps the processor busy for longer."""
    start = time.process_time()
    yield
    spent = (time.process_time() - start) / unit()
    assert spent <= paces, f"{spent:.0f} paces of {1000 * unit():.0f} ms; {paces} are allowed"


def calls(work):
    """Count the calls of functions, Python's and C's, that some work comes to."""
    counted = 0

    def count(_frame, event, _about):
        nonlocal counted
        counted += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        work()
    finally:
        sys.setprofile(before)
    return counted
