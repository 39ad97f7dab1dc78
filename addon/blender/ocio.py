# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the OCIO configuration tells Blender of its color spaces; read once, as Blender does."""

from __future__ import annotations

import os

from ...core.errors import InputError
from ...core.numerics.memoized import memoized
from ..support import user_files

_ROLE = "aces_interchange"
"""With this role Blender knows a space's XYZ. Without it takes scene linear for Rec.709."""


@memoized(maxsize=1)
def warning() -> str:
    """Say that Blender only assumes Rec.709, because a custom configuration does not tell."""
    path = os.environ.get("OCIO", "")  # Blender sets it to its own configuration, or leaves it
    if not path:
        return ""
    try:
        text = user_files.read(path).decode(errors="replace")
    except InputError:
        return ""
    if _ROLE in text:
        return ""
    return (
        f"{path}: the OCIO configuration has no role {_ROLE}, so Blender takes scene "
        "linear for Rec.709; add the role, or expect wrong colors in another space."
    )
