# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What lamps send, and pictures with other lamps without rendering."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping

import bpy

from ...core.errors import MaterialError
from ...core.limits import TOLERANCE
from ..picture import chosen_light, light_spectra
from ..picture import groups as picture_groups
from ..picture import relight as picture_relight
from ..picture import render as picture_render
from ..picture.picture import SpectralPicture
from ..picture.relight import Lights
from ..samples import light_source
from .checks import check_enabled


def picture_lights(
    scene: bpy.types.Scene | None = None,
    *,
    tolerance: float = TOLERANCE / 2,
    bands: int | None = None,
    samples: int | None = None,
    percentage: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Lights:
    """Render the light of each lamp apart, so that lamps can be changed without rendering.

    Parameters
    ----------
    scene, bands, samples, percentage, progress
        As for `spectral_picture`.
    tolerance
        ΔE00 within which 95 % of the picture shall be, in the scene's own light and in that of
        the usual illuminants.

    Returns
    -------
    Their `names`, `spectra`, `parts`, `alpha` and `wavelengths`, for `relight`.

    Raises
    ------
    RoughSpectraError
        As of `spectral_picture`; and where lamps cannot be told apart.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> lights = picture_lights(scene, bands=3, samples=1)
    >>> lights.names, lights.parts.shape, relight(lights, {"Gray": "A"}).rgb.shape
    (('Gray',), (1, 3, 8, 8), (8, 8, 4))
    """
    check_enabled()
    wanted = picture_render.Wanted(
        tolerance, bands, plain=False, samples=samples, percentage=percentage, steady=True
    )
    return picture_groups.gather(scene or bpy.context.scene, wanted, progress)


def relight(
    lights: Lights,
    spectra: Mapping[str, str] | None = None,
    intensities: Mapping[str, float] | None = None,
    observer: int = 2,
) -> SpectralPicture:
    """Give the picture with other lamps, without rendering; see `picture_lights`.

    Parameters
    ----------
    lights
        What `picture_lights` gave.
    spectra
        By name, the CIE illuminant that a lamp becomes, or the path of a table.
    intensities
        By name, how many times as bright it is.
    observer
        2 or 10 degrees.

    Raises
    ------
    DomainError, InputError
        There is no such lamp or light, or the open file has another working space.

    Examples
    --------
    >>> import numpy as np
    >>> from rough_spectra.addon.colorimetry import illuminant_spectra
    >>> nm, day = illuminant_spectra.GRID, illuminant_spectra.cie("D65")
    >>> gray, parts = np.full((1, nm.size), 0.5), np.full((1, 3, 2, 2), 0.5, np.float32)
    >>> at = nm[[18, 36, 54]]
    >>> lights = Lights(("Lamp",), day[None], parts, np.ones((2, 2)), at, gray, "Linear Rec.709")
    >>> round(float(relight(lights, {"Lamp": "A"}, {"Lamp": 2.0}).xyz[0, 0, 1]), 3)
    1.0
    """
    check_enabled()
    desk = picture_relight.Desk(lights, observer)
    picture_relight.set_all(desk, spectra or {}, intensities or {})
    return desk.picture()


def measured_light(light: bpy.types.Light | bpy.types.World, path: str | os.PathLike[str]) -> None:
    r"""Let a lamp or a world have the spectrum of a file in spectral pictures; it is kept with it.

    A CIE illuminant needs no function: ``light.rough_spectra.spectrum = "F11"``, and "COLOR" for
    what fits its color.

    Parameters
    ----------
    light
        A lamp or a world.
    path
        A TM-27 file (.spdx), a table of wavelengths and power, or a spectral image.

    Raises
    ------
    InputError
        The file cannot be read, or nothing of this light is seen.
    MaterialError
        The light is linked from another file.

    Examples
    --------
    >>> _ = Path("lamp.csv").write_text("nm,W\n400,0.2\n500,0.5\n600,0.9\n700,1\n")
    >>> lamp = bpy.data.lights.new("Lamp", "POINT")
    >>> measured_light(lamp, "lamp.csv")
    >>> lamp.rough_spectra.spectrum, lamp.rough_spectra.sample_name
    ('MEASURED', 'lamp.csv')
    """
    check_enabled()
    if not light.is_editable:
        msg = f"{light.name!r} is linked from another file; make it local first."
        raise MaterialError(msg)
    source = light_source.read(path)
    light_spectra.measured(source)  # refuses what nobody sees
    chosen_light.keep(light, source, str(path))
