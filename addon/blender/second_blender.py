# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The process of a second Blender: one for each job, or one that is kept for job after job.

A Blender starts in a second or more, and most jobs take less. Where one follows the other, as in a
search that measures again and again, whoever runs them says so (`kept`): the next job then goes to
the Blender that has done the last one.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import bpy

from ..support import events

DONE = "done"
"""File that a Blender which is kept leaves in the folder of a job that it has done."""
_TAKES_JOBS = Path(__file__).with_name("job_taker.py")
_PATIENCE_SECONDS = 5.0
"""How long a Blender that was asked to end may take before it is killed."""


@dataclass
class _Kept:
    """A Blender that takes jobs, and what it was started with."""

    process: subprocess.Popen[bytes]
    command: list[str]
    settings: dict[str, str]
    is_at_work: bool = True


_keepers = 0
_last: _Kept | None = None


@contextlib.contextmanager
def kept() -> Iterator[None]:
    """Give jobs that follow each other to one Blender, until this ends."""
    global _keepers
    _keepers += 1
    try:
        yield
    finally:
        _keepers -= 1
        if not _keepers:
            _dismiss()


def start(worker: Path, job: Path) -> subprocess.Popen[bytes]:
    """Have a Blender do a job; gives its process.

    Parameters
    ----------
    worker
        The script that does it.
    job
        What it does, a JSON file. Beside it is written what the Blender says, as `log`, and `DONE`
        where the Blender goes on after the job.

    Raises
    ------
    OSError
        If a Blender cannot be started.
    """
    settings = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}
    if not _keepers:
        return _open([*_blender(worker), str(job)], settings, job, subprocess.DEVNULL)
    command = _blender(_TAKES_JOBS)
    if _last is not None and _takes(_last, command, settings, [str(worker), str(job)]):
        return _last.process
    return _keep(command, settings, worker, job)


def give_back(process: subprocess.Popen[bytes], is_done: bool) -> None:
    """Let go of the process of a job: stop it, unless it is kept and the job is done."""
    last = _last if _last is not None and _last.process is process else None
    if last is not None and is_done:
        last.is_at_work = False
        return
    if process.poll() is None:
        process.terminate()
        _see_to_the_end(process)
    _close(process)
    if last is not None:
        _dismiss()


def _keep(
    command: list[str], settings: dict[str, str], worker: Path, job: Path
) -> subprocess.Popen[bytes]:
    """Start a Blender that takes jobs after this one, too, in place of the one before."""
    global _last
    words = [*command, str(worker), str(job)]
    process = _open(words, settings, job, subprocess.PIPE)
    if _last is None or not _last.is_at_work:
        _dismiss()
        _last = _Kept(process, command, settings)
        # Switching the extension off, or quitting Blender, ends it.
        events.unregistering.subscribe(_dismiss)
    return process


def _takes(last: _Kept, command: list[str], settings: dict[str, str], job: list[str]) -> bool:
    """Give a job to the Blender that is kept, if it is free and as one would be started now."""
    if last.is_at_work or last.process.poll() is not None:
        return False
    if (last.command, last.settings) != (command, settings):
        return False
    assert last.process.stdin is not None
    try:
        last.process.stdin.write(json.dumps(job).encode() + b"\n")
        last.process.stdin.flush()
    except OSError:  # it has just ended
        return False
    last.is_at_work = True
    return True


def _dismiss() -> None:
    """Let the Blender that is kept end; one at work is no longer kept, and its job ends it."""
    global _last
    last, _last = _last, None
    if last is None:
        return
    events.unregistering.unsubscribe(_dismiss)
    if not last.is_at_work:
        _close(last.process)
        _see_to_the_end(last.process)


def _close(process: subprocess.Popen[bytes]) -> None:
    """Let a process know that no more jobs come."""
    if process.stdin is not None:
        with contextlib.suppress(OSError):
            process.stdin.close()


def _open(
    words: list[str], settings: dict[str, str], job: Path, stdin: int
) -> subprocess.Popen[bytes]:
    with job.with_name("log").open("wb") as log:
        return subprocess.Popen(
            words, stdin=stdin, stdout=log, stderr=subprocess.STDOUT, env=settings
        )


def _see_to_the_end(process: subprocess.Popen[bytes]) -> None:
    try:
        process.wait(_PATIENCE_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _blender(script: Path) -> list[str]:
    """Command that runs a script, in Blender's executable or in Python with the bpy module."""
    if bpy.app.binary_path:
        options = ["--background", "--factory-startup", "--python-exit-code", "1"]
        return [bpy.app.binary_path, *options, "--python", str(script), "--"]
    return [sys.executable, "-P", str(script)]
