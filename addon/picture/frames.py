# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a range of frames, one after the other."""

from __future__ import annotations

import re
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from ...core.errors import DomainError
from ..blender.background_job import Progress
from ..support import journal
from .spectral_file import ENDING as SPECTRAL

_Picture = TypeVar("_Picture")
_RANGE = re.compile(r"(-?\d+)(?:-(-?\d+)(?:x(\d+))?)?")
_MOST = 1_000_000
"""Frames that can be asked for; Blender has as many."""


def numbers(text: str) -> list[int]:
    """Give the frames of a text such as "1-48", "1-48x2" or "7,12-20".

    Raises
    ------
    DomainError
        If it is none.

    Examples
    --------
    >>> numbers("7,10-20x5")
    [7, 10, 15, 20]
    """
    found: dict[int, None] = {}
    for part in text.split(","):
        match = _RANGE.fullmatch(part.strip())
        first, last, step = match.groups() if match else (None, None, None)
        if first is None or step == "0" or abs(int(last or first) - int(first)) >= _MOST:
            msg = f"{text!r} are no frames; write 7, 1-48, 1-48x2 or several with commas."
            raise DomainError(msg)
        end = int(first if last is None else last)
        if end < int(first):
            msg = f"Frames {part.strip()} end before they begin; write the first one first."
            raise DomainError(msg)
        found |= dict.fromkeys(range(int(first), end + 1, int(step or 1)))
    return [*found]


def path_of(path: Path, frame: int) -> Path:
    """Give the path of a frame's file: room.exr becomes room-0007.exr.

    Examples
    --------
    >>> path_of(Path("room.exr"), 7).name, path_of(Path("room.spectral.exr"), 7).name
    ('room-0007.exr', 'room-0007.spectral.exr')
    """
    ending = SPECTRAL if path.name.lower().endswith(SPECTRAL) else path.suffix
    name = path.name[: len(path.name) - len(ending)]
    return path.with_name(f"{name}-{frame:04d}{path.name[len(name) :]}")


def left(frames: Sequence[int], path: Path) -> list[int]:
    """Give the frames whose picture is not there; what is there is whole.

    Raises
    ------
    OutputError
        If the folder cannot be written.
    """
    if path.parent.is_dir():
        journal.finish(path.parent)  # what a killed process has left half renamed
    return [frame for frame in frames if not path_of(path, frame).exists()]


def each(
    scene: Any,
    frames: Sequence[int],
    make: Callable[[Progress], _Picture],
    progress: Progress,
) -> Generator[tuple[int, _Picture], None, None]:
    """Render frames; gives number and picture of each once it is there.

    Memory does not grow with the frames if whoever takes a picture lets it go before the next.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`; its frame is put back at the end.
    frames
        Their numbers.
    make
        Renders the scene as it is, and tells how many of its renders are done.
    progress
        Called with renders done and renders in all frames.
    """
    with _frame_kept(scene):
        for number, frame in enumerate(frames):
            scene.frame_set(frame)

            def told(done: int, total: int, before: int = number) -> None:
                progress(before * total + done, len(frames) * total)

            yield frame, make(told)


@contextmanager
def _frame_kept(scene: Any) -> Iterator[None]:
    before = scene.frame_current, scene.frame_subframe
    try:
        yield
    finally:
        scene.frame_set(before[0], subframe=before[1])
