# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read what goniometers found of matte materials, from files that the project does not ship.

Two kinds: points as NIST publishes them (PTFE.data.csv of Germer 2017), and networks fitted to
measured BRDFs (Neural-BRDF's zips of RGL, MERL and Nielsen's data), which take the half vector and
the difference vector of Rusinkiewicz's parameters and give a BRDF in red, green and blue. Of these
the mean is taken: in the dark bands of saturated colors the networks themselves are uncertain.
Networks need h5py.
"""

from __future__ import annotations

import importlib
import io
import itertools
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from core.numerics.arrays import Array

STEEPEST = np.radians(60.0)
"""Beyond, networks were fitted to few or no points."""
_ROUNDED = 1e-3
"""Radians by which angles in files miss round numbers."""

POINTS = ("PTFE.data.csv", "PTFE.data.random.csv")
POINTS_HEAD = ("lambda", "thetai", "phi", "thetar", "phir", "f_r11")

NETWORKS = {
    "rgl-isotropic.zip": (
        "paper_white_rgb", "paper_yellow_rgb", "paper_red_rgb", "paper_green_rgb", "paper_blue_rgb",
        "acrylic_felt_white_rgb", "acrylic_felt_yellow_rgb", "acrylic_felt_orange_rgb",
        "acrylic_felt_pink_rgb", "acrylic_felt_purple_rgb", "acrylic_felt_green_rgb",
        "cardboard_rgb", "spectralon_rgb", "laika_ceiling_paint_18_gray_rgb",
    ),
    "merl.zip": ("polyurethane-foam", "pink-felt", "white-diffuse-bball"),
    "nielsen.zip": ("cardboard", "yellowpaper", "greencloth"),
}  # fmt: skip
"""The matte ones: papers, felts, cardboard, cloth, foam, a ball, ceiling paint, Spectralon."""

_LAYERS = ("dense_1", "dense_2", "dense_3")


class GoniometerError(Exception):
    """A path or file that can't be used; the message is one sentence for whoever gave it."""


@dataclass(frozen=True, eq=False)
class Material:
    """What was measured of one material.

    Attributes
    ----------
    name, source
        What and whose.
    angles
        θi, θr and Δφ (0 is toward the light), radians, shape (3, directions).
    factor
        Reflectance factor π f, shape (directions,).
    """

    name: str
    source: str
    angles: Array
    factor: Array

    def toward_light(self) -> Material:
        """Keep the directions on the light's side, Δφ ≤ 90°."""
        near = self.angles[2] <= np.pi / 2 + _ROUNDED
        return Material(self.name, self.source, self.angles[:, near], self.factor[near])


def load(folder: Path) -> list[Material]:
    """Read all materials of a folder.

    Raises
    ------
    GoniometerError
        If it holds none of the files, one is damaged, or h5py is missing for networks.
    """
    if not folder.is_dir():
        raise GoniometerError(f"{folder} is no folder: give the one with {_wanted()}.")
    found: list[Material] = []
    for name in NETWORKS:
        if (folder / name).is_file():
            found += networks(folder / name)
    for name in POINTS:
        if (folder / name).is_file():
            found.append(points(folder / name))
    if not found:
        raise GoniometerError(f"{folder} holds none of {_wanted()}: docs/chart.md says where from.")
    return found


def _wanted() -> str:
    return ", ".join((*NETWORKS, *POINTS))


def points(path: Path, wavelength: float | None = None) -> Material:
    """Read NIST's points up to 60°, of the wavelength nearest to 0.55 µm unless one is named.

    Raises
    ------
    GoniometerError
        If a column is missing, a cell is no number or no point is left.
    """
    try:
        with path.open(encoding="utf-8") as lines:
            names = next(lines, "").strip().split(",")
            columns = [names.index(name) for name in POINTS_HEAD]
            table = np.loadtxt(lines, delimiter=",", usecols=columns, ndmin=2)
    except (OSError, UnicodeDecodeError, ValueError) as error:
        raise GoniometerError(
            f"{path.name} is no table of points with the columns {', '.join(POINTS_HEAD)}: {error}."
        ) from error
    if not table.size:
        raise GoniometerError(f"{path.name} holds no points.")
    bands = np.unique(table[:, 0])
    band = bands[np.abs(bands - (wavelength or 0.55)).argmin()]
    table = table[table[:, 0] == band]
    light, azimuth, view, other = np.radians(table[:, 1:5]).T
    # φr = 180° is away from the light where θi > 0; a negative θi is the other side of the normal.
    turned = other - azimuth + np.pi * ((light < 0) != (view < 0))
    apart = np.abs((turned + np.pi) % (2 * np.pi) - np.pi)
    light, view = np.abs(light), np.abs(view)
    kept = (np.maximum(light, view) <= STEEPEST + _ROUNDED) & (table[:, 5] > 0)
    if not kept.any():
        raise GoniometerError(f"{path.name} holds no points below 60°.")
    angles = np.stack((light, view, apart))[:, kept]
    name = f"sintered PTFE{', random directions' if 'random' in path.name else ''}"
    title = f"{name} at {band * 1000:.0f} nm"
    return Material(title, "NIST", angles, np.pi * table[kept, 5])


def networks(path: Path) -> list[Material]:
    """Read the matte materials of one zip of networks, asked every 10° and 15°.

    Raises
    ------
    GoniometerError
        If h5py is missing, the zip is damaged or a network is not in it.
    """
    try:
        h5py = importlib.import_module("h5py")
    except ImportError as error:
        raise GoniometerError(
            f"{path.name} holds networks in HDF5: install h5py into the Python that runs this."
        ) from error
    source = {"r": "RGL", "m": "MERL", "n": "Nielsen"}[path.name[0]]
    angles = grid()
    found = []
    try:
        with zipfile.ZipFile(path) as packed:
            members = {Path(name).stem: name for name in packed.namelist() if name[-3:] == ".h5"}
            for name in NETWORKS[path.name]:
                with h5py.File(io.BytesIO(packed.read(members[name])), "r") as stored:
                    layers = [_layer(stored, layer) for layer in _LAYERS]
                factor = np.pi * network(layers, rusinkiewicz(angles)).mean(axis=-1)
                title = name.removesuffix("_rgb").replace("_", " ").replace("-", " ")
                found.append(Material(title, source, angles, factor))
    except (zipfile.BadZipFile, KeyError, OSError, ValueError) as error:
        raise GoniometerError(f"{path.name} is no zip of networks as expected: {error}.") from error
    return found


def _layer(stored: Any, name: str) -> tuple[Array, Array]:
    of = stored[name][name]
    return np.asarray(of["kernel:0"], np.float64), np.asarray(of["bias:0"], np.float64)


def grid() -> Array:
    """θi and θr to 60°, Δφ to 180°, radians, shape (3, directions)."""
    polar = np.radians(np.arange(0.0, 61.0, 10.0))
    azimuth = np.radians(np.arange(0.0, 181.0, 15.0))
    return np.array(list(itertools.product(polar, polar, azimuth))).T


def rusinkiewicz(angles: Array) -> Array:
    """Half vector and difference vector of directions (3, n), shape (n, 6).

    S. Rusinkiewicz, "A New Change of Variables for Efficient BRDF Representation" (1998). The
    half vector's azimuth is turned away, as in the data, which are isotropic.
    """
    theta_i, theta_r, azimuth = angles
    light = _vector(theta_i, np.zeros_like(azimuth))
    view = _vector(theta_r, azimuth)
    half = light + view
    half /= np.linalg.norm(half, axis=0)
    turn = np.arctan2(half[1], half[0])
    lean = np.arccos(np.clip(half[2], -1, 1))
    x = np.cos(turn) * light[0] + np.sin(turn) * light[1]
    y = np.cos(turn) * light[1] - np.sin(turn) * light[0]
    difference = np.stack(
        (np.cos(lean) * x - np.sin(lean) * light[2], y, np.sin(lean) * x + np.cos(lean) * light[2])
    )
    upright = _vector(lean, np.zeros_like(lean))
    return np.concatenate((upright, difference)).T


def _vector(polar: Array, azimuth: Array) -> Array:
    sine = np.sin(polar)
    return np.stack((sine * np.cos(azimuth), sine * np.sin(azimuth), np.cos(polar)))


def network(layers: list[tuple[Array, Array]], inputs: Array) -> Array:
    """Evaluate 6 → 21 → 21 → 3 with relu between, then exp(x) - 1: a BRDF, shape (n, 3)."""
    values = inputs
    for kernel, bias in layers[:-1]:
        values = np.maximum(values @ kernel + bias, 0)
    kernel, bias = layers[-1]
    return np.expm1(values @ kernel + bias)
