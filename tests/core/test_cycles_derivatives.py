# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The closure's derivatives against differences of `cycles.reflectance`."""

import numpy as np
import pytest

from core import cycles
from core.cycles import derivatives

STEP = 1e-6


def test_values_and_slopes_are_those_of_the_closure():
    random = np.random.default_rng(5)
    color, roughness = random.uniform(0.01, 0.99, (7, 3)), random.uniform(0.01, 0.99, 7)
    angles = (*random.uniform(0, np.pi / 2, (2, 50)), random.uniform(0, np.pi, 50))

    def plain(color, roughness):
        return cycles.reflectance(color[:, np.newaxis], roughness[:, np.newaxis], *angles)

    functions = derivatives.functions(*angles)
    materials = np.column_stack((color, roughness)).tolist()
    # The closure's value and its derivatives: materials, directions, channels.
    seen, *by_channel, by_roughness = (
        np.swapaxes(derivatives.coefficients(materials) @ functions, 2, 3)
    ).swapaxes(0, 1)
    assert seen == pytest.approx(plain(color, roughness), abs=1e-14)
    steeper = plain(color + STEP, roughness) - plain(color - STEP, roughness)
    for channel, slope in enumerate(by_channel):
        others = np.arange(3) != channel
        assert slope[..., channel] == pytest.approx(steeper[..., channel] / (2 * STEP), abs=1e-8)
        assert not slope[..., others].any()
    rougher = plain(color, roughness + STEP) - plain(color, roughness - STEP)
    assert by_roughness == pytest.approx(rougher / (2 * STEP), abs=1e-8)


def test_ends_of_the_domain_are_finite():
    angles = (np.array([0.0, np.pi / 2]), np.array([np.pi / 2, np.pi / 2]), np.zeros(2))
    assert np.isfinite(derivatives.functions(*angles)).all()
    ends = derivatives.coefficients([[0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0]])
    assert np.isfinite(ends).all()
