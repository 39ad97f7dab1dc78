# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All models behind one name, and the choice between two shaders."""

from pathlib import Path

import numpy as np
import pytest

from core import (
    ladder,
    models,
    oren_nayar,
    surface,
    vcavity,
)
from core.errors import DomainError
from core.vcavity import closed

GEOMETRY = np.radians([[[0.0], [30.0]], [[45.0], [70.0]], [[10.0], [150.0]]])


@pytest.mark.parametrize("model", models.NAMES)
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
        "closure": lambda: closed.reflectance(albedo, *GEOMETRY, sigma),
        "reference": lambda: vcavity.reflectance(albedo, *GEOMETRY, sigma),
        "surface": lambda: surface.reflectance(albedo, *GEOMETRY, sigma),
    }[model]()
    assert found.dtype == dtype
    assert found.shape == (2, 3, 4)
    np.testing.assert_allclose(found, expected, rtol=8 * np.finfo(dtype).eps)


@pytest.mark.parametrize("model", models.NAMES)
def test_a_level_surface_is_lambertian(model):
    albedo = np.linspace(0.05, 1, 5)
    found = ladder.reflectance(model, albedo, *GEOMETRY, 0.0)
    np.testing.assert_array_equal(found, np.broadcast_to(albedo, found.shape))


@pytest.mark.parametrize("model", models.NAMES)
def test_bad_arguments_are_refused(model):
    with pytest.raises(DomainError, match="degrees"):
        ladder.reflectance(model, [0.5], 45.0, 0.0, 0.0, 0.3)
    with pytest.raises(DomainError, match="last axis"):
        ladder.reflectance(model, 0.5, 0.7, 0.0, 0.0, 0.3)
    with pytest.raises(DomainError, match="two-bounce, closure"):
        ladder.reflectance("mirror", [0.5], 0.7, 0.0, 0.0, 0.3)


@pytest.mark.parametrize(
    ("lambert", "rough", "model", "words"),
    [
        (
            [0.2, 0.9],
            [0.1, 0.1],
            "lambert",
            "lambert: within ΔE00 1 in all directions, at most 0.90.",
        ),
        (
            [0.2, 3.0],
            [0.1, 0.4],
            "rough",
            "in all directions, at most 0.40; without roughness up to 3.00.",
        ),
        (
            [0.2, 3.0],
            [0.1, 1.0004],
            "rough",
            "rough: off by more than ΔE00 1 in 50 % of directions, at most 1.0004; without",
        ),
        (
            [0.2, 2.0],
            [0.1, 2.5],
            "lambert",
            "at most 2.00; with roughness up to 2.50.",
        ),
        ([np.nan], [0.5], "rough", "an unknown amount"),
    ],
)
def test_shader(lambert, rough, model, words):
    choice = ladder.choose_shader(lambert, rough)
    assert choice.model == model
    assert words in choice.reason
    assert list(choice.errors) == ["lambert", "rough"]


def test_the_manual_has_a_row_for_every_rung_in_their_order():
    page = Path(__file__).resolve().parents[2] / "docs" / "ladder.md"
    table = page.read_text("utf-8").split("## The rungs")[1].split("## How")[0]
    rows = [line.split("|")[1].strip() for line in table.splitlines() if line.startswith("| ")]
    assert tuple(rows[1:]) == models.NAMES
