# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whoever waits for a job in the background leaves none behind."""

import pytest
from rough_spectra.addon.blender import background_job


class Counting:
    """What can be waited for, and fails on the way if it is to."""

    def __init__(self, fault=None):
        self.fault, self.closed, self.told = fault, 0, []

    def wait(self, progress=None):
        if progress is not None:
            progress(1, 2)
        if self.fault is not None:
            raise self.fault

    def close(self):
        self.closed += 1


def test_it_is_open_while_its_result_is_used_and_closed_after():
    job, told = Counting(), []
    with background_job.waited(job, lambda *numbers: told.append(numbers)) as found:
        assert found is job
        assert job.closed == 0
    assert job.closed == 1
    assert told == [(1, 2)]


@pytest.mark.parametrize("fault", [KeyboardInterrupt, OSError])
def test_it_is_closed_where_waiting_ends_in_a_fault(fault):
    job = Counting(fault())
    with pytest.raises(fault), background_job.waited(job):
        pytest.fail("there is no result to use")
    assert job.closed == 1


def test_it_is_closed_where_its_result_cannot_be_used():
    job = Counting()
    with pytest.raises(ValueError, match="odd"), background_job.waited(job):
        raise ValueError("odd")
    assert job.closed == 1
