# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What terminals and render farms are told: how much is done, how fast, how long it will take."""

from __future__ import annotations

import sys
import time
from typing import TextIO

from ..support.shown_text import heard

_TERMINAL_SECONDS = 0.2
_LOG_SECONDS = 10.0
"""In a log file every line stays, so there are fewer."""
_ENGINE_SECONDS = 2.0

ENGINES = ("openjd",)
"""Whose lines progress can be told in: Open Job Description's, of Deadline Cloud and others."""


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
    count
        How many materials the work is for, which people then read of; None reads of its steps.
    """

    def __init__(self, what: str, stream: TextIO | None = None, count: int | None = None) -> None:
        self._what = what
        self._count = count
        self._stream = stream or sys.stderr
        self._start = time.monotonic()
        self._last = -1e9
        self._told = -1
        self._open = False

    def __enter__(self) -> ProgressLine:
        """Give itself; the line ends with the block."""
        return self

    def __exit__(self, *_why: object) -> None:
        """End the line, whatever happened."""
        self.close()

    def __call__(self, done: int, total: int) -> None:
        """Show the state, unless it was shown a moment ago, or nobody wants to know."""
        said = heard()
        now = time.monotonic()
        if said.engine:
            self._tell_engine(done, total, now, said.share)
            return
        if said.quiet:
            return
        terminal = self._stream.isatty()
        if now - self._last < (_TERMINAL_SECONDS if terminal else _LOG_SECONDS):
            return
        self._last = now
        line = f"{self._what}: {self._state(done, total, now)}"
        if terminal:
            self._stream.write(f"\r\x1b[K{line}")
            self._open = True
        else:
            self._stream.write(line + "\n")
        self._stream.flush()

    def _tell_engine(self, done: int, total: int, now: float, share: tuple[float, float]) -> None:
        """Tell the percentage as Open Job Description asks for, also at the end."""
        if total == 0 or done == self._told:
            return
        if now - self._last < _ENGINE_SECONDS and done < total:
            return
        self._last, self._told = now, done
        begin, end = share
        percent = 100 * (begin + (end - begin) * done / total)
        self._stream.write(f"openjd_progress: {percent:.1f}\n")
        self._stream.write(f"openjd_status: {self._what}: {self._state(done, total, now)}\n")
        self._stream.flush()

    def _state(self, done: int, total: int, now: float) -> str:
        if self._count is None or total == 0:
            return _state(done, total, now - self._start)
        return _state(done * self._count // total, self._count, now - self._start, " materials")

    def close(self) -> None:
        """End the line, so that what follows starts a new one."""
        if self._open:
            self._stream.write("\r\x1b[K")
            self._stream.flush()


def _state(done: int, total: int, seconds: float, things: str = "") -> str:
    if total == 0:
        return "starting Blender"
    if done == 0 or seconds == 0:
        return f"0 of {total}{things}"
    rate = done / seconds
    return f"{done} of {total}{things}, {rate:.1f}/s, {(total - done) / rate:.0f} s left"
