# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Finding the material whose lobe is wanted: where the answer is known, and by trying them all."""

import math

import numpy as np
import pytest

from core import cycles, instruments
from core.color.color_difference import delta_e, xyz_to_lab
from core.cycles import instrument_lobe, matching
from core.errors import DomainError
from core.instruments import quadrature
from core.numerics import direction_grid

ANGLES_45_0 = (math.pi / 4, 0.0, 0.0)


@pytest.mark.parametrize(("dtype", "tolerance"), [(np.float64, 1e-14), (np.float32, 2e-6)])
def test_color_comes_back_from_its_reading(dtype, tolerance):
    color = np.concatenate(([0, 1e-9, 1e-4], np.linspace(0.01, 1, 40))).astype(dtype)
    roughness = np.array([0, 1e-9, 0.01, 0.25, 0.5, 0.75, 1], dtype)
    read = cycles.reflectance(color, roughness, *ANGLES_45_0)
    back = matching.color_for_reading(read, roughness)
    np.testing.assert_allclose(back, np.broadcast_to(color, back.shape), rtol=tolerance, atol=0)


def test_colors_out_of_gamut_are_not_clipped():
    read = np.array([-0.05, 0.0, 1.2])
    color = matching.color_for_reading(read, 0.6)
    assert color[0] < 0
    assert color[1] == 0
    assert color[2] > 1
    np.testing.assert_allclose(cycles.reflectance(color, 0.6, *ANGLES_45_0), read, rtol=1e-13)


SRGB_TO_XYZ = np.array(
    ((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505))
)


def perceive(rgb):
    return xyz_to_lab(rgb @ SRGB_TO_XYZ.T, SRGB_TO_XYZ.sum(axis=1))


def test_match_finds_cycles_own_materials():
    """Targets rendered by the closure itself have one right answer."""
    rng = np.random.default_rng(3)
    color, roughness = rng.uniform(0.05, 0.9, (40, 3)), rng.uniform(0, 1, 40)
    roughness[:2] = 0, 1
    directions = direction_grid.hemisphere(32)
    targets = cycles.reflectance(color[:, None], roughness[:, None], *directions)
    read = cycles.reflectance(color, roughness, *ANGLES_45_0)
    found_color, found = matching.match(read, targets, directions, perceive)
    # Half of the last step, 1/128: where the right answer is a kink, a parabola cannot do better.
    np.testing.assert_allclose(found, roughness, atol=0.5 / 128)
    np.testing.assert_array_equal(found[:2], roughness[:2])
    np.testing.assert_allclose(
        cycles.reflectance(found_color, found, *ANGLES_45_0), read, rtol=1e-13
    )


def test_match_of_one_is_that_of_many():
    """What a material becomes doesn't depend on what is matched beside it."""
    rng = np.random.default_rng(5)
    directions = direction_grid.hemisphere(16)
    targets, read = rng.uniform(0.1, 0.9, (150, 16, 3)), rng.uniform(0.1, 0.9, (150, 3))
    color, roughness = matching.match(read, targets, directions, perceive)
    for i in (0, 63, 64, 149):
        one = matching.match(read[i : i + 1], targets[i : i + 1], directions, perceive)
        np.testing.assert_array_equal(one[0][0], color[i])
        assert one[1][0] == roughness[i]


def test_match_is_as_good_as_trying_a_thousand():
    """Bumpy costs, as random targets have them; on the smooth ones of surfaces it is far closer."""
    rng = np.random.default_rng(7)
    directions = direction_grid.hemisphere(16)
    read = rng.uniform(0.1, 0.9, (30, 3))
    shape = cycles.reflectance(read[:, None], rng.uniform(0, 1, (30, 1)), *directions)
    targets = shape * rng.uniform(0.95, 1.05, shape.shape)

    def cost(roughness):
        color = matching.color_for_reading(read, roughness)
        seen = cycles.reflectance(
            color[:, None], np.broadcast_to(roughness, 30)[:, None], *directions
        )
        return delta_e(perceive(seen), perceive(targets)).mean(axis=-1)

    _, found = matching.match(read, targets, directions, perceive)
    least = np.min([cost(np.full(30, s)) for s in np.linspace(0, 1, 1001)], axis=0)
    assert (cost(found) / least).max() < 1.002


def test_no_reading_up_to_1_needs_a_color_above_1():
    """At 45°/0° a white lobe of any roughness reads at least 1, so nothing has to be given up."""
    color = matching.color_for_reading(np.linspace(0, 1, 101), np.linspace(0, 1, 101)[:, None])
    # One rounding at roughness 0.
    assert color.max() <= 1 + 4e-16


def test_match_of_no_materials():
    color, roughness = matching.match(
        np.zeros((0, 3)), np.zeros((0, 8, 3)), direction_grid.hemisphere(8), perceive
    )
    assert color.shape == (0, 3)
    assert roughness.shape == (0,)


@pytest.mark.parametrize("instrument", ["45x:0-iso", "di:8", "de:8", "45as110"])
def test_match_meets_the_reading_of_any_instrument(instrument):
    rng = np.random.default_rng(11)
    color, roughness = rng.uniform(0.05, 0.9, (20, 3)), rng.uniform(0, 1, 20)
    directions = direction_grid.hemisphere(32)
    targets = cycles.reflectance(color[:, None], roughness[:, None], *directions)
    read = instrument_lobe.reflectance(color, roughness, instrument)
    found_color, found = matching.match(read, targets, directions, perceive, instrument)
    np.testing.assert_allclose(found, roughness, atol=0.5 / 128)
    np.testing.assert_allclose(
        instrument_lobe.reflectance(found_color, found, instrument), read, rtol=1e-13
    )


def test_an_unknown_instrument_is_refused():
    for call in (
        lambda: matching.color_for_reading([0.5], 0.5, "d:8"),
        lambda: instrument_lobe.reflectance([0.5], 0.5, "d:8"),
    ):
        with pytest.raises(DomainError, match="Instrument 'd:8' is not known; choose one of: 45a"):
            call()


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("name", instruments.REGISTRY)
def test_an_instruments_reading_is_the_mean_over_its_directions(name, dtype):
    of = quadrature.of(name)
    color = np.linspace(0.01, 1, 12, dtype=dtype).reshape(4, 3)
    roughness = np.array([0, 0.2, 0.7, 1], dtype)
    found = instrument_lobe.reflectance(color, roughness, name)
    each = cycles.reflectance(
        color[:, np.newaxis], roughness[:, np.newaxis], of.theta_i, of.theta_r, of.delta_phi
    )
    assert found.dtype == dtype
    np.testing.assert_allclose(
        found, np.einsum("g,mgc->mc", of.weights, each), rtol=20 * np.finfo(dtype).eps
    )
    if of.angles is not None:
        np.testing.assert_array_equal(found, cycles.reflectance(color, roughness, *of.angles))


@pytest.mark.parametrize("name", ["45a:0-iso", "0:45a-iso", "45x:0-iso", "di:8", "de:8"])
def test_the_nodes_of_instruments_are_enough_for_the_lobe(name):
    color, roughness = np.linspace(0.1, 1, 10)[:, np.newaxis], np.array([0.3, 1.0])
    found = instrument_lobe.reflectance(color[:, np.newaxis], roughness, name)
    of = quadrature.build(instruments.find(name), 3)
    each = cycles.reflectance(
        color[:, np.newaxis, np.newaxis],
        roughness[:, np.newaxis],
        of.theta_i,
        of.theta_r,
        of.delta_phi,
    )
    # Measured: 9.1e-7 for the ring from 40° to 50°.
    np.testing.assert_allclose(found, of.weights @ each, rtol=1e-6)
