# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Other lamps in a picture that was rendered once: spectrum and intensity of each, and observer.

What a lamp's light becomes on its way does not depend on its spectrum. So each lamp's light is
rendered apart, in bands in which it sends the same everywhere, and what lamps really send comes in
afterwards, as weights of the bands: a sum, and no render.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from ...core import bands
from ...core.color import color_difference
from ...core.errors import DomainError, InputError
from ...core.numerics.arrays import Array
from ..blender import working_space
from ..colorimetry import cie_tables, illuminant_spectra
from ..scene import light_spectra
from ..support import atomic_files
from .picture import SpectralPicture

ILLUMINANTS = ("D65", "A", "F11", "LED-B3")
"""What a table of metamerism is of, unless told otherwise."""
ENDING = ".npz"

_FORMAT = "rough-spectra-lights 1"
_FIELDS = {"names": 1, "spectra": 2, "parts": 4, "alpha": 2, "wavelengths": 1, "surfaces": 2}
"""Arrays in a file, and their dimensions."""


@dataclass(frozen=True, eq=False)
class Lights:
    """A picture in bands of each lamp's light.

    Parameters
    ----------
    names
        Of lamps, world and materials that shine.
    spectra
        That of each as it was, at `illuminant_spectra.GRID`, luminance 1, shape (lamps, n).
    parts
        Light of each in each band, as if it sent its luminance times 1 in all of them, float32,
        shape (lamps, bands, rows, columns), from the bottom up.
    alpha
        Shape (rows, columns).
    wavelengths
        Of the bands, nanometers.
    surfaces
        Albedos that stand for the scene's, shape (surfaces, n): weights are fitted to them.
    space
        Name of the working space.
    """

    names: tuple[str, ...]
    spectra: Array
    parts: Array
    alpha: Array
    wavelengths: Array
    surfaces: Array
    space: str

    def number(self, name: str) -> int:
        """Give the number of a lamp.

        Raises
        ------
        DomainError
            If there is none of this name.
        """
        if name not in self.names:
            msg = f"There is no light {name!r} in the picture; there are {', '.join(self.names)}."
            raise DomainError(msg)
        return self.names.index(name)

    def weights(self, spectrum: Array, observer: int = 2) -> tuple[Array, bands.Error]:
        """Fit weights from the bands to XYZ for a lamp, shape (bands, 3); white is exact.

        Parameters
        ----------
        spectrum
            At `illuminant_spectra.GRID`.
        observer
            2 or 10 degrees.
        """
        found = bands.at(
            illuminant_spectra.GRID,
            self.wavelengths,
            self.surfaces,
            np.asarray(spectrum, np.float64)[np.newaxis],
            illuminant_spectra.observer(observer),
        )
        return found.weights * found.lights.T, found.error


class Desk:
    """Where lamps are set: it keeps what each makes of the picture, so that a step is a sum.

    Parameters
    ----------
    lights
        What was rendered.
    observer
        2 or 10 degrees.
    """

    def __init__(self, lights: Lights, observer: int = 2) -> None:
        if observer not in cie_tables.OBSERVERS:
            msg = f"Observer {observer!r} is not known; choose 2 or 10 degrees."
            raise DomainError(msg)
        self.lights, self.observer = lights, observer
        self.spectra = list(lights.spectra)
        self.intensities = [1.0] * len(lights.names)
        self._xyz: list[Array | None] = [None] * len(lights.names)
        self._weights: list[tuple[Array, bands.Error] | None] = [None] * len(lights.names)

    def set_light(self, name: str, light: str | Array) -> None:
        """Give a lamp another spectrum; its luminance stays.

        Parameters
        ----------
        name
            Of the lamp.
        light
            A CIE illuminant, the path of a table (`light_spectra.find`), or a spectrum at
            `illuminant_spectra.GRID`.

        Raises
        ------
        DomainError, InputError
            If there is no such lamp, or no such light.
        """
        number = self.lights.number(name)
        spectrum = light_spectra.find(light)[0] if isinstance(light, str) else np.asarray(light)
        self.spectra[number] = spectrum / illuminant_spectra.to_xyz(spectrum)[1]
        self._xyz[number] = self._weights[number] = None

    def set_intensity(self, name: str, times: float) -> None:
        """Let a lamp shine so many times as it did.

        Raises
        ------
        DomainError
            If there is no such lamp, or the number is below 0.
        """
        if not 0 <= times < np.inf:
            msg = f"The intensity of {name!r} is {times:g}; give 0 or more."
            raise DomainError(msg)
        self.intensities[self.lights.number(name)] = float(times)

    def xyz(self) -> Array:
        """XYZ by the observer, float32, shape (3, rows, columns), from the bottom up."""
        _, _, rows, columns = self.lights.parts.shape
        total = np.zeros((3, rows * columns), np.float32)
        for number, times in enumerate(self.intensities):
            if times:
                part = self._of(number)
                total += part if times == 1 else np.float32(times) * part
        return total.reshape(3, rows, columns)

    def at(self, column: int, row: int, around: int = 1) -> Array:
        """XYZ of a pixel and those around it, mean, shape (3,).

        Raises
        ------
        DomainError
            If it is outside of the picture.
        """
        _, _, rows, columns = self.lights.parts.shape
        if not (0 <= column < columns and 0 <= row < rows):
            msg = f"There is no pixel {column}, {row} in a picture of {columns} × {rows}."
            raise DomainError(msg)
        across = slice(max(row - around, 0), row + around + 1)
        along = slice(max(column - around, 0), column + around + 1)
        found = np.zeros(3)
        for number, times in enumerate(self.intensities):
            bands_there = self.lights.parts[number][:, across, along].mean(axis=(1, 2))
            weights, _ = self._weighed(number)
            found += times * (bands_there.astype(np.float64) @ weights)
        return found

    def picture(self) -> SpectralPicture:
        """Give it as a spectral picture of the open file, without a comparison.

        Raises
        ------
        InputError
            If the open file works in another space than the picture's.
        """
        space = working_space.current()
        if space.name != self.lights.space:
            msg = (
                f"The lights were rendered in {self.lights.space!r} and the open file works in "
                f"{space.name!r}; open their file."
            )
            raise InputError(msg)
        xyz = np.moveaxis(self.xyz(), 0, -1).astype(np.float64)
        rgb = xyz @ illuminant_spectra.to_2_degrees(self.observer).T @ space.from_xyz.T
        errors = [self._weighed(number)[1] for number in range(len(self.spectra))]
        worst = max(errors, key=lambda error: error.usual)
        shown = np.concatenate((rgb, self.lights.alpha[..., np.newaxis]), axis=-1)
        return SpectralPicture(
            shown, xyz, self.observer, self.lights.wavelengths, False, worst, True, None, {}, {}, ()
        )

    def _weighed(self, number: int) -> tuple[Array, bands.Error]:
        found = self._weights[number]
        if found is None:
            found = self.lights.weights(self.spectra[number], self.observer)
            self._weights[number] = found
        return found

    def _of(self, number: int) -> Array:
        found = self._xyz[number]
        if found is None:
            weights, _ = self._weighed(number)
            part = self.lights.parts[number].reshape(len(weights), -1)
            found = self._xyz[number] = weights.T.astype(np.float32) @ part
        return found


def metamerism(
    desk: Desk,
    first: tuple[int, int],
    second: tuple[int, int],
    illuminants: Sequence[str] = ILLUMINANTS,
    around: int = 1,
) -> dict[str, float]:
    """Tell how far two places of the picture are apart with all lamps of one kind, then another.

    Parameters
    ----------
    desk
        With the lamps' intensities, and the observer.
    first, second
        Column and row of the places, from the bottom left.
    illuminants
        What all lamps are, as `Desk.set_light` takes it.
    around
        Pixels around each place that count as well.

    Returns
    -------
    ΔE00 under each, with white as a white surface of radiance 1 shows that light.
    """
    found = {}
    for name in illuminants:
        there = Desk(desk.lights, desk.observer)
        there.intensities = list(desk.intensities)
        for lamp in desk.lights.names:
            there.set_light(lamp, name)
        step = illuminant_spectra.GRID[1] - illuminant_spectra.GRID[0]
        white = there.spectra[0] @ illuminant_spectra.observer(desk.observer) * step
        pair = (there.at(*first, around), there.at(*second, around))
        labs = (color_difference.xyz_to_lab(each, white / white[1]) for each in pair)
        found[name] = float(color_difference.delta_e(*labs))
    return found


def set_all(desk: Desk, spectra: Mapping[str, str], intensities: Mapping[str, float]) -> None:
    """Set several lamps; see `Desk.set_light` and `Desk.set_intensity`."""
    for name, light in spectra.items():
        desk.set_light(name, light)
    for name, times in intensities.items():
        desk.set_intensity(name, times)


def write(lights: Lights, path: Path) -> None:
    """Keep what was rendered, whole or not at all.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    with atomic_files.publication() as publication, publication.stage(path).open("wb") as file:
        np.savez(
            file,
            format=np.array(_FORMAT),
            space=np.array(lights.space),
            names=np.array(lights.names),
            spectra=lights.spectra,
            parts=lights.parts,
            alpha=lights.alpha,
            wavelengths=lights.wavelengths,
            surfaces=lights.surfaces,
        )


def read(path: Path) -> Lights:
    """Read what `write` kept.

    Raises
    ------
    InputError
        If it is no such file.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            kept = {name: file[name] for name in (*_FIELDS, "format", "space")}
    except (OSError, ValueError, KeyError, EOFError, BadZipFile) as error:
        msg = f"{path} holds no lights of a picture ({error}); render them again."
        raise InputError(msg) from error
    shapes = {name: kept[name].shape for name in _FIELDS}
    lamps, count, rows, columns = shapes["parts"] if len(shapes["parts"]) == 4 else (0,) * 4
    grid = illuminant_spectra.GRID.size
    fits = (
        str(kept["format"]) == _FORMAT
        and all(len(shapes[name]) == dimensions for name, dimensions in _FIELDS.items())
        and shapes["names"] == (lamps,)
        and shapes["spectra"] == (lamps, grid)
        and shapes["alpha"] == (rows, columns)
        and shapes["wavelengths"] == (count,)
        and shapes["surfaces"][1] == grid
    )
    if not fits:
        msg = f"{path} holds no lights of a picture that fit together; render them again."
        raise InputError(msg)
    return Lights(
        tuple(str(name) for name in kept["names"]),
        kept["spectra"],
        kept["parts"],
        kept["alpha"],
        kept["wavelengths"],
        kept["surfaces"],
        str(kept["space"]),
    )
