# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture as an EXR, and as an image in Blender."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.errors import OutputError
from ...core.numerics.arrays import Array
from ..blender import working_space
from ..support import atomic_files
from . import exr_file, spectral_file
from .picture import SpectralPicture

ENDING = ".exr"


def write(
    picture: SpectralPicture, path: Path, spectra: Path | None = None, *, at_bands: bool = False
) -> list[Path]:
    """Write the picture, its map of ΔE00 beside it where there is one, and spectra if asked for.

    Parameters
    ----------
    picture
        Of the open file.
    path
        Of an EXR; the map has `-delta-e` before the ending.
    spectra, at_bands
        Path and wavelengths of a spectral image, see `spectral_file.write`; None for none.

    Returns
    -------
    What was written.

    Raises
    ------
    OutputError
        If an ending is another, or the files cannot be written. All or none are.
    """
    check(path, spectra)
    files: list[tuple[Path, Array, tuple[str, ...]]] = [(path, picture.rgb, ("R", "G", "B", "A"))]
    if picture.comparison is not None:
        beside = path.with_name(f"{path.stem}-delta-e{path.suffix}")
        files.append((beside, picture.comparison.delta_e[..., np.newaxis], ("Y",)))
    with atomic_files.publication() as publication:
        for target, pixels, names in files:
            told = _attributes(picture)
            if len(names) > 1:
                told["chromaticities"] = spectral_file.chromaticities()
            exr_file.write(publication.stage(target), target, pixels, names, told)
        if spectra is not None:
            spectral_file.write(picture, publication.stage(spectra), spectra, at_bands=at_bands)
    written = [target for target, *_ in files]
    return written if spectra is None else [*written, spectra]


def check(path: Path, spectra: Path | None = None) -> None:
    """Refuse paths that `write` would.

    Raises
    ------
    OutputError
        If an ending is another, or no file can be there.
    """
    if path.name.lower().endswith(spectral_file.ENDING):
        msg = (
            f"{path} is called like a spectral image, which Blender cannot open; give it another "
            "name, and write the spectra beside it."
        )
        raise OutputError(msg)
    if path.suffix.lower() != ENDING:
        msg = f"{path} is no EXR by its name; let it end in {ENDING}."
        raise OutputError(msg)
    atomic_files.check_target(path)
    if spectra is not None:
        spectral_file.check(spectra)


def image(picture: SpectralPicture, name: str) -> Any:
    """Put the picture into a `bpy.types.Image` of the open file, a new one; it is packed."""
    return image_of(picture.rgb, name)


def image_of(pixels: Array, name: str, space: str = "") -> Any:
    """Put RGBA, shape (rows, columns, 4), from the bottom up, into one.

    They are in the working space, unless another `space` is named.
    """
    rows, columns = pixels.shape[:2]
    found = bpy.data.images.new(name, columns, rows, alpha=True, float_buffer=True)
    space = space or working_space.working_space_name()
    known = found.colorspace_settings.bl_rna.properties["name"].enum_items
    if space in known:
        found.colorspace_settings.name = space
    found.pixels.foreach_set(pixels.astype(np.float32, copy=False).ravel())
    found.update()
    found.pack()
    return found


def told(picture: SpectralPicture) -> Iterable[str]:
    """Say in sentences what was rendered and what the comparison found."""
    bands = ", ".join(f"{nm:g}" for nm in picture.wavelengths)
    apart = ", direct light apart" if picture.direct else ""
    if picture.direct_words:
        apart += f", {picture.direct_words}"
    predicted = picture.predicted
    if not bands:
        yield f"no bands{apart}"
    else:
        yield (
            f"{len(picture.wavelengths)} bands ({bands} nm){apart}; predicted ΔE00 to the whole "
            f"spectrum: mean {predicted.mean:.2f}, 95 % {predicted.usual:.2f}, at most "
            f"{predicted.largest:.1f}"
        )
    if picture.touched is not None:
        share = 100 * picture.touched
        yield f"materials with something that stays RGB take {share:.0f} % of the picture"
    found = picture.comparison
    if found is not None:
        column, row = found.where
        yield (
            f"the RGB picture is off by ΔE00 {found.mean:.2f} on average, 95 % within "
            f"{found.usual:.2f}, at most {found.largest:.1f} (column {column}, row {row} from the "
            "bottom left)"
        )


def _attributes(picture: SpectralPicture) -> dict[str, Any]:
    return {
        "roughSpectra:bands": " ".join(f"{nm:g}" for nm in picture.wavelengths),
        "roughSpectra:observer": f"{picture.observer} degrees",
    }
