# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Light sources as numbers: what falls from them on a point, before shadows. No Blender here.

The laws are those of Cycles, held to renders in the tests: watts of a point lamp spread over the
sphere, those of an area lamp over the half in front of it, a sun's strength is irradiance itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...core.numerics.arrays import Array

FAR = 1e9
"""Distance of what is infinitely far away."""


@dataclass(frozen=True)
class Sampled:
    """Directions from points towards a lamp, and what would come from there unhindered.

    Parameters
    ----------
    toward
        Unit vectors, shape (points, 3).
    distance
        To the lamp, shape (points,).
    irradiance
        In the lamp's own units of color, with the cosine at the surface, shape (points,).
    """

    toward: Array
    distance: Array
    irradiance: Array


class Source(Protocol):
    """Anything that sheds light."""

    def sample(self, points: Array, normals: Array, random: np.random.Generator) -> Sampled:
        """Choose one point of the lamp for each point of a surface."""
        ...


@dataclass(frozen=True)
class Bulb:
    """Point or spot lamp: a sphere that shines into all directions, or into a cone.

    `axis` is None for a point lamp; `outer` and `inner` are cosines of the cone's half angles.
    """

    center: Array
    radius: float
    axis: Array | None = None
    outer: float = -1.0
    inner: float = -1.0

    def sample(self, points: Array, normals: Array, random: np.random.Generator) -> Sampled:
        """Choose a point within the sphere."""
        shift = random.standard_normal(points.shape)
        shift /= np.linalg.norm(shift, axis=1, keepdims=True)
        toward, distance = _toward(points, self.center + self.radius * shift)
        irradiance = _cosine(toward, normals) / (4 * np.pi * distance**2)
        if self.axis is not None:
            along = -toward @ self.axis
            t = np.clip((along - self.outer) / max(self.inner - self.outer, 1e-6), 0, 1)
            irradiance *= t * t * (3 - 2 * t)
        return Sampled(toward, np.maximum(distance - self.radius, 0), irradiance)


@dataclass(frozen=True)
class Panel:
    """Area lamp: a rectangle or an ellipse that shines to one side.

    `half_u` and `half_v` reach from the center to the edges; `half_spread` is in radians.
    """

    center: Array
    half_u: Array
    half_v: Array
    normal: Array
    round: bool = False
    half_spread: float = np.pi / 2

    def sample(self, points: Array, normals: Array, random: np.random.Generator) -> Sampled:
        """Choose a point of the area."""
        u, v = random.uniform(-1, 1, (2, len(points), 1))
        if self.round:
            u, v = np.sqrt(np.abs(u)) * np.cos(np.pi * v), np.sqrt(np.abs(u)) * np.sin(np.pi * v)
        toward, distance = _toward(points, self.center + u * self.half_u + v * self.half_v)
        leaving = np.maximum(-toward @ self.normal, 0)
        irradiance = _cosine(toward, normals) * leaving / (np.pi * distance**2)
        if self.half_spread < np.pi / 2 - 1e-3:
            limit = np.tan(self.half_spread)
            tangent = np.sqrt(np.maximum(1 - leaving**2, 0)) / np.maximum(leaving, 1e-9)
            irradiance *= np.maximum(limit - tangent, 0) / (limit - self.half_spread)
        return Sampled(toward, distance, irradiance)


@dataclass(frozen=True)
class Sun:
    """Light from one direction, spread over a disk of `half_angle` radians."""

    toward: Array
    half_angle: float

    def sample(self, points: Array, normals: Array, random: np.random.Generator) -> Sampled:
        """Choose a direction within the disk."""
        shift = random.standard_normal(points.shape)
        shift -= (shift @ self.toward)[:, np.newaxis] * self.toward
        shift /= np.linalg.norm(shift, axis=1, keepdims=True)
        part = np.tan(self.half_angle) * np.sqrt(random.uniform(size=(len(points), 1)))
        toward = self.toward + part * shift
        toward /= np.linalg.norm(toward, axis=1, keepdims=True)
        return Sampled(toward, np.full(len(points), FAR), _cosine(toward, normals))


@dataclass(frozen=True)
class Dome:
    """Light from all around: the world.

    `radiance` is an equirectangular picture, shape (rows, columns), from the zenith down, whose
    middle column lies towards +X and whose right half towards -Y, as Cycles looks it up; one
    pixel for an even world. `turn` is the angle about Z by which it is turned. `xyz` is the
    picture's color, shape (rows, columns, 3), or None where all of it is of one color.
    """

    radiance: Array
    turn: float = 0.0
    xyz: Array | None = None

    def sample(self, points: Array, normals: Array, random: np.random.Generator) -> Sampled:
        """Choose half of the directions by the surface's cosine, half by the world's light.

        All by the cosine where the world is even.
        """
        rows, columns = self.radiance.shape
        count = len(points)
        toward = normals + _on_sphere(random.uniform(size=(2, count)))
        toward /= np.maximum(np.linalg.norm(toward, axis=1, keepdims=True), 1e-9)
        if self.radiance.size == 1:
            even = np.where(_cosine(toward, normals) > 0, np.pi * self.radiance.item(), 0.0)
            return Sampled(toward, np.full(count, FAR), even)
        middle = (np.arange(rows) + 0.5) * np.pi / rows
        solid = np.sin(middle)[:, np.newaxis] * (2 * np.pi**2 / (rows * columns))
        power = np.cumsum((self.radiance * solid).ravel())
        if not power[-1] > 0:
            return Sampled(toward, np.full(count, FAR), np.zeros(count))
        picked = np.searchsorted(power, random.uniform(0, power[-1], count))
        row, column = np.divmod(np.minimum(picked, power.size - 1), columns)
        by_light = random.uniform(size=count) < 0.5
        jitter = random.uniform(size=(2, count))
        cos = np.cos((row + jitter[0]) * np.pi / rows)
        azimuth = _azimuth((column + jitter[1]) / columns) + self.turn
        sin = np.sqrt(np.maximum(1 - cos**2, 0))
        bright = np.stack((sin * np.cos(azimuth), sin * np.sin(azimuth), cos), axis=-1)
        toward = np.where(by_light[:, np.newaxis], bright, toward)
        radiance = self.radiance[self.pixel(toward)]
        cosine = _cosine(toward, normals)
        density = 0.5 * cosine / np.pi + 0.5 * radiance / power[-1]
        irradiance = np.where(cosine > 0, radiance * cosine / np.maximum(density, 1e-30), 0)
        return Sampled(toward, np.full(count, FAR), irradiance)

    def pixel(self, toward: Array) -> tuple[Array, Array]:
        """Row and column that directions of shape (points, 3) look at."""
        rows, columns = self.radiance.shape
        polar = np.arccos(np.clip(toward[:, 2], -1, 1))
        turned = np.arctan2(toward[:, 1], toward[:, 0]) - self.turn
        across = (0.5 - turned / (2 * np.pi)) % 1.0
        row = np.minimum((polar / np.pi * rows).astype(int), rows - 1)
        column = np.minimum((across * columns).astype(int), columns - 1)
        return row, column


@dataclass(frozen=True)
class Glow:
    """Faces that emit: triangles of shape (triangles, 3, 3), which shine to both sides."""

    triangles: Array

    def sample(self, points: Array, normals: Array, random: np.random.Generator) -> Sampled:
        """Choose a triangle by its area, and a point of it."""
        first = self.triangles[:, 0]
        edges = self.triangles[:, 1:] - first[:, np.newaxis]
        across = np.cross(edges[:, 0], edges[:, 1])
        area = np.linalg.norm(across, axis=1) / 2
        total = np.cumsum(area)
        picked = np.searchsorted(total, random.uniform(0, total[-1], len(points)))
        picked = np.minimum(picked, len(area) - 1)
        u, v = random.uniform(size=(2, len(points), 1))
        u, v = np.where(u + v > 1, (1 - u, 1 - v), (u, v))
        toward, distance = _toward(
            points, first[picked] + u * edges[picked, 0] + v * edges[picked, 1]
        )
        facing = across[picked] / np.maximum(2 * area[picked], 1e-30)[:, np.newaxis]
        leaving = np.abs(np.einsum("ij,ij->i", toward, facing))
        irradiance = _cosine(toward, normals) * leaving * total[-1] / distance**2
        return Sampled(toward, distance, irradiance)


def _toward(points: Array, lamp: Array) -> tuple[Array, Array]:
    way = lamp - points
    distance = np.maximum(np.linalg.norm(way, axis=1), 1e-6)
    return way / distance[:, np.newaxis], distance


def _cosine(toward: Array, normals: Array) -> Array:
    return np.maximum(np.einsum("ij,ij->i", toward, normals), 0)


def _on_sphere(uniform: Array) -> Array:
    z = 2 * uniform[0] - 1
    azimuth = 2 * np.pi * uniform[1]
    radius = np.sqrt(np.maximum(1 - z * z, 0))
    return np.stack((radius * np.cos(azimuth), radius * np.sin(azimuth), z), axis=-1)


def _azimuth(across: Array) -> Array:
    """Azimuth of a place across an equirectangular picture, 0 at its left edge."""
    return np.asarray(np.pi - 2 * np.pi * across)
