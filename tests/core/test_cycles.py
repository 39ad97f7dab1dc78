# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The closed form of Cycles' Diffuse closure; tests/addon compares it with renders."""

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest

from core import cycles
from core.cycles import matching
from core.errors import DomainError

HALF_PI = math.pi / 2
ANGLES_45_0 = (math.pi / 4, 0.0, 0.0)


def random_lobes(count):
    rng = np.random.default_rng(2012)
    color = rng.uniform(0, 1, (count, 3))
    return color, (
        rng.uniform(0, 1, count),
        rng.uniform(0, math.radians(89), count),
        rng.uniform(0, math.radians(89), count),
        rng.uniform(0, 2 * math.pi, count),
    )


def exact(color, roughness, sin_cos_i, sin_cos_r, theta_i, theta_r, cos_phi):
    """Cycles' kernel/closure/bsdf_oren_nayar.h in its own order, with 40 digits."""
    pi = Decimal("3.1415926535897932384626433832795028841972")
    roughness, color = Decimal(roughness), Decimal(color)
    a = 1 / (pi + roughness * (pi / 2 - Decimal(2) / 3))
    b = roughness * a

    def g(sin, cos, theta):
        tail = sin / cos * (1 - sin**3)
        return sin * (theta - Decimal(2) / 3 - sin * cos) + Decimal(2) / 3 * tail

    cos_gamma = sin_cos_i[0] * sin_cos_r[0] * cos_phi + sin_cos_i[1] * sin_cos_r[1]
    t = cos_gamma - sin_cos_i[1] * sin_cos_r[1]
    if t > 0:
        t /= max(sin_cos_i[1], sin_cos_r[1])
    average = pi * a + b * (2 * pi - Decimal("5.6")) / 3
    seen = [pi * a + b * g(*pair, th) for pair, th in ((sin_cos_i, theta_i), (sin_cos_r, theta_r))]
    again = color**2 * average / (1 - color * (1 - average))
    again *= (1 - seen[0]) * (1 - seen[1]) / (1 - average)
    return color * (pi * (a + b * t) + again)


def sin_cos(theta):
    """Sine and cosine by their series, in the precision of the context."""
    sin = cos = Decimal(0)
    term = Decimal(1)
    for n in range(0, 60, 2):
        cos += term
        term = term * theta / (n + 1)
        sin += term
        term = -term * theta / (n + 2)
    return sin, cos


# Rendered with Blender 4.5 and 5.2, Cycles on the CPU: light at 45°, view along the normal.
@pytest.mark.parametrize(
    ("roughness", "rendered"),
    [(1.0, (0.15700, 0.41614, 0.74201)), (0.25, (0.18714, 0.47542, 0.78365))],
)
def test_readings_measured_in_cycles(roughness, rendered):
    found = cycles.reflectance([0.2, 0.5, 0.8], roughness, *ANGLES_45_0)
    np.testing.assert_array_equal(np.round(found, 5), rendered)


def test_formula_agrees_with_40_digits():
    colors, lobes = random_lobes(60)
    found = cycles.reflectance(colors, *lobes)
    with localcontext() as context:
        context.prec = 40
        for row, color, *lobe in zip(found, colors, *lobes, strict=True):
            s, light, view, phi = (Decimal(float(x)) for x in lobe)
            pairs = sin_cos(light), sin_cos(view)
            for channel in range(3):
                expected = exact(float(color[channel]), s, *pairs, light, view, sin_cos(phi)[1])
                # At the steepest, 1 - E of two directions are differences of nearly equal
                # numbers, each known to some ten roundings.
                assert row[channel] == pytest.approx(float(expected), rel=5e-14, abs=1e-17)


def test_smooth_lobe_is_lambertian_everywhere():
    colors, lobes = random_lobes(100)
    np.testing.assert_allclose(cycles.reflectance(colors, 0.0, *lobes[1:]), colors, rtol=3e-16)


@pytest.mark.parametrize("roughness", [0.01, 0.3, 1.0])
@pytest.mark.parametrize("theta", [0.0, 0.5, 1.0, 1.4, HALF_PI])
def test_white_lobe_reflects_all_light(roughness, theta):
    """In a white furnace: the hemisphere's integral over the view, by Gauss-Legendre."""
    node, weight = np.polynomial.legendre.leggauss(80)
    # sin² θr is uniform under cosine weighting, and the substitution u² smooths the rim.
    u, u_weight = (node + 1) / 2, weight / 2
    theta_r = np.arcsin(np.sqrt(1 - u**2))[:, np.newaxis]
    phi = np.pi * (np.arange(4000) + 0.5) / 4000
    r = cycles.reflectance([1.0], roughness, theta, theta_r, phi)[..., 0].mean(axis=1)
    energy = float((2 * u * u_weight * r).sum())
    # Cycles rounds the average of G to (2π - 5.6)/3: exact would be (2π - 5.6075…)/3, which
    # changes 1 - Ē by half a percent and the whole by at most that of the multiple scattering.
    assert energy == pytest.approx(1, abs=2e-3 * roughness)


def test_light_and_view_can_be_swapped():
    colors, (roughness, light, view, phi) = random_lobes(100)
    np.testing.assert_allclose(
        cycles.reflectance(colors, roughness, light, view, phi),
        cycles.reflectance(colors, roughness, view, light, -phi),
        rtol=1e-15,
    )


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_grazing_and_normal_are_finite(dtype):
    limits = np.array([0, HALF_PI / 2, np.nextafter(dtype(HALF_PI), dtype(0)), HALF_PI], dtype)
    light, view, phi, roughness = np.meshgrid(
        limits, limits, np.array([0, 1, np.pi], dtype), np.array([0, 1e-6, 1], dtype)
    )
    color = np.array([0, 1e-6, 0.5, 1], dtype)
    r = cycles.reflectance(color, roughness, light, view, phi)
    assert r.dtype == dtype
    assert np.isfinite(r).all()
    # -1e-6: with both directions grazing and opposite, π (a - b) + … is 0 at s = 1 by design.
    assert r.min() >= -1e-6
    np.testing.assert_array_equal(r[..., 0], 0)


def test_float32_agrees_with_float64():
    colors, lobes = random_lobes(500)
    singles = [x.astype(np.float32) for x in lobes]
    found = cycles.reflectance(colors.astype(np.float32), *singles)
    wide = [x.astype(np.float64) for x in singles]
    expected = cycles.reflectance(colors.astype(np.float32).astype(np.float64), *wide)
    # 20 float32 roundings of terms up to 1; relative to color, since opposite grazing cancels.
    assert np.max(np.abs(found - expected) / colors) < 20 * np.finfo(np.float32).eps


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("color_shape", [(3,), (1, 3), (2, 1, 3), (5,)])
@pytest.mark.parametrize("lobe_shape", [(), (4,), (1, 4)])
def test_precision_and_broadcasting(dtype, color_shape, lobe_shape):
    color = np.full(color_shape, 0.5, dtype)
    for roughness in (0.5, np.float64(0.5), np.full(lobe_shape, 0.5)):
        r = cycles.reflectance(color, roughness, np.full(lobe_shape, 0.2), 0.3, 0.4)
        assert r.dtype == dtype
        assert r.shape == (*np.broadcast_shapes(color_shape[:-1], lobe_shape), color_shape[-1])
    back = matching.color_for_reading(color, np.full(lobe_shape, 0.5))
    assert back.dtype == dtype
    assert back.shape == (*np.broadcast_shapes(color_shape[:-1], lobe_shape), color_shape[-1])


def test_nothing_in_gives_nothing_out():
    assert cycles.reflectance(np.zeros((0, 3)), 0.5, 0.1, 0.2, 0.3).shape == (0, 3)
    assert cycles.reflectance([0.1, 0.2, 0.3], 0.5, np.zeros(0), 0.2, 0.3).shape == (0, 3)
    assert cycles.reflectance(np.zeros((2, 0)), 0.5, 0.1, 0.2, 0.3).shape == (2, 0)
    assert matching.color_for_reading(np.zeros((0, 3)), 0.5).shape == (0, 3)


def test_nan_stays_where_it_was():
    color = np.array([[0.1, np.nan, 0.3]])
    roughness = np.array([0.5, np.nan, 0.5, 0.5])
    light = np.array([0.5, 0.5, np.nan, 0.5])
    r = cycles.reflectance(color, roughness, light, 0.3, 0.4)
    expected = np.array([False, True, True, False])[:, np.newaxis] | np.isnan(color)
    np.testing.assert_array_equal(np.isnan(r), expected)
    back = matching.color_for_reading(color, roughness)
    np.testing.assert_array_equal(
        np.isnan(back), np.isnan(roughness)[:, np.newaxis] | np.isnan(color)
    )


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((1.2, 0, 0, 0), "Cycles' diffuse roughness holds 1.2; it runs from 0 to 1 and is not σ."),
        ((-0.1, 0, 0, 0), "Cycles' diffuse roughness holds -0.1; it runs from 0 to 1"),
        ((0.5, 45, 0, 0), "theta_i holds 45 rad (2578°), outside 0 to π/2"),
        ((0.5, 0, -1, 0), "theta_r holds -1 rad (-57.3°), outside 0 to π/2"),
    ],
)
def test_bad_arguments_are_refused_in_a_sentence(arguments, sentence):
    with pytest.raises(DomainError) as caught:
        cycles.reflectance([0.5, 0.5, 0.5], *arguments)
    assert str(caught.value).startswith(sentence)
