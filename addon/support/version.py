# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension's version, from the one place it stands in: the manifest."""

from __future__ import annotations

import tomllib
from pathlib import Path

from ...core.numerics.memoized import memoized


@memoized(maxsize=1)
def version() -> str:
    """Give the version as in "0.1.0"."""
    manifest = Path(__file__).parents[2] / "blender_manifest.toml"
    return str(tomllib.loads(manifest.read_text(encoding="utf-8"))["version"])
