# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders of a picture are summed up one by one, and their channels lie on the disk."""

import errno
import tempfile
import tracemalloc

import numpy as np
import pytest
from rough_spectra.addon.picture import render
from rough_spectra.addon.picture.channels import Channels
from rough_spectra.addon.picture.passes import Pass
from rough_spectra.core.errors import OutputError

ROWS, COLUMNS = 60, 100


def left(folder, count):
    """What the worker leaves of so many renders, and what they are."""
    chance = np.random.default_rng(7)
    renders = []
    for number in range(count):
        pixels = chance.random((ROWS, COLUMNS, 4), np.float32)
        np.save(folder / f"pass-{number}.npy", pixels)
        none = np.zeros((0, 3))
        renders.append(Pass(none, none, chance.random((3, 3))))
    return renders


@pytest.mark.parametrize("keep", [False, True])
def test_memory_does_not_grow_with_renders(tmp_path, keep):
    peaks = []
    renders = left(tmp_path, 12)
    for count in (3, 12):
        tracemalloc.start()
        held = render.together(tmp_path.joinpath, renders[:count], keep)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        assert (held[2] is not None) == keep
    assert peaks[1] < 1.05 * peaks[0]


def test_channels_are_those_of_the_renders(tmp_path):
    renders = left(tmp_path, 3)
    alpha, xyz, channels = render.together(tmp_path.joinpath, renders, True)
    files = [np.load(tmp_path / f"pass-{number}.npy") for number in range(3)]
    assert np.array_equal(alpha, files[0][..., 3:])
    truth = sum(
        pixels[..., :3].astype(float) @ each.to_xyz
        for pixels, each in zip(files, renders, strict=True)
    )
    assert xyz == pytest.approx(truth)
    whole = np.concatenate([pixels[..., :3] for pixels in files], axis=-1)
    assert np.array_equal(channels.at(99, 59), whole[59, 99])
    assert np.array_equal(channels.lines(16, 32), whole[16:32])


def test_a_disk_that_is_full_is_told(monkeypatch):
    """There is no disk to fill here: the system's answer alone is put in its place."""

    def full(**_options):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(tempfile, "TemporaryFile", full)
    with pytest.raises(OutputError, match=r"No space left on device.*TMPDIR"):
        Channels(2, 2)
