# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip that users install, built once."""

import sys
from pathlib import Path

import pytest

from tools.environment import package, wheels

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """Path of the zip."""
    folder = tmp_path_factory.mktemp("package")
    python = Path(sys.executable)
    output = folder / "rough_spectra.zip"
    package.build(ROOT, python, wheels.shipped(ROOT, python), folder / "stage", output)
    return output
