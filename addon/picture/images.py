# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last spectral picture as images of the open file, and what a pixel of them is.

A file has one such picture, and one map of ΔE00 beside it; the next takes their places. They stay
with the file when it is saved. Spectra are on the disk only, as long as the file is open.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import bpy
import numpy as np

from ...core.numerics.arrays import Array
from . import files, through_undo
from .of_file import OfFile
from .picture import SpectralPicture
from .pixel import Pixel
from .through_undo import MARK

PICTURE, MAP = "Spectral", "Spectral ΔE00"
"""Names of the images, unless others are called so."""
_RAMP = np.array(
    (
        (0.0, 0.0, 0.0, 0.0),
        (0.25, 0.25, 0.05, 0.45),
        (0.5, 0.75, 0.15, 0.35),
        (0.75, 1.0, 0.55, 0.1),
        (1.0, 1.0, 1.0, 0.9),
    )
)
"""Shares of the map's top, and their colors on screen: each is lighter than the one before."""


find = through_undo.find
"""Gives our image of a name, such as `MAP`, whatever it is called by now; None without one."""


class Shown(NamedTuple):
    """A picture that is shown.

    Parameters
    ----------
    picture
        With its spectra.
    told
        What was rendered and found, in sentences.
    top
        ΔE00 from which on the map is white; None without one.
    """

    picture: SpectralPicture
    told: tuple[str, ...]
    top: float | None


_held: OfFile[Shown] = OfFile()
"""The last picture."""
_picked: OfFile[Pixel] = OfFile()
"""The pixel of it that was read last, if any was."""


def put(picture: SpectralPicture) -> list[Any]:
    """Put a picture, and its map where it has one, in the places of those before.

    Returns
    -------
    The images, the picture first.
    """
    top = None if picture.comparison is None else _top(picture.comparison.delta_e)
    _picked.forget()
    _held.put(Shown(picture, tuple(files.told(picture)), top))
    shown = [replace(PICTURE, partial(files.image, picture, PICTURE))]
    if picture.comparison is not None and top is not None:
        share = picture.comparison.delta_e / top
        shown.append(replace(MAP, partial(on_screen, share, MAP)))
    for image in bpy.data.images:
        if image.get(MARK) == MAP and image not in shown and image.is_editable:
            del image[MARK]  # of an earlier picture: it stays, as anybody's image
    return shown


def last() -> Shown | None:
    """Give the last picture of the open file, while it is in memory."""
    return _held.get()


def pick(pixel: Pixel) -> None:
    """Remember the pixel that was read, for the panel."""
    _picked.put(pixel)


def picked() -> Pixel | None:
    """Give the pixel that was read last of the last picture."""
    return _picked.get()


def of(image: Any) -> SpectralPicture | None:
    """Give the picture that an image shows, or that its map is of; None of any other image."""
    shown = last()
    if image is None or shown is None or image.get(MARK) not in (PICTURE, MAP):
        return None
    picture = shown.picture
    rows, columns = picture.xyz.shape[:2]
    return picture if tuple(image.size) == (columns, rows) else None


def _top(delta_e: Array) -> float:
    """Give a whole number that most of a map is within."""
    return float(max(math.ceil(np.quantile(delta_e, 0.98)), 1))


def on_screen(share: Array, name: str) -> Any:
    """Make an image of colors on screen, which no view changes, of what is 0 to 1."""
    rows, columns = share.shape
    shown = np.clip(share, 0, 1)
    pixels = np.ones((rows, columns, 4), np.float32)
    for channel in range(3):
        pixels[..., channel] = np.interp(shown, _RAMP[:, 0], _RAMP[:, 1 + channel])
    found = bpy.data.images.new(name, columns, rows)
    found.pixels.foreach_set(pixels.ravel())
    found.update()
    found.pack()
    return found


def replace(name: str, make: Callable[[], Any]) -> Any:
    """Make an image, let it be used wherever the one before was, and make it again after undo."""
    new = make()
    for old in list(bpy.data.images):
        if old.get(MARK) == name and old.is_editable and old != new:
            old.user_remap(new)
            bpy.data.images.remove(old)
    new[MARK] = name
    new.name = name
    new.use_fake_user = True  # it stays with the file though nothing there uses it
    new.use_view_as_render = new.is_float  # the others have colors on screen
    through_undo.keep(new, partial(replace, name, make))
    return new
