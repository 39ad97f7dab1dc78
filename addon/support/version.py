# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension's version, from the one place it stands in: the manifest."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from ...core.numerics.memoized import memoized


@memoized(maxsize=1)
def version() -> str:
    """Give the version as in "0.1.0"."""
    return str(_manifest()["version"])


def where_to_report() -> str:
    """Give the website or the maintainer that the manifest names."""
    known = _manifest()
    return str(known.get("website") or known["maintainer"])


def website() -> str:
    """Give the address that the manifest names, where the manual is; empty where it names none."""
    return str(_manifest().get("website", ""))


def read_me() -> Path:
    """Give the page that comes with the extension: how it is used, and what it cannot do."""
    return Path(__file__).parents[2] / "README.md"


def _manifest() -> dict[str, Any]:
    path = Path(__file__).parents[2] / "blender_manifest.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))
