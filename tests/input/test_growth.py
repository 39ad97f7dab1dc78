# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A large file made of a small one takes time and memory in proportion, whatever is repeated.

`tools/checks/growth.py` does the same at 1 MB with all fixtures, and in all its ways.
"""

import pytest
from rough_spectra.addon.samples import readers

from tests import pace
from tools.checks import growth, promises

SIZE = growth.SIZE // 4
SLACK = 3
"""How much slower than promised a reader may be before a test fails, on a machine as fast as the
manual's; anything quadratic is slower by hundreds."""
FIXTURES = [(name, paths) for name, paths in growth.by_reader(readers).items() if paths]
EACH = 12  # of the ways, other ones for each reader
ALWAYS = 3
WEIGHED = 2  # tracing memory makes reading several times slower: of the slowest only


@pytest.mark.parametrize("at", range(len(FIXTURES)), ids=[name for name, _ in FIXTURES])
def test_time_and_memory_follow_the_size(at):
    name, (path, *_) = FIXTURES[at]
    spent = []
    for number, (way, data) in enumerate(growth.grown(path.read_bytes(), SIZE, places=2)):
        if number >= ALWAYS and number % EACH != at % EACH:
            continue
        found = promises.outcome(readers, path, data)
        seconds = pace.there(found.seconds) / SLACK
        faults = promises.faults(name, path, len(data), found._replace(seconds=seconds))
        assert list(faults) == [], way
        spent.append((found.seconds, way, data))
    for _, way, data in sorted(spent)[-WEIGHED:]:
        found = promises.weighed(readers, path, data)
        assert list(promises.faults(name, path, len(data), found)) == [], way


def test_every_reader_is_among_them():
    names = {promises.short(reader) for reader in readers.readers()}
    assert {name for name, _ in FIXTURES} == names


def test_a_hang_and_a_glut_would_be_found():
    """The two faults that this file is for."""
    path = FIXTURES[0][1][0]
    for outcome in (promises.Outcome([], "", 1.1), promises.Outcome([], "", 0.0, 22 * 2**20)):
        assert list(promises.faults("nix", path, 10**6, outcome)) != []
