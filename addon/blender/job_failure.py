# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Why a second Blender failed, from its exit status and its log, and what to do about it."""

from __future__ import annotations

import re
import signal

from ...core import errors

_TRACEBACK = "Traceback (most recent call last):"
_FAREWELL = "Blender quit"
"""What Blender says last, whatever happened before."""
_LONGEST = 300
"""Characters of the log that a sentence quotes."""

_NO_MEMORY = re.compile(r"MemoryError|bad_alloc|[MC]alloc returns null|out of memory", re.I)
_NO_ROOM = re.compile(r"No space left on device|disk quota exceeded|is the disk full", re.I)
_NO_PART = re.compile(r"^(ModuleNotFoundError|ImportError)\b")
_NO_LIBRARY = re.compile(r"^LibraryError\b")
_EXCEPTION = re.compile(r"^(?:[A-Za-z_]\w*\.)*([A-Za-z_]\w*(?::.*|$))")
"""First line of an exception as Python prints it: its name, and mostly what it says."""

_LEAST_ROOM = 1 << 20
"""Bytes; a disk with less is full: a picture or a .blend needs more."""
_SHELL_SIGNAL = 128
"""A shell's exit status when a signal ended what it ran is this and the signal's number."""


def reason(log: str) -> str:
    """Quote what says most in a log: its last exception, else its last line.

    Parameters
    ----------
    log
        All that the second Blender printed.

    Returns
    -------
    One line without a line break.
    """
    lines = [line.rstrip() for line in log.splitlines()]
    starts = [number for number, line in enumerate(lines) if line.lstrip() == _TRACEBACK]
    if starts:
        # The frames are indented, and what the exception says may go on for lines.
        after = iter(lines[starts[-1] + 1 :])
        named = next((found for line in after if (found := _EXCEPTION.match(line))), None)
        if named is not None:
            said = named[1]
            if said.endswith(":"):
                said += f" {next((line.strip() for line in after if line.strip()), '')}"
            return said[:_LONGEST]
    said = next((line for line in reversed(lines) if line.strip() not in ("", _FAREWELL)), "")
    return said.strip()[:_LONGEST] or "it said nothing"


def remedy(status: int, said: str, log: str, free: int, smaller: str) -> str | None:
    """Say what to do.

    Parameters
    ----------
    status
        Exit status; negative for the signal that ended it.
    said
        What `reason` quotes.
    log
        All that the second Blender printed.
    free
        Bytes left on the disk with the temporary files.
    smaller
        How to ask for less, such as "measure fewer materials at once".

    Returns
    -------
    A sentence, empty where `said` has it already, or None when the fault is not the user's: then
    it is to be reported.
    """
    ended_by = status - _SHELL_SIGNAL if status > _SHELL_SIGNAL else -status
    killed = ended_by == getattr(signal, "SIGKILL", None)
    if killed or _NO_MEMORY.search(said) or (ended_by > 0 and _NO_MEMORY.search(log)):
        return f"The memory is probably full: close other programs, or {smaller}."
    if _NO_ROOM.search(log) or free < _LEAST_ROOM:
        return "Free the disk, or let TMPDIR name another one."
    if _NO_PART.search(said):
        return (
            "A part is missing: disable the extension and enable it again, which puts its "
            "libraries back."
        )
    if _NO_LIBRARY.search(said):
        return "Mend the link in the Outliner, or make the material local."
    if issubclass(getattr(errors, said.partition(":")[0], object), errors.RoughSpectraError):
        return ""  # such a sentence names the remedy itself
    if ended_by in (signal.SIGTERM, signal.SIGINT):
        return "It was ended from outside; try again."
    return None
