# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A house to break."""

import shutil

import pytest

from tests.architecture import house


@pytest.fixture
def broken(tmp_path):
    """A copy of the house in which a line is added to a file."""

    def add(path, line):
        for top in ("core", "addon"):
            ignored = shutil.ignore_patterns("__pycache__")
            shutil.copytree(house.ROOT / top, tmp_path / top, ignore=ignored)
        with (tmp_path / path).open("a", encoding="utf-8") as file:
            file.write(f"\n{line}\n")
        return tmp_path

    return add
