# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One second Blender does job after job, and nobody can tell by what it leaves."""

from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.blender import colors, second_blender
from rough_spectra.addon.instrument import adjustment
from rough_spectra.addon.instrument.measure import RING_45_0, Geometry, Measurement, measure
from rough_spectra.core.errors import OwnFaultError


@pytest.fixture(autouse=True)
def unkept(monkeypatch):
    """As outside of these tests, which keep one from the first to the last."""
    monkeypatch.setattr(second_blender, "_keepers", 0)
    monkeypatch.setattr(second_blender, "_last", None)


@pytest.fixture
def started(monkeypatch):
    """The processes that were started."""
    found, opened = [], second_blender._open

    def noted(*args):
        found.append(opened(*args))
        return found[-1]

    monkeypatch.setattr(second_blender, "_open", noted)
    return found


def test_jobs_in_a_row_share_one_and_read_the_same(make_material, started):
    materials = [make_material("A", Color=(0.3, 0.5, 0.1, 1)), make_material("B", Roughness=0.7)]
    alone = measure(materials)
    assert [process.poll() for process in started] == [0]
    with second_blender.kept():
        with second_blender.kept():
            np.testing.assert_array_equal(measure(materials), alone)
        np.testing.assert_array_equal(measure(materials[1:]), alone[:, 1:])
        np.testing.assert_array_equal(measure(materials[::-1]), alone[:, ::-1])
        assert [process.poll() for process in started] == [0, None]
    assert [process.poll() for process in started] == [0, 0]


def test_what_fails_or_is_stopped_ends_it_and_the_next_job_has_another(
    make_material, started, monkeypatch
):
    material = make_material()
    with second_blender.kept():
        with pytest.raises(OwnFaultError, match="status 1") as failed:
            measure([material], [Geometry((("not an angle", 0.0),), 0.0)])
        assert started[0].poll() == 1
        stopped = Measurement([material], [RING_45_0] * 500)
        stopped.close()
        assert started[1].poll() not in (None, 0)
        reading = measure([material])
        stopped.close()  # once more, where another job may be at work
        monkeypatch.setenv("ROUGH_SPECTRA_TEST", "other settings")
        np.testing.assert_array_equal(measure([material]), reading)
        assert [process.poll() for process in started[2:]] == [0, None]
        started[3].kill()
        started[3].wait()
        np.testing.assert_array_equal(measure([material]), reading)
    assert len(started) == 5
    assert all(process.poll() is not None for process in started)
    Path(str(failed.value).partition("please report it with ")[2].rstrip(".")).unlink()


def test_jobs_side_by_side_have_one_each(make_material, started):
    material = make_material()
    with second_blender.kept():
        jobs = [Measurement([material], [RING_45_0]) for _ in range(2)]
        for job in jobs:
            job.wait()
        readings = [job.result() for job in jobs]
        for job in jobs:
            job.close()
    np.testing.assert_array_equal(*readings)
    assert len(started) == 2
    assert all(process.poll() is not None for process in started)


def test_a_search_measures_in_one(make_material, nix, request_for, started):
    material = make_material("Mix", Color=(0.2, 0.3, 0.4, 1))
    request = request_for(next(iter(nix.values())))
    search = adjustment.Adjustment(material, request, colors.places(material)[0])
    try:
        search.wait()
        assert search.done > 1
        assert started[0].poll() is None
    finally:
        search.close()
    assert [process.poll() for process in started] == [0]
