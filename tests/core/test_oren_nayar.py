# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The functional model, against the paper's equations 30 and 31 written out number by number."""

import math

import numpy as np
import pytest

from core import oren_nayar
from core.errors import DomainError

HALF_PI = math.pi / 2
GRAZING = math.radians(89.9)


def paper(theta_i, theta_r, delta_phi, sigma):
    """Coefficients of ρ and ρ² as Oren and Nayar (SIGGRAPH 1994) print them, one number a time."""
    s2 = sigma * sigma
    alpha, beta = max(theta_i, theta_r), min(theta_i, theta_r)
    c1 = 1 - 0.5 * s2 / (s2 + 0.33)
    if math.cos(delta_phi) >= 0:
        c2 = 0.45 * s2 / (s2 + 0.09) * math.sin(alpha)
    else:
        c2 = 0.45 * s2 / (s2 + 0.09) * (math.sin(alpha) - (2 * beta / math.pi) ** 3)
    c3 = 0.125 * (s2 / (s2 + 0.09)) * (4 * alpha * beta / math.pi**2) ** 2
    first = (
        c1
        + math.cos(delta_phi) * c2 * math.tan(beta)
        + (1 - abs(math.cos(delta_phi))) * c3 * math.tan((alpha + beta) / 2)
    )
    second = 0.17 * s2 / (s2 + 0.13) * (1 - math.cos(delta_phi) * (2 * beta / math.pi) ** 2)
    return first, second


def random_geometries(count):
    rng = np.random.default_rng(1994)
    return (
        rng.uniform(0, GRAZING, count),
        rng.uniform(0, GRAZING, count),
        rng.uniform(-2 * math.pi, 2 * math.pi, count),
        rng.uniform(0, HALF_PI, count),
    )


def test_factors_are_the_papers_equations():
    geometries = random_geometries(500)
    expected = np.array([paper(*map(float, row)) for row in zip(*geometries, strict=True)])
    # 1e-13: a few roundings of sums whose terms, with tan(89.9°), are up to 300.
    np.testing.assert_allclose(np.array(oren_nayar.factors(*geometries)).T, expected, 1e-13, 1e-13)


def test_reflectance_is_the_papers_sum_at_every_band():
    geometries = random_geometries(40)
    rho = np.linspace(0, 1, 11)
    expected = [
        [first * band + second * band * band for band in rho]
        for first, second in (paper(*map(float, row)) for row in zip(*geometries, strict=True))
    ]
    np.testing.assert_allclose(
        oren_nayar.reflectance(rho, *geometries), expected, rtol=1e-12, atol=1e-13
    )


def test_light_and_view_can_be_swapped():
    theta_i, theta_r, delta_phi, sigma = random_geometries(100)
    np.testing.assert_array_equal(
        oren_nayar.factors(theta_i, theta_r, delta_phi, sigma),
        oren_nayar.factors(theta_r, theta_i, delta_phi, sigma),
    )


def test_azimuth_is_even_and_has_no_meaning_along_the_normal():
    theta_i, theta_r, delta_phi, sigma = random_geometries(100)
    np.testing.assert_array_equal(
        oren_nayar.factors(theta_i, theta_r, delta_phi, sigma),
        oren_nayar.factors(theta_i, theta_r, -delta_phi, sigma),
    )
    around = np.linspace(0, 2 * math.pi, 25)
    for f in oren_nayar.factors(0.7, 0.0, around, 0.5):
        assert np.ptp(f) == 0
    for f in oren_nayar.factors(0.0, 0.7, around, 0.5):
        assert np.ptp(f) == 0


def test_smooth_surface_is_lambertian_everywhere():
    angles = np.linspace(0, math.radians(89), 12)
    theta_i, theta_r, phi = np.meshgrid(angles, angles, np.linspace(0, math.pi, 7))
    f1, f2 = oren_nayar.factors(theta_i, theta_r, phi, 0.0)
    np.testing.assert_array_equal(f1, 1.0)
    np.testing.assert_array_equal(f2, 0.0)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_grazing_light_stays_finite_with_the_sign_of_the_paper(dtype):
    half_pi = np.array([math.pi / 2], dtype)
    f1, f2 = oren_nayar.factors(half_pi, np.array([0.3], dtype), np.array([0.0], dtype), 0.5)
    expected = paper(math.pi / 2, float(np.float32(0.3)) if dtype == np.float32 else 0.3, 0, 0.5)
    assert f1.dtype == f2.dtype == dtype
    np.testing.assert_allclose([f1[0], f2[0]], expected, rtol=8 * np.finfo(dtype).eps)
    # float32's π/2 lies beyond π/2, where the tangent is negative.
    grazing, _ = oren_nayar.factors(half_pi, half_pi, np.array([0.0], dtype), 0.5)
    assert np.isfinite(grazing[0])
    assert grazing[0] > 1e5


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("shape", [(), (1,), (4, 3)])
def test_precision_and_shape_of_factors_are_as_given(dtype, shape):
    for f in oren_nayar.factors(*(np.full(shape, x, dtype) for x in (0.3, 0.4, 2.0, 0.5))):
        assert f.dtype == dtype
        assert f.shape == shape
    # Python numbers adapt to the array beside them.
    for f in oren_nayar.factors(0.3, 0.4, 2.0, np.full(shape, 0.5, dtype)):
        assert f.dtype == dtype


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("rho_shape", [(5,), (1, 5), (2, 1, 5)])
@pytest.mark.parametrize("geometry_shape", [(), (7,), (1, 7)])
def test_reflectance_broadcasts_materials_geometries_and_bands(dtype, rho_shape, geometry_shape):
    rho = np.linspace(0.05, 0.95, math.prod(rho_shape)).reshape(rho_shape).astype(dtype)
    angle = np.full(geometry_shape, 0.6)
    r = oren_nayar.reflectance(rho, angle, 0.4, 1.0, 0.5)
    leading = np.broadcast_shapes(rho_shape[:-1], geometry_shape)
    assert r.dtype == dtype
    assert r.shape == (*leading, 5)
    first, second = paper(0.6, 0.4, 1.0, 0.5)
    wide = np.broadcast_to(rho, r.shape).astype(float)
    np.testing.assert_allclose(r, first * wide + second * wide**2, rtol=20 * np.finfo(dtype).eps)


@pytest.mark.parametrize(
    ("rho_shape", "geometry_shape", "shape"),
    [
        ((0,), (), (0,)),
        ((0,), (3,), (3, 0)),
        ((5,), (0,), (0, 5)),
        ((0, 5), (), (0, 5)),
        ((2, 1, 5), (0,), (2, 0, 5)),
    ],
)
def test_nothing_in_gives_nothing_out(rho_shape, geometry_shape, shape):
    r = oren_nayar.reflectance(np.zeros(rho_shape), np.zeros(geometry_shape), 0.1, 0.2, 0.3)
    assert r.shape == shape


@pytest.mark.parametrize("many_spectra", [False, True])
def test_nan_stays_where_it_was(many_spectra):
    rho = np.array([0.1, np.nan, 0.3])
    if many_spectra:
        rho = np.stack((rho, [0.1, 0.2, 0.3]))[:, np.newaxis]
    angle = np.array([0.2, np.nan, 0.4, 0.5])
    r = oren_nayar.reflectance(rho, angle, 0.3, 0.4, 0.5)
    np.testing.assert_array_equal(np.isnan(r), np.isnan(angle)[:, np.newaxis] | np.isnan(rho))
    for position in range(4):
        arguments = [np.full(3, x) for x in (0.2, 0.3, 2.5, 0.5)]
        arguments[position][1] = np.nan
        f1, f2 = oren_nayar.factors(*arguments)
        np.testing.assert_array_equal(np.isnan(f1), [False, True, False])
        assert not np.isnan(f2[[0, 2]]).any()


def test_black_reflects_nothing_and_white_what_the_factors_say():
    geometries = random_geometries(50)
    r = oren_nayar.reflectance(np.array([0.0, 1.0]), *geometries)
    np.testing.assert_array_equal(r[:, 0], 0)
    np.testing.assert_allclose(r[:, 1], np.sum(oren_nayar.factors(*geometries), axis=0), 1e-15)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((45.0, 0.0, 0.0, 0.3), "theta_i holds 45 rad (2578°), outside 0 to π/2; angles are"),
        ((0.0, -0.1, 0.0, 0.3), "theta_r holds -0.1 rad (-5.73°), outside 0 to π/2; angles are"),
        ((0.0, 0.0, 0.0, 15.0), "the roughness sigma holds 15 rad (859.4°), outside 0 to π/2;"),
        ((0.0, 0.0, 0.0, [0.1, -1e-9]), "the roughness sigma holds -1e-09 rad"),
        ((np.inf, 0.0, 0.0, 0.1), "theta_i holds inf rad"),
    ],
)
def test_degrees_and_negatives_are_refused_in_a_sentence(arguments, sentence):
    with pytest.raises(DomainError) as caught:
        oren_nayar.factors(*arguments)
    assert str(caught.value).startswith(sentence)
    assert str(caught.value).endswith("convert degrees with numpy.radians.")


def test_a_single_number_is_no_spectrum():
    with pytest.raises(DomainError, match="the albedo is a single number; give an array"):
        oren_nayar.reflectance(0.5, 0.1, 0.2, 0.3, 0.4)
