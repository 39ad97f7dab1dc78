# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures that OpenImageIO reads: spectral OpenEXR, and red, green and blue of a scanner.

Whole numbers, as in a PNG, are encoded as sRGB; floats are linear. Both are of Rec.709.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..colorimetry import srgb
from ..samples.readers.parts import spectral_channels
from ..support.openimageio import openimageio
from .image import BandImage, Pixels, fault

_EXR_LINES = 16
"""Lines that OpenEXR packs together by ZIP; other ways pack a part or twice of them."""


class Picture(BandImage):
    """A picture that is open for reading.

    Raises
    ------
    InputError
        If it cannot be read, or its channels are neither reflectance by wavelength nor RGB.
    """

    def __init__(self, path: Path) -> None:
        oiio = openimageio()
        config = oiio.ImageSpec()
        config.attribute("oiio:UnassociatedAlpha", 1)
        if not path.is_file():
            raise fault(path, "is no file; check the path")
        image = oiio.ImageInput.open(str(path), config)
        if image is None:
            oiio.geterror()
            raise fault(path, "cannot be read as an image or as an ENVI cube; check the file")
        self._image, self._oiio = image, oiio
        spec = image.spec()
        super().__init__(path, spec.width, spec.height)
        if spec.deep:
            raise self.fault("is a deep image; save it flat")
        self._top, self._tile = spec.y, (spec.tile_width, spec.tile_height)
        self._left = spec.x
        self._encoded = spec.format.basetype not in (oiio.HALF, oiio.FLOAT, oiio.DOUBLE)
        self.lines = spec.tile_height or _EXR_LINES
        self._channels = self._find(list(spec.channelnames))
        self.take(range(len(self._channels)))

    def take(self, bands: Sequence[int]) -> None:
        """Read these bands from now on."""
        channels = [self._channels[band] for band in bands]
        self._span = min(channels), max(channels) + 1
        within = [channel - self._span[0] for channel in channels]
        self._within = None if within == list(range(self._span[1] - self._span[0])) else within

    def read(self, first: int, last: int) -> Pixels:
        """Read lines, linear."""
        oiio, (low, high) = self._oiio, self._span
        top, bottom = self._top + first, self._top + last
        if self._tile[0]:
            ends = (self._left, self._left + self.width)
            values = self._image.read_tiles(*ends, top, bottom, 0, 1, low, high, oiio.FLOAT)
        else:
            values = self._image.read_scanlines(top, bottom, 0, low, high, oiio.FLOAT)
        if values is None:
            self._image.geterror()
            raise self.fault(f"is damaged from line {first} on; save the image again")
        pixels = np.asarray(values, np.float32).reshape((last - first) * self.width, high - low)
        if self._within is not None:
            pixels = pixels[:, self._within]
        if self._encoded:
            pixels = srgb.decode(pixels).astype(np.float32, copy=False)
        return pixels

    def close(self) -> None:
        """Let the file go."""
        self._image.close()

    def _find(self, names: list[str]) -> list[int]:
        """Give the channels that hold the bands, and note what these are."""
        spectral = {i: found for i, name in enumerate(names)
                    if (found := spectral_channels.parse(name))}  # fmt: skip
        if any(found.bispectral for found in spectral.values()):
            raise self.fault("is bispectral, of a fluorescent surface, which no texture can hold")
        bands = {i: found.nm for i, found in spectral.items() if not found.emits}
        if len({spectral[i].layer for i in bands}) > 1:
            raise self.fault("has spectra in several layers; save one of them alone")
        if spectral and not bands:
            raise self.fault(
                "holds radiance (channels S0), which is light and no reflectance; divide it by a "
                "white's and name the channels T"
            )
        if not bands:
            bands = {i: nm for i, name in enumerate(names)
                     if (nm := spectral_channels.plain(name)) is not None}  # fmt: skip
        if bands:
            if self._encoded:
                raise self.fault("has spectra in whole numbers; save them as floats")
            self.wavelengths = np.array(list(bands.values()))
            self.names = tuple(names[i] for i in bands)
            return list(bands)
        if {"R", "G", "B"} <= set(names):
            self.names = ("R", "G", "B")
            return [names.index(name) for name in self.names]
        raise self.fault(
            f"has the channels {', '.join(names[:4])}, and neither R, G and B nor wavelengths such "
            "as 'T.400,0nm'; save it with these"
        )
