# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball of a material under one light, as Cycles shades it: what its roughness looks like."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....core import cycles
from ....core.cycles import gloss_lobe
from ....core.gloss import Gloss
from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized
from ...colorimetry import srgb
from ..drawing import raster

_LIGHT = (-0.26, 0.3, 0.92)
"""Where the light is: behind the viewer, a little to the left and above: what roughness changes
most is how bright a ball stays toward its edge."""
_LAMP = 0.06
"""Width of the light, as slopes of facets, which a lobe gets wider by (GGX's alpha). Without one it
would not show in what is polished: the ball would look as dull at Gloss 1 as at 0."""
_FINER = 4
"""Points along each side of a pixel that its share of the disk is counted from."""
_FINEST = 96
"""Pixels of a side up to which each is shaded; of more, every second one: a slider is dragged."""


class _Ball(NamedTuple):
    """What of a ball depends on its size alone.

    Parameters
    ----------
    step
        Pixels that are shaded as one, in both directions.
    lit
        Which of these the light reaches, bool.
    directions, glossy
        What the diffuse lobe and gloss want of light and view there, each (lit,).
    cosine
        Of the light's angle, (lit, 1).
    coverage
        Each pixel's share of the disk, (side, side).
    """

    step: int
    lit: Array
    directions: tuple[Array, ...]
    glossy: gloss_lobe.Directions
    cosine: Array
    coverage: Array


def ball(
    side: int, color: Array, roughness: float, to_screen: Array, gloss: Gloss | None = None
) -> Array:
    """Draw a ball that fills a square.

    Parameters
    ----------
    side
        Pixels.
    color, roughness
        Of the diffuse lobe: scene-linear RGB, shape (3,), and Cycles' diffuse roughness.
    to_screen
        Matrix from scene-linear RGB to linear sRGB, (3, 3).
    gloss
        What lies over it.

    Returns
    -------
    A canvas, transparent around the ball.
    """
    return np.asarray(balls(side, color[np.newaxis], roughness, to_screen, gloss)[0])


def balls(
    side: int, colors: Array, roughness: float, to_screen: Array, gloss: Gloss | None = None
) -> Array:
    """Draw balls that differ in color alone, (balls, 3): canvases (balls, side, side, 4).

    Other parameters as with `ball`.
    """
    seen = _of_size(side)
    terms = cycles.lobe(np.asarray(roughness, float), *seen.directions)
    shown = cycles.reflected(colors[:, np.newaxis], terms)
    if gloss is not None:
        shown = gloss_lobe.in_directions(_of_lamp(gloss), seen.glossy).over(shown)
    image = np.ones((len(colors), *seen.lit.shape, 4), np.float32)
    image[..., :3] = 0
    image[:, seen.lit, :3] = np.clip(srgb.encode(shown * seen.cosine @ to_screen.T), 0, 1)
    if seen.step > 1:
        image = image.repeat(seen.step, axis=1).repeat(seen.step, axis=2)[:, :side, :side]
    return raster.encoded(image * seen.coverage[..., np.newaxis])


def _of_lamp(gloss: Gloss) -> Gloss:
    """Give the gloss whose lobe has the width that this one's has under the light."""
    return gloss._replace(
        roughness=_wider(gloss.roughness), coat_roughness=_wider(gloss.coat_roughness)
    )


def _wider(roughness: float) -> float:
    return float(min((max(roughness, 0.0) ** 4 + _LAMP**2) ** 0.25, 1.0))


@memoized(maxsize=8)
def _of_size(side: int) -> _Ball:
    step = 1 if side <= _FINEST else 2
    x, y = _places(side, step)
    height = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    light = np.array(_LIGHT) / np.linalg.norm(_LIGHT)
    toward = np.clip(x * light[0] + y * light[1] + height * light[2], -1, 1)
    lit = (height > 0) & (toward > 0)
    toward, height = toward[lit], height[lit]
    across = np.sqrt((1 - toward**2) * (1 - height**2))
    turn = (light[2] - toward * height) / np.maximum(across, 1e-9)
    angles = np.arccos(toward), np.arccos(height), np.arccos(np.clip(turn, -1, 1))
    fine_x, fine_y = _places(side * _FINER, 1)
    inside = fine_x**2 + fine_y**2 < 1
    coverage: Array = inside.reshape(side, _FINER, side, _FINER).mean(axis=(1, 3), dtype=np.float32)
    wanted = cycles.directions(*angles), gloss_lobe.directions(*angles)
    return _Ball(step, lit, *wanted, toward[:, np.newaxis], coverage)


def _places(side: int, step: int) -> tuple[Array, Array]:
    """Give the middles of pixels, each as wide as `step`: from -1 to 1, x to the right and y up."""
    at = np.arange(step / 2, side + step / 2, step) / side * 2 - 1
    x, y = np.meshgrid(at, -at)
    return x, y
