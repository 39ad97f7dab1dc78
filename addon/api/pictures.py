# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral pictures of a scene, and whether RGB is enough."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import bpy

from ...core.limits import TOLERANCE
from ..picture import files as picture_files
from ..picture import pixel as picture_pixels
from ..picture import render as picture_render
from ..picture import verdict as picture_judgement
from ..picture.picture import SpectralPicture
from ..picture.pixel import Pixel
from ..picture.verdict import Verdict
from .checks import check_enabled


def spectral_picture(
    scene: bpy.types.Scene | None = None,
    *,
    tolerance: float = TOLERANCE,
    bands: int | None = None,
    observer: int = 2,
    direct: bool | None = None,
    compare: bool = True,
    samples: int | None = None,
    percentage: int | None = None,
    lights: Mapping[str, str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> SpectralPicture:
    """Render a scene spectrally: as many ordinary renders as needed, with three bands in each.

    A second Blender renders a copy of the open file as it is now, and this call waits for it. The
    file, its settings and the last render are not changed. What comes after the render, such as
    compositing, is not done.

    Parameters
    ----------
    scene
        Rendered by Cycles; the active one if left out. Of its view layers the first counts that is
        rendered.
    tolerance
        ΔE00 within which 95 % of the picture shall be, as far as the number of bands decides it.
    bands
        A number of bands instead, a multiple of 3.
    observer
        2 or 10 degrees.
    direct
        Whether light that met one surface alone is rendered apart and is exact, at the cost of one
        more render for each spectrum of light. None chooses what needs fewer renders.
    compare
        Whether the ordinary picture is rendered, too, and compared.
    samples, percentage
        Of the renders, instead of the scene's own.
    lights
        By the names of lamps, worlds and materials that emit one color, the spectrum that it has:
        a CIE illuminant such as "F11", or the path of a TM-27 file (.spdx), of a table of
        wavelengths and power on any scale, or of a spectral image. Its luminance stays that of its
        color.
    progress
        Called with renders done and renders in all.

    Returns
    -------
    Its `rgb` is what a render would be: scene-linear RGB and alpha, shape (rows, columns, 4), from
    the bottom up; `xyz`; the `wavelengths` of the bands; the `predicted` error (`mean`, `usual`,
    which is 95 %, and `largest`), and whether it is `enough`; the `comparison` with the ordinary
    picture: `delta_e`, `mean`, `usual`, `largest`, and `where`; by which `rules` each material,
    lamp and world got its spectra; what stayed RGB (`untranslated`); `seconds`; and `spectra`,
    whose `at(column, row)` is a pixel's radiance per nanometer from 360 to 780 nm every 10 nm.

    Raises
    ------
    MaterialError
        The scene has another render engine, no camera, no light, or none that `lights` names.
    DomainError
        An argument is none of these.
    InputError
        A file of `lights` cannot be read.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> picture = spectral_picture(scene, bands=3, samples=1, compare=False)
    >>> picture.rgb.shape, len(picture.wavelengths), picture.untranslated
    ((8, 8, 4), 3, {})
    """
    check_enabled()
    wanted = picture_render.Wanted(
        tolerance, bands, observer, direct, compare, samples, percentage, lights or {}
    )
    return picture_render.render(scene or bpy.context.scene, wanted, progress)


def picture_verdict(
    scene: bpy.types.Scene | None = None,
    *,
    tolerance: float = TOLERANCE,
    samples: int | None = None,
    percentage: int | None = None,
    lights: Mapping[str, str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Verdict:
    """Say whether RGB is enough for a scene, and if not, the least that is.

    A second Blender renders small pictures of a copy of the open file, and this call waits for it.

    Parameters
    ----------
    scene, lights, progress
        As for `spectral_picture`.
    tolerance
        ΔE00 within which 95 % of the picture shall be.
    samples, percentage
        Of the small pictures; 8, and what comes to 240 × 135 pixels, if left out.

    Returns
    -------
    Whether RGB is `enough`; the `sentence`; the `rungs`, from RGB as it is over the working space
    and the materials' match to passes of three bands, each with `kind`, `words`, `renders`,
    `mean`, `usual`, `largest` (ΔE00) and `seconds`; the `chosen` one, which is RGB within the
    tolerance, else the first that surely is, or None; the `comparison` of RGB with the spectral
    picture, in blocks of pixels; what stayed RGB (`untranslated`), and which part of the picture
    that has `touched`.

    Raises
    ------
    RoughSpectraError
        As of `spectral_picture`.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> picture_verdict(scene, samples=1).sentence
    'RGB is enough: 95 % of the picture within ΔE00 0.00, the tolerance is 1.'
    """
    check_enabled()
    return picture_judgement.judge(
        scene or bpy.context.scene,
        progress,
        tolerance=tolerance,
        samples=samples,
        percentage=percentage,
        lights=lights,
    )


def write_picture(
    picture: SpectralPicture,
    path: str | os.PathLike[str],
    spectra: str | os.PathLike[str] | None = None,
    *,
    at_bands: bool = False,
) -> list[Path]:
    """Write a spectral picture as an EXR in the working space, and its map of ΔE00 beside it.

    Parameters
    ----------
    picture
        What `spectral_picture` gave, of the open file.
    path
        Ends in .exr; the map is called the same with `-delta-e`.
    spectra
        Of a spectral image, which ends in .spectral.exr, if that is wanted, too: radiance every
        10 nm, in channels such as S0.440,000000nm. Don't open it with Blender.
    at_bands
        Whether it holds the radiance at the bands' wavelengths instead.

    Returns
    -------
    What was written.

    Raises
    ------
    OutputError
        The files cannot be written; none is.

    Examples
    --------
    >>> import numpy as np
    >>> from rough_spectra.core.bands import Error
    >>> blank, error = np.zeros((2, 3, 4)), Error(0.0, 0.0, 0.0)
    >>> picture = SpectralPicture(
    ...     blank, blank[..., :3], 2, np.zeros(3), False, error, True, None, {}, {}, ()
    ... )
    >>> [path.name for path in write_picture(picture, "room.exr")]
    ['room.exr']
    """
    check_enabled()
    beside = None if spectra is None else Path(spectra)
    return picture_files.write(picture, Path(path), beside, at_bands=at_bands)


def picture_image(picture: SpectralPicture, name: str = "Spectral") -> Any:
    """Put a spectral picture into a new image of the open file, which can be saved or used there.

    Parameters
    ----------
    picture
        What `spectral_picture` gave, of the open file.
    name
        Of the image.

    Examples
    --------
    >>> import numpy as np
    >>> from rough_spectra.core.bands import Error
    >>> blank, error = np.zeros((2, 3, 4)), Error(0.0, 0.0, 0.0)
    >>> picture = SpectralPicture(
    ...     blank, blank[..., :3], 2, np.zeros(3), False, error, True, None, {}, {}, ()
    ... )
    >>> picture_image(picture).size[:]
    (3, 2)
    """
    check_enabled()
    return picture_files.image(picture, name)


def picture_pixel(picture: SpectralPicture, column: int, row: int) -> Pixel:
    """Read a pixel of a spectral picture.

    Parameters
    ----------
    picture
        What `spectral_picture` gave.
    column, row
        From the bottom left.

    Returns
    -------
    Its `wavelengths`, from 360 to 780 nm every 10 nm, and `radiance` per nanometer in the scene's
    units; `xyz` by the picture's observer; `lab` against white at a radiance of 1 under the scene's
    light; and `delta_e`, ΔE00 of the ordinary picture there, None without one.

    Raises
    ------
    DomainError
        There is no such pixel.

    Examples
    --------
    >>> scene = bpy.context.scene
    >>> scene.render.engine, scene.world = "CYCLES", bpy.data.worlds.new("Gray")
    >>> scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    >>> scene.collection.objects.link(scene.camera)
    >>> scene.render.resolution_x = scene.render.resolution_y = 8
    >>> scene.cycles.use_denoising = False
    >>> picture = spectral_picture(scene, bands=3, samples=1)
    >>> pixel = picture_pixel(picture, 4, 4)
    >>> pixel.radiance.shape, [round(abs(value), 1) for value in pixel.lab[1:]]
    ((43,), [0.0, 0.0])
    """
    check_enabled()
    return picture_pixels.read(picture, column, row)
