# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rough surfaces as shapes: their slopes on the facets, their laws, their periods."""

import numpy as np
import pytest

from core import heights
from core.errors import DomainError

SIGMAS = (5, 15, 30, 45, 60)


@pytest.mark.parametrize("make", [heights.gaussian, heights.multiscale, heights.grains])
@pytest.mark.parametrize("degrees", SIGMAS)
def test_facets_have_the_slope_that_was_asked_for(make, degrees):
    """Counted over the mesh's triangles, by their normals."""
    mesh = heights.mesh_of_field(make(np.radians(degrees), cells=128, seed=degrees))
    slopes, share = mesh.slopes()
    assert share == pytest.approx(1 / len(mesh.faces))
    along = np.sqrt(np.mean(slopes**2, axis=0))
    assert np.sqrt(np.mean(along**2)) == pytest.approx(np.tan(np.radians(degrees)), rel=1e-9)
    assert along[0] == pytest.approx(along[1], rel=0.35), "the same both ways, but for chance"


def test_slopes_of_a_gaussian_surface_are_gaussian():
    """Mean tilt of a Gaussian surface: atan of a Rayleigh variable, by quadrature."""
    mesh = heights.mesh_of_field(heights.gaussian(np.radians(30), cells=1024))
    slopes, _ = mesh.slopes()
    tilt = np.arctan(np.hypot(*slopes.T))
    share = (np.arange(10000) + 0.5) / 10000
    drawn = np.arctan(np.tan(np.radians(30)) * np.sqrt(-2 * np.log(1 - share)))
    assert np.degrees(tilt.mean()) == pytest.approx(np.degrees(drawn.mean()), abs=0.1)
    assert np.degrees(np.percentile(tilt, 95)) == pytest.approx(
        np.degrees(np.percentile(drawn, 95)), abs=0.3
    )


def test_correlation_is_what_was_asked_for():
    """At one correlation length it has fallen to 1/e, averaged over surfaces."""
    found = []
    for seed in range(8):
        field = heights.gaussian(0.3, 1.0, cells=256, correlation_cells=8, seed=seed).heights
        found.append(np.mean(field * np.roll(field, 8, 1)) / np.mean(field**2))
    assert np.mean(found) == pytest.approx(np.exp(-1), abs=0.02)


def test_a_multiscale_surface_has_no_one_scale():
    """Its slope comes from finer and finer waves; a Gaussian one has lost them at a quarter ℓ."""

    def coarse_share(field, step):
        coarse = heights.HeightField(
            field.heights[::step, ::step], tuple(step * np.array(field.spacing))
        )
        return coarse.rdq / field.rdq

    many = heights.multiscale(0.5, cells=512, correlation_cells=64)
    one = heights.gaussian(0.5, cells=512, correlation_cells=64)
    assert coarse_share(one, 16) > 0.95
    assert coarse_share(many, 16) < 0.75


@pytest.mark.parametrize("law", heights.LAWS)
@pytest.mark.parametrize("degrees", SIGMAS)
def test_grooves_follow_their_law(law, degrees):
    """Against the mean of tan θ's bounded companions by a quadrature of the law itself."""
    sigma = np.radians(degrees)
    walls = heights.grooves(sigma, law)
    slope = (np.arange(200_000) + 0.5) / 200_000 * np.pi / 2
    if law == "gaussian":
        density = np.tan(slope) / np.cos(slope) ** 2
        density = density * np.exp(-(np.tan(slope) ** 2) / 2 / np.tan(sigma) ** 2)
    else:
        density = np.exp(-(slope**2) / 2 / sigma**2) * np.sin(slope)
    for of in (np.cos, np.sin, lambda t: t):
        expected = np.sum(of(slope) * density) / np.sum(density)
        assert np.sum(walls.widths * of(walls.slopes)) == pytest.approx(expected, rel=3e-4)
    assert walls.period == pytest.approx(1)
    assert walls.depths.max() <= 2 / 1024 + 1e-12


def test_grooves_have_level_rims_and_the_slopes_on_their_facets():
    walls = heights.grooves(np.radians(30), strips=64)
    mesh = heights.mesh_of_grooves(walls)
    assert mesh.vertices[: 2 * 64 + 1 : 2, 2] == pytest.approx(0)
    slopes, share = mesh.slopes()
    assert np.abs(slopes[::2, 0]) == pytest.approx(np.tan(walls.slopes))
    assert slopes[::2, 0] == pytest.approx(-slopes[1::2, 0])
    assert share[::2] * 2 == pytest.approx(walls.widths)
    assert mesh.sdq == pytest.approx(walls.sdq)


def test_grains_are_spheres_that_cover_the_floor():
    """A sphere's top is as curved as its radius says, and no floor shows."""
    bed = heights.grains(diameter=2.0, cells=256, diameter_cells=32)
    top = np.unravel_index(np.argmax(bed.heights), bed.heights.shape)
    row = np.roll(bed.heights[top[0]], 128 - top[1])[128 - 4 : 128 + 5]
    away = np.arange(-4, 5) * bed.spacing[0]
    assert row - row[4] == pytest.approx(np.sqrt(1 - away**2) - 1, abs=1e-9)
    assert bed.heights.max() - bed.heights.min() < 12
    unique, count = np.unique(np.round(bed.heights, 9), return_counts=True)
    assert unique.size > 1000
    assert count[0] == 1, "a level floor would repeat its height"


@pytest.mark.parametrize("make", [heights.gaussian, heights.multiscale, heights.grains])
def test_a_seed_is_a_surface(make):
    first, again, other = (make(0.3, cells=128, seed=seed).heights for seed in (1, 1, 2))
    assert (first == again).all()
    assert not np.allclose(first, other)


def test_level_surfaces_are_level():
    assert heights.gaussian(0.0, cells=64).sdq == 0
    assert heights.grooves(0.0).sdq == 0


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: heights.gaussian(np.pi / 2), "σ is 90°; give 0 to below 90 degrees"),
        (lambda: heights.gaussian(-0.1), "σ is -5.72958°"),
        (lambda: heights.gaussian(0.3, 0.0), "The correlation length is not above 0"),
        (lambda: heights.gaussian(0.3, cells=16), "8 cells of a grid of 16; give 1 to a quarter"),
        (lambda: heights.gaussian(0.3, cells=4), "The grid has 4 cells a side; give 8 or more."),
        (lambda: heights.multiscale(0.3, hurst=0.0), "The Hurst exponent is 0"),
        (lambda: heights.multiscale(0.3, finest=1.0), "The finest wavelength is 1 cells"),
        (lambda: heights.grains(diameter=-1.0), "The diameter of the grains is not above 0"),
        (lambda: heights.grooves(0.3, "beckmann"), "Slope law 'beckmann' is not known"),
        (lambda: heights.grooves(0.3, strips=0), "0 strips over 1 are no surface"),
        (
            lambda: heights.HeightField(np.array([[0, np.nan], [0, 1]]), (1.0, 1.0)),
            "1 of 4 heights are missing; fill the holes first",
        ),
        (lambda: heights.HeightField(np.zeros(4), (1.0, 1.0)), "give 2 × 2 or more"),
        (lambda: heights.HeightField(np.zeros((2, 2)), (1.0, 0.0)), "give two lengths above 0"),
        (
            lambda: heights.HeightField(np.zeros((2, 2)), (1.0, 1.0)).of_slope(0.1),
            "The surface is level",
        ),
    ],
)
def test_what_is_no_surface_is_refused(make, sentence):
    with pytest.raises(DomainError) as caught:
        make()
    assert sentence in str(caught.value)
