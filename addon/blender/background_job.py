# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a job in a second Blender, so that this one stays free and its file untouched.

The job is a JSON file in a temporary folder of its own. The worker, a script, leaves its results
beside it and tells its progress there; see `instrument/worker.py` for what it owes this side.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import IO, Any, ClassVar, Protocol, TypeVar

import bpy

from ...core.errors import CancelledError, OutputError, OwnFaultError, RoughSpectraError
from ..support import events, file_lock
from . import job_failure, second_blender

Progress = Callable[[int, int], None]
"""Is told how much is done, and of how much."""

_POLL_SECONDS = 0.05
_PREFIX = "rough-spectra-"
_HELD = "held"
"""File in the folder of a job, locked for as long as the process lives that asked for it."""
_SAYS_A_RATE = 0.05
"""Share done from which on the time left is told."""


class Waitable(Protocol):
    """What runs beside us: a job, or several one after the other."""

    def wait(self, progress: Progress | None = None) -> None:
        """Wait for the end."""

    def close(self) -> None:
        """Stop what still runs, and leave nothing behind."""


_Waited = TypeVar("_Waited", bound=Waitable)


@contextmanager
def waited(job: _Waited, progress: Progress | None = None) -> Iterator[_Waited]:
    """Wait for a job's end, let its result be used, and close it, whatever happens.

    Raises
    ------
    CancelledError
        On an interrupt from the keyboard.
    """
    try:
        job.wait(progress)
        yield job
    finally:
        job.close()


class Job:
    """A job under way in a second Blender.

    Parameters
    ----------
    worker
        The script that does it.
    prepare
        Puts what the worker needs into the job's folder and gives what the job says.

    Raises
    ------
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    doing: ClassVar[str]
    """What the second Blender does, as in "measures"."""
    interrupted: ClassVar[str]
    """Sentence for an interrupt from the keyboard."""
    smaller: ClassVar[str]
    """How to ask for less when the memory is full, as in "measure fewer materials at once"."""

    def __init__(self, worker: Path, prepare: Callable[[Path], dict[str, Any]]) -> None:
        self._folder: Path | None = None
        self._held: IO[bytes] | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._is_at_work = False
        self._traces = ExitStack()
        self.total = 0
        self.done = 0
        self.share = 0.0
        self._started = time.monotonic()
        try:
            with ExitStack() as undone:
                undone.callback(self.close)
                # Switching the extension off, or quitting Blender, ends what runs.
                events.unregistering.subscribe(self.close)
                sweep(Path(tempfile.gettempdir()))
                self._folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
                self._held = _hold(self._folder)
                scene = bpy.context.scene
                frame = (scene.frame_current, scene.frame_subframe)
                job = {"asked_by": os.getpid(), "frame": frame, **prepare(self._folder)}
                self._start(self._folder, worker, job)
                undone.pop_all()
        except (OSError, RuntimeError) as error:
            # Blender says "Error: Success" when the disk is full.
            reason = getattr(error, "strerror", None) or "is the disk full?"
            msg = (
                f"Temporary files cannot be written in {tempfile.gettempdir()} ({reason}); free "
                "the disk, or let TMPDIR name another one."
            )
            raise OutputError(msg) from error

    def poll(self) -> bool:
        """Update `done`, `total` and `share`; returns whether the job has ended.

        `share` of 0 to 1 is done, parts of a step as well where the worker tells them.
        """
        assert self._process is not None
        assert self._folder is not None
        ended = self._process.poll() is not None or self._is_done()
        try:
            done, total = (self._folder / "progress").read_text(encoding="ascii").split()
            self.done, self.total = int(float(done)), int(total)
            self.share = float(done) / max(self.total, 1)
        except FileNotFoundError:
            pass  # the other Blender is still starting
        return ended

    @property
    def left(self) -> float | None:
        """Seconds until the end, at the rate of so far; None while that is a guess."""
        if self.share < _SAYS_A_RATE:
            return None
        return (time.monotonic() - self._started) * (1 - self.share) / self.share

    def wait(self, progress: Progress | None = None) -> None:
        """Wait for the end.

        Raises
        ------
        CancelledError
            On an interrupt from the keyboard.
        """
        try:
            while not self.poll():
                if progress is not None:
                    progress(self.done, self.total)
                time.sleep(_POLL_SECONDS)
            if progress is not None:
                progress(self.done, self.total)  # what was done since, or nobody hears of the end
        except KeyboardInterrupt as error:
            raise CancelledError(self.interrupted) from error

    def output(self, name: str) -> Path:
        """Give the path of a file that the worker left, once `poll` says that it has ended.

        Raises
        ------
        OutputError
            If the second Blender failed.
        OwnFaultError
            If what failed there is a fault of ours.
        """
        assert self._process is not None
        assert self._folder is not None
        path = self._folder / name
        ended_well = self._process.returncode == 0 or self._is_done()
        if not ended_well or not path.exists():
            raise self._failure(self._folder, self._process.returncode or 0)
        return path

    def when_closed(self, act: Callable[[], None]) -> None:
        """Call a function once the job is closed, whoever closes it."""
        self._traces.callback(act)

    def close(self) -> None:
        """Stop the second Blender if it still works, and remove its files and all other traces."""
        if self._is_at_work and self._process is not None:
            second_blender.give_back(self._process, self._is_done())
            self._is_at_work = False  # by now it may be at work for another
        if self._held is not None:
            self._held.close()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
        events.unregistering.unsubscribe(self.close)
        self._traces.close()

    def _is_done(self) -> bool:
        """Whether a Blender that is kept has done it; any other one ends."""
        return self._folder is not None and (self._folder / second_blender.DONE).exists()

    def _failure(self, folder: Path, status: int) -> RoughSpectraError:
        """Say what became of the second Blender, and what to do."""
        log = (folder / "log").read_text(encoding="utf-8", errors="replace")
        said = job_failure.reason(log)
        free = shutil.disk_usage(folder).free
        remedy = job_failure.remedy(status, said, log, free, self.smaller)
        told = (
            f"The Blender that {self.doing} stopped with status {status} ({said}); nothing was "
            "written."
        )
        if remedy is not None:
            return OutputError(f"{told} {remedy}".rstrip())
        kept = folder.with_name(f"{folder.name}.log")
        shutil.copyfile(folder / "log", kept)
        return OwnFaultError(f"{told} This is no fault of yours: please report it with {kept}.")

    def _start(self, folder: Path, worker: Path, job: dict[str, Any]) -> None:
        job_path = folder / "job.json"
        job_path.write_text(json.dumps(job), encoding="utf-8")
        self._process = second_blender.start(worker, job_path)
        self._is_at_work = True


def sweep(temporary: Path) -> None:
    """Remove the folders of jobs whose process was killed, and its second Blender with it.

    Parameters
    ----------
    temporary
        Where they are. Folders of other users, and those that cannot be removed, stay.
    """
    for folder in temporary.glob(f"{_PREFIX}*"):
        try:
            is_mine = not hasattr(os, "getuid") or folder.stat().st_uid == os.getuid()
            if is_mine and file_lock.is_left(folder / _HELD):
                shutil.rmtree(folder, ignore_errors=True)
        except OSError:
            continue  # not a job's, or gone by now


def _hold(folder: Path) -> IO[bytes]:
    """Lock the file by which others tell that a job is alive."""
    # It has its name only once it is locked, but for Windows, which renames no open file.
    named = folder / _HELD
    making = named if os.name == "nt" else named.with_suffix(".new")
    held = making.open("wb")
    file_lock.hold(held, 0)
    if making != named:
        making.rename(named)
    return held
