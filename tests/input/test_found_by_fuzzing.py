# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever once broke a promise of a reader keeps it now: time, memory, messages, samples."""

from pathlib import Path

import pytest
from rough_spectra.addon.samples import readers

from tools.checks import promises

FOUND = Path(__file__).resolve().parents[1] / "fixtures" / "fuzz"
FILES = [path for path in sorted(FOUND.glob("*/*")) if path.is_file()]


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_what_fuzzing_found_breaks_no_promise_again(path):
    data, name = path.read_bytes(), path.parent.name
    assert name in {promises.short(reader) for reader in readers.readers()}
    for look in (promises.outcome, promises.weighed):
        # By the reader it was found with, and by the one that takes it.
        for wanted in (name, ""):
            with promises.confined(path.parent):
                found = look(readers, path, data, wanted)
            assert list(promises.faults(name, path, len(data), found)) == []


def test_the_promises_are_checked_at_all(tmp_path):
    """A file that is opened, a long time, much memory and a bad message do not pass."""
    path = tmp_path / "a.csv"
    with pytest.raises(promises.Strayed, match="opened"), promises.confined(tmp_path):
        FILES[0].read_bytes()
    with pytest.raises(promises.Strayed, match=r"os\.remove"), promises.confined(tmp_path):
        path.unlink()
    (tmp_path / "beside").write_bytes(b"1")
    with promises.confined(tmp_path):
        assert (tmp_path / "beside").read_bytes() == b"1"
    for message in ("no such file", f"{path}: a\nb.", f"{path}: no end", "other.csv: wrong."):
        outcome = promises.Outcome([], message, 0.0)
        assert list(promises.faults("nix", path, 1, outcome)) != []
    slow, heavy = promises.Outcome([], "", 2.0), promises.Outcome([], "", 0.0, 30_000_000)
    for outcome in (slow, heavy):
        assert len(list(promises.faults("nix", path, 10**6, outcome))) == 1
        assert list(promises.faults("nix", path, 3 * 10**6, outcome)) == []
