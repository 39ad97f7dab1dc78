# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What verbs share that render pictures: one of a scene as it is, or those of a range of frames."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from ...core.errors import InputError
from ..support.shown_text import tell
from .progress import ProgressLine, counted
from .result import add
from .work_list import share

if TYPE_CHECKING:
    from ..blender.background_job import Progress

_Picture = TypeVar("_Picture")
PathOf = Callable[[Path], Path]
"""Gives the path of a frame's file, from that without its number."""


class Made(NamedTuple, Generic[_Picture]):
    """A picture that was rendered and written.

    Parameters
    ----------
    frame
        Its number; None of a scene as it is.
    picture
        What was rendered.
    files
        What was written.
    """

    frame: int | None
    picture: _Picture
    files: list[Path]

    @property
    def words(self) -> str:
        """Name the frame, in front of what is told of it; empty without one."""
        return "" if self.frame is None else f"frame {self.frame}: "

    @property
    def names(self) -> str:
        """Say what was written."""
        return ", ".join(path.name for path in self.files)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare --frames, --shard and --skip-done."""
    parser.add_argument(
        "--frames",
        metavar="A-B",
        help="these frames, such as 1-48, 1-48x2 for every second one, or 7,12-20; their numbers "
        "go into the names of the files: room-0007.exr",
    )
    parser.add_argument(
        "--shard",
        type=share,
        default=(1, 1),
        metavar="I/N",
        help="only every N-th of the frames, from the I-th on",
    )
    parser.add_argument(
        "--skip-done",
        action="store_true",
        help="leave out frames whose picture is there; a file that is there is whole",
    )


def pictures(
    options: argparse.Namespace,
    scene: Any,
    make: Callable[[Progress], _Picture],
    write: Callable[[_Picture, PathOf], list[Path]],
) -> Iterator[Made[_Picture]]:
    """Render and write what is asked for, one after the other; each is let go before the next.

    Parameters
    ----------
    options
        With those of `add_arguments`, and `output`.
    scene
        A `bpy.types.Scene`.
    make
        Renders the scene as it is, and tells how far it is.
    write
        Writes a picture, and gives the files.

    Raises
    ------
    InputError, DomainError
        If the frames are none, or there is a share of none.
    """
    from ..picture import frames

    if options.frames is None:
        if options.shard != (1, 1) or options.skip_done:
            raise InputError("--shard and --skip-done are for --frames; name the frames.")
        with ProgressLine("rendering") as progress:
            picture = make(progress)
        yield Made(None, picture, write(picture, lambda path: path))
        return
    index, count = options.shard
    mine = frames.numbers(options.frames)[index - 1 :: count]
    rest = frames.left(mine, options.output) if options.skip_done else mine
    if len(rest) < len(mine):
        tell(f"{counted(len(mine) - len(rest), 'frame')} done before")
    add(options, done_before=len(mine) - len(rest))
    # Closed in any case: then the scene's frame is put back.
    with (
        ProgressLine("rendering") as progress,
        closing(frames.each(scene, rest, make, progress)) as made,
    ):
        for frame, picture in made:
            progress.close()
            yield Made(frame, picture, write(picture, partial(_numbered, frame)))
            del picture


def _numbered(frame: int, path: Path) -> Path:
    from ..picture import frames

    return frames.path_of(path, frame)
