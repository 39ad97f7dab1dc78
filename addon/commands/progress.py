# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What terminals are told: how much is done, how fast, how long it will take."""

from __future__ import annotations

import sys
import time
from typing import TextIO

from ..support.shown_text import is_quiet

_TERMINAL_SECONDS = 0.2
_LOG_SECONDS = 10.0
"""In a log file every line stays, so there are fewer."""


def counted(count: int, thing: str) -> str:
    """Say how many of a thing there are: "1 reading", "2 readings"."""
    return f"{count} {thing}" if count == 1 else f"{count} {thing}s"


class ProgressLine:
    """Callable `progress(done, total)` that keeps one line on a terminal up to date.

    Parameters
    ----------
    what
        What is under way, as in "measuring".
    stream
        Where to write; standard error if not given, since results may go to standard output.
    """

    def __init__(self, what: str, stream: TextIO | None = None) -> None:
        self._what = what
        self._stream = stream or sys.stderr
        self._start = time.monotonic()
        self._last = -1e9
        self._open = False

    def __call__(self, done: int, total: int) -> None:
        """Show the state, unless it was shown a moment ago, or nobody wants to know."""
        if is_quiet():
            return
        now = time.monotonic()
        terminal = self._stream.isatty()
        if now - self._last < (_TERMINAL_SECONDS if terminal else _LOG_SECONDS):
            return
        self._last = now
        line = f"{self._what}: {_state(done, total, now - self._start)}"
        if terminal:
            self._stream.write(f"\r\x1b[K{line}")
            self._open = True
        else:
            self._stream.write(line + "\n")
        self._stream.flush()

    def close(self) -> None:
        """End the line, so that what follows starts a new one."""
        if self._open:
            self._stream.write("\r\x1b[K")
            self._stream.flush()


def _state(done: int, total: int, seconds: float) -> str:
    if total == 0:
        return "starting Blender"
    if done == 0 or seconds == 0:
        return f"0 of {total}"
    rate = done / seconds
    return f"{done} of {total}, {rate:.1f}/s, {(total - done) / rate:.0f} s left"
