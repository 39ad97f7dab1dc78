# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model "surface" against surfaces that it was not made from, and its limits."""

import numpy as np
import pytest

from core import ladder, models, reading, surface
from core.errors import DomainError
from core.numerics import direction_grid
from tools.tables import traces

RHO = np.array([0.02, 0.2, 0.5, 0.8, 0.95, 1.0])


def relative(kind, degrees):
    """Relative errors (65, 6), and by how much they exceed the traces' own."""
    known = traces.load(kind, degrees)
    found = surface.reflectance(traces.ALBEDOS, *known.directions, np.radians(degrees))
    error = np.abs(found / known.reflectance - 1)
    return error, np.maximum(error - known.error / known.reflectance, 0)


@pytest.mark.parametrize("degrees", [15, 30, 45])
def test_it_is_what_paths_from_the_eye_find_on_other_fields(degrees):
    error, beyond = relative("gaussian", degrees)
    assert np.median(error) < 0.005
    assert np.median(beyond) < 0.001
    assert np.quantile(beyond, 0.95) < 0.006


def test_the_spectrum_of_the_heights_hardly_matters_and_other_shapes_do():
    medians = {kind: np.median(relative(kind, 30)[0]) for kind in ("multi-scale", "band")}
    assert max(medians.values()) < 0.005
    assert np.median(relative("grooves", 30)[0]) > 0.01
    assert np.median(relative("grains", 30)[0]) > 0.03


@pytest.mark.parametrize("degrees", [15, 30, 45])
@pytest.mark.parametrize("kind", ["gaussian", "multi-scale"])
def test_readings_of_several_albedos_tell_one_roughness(kind, degrees):
    albedo = np.array([0.2, 0.5, 0.9])
    read = traces.load(kind, degrees).of(albedo)[0]
    sigma = np.radians(np.linspace(1, 60, 2361))
    away = np.abs(reading.from_albedo(albedo, sigma, "surface") - read)
    told = np.degrees(sigma[away.argmin(axis=0)])
    # At 0.9 a reading changes by 1e-3 a degree.
    np.testing.assert_allclose(told, degrees, rtol=0, atol=0.7 if degrees == 15 else 2.5)


def test_white_facets_lose_nothing():
    """Integrated over the view; what is missing near the horizon holds 0.1 % of its weight."""
    cosine, weights = np.polynomial.legendre.leggauss(24)
    squared = (cosine + 1) / 2  # of the sine: dω cos θ = d(sin² θ)/2 dφ
    view, azimuth = (
        np.arcsin(np.sqrt(squared))[:, np.newaxis],
        np.radians(np.arange(0, 180, 5) + 2.5),
    )
    for light in np.radians([0.0, 30, 60, 75]):
        for sigma in np.radians([5.0, 15, 30, 45, 60]):
            seen = surface.reflectance([1.0], light, view, azimuth, sigma)[..., 0].mean(axis=1)
            assert float(seen @ weights / 2) == pytest.approx(1, abs=0.006)


def test_light_and_view_may_be_swapped_and_mirrored():
    light, view, azimuth = direction_grid.hemisphere(300)
    there = surface.reflectance(RHO, light, view, azimuth, 0.5)
    np.testing.assert_array_equal(surface.reflectance(RHO, view, light, azimuth, 0.5), there)
    mirrored = surface.reflectance(RHO, light, view, -azimuth - 2 * np.pi, 0.5)
    np.testing.assert_allclose(mirrored, there, rtol=1e-12)


def test_it_goes_over_into_the_level_surface():
    light, view, azimuth = direction_grid.hemisphere(100)
    np.testing.assert_array_equal(
        surface.reflectance(RHO, light, view, azimuth, 0.0), np.broadcast_to(RHO, (100, 6))
    )
    for sigma in (1e-12, 1e-6, 1e-3):
        found = surface.reflectance(RHO, light, view, azimuth, sigma)
        np.testing.assert_allclose(
            found, np.broadcast_to(RHO, (100, 6)), rtol=3 * sigma, atol=1e-15
        )


def test_more_albedo_reflects_more_and_the_inverse_finds_it():
    light, view, azimuth = direction_grid.hemisphere(500)
    rho = np.linspace(0, 1, 101)
    for sigma in np.radians([0.0, 1, 20, 45, 65]):
        assert np.all(np.diff(surface.reflectance(rho, light, view, azimuth, sigma)) > 0)
        for instrument in ("45a:0", "di:8", "45as15"):
            read = reading.from_albedo(rho, sigma, "surface", instrument)
            back = reading.to_albedo(read, sigma, "surface", instrument)
            np.testing.assert_allclose(back, rho, rtol=1e-10, atol=1e-14)


def test_every_way_through_the_table_gives_the_same():
    """Few and many directions, one σ and many, together and apart."""
    light, view, azimuth = direction_grid.hemisphere(3000)
    sigma = np.radians(np.linspace(0, 65, 40))
    together = np.stack(surface.factors(light, view, azimuth, 0.4))
    few = np.stack(surface.factors(light[:40], view[:40], azimuth[:40], 0.4))
    np.testing.assert_allclose(few, together[:, :40], rtol=1e-9)
    crossed = np.stack(surface.factors(light[:40], view[:40], azimuth[:40], sigma[:, np.newaxis]))
    each = np.stack(surface.factors(light[:40], view[:40], azimuth[:40], sigma))
    np.testing.assert_allclose(np.einsum("cii->ci", crossed), each, rtol=1e-9, atol=1e-12)
    alone = np.stack(surface.factors(light[7], view[7], azimuth[7], sigma[9]))
    np.testing.assert_allclose(
        alone, each[:, 7] if sigma[7] == sigma[9] else crossed[:, 9, 7], rtol=1e-9
    )


def test_an_instrument_of_one_direction_reads_what_is_seen_there():
    sigma = np.radians([3.0, 22, 41, 63])
    read = reading.from_albedo(RHO, sigma, "surface", "45as15")
    angles = reading.INSTRUMENT_ANGLES["45as15"]
    seen = ladder.reflectance("surface", RHO, *angles, sigma)
    np.testing.assert_allclose(read, seen, rtol=1e-12)


def test_it_ends_where_nothing_was_traced():
    assert models.find("surface").largest_sigma == pytest.approx(
        np.degrees(surface.TABLE.largest_sigma)
    )
    with pytest.raises(DomainError, match=r"70°, and the model 'surface' ends at 65°"):
        surface.reflectance(RHO, 0.3, 0.2, 0.1, np.radians(70))
    last = surface.reflectance(RHO, np.radians(88), 0.3, 0.2, 0.5)
    np.testing.assert_array_equal(surface.reflectance(RHO, np.pi / 2, 0.3, 0.2, 0.5), last)


def test_numbers_that_are_none_stay_where_they_were():
    light = np.array([0.3, np.nan, 0.5])
    found = surface.reflectance([0.5, np.nan], light, 0.2, [0.1, 0.1, np.inf], 0.5)
    np.testing.assert_array_equal(np.isnan(found), [[False, True], [True, True], [True, True]])
    assert np.isnan(surface.reflectance([0.5], 0.3, 0.2, 0.1, np.nan)).all()
