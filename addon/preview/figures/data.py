# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that figures show: the target from a request, Blender from color and roughness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....core import cycles
from ....core.cycles import instrument_lobe
from ....core.gloss import Gloss
from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized
from ...colorimetry import srgb, tristimulus
from ...colorimetry.rgb_space import WorkingSpace, matrix_of
from ...matching import glossy, scene_match, surface_spectra
from ...matching.assess import in_directions, under_main_light
from ...matching.request import Request
from ..drawing.raster import Color
from . import LIGHT_ANGLE, SHOWN_NM, STEEPEST

VIEW_ANGLES = np.linspace(-STEEPEST, STEEPEST, 65)
"""Degrees in the plane of incidence, negative on the side of the light."""

_VIEW = np.radians(np.abs(VIEW_ANGLES))
_DIRECTIONS = (
    np.full(_VIEW.shape, np.radians(LIGHT_ANGLE)),
    _VIEW,
    np.where(VIEW_ANGLES < 0, 0.0, np.pi),
)
"""Polar angles of light and view, and the azimuth between them, radians."""

_OUTSIDE = 0.002
"""How far display-encoded values may leave 0 to 1 before a color counts as outside of the gamut:
half of what the screen resolves."""

_GRID = np.arange(SHOWN_NM[0], SHOWN_NM[1] + 1, 5.0)
_LEAST_WEIGHT = 0.02
"""Share of a channel's largest weight from where on its bar begins."""


@dataclass(frozen=True, eq=False)
class Patch:
    """A color as the screen shows it: display-encoded sRGB, and whether that had to be clipped."""

    color: Color
    outside: bool


@dataclass(frozen=True, eq=False)
class Data:
    """Numbers of all figures of one material.

    Parameters
    ----------
    target, blender
        Colors of the reading: wanted, and in Blender.
    wavelengths, albedo, reading
        Nanometers and fractions, shape (bands,); the reading is the virtual instrument's.
    open_albedos
        Lowest and highest albedo, each (bands,), that the sample's reading leaves open while σ is
        unknown; None where there is no such range.
    bars
        First and last wavelength, and value, of Blender's blue, green and red.
    view
        `VIEW_ANGLES`.
    target_curve, blender_curve, lambert
        Luminance factors there, shape (angles,), and the Lambertian one.
    sigma, sigma_max
        Degrees; None where every σ fits the reading.
    engine
        What draws for Blender.
    color, roughness, gloss
        What is drawn: scene-linear RGB, shape (3,), Cycles' diffuse roughness, and what lies over.
    to_screen
        Matrix from scene-linear RGB to linear sRGB, (3, 3).
    """

    target: Patch
    blender: Patch
    wavelengths: Array
    albedo: Array
    reading: Array
    bars: tuple[tuple[float, float, float], ...]
    view: Array
    target_curve: Array
    blender_curve: Array
    lambert: float
    sigma: float
    sigma_max: float | None
    engine: str
    color: Array
    roughness: float
    gloss: Gloss | None
    to_screen: Array
    open_albedos: tuple[Array, Array] | None = None


def of_request(
    request: Request, color: Array, roughness: float, space: WorkingSpace, engine: str = "Cycles"
) -> Data:
    """Compute what figures show.

    Parameters
    ----------
    request
        With a settled model.
    color, roughness
        What the shader node shows: color of shape (3,).
    space
        The working space that the color is in.
    engine
        What draws for Blender.

    Raises
    ------
    DomainError
        If the spectrum does not cover the visible range.
    """
    sample, light = request.sample, request.illuminant
    bands = sample.wavelengths
    weights = space.rgb_weights(bands, light)
    luminance = tristimulus.weights(bands, light)[:, 1]
    seen, rho = spectra_of(request)
    everywhere = instrument_lobe.with_directions(_DIRECTIONS, request.read_at)
    # The instrument comes last.
    shown = cycles.reflected(color, cycles.lobe(np.asarray(roughness, float), *everywhere))
    if request.gloss is not None:
        layer, _ = glossy.with_instrument(request.gloss, _DIRECTIONS, request.read_at)
        shown = layer.over(shown)
    shown, at_instrument = shown[:-1], shown[-1]
    target, blender = seen @ weights, at_instrument
    curve = space.to_xyz(shown, light)[:, 1]
    if request.scene is not None:
        main = request.scene.lights[0]
        target, blender = under_main_light(request.scene, seen, bands, blender, space)
        luminance = main.weights(bands)[:, 1]
        curve = scene_match.to_xyz(shown, main, space)[:, 1]
    targets = in_directions(request, rho, _DIRECTIONS)
    target_curve = np.maximum(targets @ luminance, 0)
    if request.gloss is not None:
        rgb = glossy.target(
            request.gloss, seen @ weights, targets @ weights, _DIRECTIONS, request.read_at
        )
        if request.scene is None:
            target_curve = space.to_xyz(rgb, light)[:, 1]
        else:
            target_curve = scene_match.to_xyz(rgb, request.scene.lights[0], space)[:, 1]
    wanted, shown_there = patches(np.array((target, blender)), space)
    return Data(
        target=wanted,
        blender=shown_there,
        wavelengths=bands,
        albedo=rho,
        reading=seen,
        bars=rgb_bars(at_instrument, space, light),
        view=VIEW_ANGLES,
        target_curve=target_curve,
        blender_curve=curve,
        lambert=float(seen @ luminance),
        sigma=float(np.degrees(request.sigma)),
        sigma_max=surface_spectra.sigma_max(request),
        engine=engine,
        color=color,
        roughness=roughness,
        gloss=request.gloss,
        to_screen=to_screen(space.key),
        open_albedos=surface_spectra.open_albedos(request),
    )


def patch(rgb: Array, space: WorkingSpace) -> Patch:
    """Show a scene-linear color as sRGB: the color itself, without the scene's view transform."""
    [found] = patches(rgb[np.newaxis], space)
    return found


def patches(colors: Array, space: WorkingSpace) -> list[Patch]:
    """Show several, (colors, 3), as `patch` does one."""
    encoded = srgb.encode(colors @ to_screen(space.key).T)
    shown = np.minimum(np.maximum(encoded, 0), 1)
    outside = np.abs(encoded - shown).max(axis=-1) > _OUTSIDE
    return [
        Patch((red, green, blue), beyond)
        for (red, green, blue), beyond in zip(shown.tolist(), outside.tolist(), strict=True)
    ]


def to_screen(key: bytes) -> Array:
    """Matrix from scene-linear RGB to linear sRGB."""
    return srgb.from_xyz(np.ones(3), of=np.linalg.inv(matrix_of(key)))


def rgb_bars(
    rgb: Array, space: WorkingSpace, illuminant: str
) -> tuple[tuple[float, float, float], ...]:
    """Place the three numbers of a color over wavelength.

    Each stands over the wavelengths that its channel weighs more than the other two. No spectrum
    belongs to three numbers; for a gray one all three have its reflectance.
    """
    spans = _spans(space.key, illuminant)
    return tuple(
        (start, end, float(value)) for (start, end), value in zip(spans, rgb[::-1], strict=True)
    )


def spectra_of(request: Request) -> tuple[Array, Array]:
    """Give reading at the virtual instrument and albedo, each (bands,), as `target` matches."""
    [seen], [rho] = surface_spectra.readings_and_albedos([request])
    return seen, rho


@memoized(maxsize=16)
def _spans(key: bytes, illuminant: str) -> tuple[tuple[float, float], ...]:
    """First and last wavelength where blue, green and red weigh most."""
    space = WorkingSpace("", matrix_of(key))
    weights = space.rgb_weights(_GRID, illuminant)
    fine = np.arange(SHOWN_NM[0], SHOWN_NM[1] + 0.5)
    shares = np.stack([np.interp(fine, _GRID, weights[:, i]) for i in range(3)])
    found = []
    for channel in (2, 1, 0):
        own = shares[channel]
        ahead = (np.argmax(shares, axis=0) == channel) & (own > _LEAST_WEIGHT * own.max())
        peak = int(np.argmax(own))
        before = np.flatnonzero(~ahead[:peak])
        after = np.flatnonzero(~ahead[peak:])
        start = fine[before[-1] + 1] if before.size else fine[0]
        end = fine[peak + after[0] - 1] if after.size else fine[-1]
        found.append((float(start), float(end)))
    return tuple(found)
