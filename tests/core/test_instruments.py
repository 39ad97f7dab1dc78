# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Instruments against random directions in the same cones, reciprocity, energy and their bounds."""

import numpy as np
import pytest

from core import (
    instruments,
    models,
    oren_nayar,
    reading,
    vcavity,
)
from core.errors import DomainError
from core.instruments import curves, quadrature
from core.vcavity import bounce_series, closed, slope_law, surface

NAMES = reading.INSTRUMENTS
AVERAGING = ("45a:0-iso", "0:45a-iso", "45x:0-iso", "di:8", "de:8")
EQUAL_TO_RING = ("45a:0", "0:45a", "45x:0", "45as45")
SIGMAS = np.array(
    [0.0, 1e-12, 1e-8, 1e-5, 1e-3, 0.00999, 0.0101, *np.linspace(0.05, np.pi / 2, 20)]
)
ALBEDOS = np.concatenate(([0.0, 1e-6], np.linspace(0.01, 0.99, 30), [0.999, 1.0]))


def sigmas(model):
    """Those of `SIGMAS` to which a model goes."""
    return SIGMAS[np.radians(models.find(model).largest_sigma) >= SIGMAS]


def test_the_names_and_the_default():
    assert NAMES[0] == "45a:0"
    assert {"0:45a", "45x:0", "di:8", "de:8", "45as15", "45as110", *AVERAGING} <= set(NAMES)
    assert reading.INSTRUMENT_ANGLES["45a:0"] == (np.pi / 4, 0.0, 0.0)
    assert set(reading.INSTRUMENT_ANGLES) == set(NAMES) - set(AVERAGING)
    for name in NAMES:
        instrument = instruments.find(name)
        assert instrument.name == name
        assert instrument.menu
        assert not instrument.description.endswith(".")
        assert instrument.title
        assert all(ord(letter) < 128 for letter in name)


@pytest.mark.parametrize("name", NAMES)
def test_weights_and_angles(name):
    found = quadrature.of(name)
    assert np.sum(found.weights) == pytest.approx(1, rel=1e-15)
    assert (found.weights > 0).all() or name == "de:8"
    for angles, top in ((found.theta_i, 90), (found.theta_r, 90), (found.delta_phi, 180)):
        assert angles.shape == found.weights.shape
        assert (angles >= 0).all()
        assert (np.degrees(angles) <= top).all()


def test_aspecular_angles():
    # Light at 45°, its mirror direction at -45°: as15 lies 30° from the normal on that side.
    expected = {-15: (60, 180), 15: (30, 180), 25: (20, 180), 45: (0, 0), 75: (30, 0), 110: (65, 0)}
    for angle, (view, azimuth) in expected.items():
        found = np.degrees(reading.INSTRUMENT_ANGLES[f"45as{angle}"])
        np.testing.assert_allclose(found, (45, view, azimuth), atol=1e-12)


# Directions drawn in space, with none of the plane geometry of core.instruments.


def in_cone(numbers, tilt, half_angle, azimuth):
    """Unit vectors uniform over solid angle in a cone, shape (n, 3); numbers (n, 2) in 0..1."""
    cosine = 1 - numbers[:, 0] * (1 - np.cos(np.radians(half_angle)))
    sine, turn = np.sqrt(1 - cosine**2), 2 * np.pi * numbers[:, 1]
    x, y, z = sine * np.cos(turn), sine * np.sin(turn), cosine
    t, p = np.radians(tilt), np.radians(azimuth)
    x, z = x * np.cos(t) + z * np.sin(t), z * np.cos(t) - x * np.sin(t)
    return np.stack((x * np.cos(p) - y * np.sin(p), x * np.sin(p) + y * np.cos(p), z), axis=-1)


def in_ring(numbers):
    cosine = np.cos(np.radians(50)) + numbers[:, 0] * np.cos(np.radians(40))
    cosine -= numbers[:, 0] * np.cos(np.radians(50))
    sine, turn = np.sqrt(1 - cosine**2), 2 * np.pi * numbers[:, 1]
    return np.stack((sine * np.cos(turn), sine * np.sin(turn), cosine), axis=-1)


def light_and_view(name, numbers):
    light, view = numbers[:, :2], numbers[:, 2:]
    if name == "45a:0-iso":
        return in_ring(light), in_cone(view, 0, 5, 0)
    if name == "0:45a-iso":
        return in_cone(light, 0, 5, 0), in_ring(view)
    if name == "45x:0-iso":
        return in_cone(light, 45, 5, 0), in_cone(view, 0, 5, 0)
    return in_cone(light, 0, 90, 0), in_cone(view, 8, 5, 0)


def drawn(name, numbers):
    """θi, θr, Δφ and weight of random pairs: cosines for what is spread over solid angle."""
    light, view = light_and_view(name, numbers)
    weight = light[:, 2] * view[:, 2]
    if name == "de:8":
        mirror = in_cone(np.zeros((1, 2)), 8, 6, 180)[0]
        weight = np.where(light @ mirror > np.cos(np.radians(6)), 0, weight)
    azimuth = np.arctan2(light[:, 1], light[:, 0]) - np.arctan2(view[:, 1], view[:, 0])
    return (
        np.arccos(np.minimum(light[:, 2], 1)),
        np.arccos(np.minimum(view[:, 2], 1)),
        azimuth,
        weight,
    )


def lattice(count):
    """Evenly spread points of the unit hypercube (..., 4): powers of the root of x⁵ = x + 1."""
    steps = 1.1673039782614187 ** -np.arange(1.0, 5.0)
    return (0.5 + np.arange(1, count + 1)[:, np.newaxis] * steps) % 1


@pytest.mark.parametrize("name", AVERAGING)
def test_published_model_agrees_with_random_directions(name):
    sigma = np.radians([10, 30, 60, 90])[:, np.newaxis]
    theta_i, theta_r, azimuth, weight = drawn(name, np.random.default_rng(1).random((400_000, 4)))
    for found, values in zip(
        reading.coefficients(sigma[:, 0], name),
        oren_nayar.factors(theta_i, theta_r, azimuth, sigma),
        strict=True,
    ):
        mean = values @ weight / weight.sum()
        noise = (
            np.std((values - mean[:, np.newaxis]) * weight, axis=1) / weight.mean() / 400_000**0.5
        )
        # Four standard errors, at most 2e-4.
        assert noise.max() < 1e-4
        assert (np.abs(found - mean) < 4 * noise + 1e-6).all()


@pytest.mark.parametrize(
    ("light", "view", "azimuth"),
    [((45, 5), (30, 5), 180), ((45, 0), (20, 8), 0), ((60, 5), (10, 0), 90)],
)
def test_tilted_cones_agree_with_random_directions(light, view, azimuth):
    """What no instrument has yet: apertures on both sides, away from the normal."""
    record = instruments.Instrument(
        *("x", "", "", "", 99), instruments.Beam(*light), instruments.Beam(*view), float(azimuth)
    )
    of = quadrature.build(record)
    numbers = np.random.default_rng(4).random((100_000, 4))
    lit = in_cone(numbers[:, :2], *light, azimuth)
    seen = in_cone(numbers[:, 2:], *view, 0)
    between = np.arctan2(lit[:, 1], lit[:, 0]) - np.arctan2(seen[:, 1], seen[:, 0])
    weight = lit[:, 2] * seen[:, 2]
    assert np.sum(of.weights) == pytest.approx(1, rel=1e-14)
    for found, values in zip(
        oren_nayar.factors(of.theta_i, of.theta_r, of.delta_phi, 0.7),
        oren_nayar.factors(np.arccos(lit[:, 2]), np.arccos(seen[:, 2]), between, 0.7),
        strict=True,
    ):
        assert found @ of.weights == pytest.approx(values @ weight / weight.sum(), rel=1e-3)


@pytest.mark.parametrize("name", ["45x:0-iso", "di:8", "de:8"])
def test_reference_agrees_with_spread_directions(name):
    # 400 directions in an even sequence: 0.2 % was seen, for 2 % of plain random ones.
    theta_i, theta_r, azimuth, weight = drawn(name, lattice(400))
    albedo = np.array([0.2, 0.7, 1.0])
    resolution = vcavity.Resolution(slopes=4, azimuths=4, panels=24)
    for degrees in (20, 45):
        sigma = np.radians(degrees)
        values = vcavity.reflectance(
            albedo,
            theta_i,
            theta_r,
            azimuth,
            sigma,
            resolution=resolution,
        )
        expected = weight @ values / weight.sum()
        found = reading.from_albedo(albedo, sigma, "reference", name)
        np.testing.assert_allclose(found, expected, rtol=5e-3)


def test_gloss_trap_is_cut_out():
    """The light that de:8 lacks is that of a cone of 6° around the mirror direction."""
    numbers = np.random.default_rng(2).random((100_000, 4))
    light, view = in_cone(numbers[:, :2], 8, 6, 180), in_cone(numbers[:, 2:], 8, 5, 0)
    azimuth = np.arctan2(light[:, 1], light[:, 0]) - np.arctan2(view[:, 1], view[:, 0])
    weight = light[:, 2] * view[:, 2]
    lost = light[:, 2].mean() * 2 * np.pi * (1 - np.cos(np.radians(6))) / np.pi
    for index, values in enumerate(
        oren_nayar.factors(np.arccos(light[:, 2]), np.arccos(view[:, 2]), azimuth, 0.8)
    ):
        trap = values @ weight / weight.sum()
        included, excluded = (reading.coefficients(0.8, n)[index] for n in ("di:8", "de:8"))
        # 1e-3 of the trap, which is 1 % of the light.
        assert (included - (1 - lost) * excluded) / lost == pytest.approx(trap, rel=1e-3)


@pytest.mark.parametrize(("slopes", "steepest"), [("gaussian", 60), ("oren-nayar", 90)])
@pytest.mark.parametrize("name", AVERAGING)
def test_twice_the_nodes_change_nothing(name, slopes, steepest):
    coarse = quadrature.of(name)
    fine = quadrature.build(instruments.find(name), refinement=2)
    assert fine.weights.size >= 4 * coarse.weights.size
    sigma = np.radians([5.0, 20, 50, steepest])
    albedo = np.array([0.1, 0.5, 0.9, 1.0])
    published, cavity = [], []
    # Few nodes inside the groove: what is tested is the average of its answers.
    resolution = surface.Resolution(slopes=3, azimuths=6, panels=12, table=48)
    shares = slope_law.weights(sigma, resolution.slopes, slopes)
    for of in (coarse, fine):
        angles = of.theta_i, of.theta_r, of.delta_phi
        f1, f2 = oren_nayar.factors(*angles, sigma[:, np.newaxis])
        published.append(np.outer(f1 @ of.weights, albedo) + np.outer(f2 @ of.weights, albedo**2))
        rows = 0
        for part in np.array_split(np.arange(of.weights.size), of.weights.size // 8):
            answer = surface.response(*(a[part] for a in angles), 6, resolution)
            rows = rows + np.tensordot(of.weights[part], answer, 1)
        cavity.append(bounce_series.evaluate(shares @ rows, albedo))
    for first, second in (published, cavity):
        np.testing.assert_allclose(first, second, rtol=quadrature.QUADRATURE_ERROR)


@pytest.mark.parametrize("model", models.NAMES)
@pytest.mark.parametrize("name", NAMES)
def test_level_surface_reads_its_albedo(name, model):
    for dtype in (np.float64, np.float32):
        albedo = ALBEDOS.astype(dtype)
        tolerance = 2 * np.finfo(dtype).eps
        if model in ("closure", "reference", "surface"):
            # Where σ is 0 nothing is interpolated.
            tolerance += curves.INTERPOLATION_ERROR
        for sigma in (0.0, 1e-12):
            read = reading.from_albedo(albedo, sigma, model, name)
            np.testing.assert_allclose(read, albedo, rtol=tolerance)
    np.testing.assert_array_equal(reading.from_albedo(ALBEDOS, 0.0, model, name), ALBEDOS)


@pytest.mark.parametrize("model", models.NAMES)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(("dtype", "tolerance"), [(np.float64, 1e-12), (np.float32, 1e-5)])
def test_albedo_comes_back_from_its_reading(name, model, dtype, tolerance):
    albedo = np.concatenate((ALBEDOS, [1.1])).astype(dtype)
    read = reading.from_albedo(albedo, sigmas(model), model, name)
    assert (np.diff(read) > 0).all()
    back = reading.to_albedo(read, sigmas(model), model, name)
    assert read.dtype == back.dtype == dtype
    np.testing.assert_allclose(back, np.broadcast_to(albedo, back.shape), rtol=tolerance)


@pytest.mark.parametrize("model", models.NAMES)
@pytest.mark.parametrize("name", EQUAL_TO_RING)
def test_45_and_0_are_one_geometry_to_the_last_bit(name, model):
    for dtype in (np.float64, np.float32):
        albedo = ALBEDOS.astype(dtype)
        expected = reading.from_albedo(albedo, sigmas(model), model)
        found = reading.from_albedo(albedo, sigmas(model), model, name)
        np.testing.assert_array_equal(found, expected)
    s2 = SIGMAS**2
    f1, f2 = reading.coefficients(SIGMAS, name)
    np.testing.assert_array_equal(f1, 1 - 0.5 * s2 / (s2 + 0.33))
    np.testing.assert_array_equal(f2, 0.17 * s2 / (s2 + 0.13))


@pytest.mark.parametrize("model", models.NAMES)
def test_reciprocity(model):
    there, back = (
        reading.from_albedo(ALBEDOS, sigmas(model), model, name)
        for name in ("45a:0-iso", "0:45a-iso")
    )
    np.testing.assert_allclose(there, back, rtol=1e-12)


def test_reciprocity_of_the_solver():
    """The tables put the larger angle first; here nothing does."""
    quarter, zero = np.array([np.pi / 4]), np.zeros(1)
    there = surface.response(quarter, zero, zero, 6)
    back = surface.response(zero, quarter, zero, 6)
    np.testing.assert_allclose(there, back, atol=1e-12)


@pytest.mark.parametrize("name", ["45a:0-iso", "di:8", "45as-15", "45as110"])
def test_tables_follow_the_solver_between_their_nodes(name):
    of = quadrature.of(name)
    sigma = np.radians([0.3, 0.616, 4.321, 15.1, 31.7, 47.3, 80.9])
    shares = slope_law.weights(sigma, vcavity.STANDARD.slopes)
    expected = 0
    for index in range(of.weights.size):
        part = slice(index, index + 1)
        angles = of.theta_i[part], of.theta_r[part], of.delta_phi[part]
        expected = expected + of.weights[index] * (shares @ surface.response(*angles, 6)[0])
    bound = curves.INTERPOLATION_ERROR if name == "di:8" else 1e-12
    np.testing.assert_allclose(curves.series(name).rows(sigma), expected, atol=bound)


@pytest.mark.parametrize("name", NAMES)
def test_published_coefficients_are_the_mean_of_the_model(name):
    of = quadrature.of(name)
    means = oren_nayar.factors(of.theta_i, of.theta_r, of.delta_phi, SIGMAS[:, np.newaxis])
    for found, values in zip(reading.coefficients(SIGMAS, name), means, strict=True):
        np.testing.assert_allclose(found, values @ of.weights, rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("name", NAMES)
def test_closure_stays_near_the_reference(name):
    sigma = np.radians(np.concatenate(([0.1, 0.5, 0.6], np.linspace(1.3, 50, 40))))
    albedo = np.concatenate((np.geomspace(1e-3, 0.1, 5), np.linspace(0.13, 0.99, 40), [0.999, 1]))
    expected = reading.from_albedo(albedo, sigma, "reference", name)
    found = reading.from_albedo(albedo, sigma, "closure", name)
    np.testing.assert_allclose(found, expected, rtol=curves.CLOSURE_ERROR)
    if name in EQUAL_TO_RING:
        np.testing.assert_allclose(found, expected, rtol=closed.RING_ERROR)


def test_sphere_loses_no_light_in_the_reference_and_28_percent_in_the_published_model():
    sigma = np.radians(np.linspace(0, 90, 31))
    white = reading.white_reading(sigmas("reference"), "reference", "di:8")
    np.testing.assert_allclose(white, 1, atol=4e-4)
    published = reading.white_reading(sigma, "two-bounce", "di:8")
    assert published[-1] == pytest.approx(0.7205, abs=1e-3)
    assert (np.diff(published) < 0).all()


def test_no_instrument_reads_below_0_and_the_backscatter_of_white_above_1_is_kept():
    for name in NAMES:
        f1, f2 = reading.coefficients(SIGMAS, name)
        # The inverse needs it: with f1 ≤ 0 two albedos would share a reading.
        assert (f1 > 0.2).all()
        assert (f2 >= 0).all()
    assert reading.white_reading(np.radians(40), "reference", "45as110") > 1.1
    assert reading.white_reading(np.radians(40), "two-bounce", "45as110") > 1.0
    found = reading.to_albedo([1.05], np.radians(40), "reference", "45as110")
    assert found < 1


@pytest.mark.parametrize("model", models.NAMES)
@pytest.mark.parametrize("name", ["di:8", "45as15"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_shapes_precision_and_nan(name, model, dtype):
    values = np.array([[[0.1, np.nan, 0.3]], [[0.4, 0.5, 0.6]]], dtype)
    sigma = np.array([0.1, np.nan, 0.3, 0.0])
    for function in (reading.from_albedo, reading.to_albedo):
        result = function(values, sigma, model, name)
        assert result.dtype == dtype
        np.testing.assert_array_equal(
            np.isnan(result), np.isnan(values) | np.isnan(sigma)[:, np.newaxis]
        )
        assert function(np.zeros((0, 3), dtype), 0.2, model, name).shape == (0, 3)
        assert function(np.zeros((2, 0), dtype), [0.1, 0.2], model, name).shape == (2, 0)
        assert function(np.zeros((4, 1, 3), dtype), np.zeros(0), model, name).shape == (4, 0, 3)
    white = reading.white_reading(np.full((2, 1), 0.3, dtype), model, name)
    assert (white.dtype, white.shape) == (dtype, (2, 1))
    assert reading.coefficients(np.full(3, 0.3, dtype), name)[1].dtype == dtype
    last = np.radians(np.array([models.find(model).largest_sigma], np.float32))
    assert np.isfinite(reading.white_reading(last, model, name)).all()


@pytest.mark.parametrize("model", models.NAMES)
def test_unknown_instruments_are_refused_with_the_known_ones(model):
    for function in (reading.from_albedo, reading.to_albedo):
        with pytest.raises(DomainError) as caught:
            function([0.5], 0.1, model, "d:8")
        assert str(caught.value).startswith("Instrument 'd:8' is not known; choose one of: 45a:0, ")
        assert "de:8" in str(caught.value)
    with pytest.raises(DomainError, match="sigma"):
        reading.from_albedo([0.5], 2.0, model, "di:8")
