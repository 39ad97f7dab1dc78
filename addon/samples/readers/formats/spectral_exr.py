# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral images in OpenEXR: the mean of a region, or of the whole image.

Channels of reflectance are read, by the names of `parts.spectral_channels`; others are refused.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample, check_spectrum
from ..parts import (
    band_order,
    exr_header,
    exr_pixels,
    geometry_words,
    spectral_channels,
)
from ..parts.document import Document, quote
from ..parts.exr_image import Image

NAME = "spectral OpenEXR image"
ENDINGS = ("exr",)
PRIORITY = 100
REGIONS = True

UNEVEN = 0.02
"""Standard deviation over the pixels above which a mean stands for no single color."""


def sniff(document: Document) -> bool:
    """Return whether this is an OpenEXR image; one without spectra is refused below."""
    return document.data.startswith(exr_header.MAGIC)


def read(document: Document) -> list[Sample]:
    """Return one sample, the mean over the document's region or over the whole image.

    Raises
    ------
    InputError
        The image cannot be read (`exr_header.open_image`), it has no channels of reflectance, the
        region is not within it, or the mean is no spectrum (`check_spectrum`).
    """
    image = exr_header.open_image(document)
    bands, skipped = _reflective(document, image)
    region = _region(document, image)
    mean, deviation = _mean(image, list(bands), region)
    nm = np.array(list(bands.values()))
    order, _ = band_order.in_order(nm)  # channels stand in the order of their names
    names = [image.channels[index].name for index in bands]
    wavelengths, values = check_spectrum(
        nm[order],
        mean[order],
        str(document.path),
        lambda band: f"channel {quote(names[order[band]])}",
    )
    x, y, width, height = region
    notes = []
    if deviation > UNEVEN:
        notes.append(
            f"The pixels differ by a standard deviation of up to {deviation:.2f}; read a region of "
            "one color if that is not meant."
        )
    if skipped:
        notes.append("The image also holds emitted light, which was not read.")
    instrument, note = geometry_words.instrument_of("")
    return [
        Sample(
            name=document.path.stem.removesuffix(".spectral") or document.path.stem,
            wavelengths=wavelengths,
            values=values,
            kind="reading",
            quantity="reflectance",
            instrument=instrument,
            source=str(document.path),
            position=f"pixels {x}, {y} to {x + width - 1}, {y + height - 1}",
            notes=(*notes, note),
            altered=(f"Mean of {width * height} pixels.",),
        )
    ]


def emission(document: Document) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the mean of emitted light over the document's region: nanometers, and radiance.

    Raises
    ------
    InputError
        The image cannot be read, has no channels of emitted light, or the region is not within it.
    """
    image = exr_header.open_image(document)
    bands: dict[int, float] = {}
    for index, channel in enumerate(image.channels):
        found = spectral_channels.parse(channel.name)
        # Others are of its polarization.
        if found is not None and found.emits and not found.bispectral and "S0." in channel.name:
            bands[index] = found.nm
    if not bands:
        raise document.error(
            "", "the image has no channels of light such as 'S0.400,000000nm'; save them with it"
        )
    mean, _ = _mean(image, list(bands), _region(document, image))
    nm = np.array(list(bands.values()))
    order, _ = band_order.in_order(nm)
    return nm[order], mean[order]


def _reflective(document: Document, image: Image) -> tuple[dict[int, float], bool]:
    """Return the wavelength in nm by channel, and whether others hold emitted light."""
    bands: dict[int, float] = {}
    layers = set()
    emits = False
    for index, channel in enumerate(image.channels):
        found = spectral_channels.parse(channel.name)
        if found is None:
            continue
        if found.bispectral:
            raise document.not_reflectance(
                f"channel {quote(channel.name)}",
                "bispectral (of a fluorescent surface, by the light's wavelength and by its own)",
            )
        if found.emits:
            emits = True
            continue
        if channel.form.kind == "u":
            raise document.error(
                f"channel {quote(channel.name)}", "its pixels are whole numbers; save it as floats"
            )
        layers.add(found.layer)
        bands[index] = found.nm
    if not bands and emits:
        raise document.not_reflectance("", "radiance (an image of light, channels S0)")
    if not bands:
        names = ", ".join(channel.name for channel in image.channels[:4])
        raise document.error(
            "",
            f"the image has no channels such as 'T.400,000000nm' but {quote(names)}; save its "
            "spectra with it",
        )
    if len(layers) > 1:
        raise document.error("", f"{len(layers)} layers hold spectra; save one of them alone")
    return bands, emits


def _region(document: Document, image: Image) -> tuple[int, int, int, int]:
    x, y, width, height = region = document.region or (0, 0, image.width, image.height)
    inside = 0 <= x < x + width <= image.width and 0 <= y < y + height <= image.height
    if not inside:
        raise document.error(
            f"region {x}, {y}, {width} x {height}",
            f"it is not within the image of {image.width} x {image.height} pixels; choose one that "
            "is",
        )
    return region


def _mean(
    image: Image, channels: list[int], region: tuple[int, int, int, int]
) -> tuple[NDArray[np.float64], float]:
    """Return the mean of each channel, and the largest standard deviation of any.

    A few lines at a time: unpacked, an image is a hundred times its file.
    """
    x, y, width, height = region
    total = np.zeros(len(image.channels))
    squares = np.zeros(len(image.channels))
    with np.errstate(over="ignore", invalid="ignore"):  # not finite: `check_spectrum` names it
        for first, block in exr_pixels.blocks(image, y, height):
            pixels = block[:, :, x : x + width].astype(np.float64)
            which = slice(first, first + pixels.shape[1])
            total[which] += pixels.sum(axis=(0, 2))
            squares[which] += np.square(pixels, out=pixels).sum(axis=(0, 2))
        mean = total[channels] / (width * height)
        variance = squares[channels] / (width * height) - mean * mean
    return mean, float(np.sqrt(max(np.nanmax(variance, initial=0.0), 0.0)))
