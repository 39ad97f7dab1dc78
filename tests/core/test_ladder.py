# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The five models behind one name."""

import numpy as np
import pytest

from core import closure, ladder, oren_nayar, vcavity
from core.errors import DomainError

GEOMETRY = np.radians([[[0.0], [30.0]], [[45.0], [70.0]], [[10.0], [150.0]]])


@pytest.mark.parametrize("model", ladder.RUNGS)
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_each_rung_is_the_model_of_its_name(model, dtype):
    albedo = np.linspace(0.1, 0.9, 12, dtype=dtype).reshape(3, 4)
    sigma = np.radians([5.0, 20, 45])
    found = ladder.reflectance(model, albedo, *GEOMETRY, sigma)
    f1, _ = oren_nayar.factors(*GEOMETRY, sigma)
    expected = {
        "lambert": lambda: np.broadcast_to(albedo, (2, 3, 4)),
        "first-order": lambda: f1[..., np.newaxis] * albedo,
        "two-bounce": lambda: oren_nayar.reflectance(albedo, *GEOMETRY, sigma),
        "closure": lambda: closure.reflectance(albedo, *GEOMETRY, sigma),
        "reference": lambda: vcavity.reflectance(albedo, *GEOMETRY, sigma),
    }[model]()
    assert found.dtype == dtype
    assert found.shape == (2, 3, 4)
    np.testing.assert_allclose(found, expected, rtol=8 * np.finfo(dtype).eps)


@pytest.mark.parametrize("model", ladder.RUNGS)
def test_a_level_surface_is_lambertian(model):
    albedo = np.linspace(0.05, 1, 5)
    found = ladder.reflectance(model, albedo, *GEOMETRY, 0.0)
    np.testing.assert_array_equal(found, np.broadcast_to(albedo, found.shape))


@pytest.mark.parametrize("model", ladder.RUNGS)
def test_bad_arguments_are_refused(model):
    with pytest.raises(DomainError, match="degrees"):
        ladder.reflectance(model, [0.5], 45.0, 0.0, 0.0, 0.3)
    with pytest.raises(DomainError, match="last axis"):
        ladder.reflectance(model, 0.5, 0.7, 0.0, 0.0, 0.3)
    with pytest.raises(DomainError, match="two-bounce, closure"):
        ladder.reflectance("mirror", [0.5], 0.7, 0.0, 0.0, 0.3)
