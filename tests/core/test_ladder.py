# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The five models behind one name, and the choice among them against the solver."""

from pathlib import Path

import numpy as np
import pytest

from core import (
    closure,
    ladder,
    models,
    oren_nayar,
    vcavity,
)
from core.color.color_difference import delta_e, xyz_to_lab
from core.errors import DomainError
from core.models.reference import SLOPES
from core.vcavity import tabulated

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
        "closure": lambda: closure.reflectance(albedo, *GEOMETRY, sigma),
        "reference": lambda: vcavity.reflectance(albedo, *GEOMETRY, sigma, slopes=SLOPES),
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


WAVELENGTHS = np.linspace(400, 700, 16)
LIGHTS = [
    np.exp(-(((WAVELENGTHS[:, np.newaxis] - [600, 550, 450]) / 45) ** 2)) * tilt[:, np.newaxis]
    for tilt in (np.full(16, 0.1), np.linspace(0.05, 0.2, 16))
]
TABLE_ERROR = 5e-4
"""Median error of the table over the directions drawn here is 2e-4."""


def difference(xyz, other, white):
    return delta_e(xyz_to_lab(xyz, white), xyz_to_lab(other, white))


def scene(random, directions):
    polar = np.arcsin(np.sqrt(random.random((2, directions))) * np.sin(np.radians(80)))
    return np.concatenate((polar, random.uniform(0, 2 * np.pi, (1, directions))))


def albedo(random, count):
    level = random.choice([-3, -1, 0, 2.5], (count, 1))
    waves = np.sin(random.uniform(0, 6, (count, 1)) + WAVELENGTHS / random.uniform(30, 90))
    return 1 / (1 + np.exp(-(level + waves)))


def true_errors(rho, sigma, geometries, lights):
    seen = {rung: ladder.reflectance(rung, rho, *geometries, sigma) for rung in models.NAMES}
    return {
        rung: max(
            difference(seen[rung] @ light, seen["reference"] @ light, light.sum(axis=0)).max()
            for light in lights
        )
        for rung in models.NAMES
    }


def test_the_table_is_as_close_to_the_solver_as_it_says():
    random = np.random.default_rng(11)
    larger = np.radians(random.uniform(0, 85, 50))
    geometry = (larger, larger * random.random(50) ** 0.3, random.uniform(-7, 7, 50))
    rho = np.stack([np.array([0.02, 0.1, 0.4, 0.7, 0.9, 0.97, 1.0])] * 7)
    sigma = np.radians([1.0, 6, 17, 28, 43, 57, 80])
    expected = np.stack(
        [
            vcavity.reflectance(r, *geometry, s, slopes=SLOPES)
            for r, s in zip(rho, sigma, strict=True)
        ]
    )
    error = np.abs(tabulated.reflectance(rho, *geometry, sigma) / expected - 1).max(axis=-1)
    # Elsewhere than at the probes of the fit a few are larger than its bound, by little.
    assert np.all(error <= 1.2 * tabulated.bound(*geometry, sigma[:, np.newaxis]))
    assert np.mean(error <= tabulated.bound(*geometry, sigma[:, np.newaxis])) > 0.99
    assert np.median(error) < TABLE_ERROR


def test_the_table_keeps_the_symmetries_and_goes_on_outside_its_albedos():
    light, view, azimuth = np.radians([20.0, 60, 5]), np.radians([70.0, 1, 80]), np.array([1, 2, 3])
    rho = np.array([[0.3, 1.0, 1.1, -0.1]])
    found = tabulated.reflectance(rho, light, view, azimuth, 0.6)
    swapped = tabulated.reflectance(rho, view, light, -azimuth - 2 * np.pi, 0.6)
    np.testing.assert_allclose(found, swapped, rtol=1e-12)
    np.testing.assert_allclose(found[..., 2], 1.1 * found[..., 1], rtol=1e-12)
    expected = vcavity.reflectance(rho[0], light, view, azimuth, 0.6, slopes=SLOPES)
    np.testing.assert_allclose(found[0], expected, rtol=5e-3)


def test_the_choice_is_the_cheapest_that_truly_suffices():
    random = np.random.default_rng(2)
    count, right = 24, 0
    for tolerance in np.linspace(0.3, 3, count):
        geometries = scene(random, 4)
        rho, sigma = albedo(random, 1), random.uniform(0, np.radians(60))
        (choice,) = ladder.choose_model(rho, sigma, geometries, LIGHTS, tolerance)
        errors = true_errors(rho[0], sigma, geometries, LIGHTS)
        assert errors[choice.model] <= 1.1 * tolerance
        right += choice.model == next(r for r in models.NAMES if errors[r] <= tolerance)
        for rung in models.NAMES:
            assert errors[rung] <= choice.errors[rung] + 1e-9
    assert right >= 0.95 * count


def test_every_material_may_have_a_scene_of_its_own():
    random = np.random.default_rng(3)
    rho, sigma = albedo(random, 5), np.radians([0.0, 5, 20, 35, 50])
    own = np.full((3, 5, 6), np.nan)
    for material, directions in enumerate((6, 1, 3, 2, 5)):
        own[:, material, :directions] = scene(random, directions)
    tolerance = np.array([0.5, 0.1, 2, 1, 0.3])
    together = ladder.choose_model(rho, sigma, own, LIGHTS, tolerance)
    for i, choice in enumerate(together):
        geometries = own[:, i, np.isfinite(own[0, i])]
        (alone,) = ladder.choose_model(rho[i], sigma[i], geometries, LIGHTS, tolerance[i])
        assert alone.reason == choice.reason
        np.testing.assert_allclose(list(alone.errors.values()), list(choice.errors.values()))


def test_a_level_surface_needs_no_more_than_lambert():
    grazing = np.radians([[89.0], [89.0], [180.0]])
    (choice,) = ladder.choose_model(albedo(np.random.default_rng(0), 1), 0.0, grazing, LIGHTS, 0.0)
    assert (choice.model, choice.error) == ("lambert", 0.0)
    assert "level" in choice.reason


def test_white_steep_grooves_lit_along_the_normal_need_the_reference():
    # The corner in which the closure is off by 8 %.
    normal = np.zeros((3, 1))
    (choice,) = ladder.choose_model(np.ones((1, 16)), np.radians(50), normal, LIGHTS[:1], 1.0)
    assert choice.model == "reference"
    assert choice.reason.startswith("reference: the simpler closure is up to ΔE00 ")
    assert choice.reason.endswith("off over 1 direction and 1 light, more than the 1 allowed.")


def test_what_is_not_known_is_not_taken_for_good():
    rho = np.full((2, 16), 0.5)
    rho[1, 3] = np.nan
    geometries = np.radians([[45.0, 86], [0, 10], [0, 20]])
    beyond, nowhere = ladder.choose_model(rho, 0.3, geometries, LIGHTS, 5.0)
    assert beyond.model == nowhere.model == "reference"
    assert "beyond" in beyond.reason
    (missing,) = ladder.choose_model(rho[1], 0.3, geometries[:, :1], LIGHTS, 5.0)
    assert missing.model == "reference"
    for lights, angles in (([], geometries), (LIGHTS, np.full((3, 2), np.nan))):
        with pytest.raises(DomainError, match="at least one"):
            ladder.choose_model(rho, 0.3, angles, lights)


def test_the_reason_says_why_the_cheaper_one_does_not_do():
    geometries = np.radians([[45.0, 30], [0, 10], [0, 90]])
    (choice,) = ladder.choose_model(np.full((1, 16), 0.8), np.radians(30), geometries, LIGHTS, 1.0)
    assert choice.reason == (
        f"closure: at most ΔE00 {choice.error:.2f} from the reference over 2 directions and "
        "2 lights, within the 1 allowed; the simpler two-bounce is "
        f"{choice.errors['two-bounce']:.2f} off."
    )


@pytest.mark.parametrize(
    ("lambert", "rough", "model", "words"),
    [
        (
            [0.2, 0.9],
            [0.1, 0.1],
            "lambert",
            "lambert: at worst ΔE00 0.90 off, within the 1 allowed.",
        ),
        (
            [0.2, 3.0],
            [0.1, 0.4],
            "rough",
            "within the 1 allowed; without roughness it would be 3.00.",
        ),
        (
            [0.2, 3.0],
            [0.1, 1.0004],
            "rough",
            "rough: at worst ΔE00 1.0004 off, the closest there is to the 1 allowed",
        ),
        (
            [0.2, 2.0],
            [0.1, 2.5],
            "lambert",
            "the closest there is to the 1 allowed; with roughness it would be 2.50.",
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
