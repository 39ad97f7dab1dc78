# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rough samples as meshes, and textures of rough surfaces."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from ...core.instruments import DEFAULT
from ...core.models import TARGET
from ..blender import working_space
from ..laboratory import experiment, kinds
from ..laboratory.experiment import Measured
from ..laboratory.kinds import RoughSample
from ..textures import convert
from ..textures import material as material_of_texture
from ..textures.wanted import Made
from ..textures.wanted import Wanted as _Wanted
from .checks import check_enabled


def rough_sample(
    kind: str,
    sigma: float | None = None,
    length: float | None = None,
    *,
    seed: int = 0,
    cells: int = kinds.CELLS,
    path: str | os.PathLike[str] | None = None,
) -> RoughSample:
    """Make a rough surface of facets, to be measured by `measure_rough`.

    Parameters
    ----------
    kind
        "gaussian" or "multiscale" (random heights), "grooves" or "grooves-oren-nayar" (V-grooves of
        either slope law), "grains" (packed spheres), or "map" (heights from a file).
    sigma
        Roughness σ, **radians**: the tangent is Rdq of the facets, or the width of the grooves'
        slope law. None leaves grains spheres, and a map as it was measured.
    length
        Correlation length, mean width of a groove, diameter of a grain, or length between two
        heights of a map that does not say it, in any unit; 1 if not given.
    seed
        Another surface of the same kind for each number.
    cells
        Of the mesh, a side; a map has its own.
    path
        Of a map: a 16-bit or float image, or a text of points x y z, of a matrix, or SDF.

    Returns
    -------
    Its `mesh` has `vertices`, `faces`, `period`, `rdq` and `sdq`; its `sigma` is the angle of Rdq.

    Raises
    ------
    DomainError
        The numbers make no such surface.
    InputError
        The file cannot be used, or has holes.

    Examples
    --------
    >>> sample = rough_sample("gaussian", radians(30), cells=64)
    >>> len(sample.mesh.faces), round(sample.mesh.rdq, 4), round(sample.mesh.sdq, 4)
    (8192, 0.5774, 0.8165)
    """
    where = None if path is None else Path(path)
    return kinds.make(kind, sigma, length, seed=seed, cells=cells, path=where)


def measure_rough(
    sample: RoughSample,
    albedos: Iterable[float],
    spot: float | None = None,
    *,
    seeds: int = experiment.SEEDS,
    samples: int = experiment.SAMPLES,
    progress: Callable[[int, int], None] | None = None,
) -> Measured:
    """Measure a rough surface in Cycles at 45°/0°, with all bounces between its facets.

    Cycles renders in a second Blender, and this call waits for it. The open file is not changed.

    Parameters
    ----------
    sample
        What `rough_sample` gave.
    albedos
        Of its Lambertian facets, 0 to 1; three are rendered at once.
    spot
        Diameter of what the instrument sees, in the unit of the sample's length. None takes half of
        what the surface repeats after.
    seeds, samples
        Renders with random numbers of their own, two or more, and rays a pixel in each; a picture
        that is finer for the sake of a small spot shares as many.
    progress
        Called with renders done and renders in all.

    Returns
    -------
    Arrays, one number an albedo: `reflectance`, the mean over all places of the spot, and `noise`,
    its standard error; `spread`, the standard deviation over places, free of noise; `spot_noise`,
    the standard error of a reading at one place.

    Raises
    ------
    DomainError
        A number is out of its range.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> sample = rough_sample("gaussian", radians(30), cells=64)
    >>> found = measure_rough(sample, [0.2, 0.8], seeds=2, samples=16)
    >>> [round(value, 2) for value in found.reflectance.tolist()]
    [0.17, 0.77]
    >>> bool((found.noise < 0.002).all()), bool((found.spread < 0.02).all())
    (True, True)
    """
    return experiment.measure(
        sample.mesh,
        list(albedos),
        spot,
        seeds=seeds,
        samples=samples,
        progress=progress,
    )


def make_texture(
    source: str | os.PathLike[str],
    target: str | os.PathLike[str],
    sigma: float,
    *,
    instrument: str = DEFAULT,
    illuminant: str = "D65",
    model: str = TARGET,
    holds: str = "albedo",
    scale: float | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Made:
    r"""Turn an image of what was read of a rough surface into a texture, in half floats.

    Parameters
    ----------
    source
        A spectral OpenEXR, an ENVI cube or its header, or red, green and blue.
    target
        The texture, an EXR in the working space of the open file.
    sigma
        Roughness σ, **radians**, 0 to π/3.
    instrument
        That the image was taken with.
    illuminant
        The light under which the texture is right; of RGB, the one that the image was taken for.
    model
        One of `core.models.NAMES`.
    holds
        "albedo" of the facets, or "color" that Cycles' Diffuse needs to read as was measured.
    scale
        Of an ENVI cube, the number that stands for a reflectance of 1; None takes the header's.
    progress
        Called with lines done and lines in all; may raise to stop.

    Returns
    -------
    Its `path`, `width` and `height`; the `roughness` that goes with it in Cycles; the `mean`
    reading as a `Sample`, None of RGB; the shares of pixels that are `infeasible` (they read more
    than white facets) and `outside` 0 to 1; and `notes`.

    Raises
    ------
    InputError
        The image cannot be read, has pixels that are not numbers, or lacks bands.
    OutputError
        The texture cannot be written.
    DomainError
        An argument is none of these.
    CancelledError
        On an interrupt from the keyboard. Nothing was written.

    Examples
    --------
    >>> header = "ENVI\nsamples = 2\nlines = 1\nbands = 4\ndata type = 1\ninterleave = bip\n"
    >>> header += "wavelength units = nm\nwavelength = {400, 500, 600, 700}\n"
    >>> _ = Path("wall.hdr").write_text(header + "reflectance scale factor = 200")
    >>> _ = Path("wall.img").write_bytes(bytes([100, 100, 100, 100, 40, 40, 40, 40]))
    >>> made = make_texture("wall.img", "wall.exr", radians(20), holds="color")
    >>> made.width, made.mean.values.round(2).tolist(), made.infeasible
    (2, [0.35, 0.35, 0.35, 0.35], 0.0)
    """
    check_enabled()
    wanted = _Wanted(sigma, instrument, illuminant, model, holds, scale)
    conversion = convert.Conversion(Path(source), Path(target), wanted, working_space.current())
    return conversion.finish(progress)


def texture_material(made: Made, name: str = "") -> Any:
    """Make a material that shows a texture, so that each of its pixels reads what was measured.

    Parameters
    ----------
    made
        What `make_texture` gave, of colors.
    name
        Of the material; empty for that of the texture's file.

    Raises
    ------
    MaterialError
        There is a material of this name, or the texture holds albedo.

    Examples
    --------
    >>> from rough_spectra.addon.support import png
    >>> import numpy as np
    >>> _ = Path("scan.png").write_bytes(png.encode(np.full((2, 2, 3), 128, np.uint8)))
    >>> made = make_texture("scan.png", "scan.exr", radians(20), holds="color")
    >>> texture_material(made, "Wall").node_tree.nodes["Image Texture"].image.name
    'scan.exr'
    """
    check_enabled()
    return material_of_texture.make(made, name)
