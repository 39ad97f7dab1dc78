# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Child processes side by side, whose output reads as if one had run after the other.

The first streams: it writes to our own streams, as it would alone. What the others write is kept
in files; when a step's turn comes, what it has written so far is shown and the rest as it comes.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO

PAUSE = 0.05
"""Seconds between two looks at the children."""
MOMENT, TIDYING, LAST = 2.0, 15.0, 5.0
"""Seconds that children have to end by themselves, after an interrupt, and once terminated."""
LONGEST = 40.0
"""Minutes that a step may take; the longest takes a quarter of that where nothing else runs."""

Say = Callable[[str], None]


@dataclass(frozen=True)
class Step:
    """One child: its name in headers and summary, its command, folder and additional settings.

    One that still runs after so many minutes hangs: it is ended, and has failed.
    """

    name: str
    command: Sequence[str | Path]
    folder: Path
    settings: Mapping[str, str] = field(default_factory=dict)
    minutes: float = LONGEST


@dataclass(frozen=True)
class Result:
    """One line of the summary that closes a run."""

    name: str
    result: str
    seconds: float = 0.0
    failed: bool = False


def cores() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run(steps: Sequence[Step], lanes: int, say: Say) -> list[Result]:
    """Run steps, at most so many at a time, and return what became of them.

    They start in the order given, which is the order of the output and of what is returned too.
    Whatever ends this early, an interrupt above all, ends the children first.

    Parameters
    ----------
    steps
        What to run.
    lanes
        How many at once, at least 1.
    say
        Prints a header before the output of each.
    """
    children: list[_Child] = []

    def start_more(shown: int) -> None:
        while len(children) < len(steps) and sum(not c.ended() for c in children) < lanes:
            number = len(children)
            # Who starts in its own turn needs no file, and knows a terminal when it sees one.
            kept = None if number == shown else Path(folder) / str(number)
            children.append(_Child(steps[number], kept))

    with tempfile.TemporaryDirectory(prefix="rough-spectra-dev-") as folder:
        try:
            for shown, step in enumerate(steps):
                say(f"\n=== {step.name}")
                start_more(shown)
                # Looked at before the output is: what a child wrote at the last is shown, too.
                while not children[shown].ended():
                    children[shown].show()
                    time.sleep(PAUSE)
                    start_more(shown)
                children[shown].show()
        finally:
            _end(children)
            for child in children:
                child.close()
    return [child.result() for child in children]


class _Child:
    """A child that runs or has run."""

    def __init__(self, step: Step, kept: Path | None) -> None:
        self._name = step.name
        self._minutes = step.minutes
        self._start = time.monotonic()
        self._seconds: float | None = None
        self._hung = False
        self._written: IO[bytes] | None = None
        sys.stdout.flush()
        with contextlib.ExitStack() as stack:
            output = None if kept is None else stack.enter_context(kept.open("wb"))
            self.process = subprocess.Popen(
                [str(word) for word in step.command],
                cwd=str(step.folder),
                env={**os.environ, **step.settings},
                stdin=None if kept is None else subprocess.DEVNULL,
                stdout=output,
                stderr=output,
            )
        if kept is not None:
            self._written = kept.open("rb")

    def ended(self) -> bool:
        """Look whether it has ended, and end it where it hangs."""
        if self._seconds is None:
            seconds = time.monotonic() - self._start
            if seconds > 60.0 * self._minutes and self.process.poll() is None:
                self._hung = True
                _abort(self.process)
            if self.process.poll() is not None:
                self._seconds = seconds
        return self._seconds is not None

    def show(self) -> None:
        """Show what it has written since the last time."""
        if self._written is not None:
            shutil.copyfileobj(self._written, sys.stdout.buffer)
            sys.stdout.flush()

    def close(self) -> None:
        """Close the file of its output."""
        if self._written is not None:
            self._written.close()

    def result(self) -> Result:
        """Return its line of the summary."""
        status = self.process.returncode
        result = "ok" if status == 0 else f"FAILED (exit status {status})"
        if self._hung:
            result = f"FAILED (still running after {self._minutes:g} minutes, and ended)"
        return Result(self._name, result, self._seconds or 0.0, status != 0)


def _end(children: Sequence[_Child]) -> None:
    """End those that still run, the harder the longer it takes.

    A terminal sends its Ctrl-C to all of them, so they are given a moment; a second interrupt would
    tear a test run out of its tidying up.
    """
    running = [child.process for child in children if not child.ended()]
    try:
        for ask, patience in ((_wait, MOMENT), (_interrupt, TIDYING), (_terminate, LAST)):
            for process in running:
                if process.poll() is None:
                    ask(process)
            end = time.monotonic() + patience
            while time.monotonic() < end and any(each.poll() is None for each in running):
                time.sleep(PAUSE)
    finally:
        for process in running:
            if process.poll() is None:
                process.kill()
            process.wait()


def _abort(process: subprocess.Popen[bytes]) -> None:
    """End a child that hangs; Python with a fault handler, as in pytest, tells where it was."""
    process.send_signal(signal.SIGTERM if sys.platform == "win32" else signal.SIGABRT)
    try:
        process.wait(LAST)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _wait(_process: subprocess.Popen[bytes]) -> None:
    pass


def _interrupt(process: subprocess.Popen[bytes]) -> None:
    if sys.platform == "win32":
        process.terminate()  # there, a console alone can send an interrupt
    else:
        process.send_signal(signal.SIGINT)


def _terminate(process: subprocess.Popen[bytes]) -> None:
    process.terminate()
