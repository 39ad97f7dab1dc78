# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The measures that other tests hold cost to can fail."""

import sys
import time

import pytest

from tests import pace


def work(turns):
    for _ in range(turns):
        pace._turn()


def test_what_takes_more_paces_than_allowed_fails():
    with pace.at_most(30):
        work(2)
    with pytest.raises(AssertionError, match=r"\d paces of \d+ ms; 2 are allowed"), pace.at_most(2):
        work(6)


def test_waiting_costs_nothing():
    with pace.at_most(1):
        time.sleep(4 * pace.unit())


def test_a_pace_takes_on_the_other_machine_what_is_written_down():
    assert pace.there(3 * pace.unit()) == pytest.approx(3 * pace.THERE)


def test_calls_are_counted_and_the_profiler_is_put_back():
    before = sys.getprofile()
    numbers = list(range(10))

    def ten():
        for number in numbers:
            abs(number)

    few, many = pace.calls(ten), pace.calls(lambda: [ten() for _ in range(3)])
    assert few < many
    assert 11 <= few < 20
    assert 33 <= many < 50
    assert sys.getprofile() is before
