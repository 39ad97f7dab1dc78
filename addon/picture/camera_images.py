# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What cameras for the infrared saw last, as images of the open file.

A file has one of each; the next takes its place.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from . import files, images
from .infrared import InfraredPicture
from .of_file import OfFile
from .thermal import ThermalPicture

INFRARED, THERMAL = "Infrared", "Thermal"
"""Names of the images, unless others are called so."""
_LEAST_RANGE = 0.5
"""Kelvin from black to white at least: less is noise."""

_near: OfFile[tuple[str, ...]] = OfFile()
_heat: OfFile[tuple[str, ...]] = OfFile()


def put_infrared(picture: InfraredPicture, *, false_color: bool) -> Any:
    """Put what an infrared camera sees in the place of the one before; gives the image."""
    rgb = picture.false_color if false_color else np.stack([picture.gray] * 3, axis=-1)
    pixels = np.concatenate((rgb, picture.alpha[..., np.newaxis]), axis=-1)
    first, last = picture.ends
    told = [f"{first:g} to {last:g} nm: mean {picture.gray.mean():.4g}"]
    told += [f"{name} has no infrared data ({why})" for name, why in picture.assumed.items()]
    told += [f"{name} is dark: {why}" for name, why in picture.dark.items()]
    _near.put(tuple(told))
    return images.replace(INFRARED, partial(files.image_of, pixels, INFRARED))


def put_thermal(picture: ThermalPicture) -> Any:
    """Put what a thermal camera sees in the place of the one before; gives the image, a map."""
    kelvin = picture.kelvin
    low, high = float(kelvin.min()), float(kelvin.max())
    first, last = picture.band
    told = [
        f"{first:g} to {last:g} nm: black is {low:.2f} K, white "
        f"{max(high, low + _LEAST_RANGE):.2f} K; mean {kelvin.mean():.2f} K"
    ]
    told += [f"{name} has no infrared data" for name in picture.assumed]
    _heat.put(tuple(told))
    share = (kelvin - low) / max(high - low, _LEAST_RANGE)
    return images.replace(THERMAL, partial(images.on_screen, share, THERMAL))


def told(name: str) -> tuple[str, ...]:
    """Say in sentences what is in the image of this name, `INFRARED` or `THERMAL`."""
    return (_near if name == INFRARED else _heat).get() or ()
