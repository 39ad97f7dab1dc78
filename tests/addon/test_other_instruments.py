# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of other instruments than the virtual one, and readings no white surface gives."""

from dataclasses import replace

import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive, properties, storage
from rough_spectra.core import models, reading
from rough_spectra.core.instruments import REGISTRY

SIGMA = np.radians(30.0)


STORED = {
    "instrument": [
        *("45a:0", "0:45a", "45x:0", "45a:0-iso", "0:45a-iso", "45x:0-iso", "di:8", "de:8"),
        *("45as-15", "45as15", "45as25", "45as45", "45as75", "45as110"),
    ],
    "model": ["two-bounce", "first-order", "closure", "auto", "lambert", "reference", "surface"],
}
"""What files hold, in the order of their numbers. Lines are added at the end and never change."""


@pytest.mark.parametrize(
    ("setting", "items", "names"),
    [
        ("instrument", properties.INSTRUMENT_ITEMS, [*REGISTRY]),
        ("model", properties.MODEL_ITEMS, ["auto", *models.NAMES]),
    ],
)
def test_menus_have_every_record_and_keep_the_numbers_that_files_hold(setting, items, names):
    assert [item[0] for item in items] == names
    numbers = {item[3]: item[0] for item in items}
    assert len(numbers) == len(items), "two have the same number"
    assert [numbers[number] for number in sorted(numbers)] == STORED[setting]
    assert sorted(numbers) == list(range(len(items)))


@pytest.mark.parametrize("instrument", sorted(REGISTRY))
@pytest.mark.parametrize("model", ["two-bounce", "closure"])
def test_the_albedo_comes_from_the_own_instrument(colorchecker, instrument, model):
    rho = colorchecker[13].values
    printed = reading.from_albedo(rho, SIGMA, model, instrument)
    sample = replace(colorchecker[13], values=printed, kind="reading", instrument=instrument)
    found = solve.target_reading(solve.Request(sample, SIGMA, model))
    np.testing.assert_allclose(found, reading.from_albedo(rho, SIGMA, model), rtol=1e-12)


def test_a_sphere_reading_is_stored_as_one(make_material, colorchecker):
    sample = replace(colorchecker[13], kind="reading", instrument="di:8")
    material = make_material("Sphere")
    derive.assign([(material, solve.Request(sample, SIGMA))])
    assert material.rough_spectra.instrument == "di:8"
    assert storage.load(material).sample.instrument == "di:8"


@pytest.mark.parametrize("model", ["auto", "lambert", "first-order", "two-bounce", "closure"])
@pytest.mark.parametrize("peak", [1.05, 2.0, 4.0])
def test_more_than_white_gives_a_finite_material_and_a_warning(colorchecker, model, peak):
    values = colorchecker[13].values * peak / colorchecker[13].values.max()
    sample = replace(colorchecker[13], values=values, kind="reading")
    [solution] = solve.solve([solve.Request(sample, SIGMA, model)], working_space.current())
    assert np.isfinite([*solution.color, solution.roughness, solution.delta_e_mean]).all()
    assert (solution.color >= 0).all()
    assert (solution.color <= 1).all()
    assert solution.warnings or model == "lambert"


def test_noise_below_zero_counts_as_zero(colorchecker):
    values = colorchecker[13].values.copy()
    values[:3] = (-0.02, -1e-6, 0.0)
    noisy = replace(colorchecker[13], values=values)
    clean = replace(colorchecker[13], values=np.maximum(values, 0))
    space = working_space.current()
    first, second = solve.solve([solve.Request(s, SIGMA) for s in (noisy, clean)], space)
    np.testing.assert_array_equal(first.color, second.color)
