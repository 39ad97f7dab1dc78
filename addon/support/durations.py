# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How long something takes, in words."""

from __future__ import annotations


def words(seconds: float) -> str:
    """Say a time as exactly as somebody wants to know it who waits.

    Examples
    --------
    >>> [words(seconds) for seconds in (0.2, 42.4, 120.0, 9000.0)]
    ['less than 1 s', '42 s', '2 min', '2.5 h']
    """
    if seconds < 0.5:
        return "less than 1 s"
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
