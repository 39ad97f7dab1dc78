# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From an image of what an instrument read of a rough surface to a texture in scene-linear RGB.

Each band of each pixel is inverted to the albedo of the facets by the core, and only then turned
into RGB: RGB(ρ²) is not RGB(ρ)². A texture of colors holds what Cycles' Diffuse needs instead, so
that each pixel reads what was measured.

Of an image in RGB the channels take the place of bands. That is exact for gray; of a color whose
spectrum changes within a channel it is off by as much as the reading is bent there.

A few lines are held at a time, whatever the size of the image.
"""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

from ...core import cycles, ladder, reading
from ...core.cycles import matching
from ...core.errors import CancelledError, DomainError, InputError, OutputError
from ...core.instruments import DEFAULT
from ...core.numerics import direction_grid
from ...core.numerics.arrays import Array
from ..colorimetry import srgb
from ..colorimetry.rgb_space import WorkingSpace
from ..matching.solve import MATCH_GEOMETRIES
from ..samples.sample import Sample
from ..support import atomic_files
from .envi import Cube, header_of
from .exr_file import Writer
from .image import BandImage, Pixels
from .picture import Picture
from .products import times, total
from .wanted import Made, Wanted

_NUMBERS_AT_ONCE = 4_000_000
"""Of a block: 16 MB, and some such arrays at once."""
_PLACES = 12
"""Blocks, spread over the image, of whose mean the roughness is matched."""
_MOST_THREADS = 8
_ENOUGH = 1e-5
"""Overshoot that is rounding of single precision."""


def open_image(path: Path, scale: float | None = None) -> BandImage:
    """Open an ENVI cube, by its header or its numbers, or a picture.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    header = header_of(path)
    return Picture(path) if header is None else Cube(header, scale)


class Conversion:
    """A texture in the making. Iterating does it, and gives lines done and lines in all.

    Parameters
    ----------
    source
        Path of the image.
    target
        Path of the texture, an EXR.
    wanted
        What to make.
    space
        The working space of the texture.

    Raises
    ------
    InputError
        If the image cannot be read, or lacks bands that a color needs.
    OutputError
        If the texture cannot be written there.
    DomainError
        If instrument, illuminant or model is unknown.
    """

    def __init__(self, source: Path, target: Path, wanted: Wanted, space: WorkingSpace) -> None:
        if target.suffix.lower() != ".exr":
            msg = f"{target} is to hold half floats; give a name that ends in .exr."
            raise OutputError(msg)
        if target.exists() and source.exists() and target.samefile(source):
            msg = f"{target} is the image itself; give the texture another name."
            raise OutputError(msg)
        atomic_files.check_target(target)
        self.target, self.wanted, self.space = target, wanted, space
        self.made: Made | None = None
        self.part = target
        self._white = float(reading.white_reading(wanted.sigma, wanted.model, wanted.instrument))
        self._image = open_image(source, wanted.scale)
        with ExitStack() as undone:
            undone.callback(self._image.close)
            self._matrix = self._take_bands()
            self._roughness = self._match()
            undone.pop_all()

    def __iter__(self) -> Generator[tuple[int, int], None, None]:
        """Convert and write; nothing appears at the target before all of it is there."""
        with atomic_files.publication() as files:
            yield from self._write_among(files)

    def _write_among(
        self, files: atomic_files.AtomicFiles
    ) -> Generator[tuple[int, int], None, None]:
        image = self._image
        try:
            size = image.width, image.height
            self.part = files.stage(self.target)
            writer = Writer(self.part, self.target, size, self._told())
            yield 0, image.height
            yield from self._convert(writer)
        finally:
            image.close()
        writer.close()
        self.made = self._result()

    def finish(
        self,
        progress: Callable[[int, int], None] | None = None,
        files: atomic_files.AtomicFiles | None = None,
    ) -> Made:
        """Do all of it; `progress` is called with lines done and lines in all, and may raise.

        With `files` the texture appears with the others of a publication.

        Raises
        ------
        InputError
            If the image is damaged, or a pixel is no reflectance.
        OutputError
            If the disk is full.
        CancelledError
            On an interrupt from the keyboard.
        """
        steps = iter(self) if files is None else self._write_among(files)
        try:
            for done, total in steps:
                if progress is not None:
                    progress(done, total)
        except KeyboardInterrupt as error:
            msg = "Making the texture was interrupted; nothing was written."
            raise CancelledError(msg) from error
        finally:
            steps.close()
        assert self.made is not None
        return self.made

    def _take_bands(self) -> Array:
        """Read only bands that have a part in the color; gives the matrix to RGB, (bands, 3)."""
        image = self._image
        bands = image.wavelengths
        if not bands.size:
            back = np.linalg.inv(srgb.from_xyz(self.space.white))
            self._nm = bands
            return np.asarray((self.space.from_xyz @ back).T)
        usable = np.array(getattr(image, "good", range(bands.size)), int)
        order = usable[np.argsort(bands[usable], kind="stable")]
        nm = bands[order]
        if nm.size > 1 and not (np.diff(nm) > 0).all():
            twice = nm[:-1][np.diff(nm) <= 0][0]
            raise image.fault(f"has two bands at {twice:g} nm; leave one of them")
        try:
            weights = self.space.rgb_weights(nm, self.wanted.illuminant)
        except DomainError as error:
            msg = f"{image.path}: {error}"
            raise InputError(msg) from error
        counts = np.flatnonzero(np.abs(weights).max(axis=1) > 0)
        by_file = counts[np.argsort(order[counts])]
        image.take([int(band) for band in order[by_file]])
        self._nm = nm[by_file]
        self._bands = order[by_file]
        return np.ascontiguousarray(weights[by_file])

    def _match(self) -> float:
        """Match Cycles' roughness to the mean of some places of the image."""
        if self.wanted.sigma == 0 or self.wanted.model == "lambert":
            return 0.0
        step = self._image.lines
        starts = np.unique(np.linspace(0, max(self._image.height - step, 0), _PLACES).astype(int))
        means = []
        for start in starts // step * step:
            values = self._image.read(int(start), min(int(start) + step, self._image.height))
            self._check(values, int(start))
            means.append(values.mean(axis=0, dtype=np.float64))
        rho = np.clip(self._albedo(np.mean(means, axis=0)), 0, 1)
        matrix, sigma = self._matrix, self.wanted.sigma
        seen = reading.from_albedo(rho, sigma, self.wanted.model, DEFAULT) @ matrix
        geometries = direction_grid.hemisphere(MATCH_GEOMETRIES)
        targets = ladder.reflectance(self.wanted.model, rho, *geometries, sigma) @ matrix
        _, roughness = matching.match(
            np.maximum(seen, 0)[np.newaxis],
            np.maximum(targets, 0)[np.newaxis],
            geometries,
            lambda rgb: self.space.to_lab(rgb, self.wanted.illuminant),
            DEFAULT,
        )
        return float(roughness[0])

    def _convert(self, writer: Writer) -> Iterator[tuple[int, int]]:
        image, matrix = self._image, self._matrix.astype(np.float32)
        added = np.zeros(len(matrix))
        self._infeasible = self._outside = 0
        count = min(os.cpu_count() or 1, _MOST_THREADS)
        with ThreadPoolExecutor(count) as threads:  # numpy computes without Python's lock
            for first, last in self._blocks():
                values = image.read(first, last)
                rgb = np.empty((len(values), 3), np.float32)
                ends = np.linspace(0, len(values), count + 1).astype(int)
                parts = [slice(*each) for each in itertools.pairwise(ends)]
                counted = threads.map(
                    lambda part, values=values, rgb=rgb: self._part(
                        values[part], rgb[part], matrix
                    ),
                    [part for part in parts if part.start < part.stop],
                )
                for finite, share, infeasible, outside in counted:
                    if not finite:
                        self._check(values, first)
                    added += share
                    self._infeasible += infeasible
                    self._outside += outside
                writer.write(first, last, rgb.reshape(last - first, image.width, 3))
                yield last, image.height
        self._mean = added / (image.width * image.height)

    def _part(self, values: Pixels, out: Pixels, matrix: Pixels) -> tuple[bool, Array, int, int]:
        """Write RGB of pixels to `out`.

        Gives whether it is finite, the sum of the bands, and how many pixels are infeasible and
        how many outside.
        """
        out[:] = self._texture(values, matrix)
        infeasible = outside = 0
        bound = self._white * (1 + _ENOUGH)
        if float(values.max()) > bound:
            infeasible = int(np.count_nonzero((values > bound).any(axis=1)))
        lowest, highest = float(out.min()), float(out.max())
        if not (lowest >= -_ENOUGH and highest <= 1 + _ENOUGH):
            red, green, blue = ((out < -_ENOUGH) | (out > 1 + _ENOUGH)).T
            outside = int(np.count_nonzero(red | green | blue))
        added = total(values)
        return math.isfinite(lowest + highest), added, infeasible, outside

    def _blocks(self) -> Iterator[tuple[int, int]]:
        image = self._image
        lines = max(_NUMBERS_AT_ONCE // (image.width * len(self._matrix)), 1)
        lines = max(lines // image.lines, 1) * image.lines
        for first in range(0, image.height, lines):
            yield first, min(first + lines, image.height)

    def _albedo(self, values: Any) -> Any:
        wanted = self.wanted
        return reading.to_albedo(values, wanted.sigma, wanted.model, wanted.instrument)

    def _texture(self, values: Pixels, matrix: Pixels) -> Pixels:
        wanted = self.wanted
        if wanted.holds == "albedo":
            return times(self._albedo(values), matrix)
        if wanted.instrument != DEFAULT:
            values = reading.from_albedo(self._albedo(values), wanted.sigma, wanted.model, DEFAULT)
        return cycles.color_for_reading(times(values, matrix), np.float32(self._roughness), DEFAULT)

    def _check(self, values: Pixels, first: int) -> None:
        """Refuse the first pixel of a block that is no reflectance.

        Raises
        ------
        InputError
            If there is one.
        """
        with np.errstate(invalid="ignore"):
            wrong = ~np.isfinite(self._albedo(values))
        if not wrong.any():
            return
        pixel, band = (int(place) for place in np.argwhere(wrong)[0])
        line, column = divmod(pixel, self._image.width)
        names = self._image.names
        name = names[self._bands[band]] if self._nm.size else names[band]
        value = float(values[pixel, band])
        what = "is not a number" if math.isnan(value) else f"is {value:g}"
        raise self._image.fault(
            f"has no reflectance at pixel {column}, {first + line}: {name!r} {what} there; fill "
            "such pixels, or crop the image to where it was measured"
        )

    def _told(self) -> dict[str, str | float]:
        wanted = self.wanted
        return {
            "holds": wanted.holds,
            "source": self._image.path.name,
            "instrument": wanted.instrument,
            "illuminant": wanted.illuminant,
            "model": wanted.model,
            "workingSpace": self.space.name,
            "sigmaDegrees": round(math.degrees(wanted.sigma), 6),
            "cyclesRoughness": self._roughness,
        }

    def _result(self) -> Made:
        image, wanted = self._image, self.wanted
        count = image.width * image.height
        mean, notes = None, list(image.notes)
        if self._nm.size:
            order = np.argsort(self._nm)
            mean = Sample(
                name=image.path.stem,
                wavelengths=self._nm[order],
                values=self._mean[order],
                kind="reading",
                instrument=wanted.instrument,
                sigma_degrees=round(math.degrees(wanted.sigma), 6),
                source=str(image.path),
                altered=(f"Mean of {count} pixels.",),
            )
        else:
            notes.append(
                "The image is RGB, so each channel was taken for a band: exact for gray, near for "
                "colors."
            )
        infeasible, outside = self._infeasible / count, self._outside / count
        if infeasible:
            notes.append(
                f"{_percent(infeasible)} of the pixels read more than white facets at "
                f"σ = {math.degrees(wanted.sigma):.1f}°, as gloss or too large a σ do; their "
                "albedo is above 1."
            )
        if outside:
            notes.append(
                f"{_percent(outside)} of the pixels lie outside 0 to 1 in {self.space.name}; they "
                "are kept as they are."
            )
        return Made(
            self.target,
            wanted,
            image.width,
            image.height,
            self._roughness,
            mean,
            infeasible,
            outside,
            tuple(notes),
        )


def _percent(share: float) -> str:
    """Write a share so that few are not none."""
    return f"{share:.1%}" if share >= 0.001 else "under 0.1%"
