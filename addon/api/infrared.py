# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in the infrared: by lamps, and by the heat of things."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path

import bpy

from ...core.emissivity import Filter
from ..picture import files as picture_files
from ..picture import infrared, infrared_file, infrared_wanted, thermal, thermal_file
from ..picture.infrared import InfraredPicture
from ..picture.thermal import ThermalPicture
from ..samples.sample import Sample
from .checks import check_enabled


def thermal_picture(
    scene: bpy.types.Scene | None = None,
    *,
    band: tuple[float, float] = thermal.BAND,
    parts: int = 3,
    ambient: float = thermal.AMBIENT,
    sky: float | None = None,
    emissivity: float = thermal.EMISSIVITY,
    materials: Mapping[str, Sample | float] | None = None,
    samples: int | None = None,
    percentage: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> ThermalPicture:
    """Render what a thermal camera sees of a scene.

    An object's temperature is its custom property `rough_spectra_temperature`, kelvin, or an
    attribute of this name of its vertices.

    Parameters
    ----------
    scene, samples, percentage, progress
        As for `spectral_picture`.
    band
        First and last wavelength of the camera, nanometers, from 700.
    parts
        Of the band, each with one emissivity a material, a multiple of 3: three a render.
    ambient
        Temperature of objects that have none, kelvin.
    sky
        That of what is seen where nothing is, kelvin; None for `ambient`.
    emissivity
        Of materials without infrared data.
    materials
        By name, a sample or an emissivity instead of what the material stores.

    Returns
    -------
    `radiance`, W m⁻² sr⁻¹ in the band, and `kelvin`, the temperature of a black body that sends
    as much, both of shape (rows, columns), from the bottom up; the `band`; the names of materials
    whose emissivity was `assumed`; and `temperatures`, by the names of objects.

    Raises
    ------
    RoughSpectraError
        An argument or a temperature is none, the scene has no camera, or the second Blender failed.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> round(float(thermal_picture(scene, sky=300.0, samples=1).kelvin.mean()), 2)
    300.0
    """
    check_enabled()
    wanted = thermal.Wanted(
        band, parts, ambient, sky, emissivity, materials or {}, samples, percentage
    )
    return thermal.render(scene or bpy.context.scene, wanted, progress)


def write_thermal(picture: ThermalPicture, path: str | os.PathLike[str]) -> None:
    """Write a thermal picture as an EXR with the channels `radiance` and `kelvin`.

    Parameters
    ----------
    picture
        What `thermal_picture` gave.
    path
        Ends in .exr.

    Raises
    ------
    OutputError
        The file cannot be written.

    Examples
    --------
    >>> import numpy as np
    >>> warm = np.full((2, 3), 300.0)
    >>> write_thermal(ThermalPicture((8000.0, 14000.0), warm, warm, (), {}), "warm.exr")
    """
    check_enabled()
    picture_files.check(Path(path))
    thermal_file.write(picture, Path(path))


def infrared_picture(
    scene: bpy.types.Scene | None = None,
    *,
    band: tuple[float, float] | Filter = infrared_wanted.BAND,
    parts: int = 3,
    lights: Mapping[str, str] | None = None,
    materials: Mapping[str, Sample | float] | None = None,
    samples: int | None = None,
    percentage: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> InfraredPicture:
    """Render what a camera sees of a scene in the infrared, by the light of its lamps.

    Parameters
    ----------
    scene, samples, percentage, progress
        As for `spectral_picture`.
    band
        First and last wavelength of the camera, nanometers, or a `Filter`.
    parts
        Of the band, in each of which lamps and surfaces have one number, a multiple of 3.
    lights
        By the names of lamps, worlds and materials that emit, a temperature such as "2856K" or the
        path of a table that reaches there, instead of what they have.
    materials
        By name, a sample or a reflectance instead of what the material stores.

    Returns
    -------
    `gray`, the mean radiance per nanometer, shape (rows, columns) from the bottom up, in units in
    which even light of luminance 1 has 1; `false_color`, that of the band's thirds; `parts`, that
    of each part; what materials and lamps were `told` to be; and by name, why materials were
    `assumed` to be as bright as to the eye, and lamps are `dark`.

    Raises
    ------
    RoughSpectraError
        An argument is none, the scene has no camera, nothing is known to shine there, or the second
        Blender failed.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine = "CYCLES"
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.world = bpy.data.worlds.new("Sky")
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> picture = infrared_picture(scene, band=(840.0, 860.0), lights={"Sky": "2856K"}, samples=1)
    >>> picture.told
    {"World 'Sky'": 'blackbody of 2856 K'}
    """
    check_enabled()
    wanted = infrared_wanted.Wanted(band, parts, lights or {}, materials or {}, samples, percentage)
    return infrared.render(scene or bpy.context.scene, wanted, progress)


def write_infrared(
    picture: InfraredPicture, path: str | os.PathLike[str], *, false_color: bool = False
) -> None:
    """Write an infrared picture as an EXR, gray or in false color.

    Parameters
    ----------
    picture
        What `infrared_picture` gave.
    path
        Ends in .exr.
    false_color
        Whether red, green and blue are the thirds of the band, red the longest wavelengths.

    Raises
    ------
    OutputError
        The file cannot be written.

    Examples
    --------
    >>> import numpy as np
    >>> one = np.ones((2, 3))
    >>> picture = InfraredPicture((700.0, 1000.0), np.ones((2, 3, 3)), one, {}, {}, {}, ())
    >>> write_infrared(picture, "near.exr")
    """
    check_enabled()
    picture_files.check(Path(path))
    infrared_file.write(picture, Path(path), false_color=false_color)
