# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The target and the shader are settled by themselves, and say so where the user looks."""

import math
from dataclasses import replace

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.instrument import bake
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derivation, derive
from rough_spectra.addon.samples import presets
from rough_spectra.core import ladder, limits, models


def assigned(degrees, model=solve.AUTO):
    material = bpy.data.materials.new("White")
    request = solve.Request(presets.load("19"), math.radians(degrees), model)
    (solution,) = derive.assign([(material, request)])
    return material, solution


@pytest.mark.parametrize("degrees", [1, 45])
def test_the_target_is_always_the_same_model(degrees):
    material, solution = assigned(degrees)
    assert solution.model == models.TARGET == "surface"
    found = derivation.get_stamp(material)
    assert (found.model, found.model_reason) == ("surface", solve.BY_DEFAULT)
    assert found.model_reason.startswith("surface: ")
    assert material.rough_spectra.model == solve.AUTO


def test_smooth_material_is_lambertian_and_rough_one_is_matched():
    _, smooth = assigned(1)
    assert smooth.roughness == 0
    assert smooth.shader_reason.startswith("lambert")
    assert smooth.delta_e_mean == smooth.delta_e_lambert < limits.TOLERANCE
    _, rough = assigned(45)
    assert rough.roughness > 0.3
    assert rough.delta_e_mean < rough.delta_e_lambert / 2


def test_model_asked_for_is_kept_and_its_material_matched():
    material, solution = assigned(5, "two-bounce")
    assert solution.model == "two-bounce"
    assert solution.roughness > 0
    assert derivation.get_stamp(material).model_reason == solve.ASKED_FOR


def test_bake_predicts_with_the_model_that_was_assigned():
    material, solution = assigned(45)
    (prepared,) = bake.prepare([("", material)])
    (entry,) = bake.compare([prepared], None).entries
    assert entry.predicted.model == "surface"
    assert entry.predicted.model_reason == solution.model_reason
    assert entry.shader_reason == solution.shader_reason
    at_45_0 = (math.pi / 4, 0.0, 0.0, math.radians(45))
    wanted = ladder.reflectance("surface", presets.load("19").values, *at_45_0)
    np.testing.assert_allclose(entry.predicted.values, wanted, rtol=1e-5)  # σ is stored in float32


@pytest.mark.parametrize("kind", ["reading", "albedo"])
@pytest.mark.parametrize(
    "model", ["lambert", "first-order", "closure", "reference", "surface", "auto"]
)
def test_a_material_solved_alone_is_the_one_solved_among_others(model, kind):
    """Alone, its spectra are kept from one step of a slider to the next; that changes nothing."""
    requests = [
        solve.Request(replace(presets.load(number), kind=kind), math.radians(degrees), model)
        for number, degrees in (("13", 20), ("14", 35), ("14", 36), ("19", 60))
    ]
    together = solve.solve(requests, working_space.current())
    for request, among in zip(requests, together, strict=True):
        for _ in range(2):
            [alone] = solve.solve([request], working_space.current())
            # Matrix products of one row and of many round differently.
            np.testing.assert_allclose(alone.color, among.color, rtol=1e-12)
            assert alone.roughness == pytest.approx(among.roughness, abs=1e-9)
            assert alone.warnings == among.warnings
            assert alone.delta_e_95 == pytest.approx(among.delta_e_95, rel=1e-9)
