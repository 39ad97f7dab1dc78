# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of samples as icons in a list: small balls with color, roughness and gloss.

Made when the list opens, and not while drawing. Nothing is read or solved for them: a list of
thousands opens at once.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import bpy

from ...core.numerics import memoized
from . import icons, theme
from .kept import Kept

if TYPE_CHECKING:
    from ...core.gloss import Gloss
    from ...core.numerics.arrays import Array

_SIDE = 16
"""Pixels of an icon in a list, at interface scale 1."""
_BOUND = 4096
"""Balls kept."""
_TOGETHER = 256
"""Balls drawn in one go: some 30 MB."""
_GRAY = (0.5, 0.5, 0.5)

_SIGMA = (0.0, 5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0)
_ROUGHNESS = (0.0, 0.024, 0.092, 0.187, 0.281, 0.446, 0.875, 1.0)
"""What a gray that reads 0.3 is matched with (`matching.solve`) at each σ in degrees."""


class Pictured(NamedTuple):
    """What of a sample a small ball shows.

    Parameters
    ----------
    color
        Of the reading, display-encoded sRGB; None where it has none, which is gray.
    sigma_degrees
        Roughness.
    gloss
        What lies over it, or None.
    """

    color: tuple[float, float, float] | None
    sigma_degrees: float
    gloss: Gloss | None = None


class _Key(NamedTuple):
    """A ball as it is drawn: what looks alike shares an icon."""

    color: tuple[int, int, int]
    sigma: int
    gloss: Gloss | None
    side: int


_balls: OrderedDict[_Key, str] = OrderedDict()


def icon_ids(pictured: Sequence[Pictured]) -> list[int]:
    """Give an icon for each sample; not to be called while drawing."""
    side = round(_SIDE * theme.scale(bpy.context.preferences))
    keys = [_key(each, side) for each in pictured]
    alike: dict[tuple[int, Gloss | None], list[_Key]] = {}
    for key in dict.fromkeys(keys):
        if key not in _balls:
            alike.setdefault((key.sigma, key.gloss), []).append(key)
    for found in alike.values():
        for start in range(0, len(found), _TOGETHER):
            _make(found[start : start + _TOGETHER])
    for key in keys:
        _balls.move_to_end(key)
    while len(_balls) > max(_BOUND, len(set(keys))):
        _, name = _balls.popitem(last=False)
        _kept.forget(name)
    return [_kept.icon_id(_balls[key]) for key in keys]


def _key(pictured: Pictured, side: int) -> _Key:
    red, green, blue = (round(255 * min(max(share, 0.0), 1.0)) for share in pictured.color or _GRAY)
    return _Key((red, green, blue), round(pictured.sigma_degrees), pictured.gloss, side)


def _make(keys: Sequence[_Key]) -> None:
    """Draw balls that differ in color alone."""
    import numpy as np

    _, sigma, gloss, side = keys[0]
    canvases = drawn(np.array([key.color for key in keys]) / 255, sigma, gloss, side)
    for key, canvas in zip(keys, canvases, strict=True):
        name = _balls[key] = f"sample-{hash(key)}"
        icons.upload(_kept.get(name), canvas, small=True)


def drawn(colors: Array, sigma_degrees: float, gloss: Gloss | None, side: int) -> Array:
    """Draw balls as canvases (balls, side, side, 4).

    Parameters
    ----------
    colors
        Of the readings, (balls, 3), display-encoded sRGB.
    sigma_degrees, gloss
        As of `Pictured`.
    side
        Pixels.
    """
    import numpy as np

    from ...core import cycles
    from ..colorimetry import srgb
    from . import figures

    roughness = float(np.interp(sigma_degrees, _SIGMA, _ROUGHNESS))
    below = np.clip(cycles.color_for_reading(srgb.decode(colors), roughness), 0.0, 1.0)
    return figures.balls(side, below, roughness, np.eye(3), gloss)


def clear() -> None:
    """Forget all balls."""
    _balls.clear()
    _kept.close()


_kept = Kept(clear)
memoized.enlist(__name__, "_balls", _balls.__len__, clear)
