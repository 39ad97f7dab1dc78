# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""EON as the chart computes it, held to what its authors state, and matching as a user would."""

import numpy as np
import pytest

from core import cycles
from tools.chart import chart_lobes
from tools.chart.chart_work import RING

ROUGHNESSES = (0.0, 0.3, 0.7, 1.0)
RHO = np.array([0.05, 0.2, 0.5, 0.8, 1.0])


def published(rho, r, light, view, azimuth):
    """Portsmouth, Kutz and Hill 2025, equations 13 to 20, written as there."""
    mu_i, mu_o = np.cos(light), np.cos(view)
    s = np.sin(light) * np.sin(view) * np.cos(azimuth)
    over = np.where(s > 0, s / np.maximum(mu_i, mu_o), s)
    scale = 1 / (1 + (1 / 2 - 2 / (3 * np.pi)) * r)

    def directional(mu):
        sine = np.sqrt(1 - mu * mu)
        g = sine * (np.arccos(mu) - sine * mu)
        g += 2 / 3 * (sine / mu * (1 - sine**3) - sine)
        return scale * (1 + r * g / np.pi)

    mean = scale * (1 + (2 / 3 - 28 / (15 * np.pi)) * r)
    later = rho**2 * mean / (1 - rho * (1 - mean))
    lost = (1 - directional(mu_i)) * (1 - directional(mu_o)) / (1 - mean)
    return rho * scale * (1 + r * over) + later * lost


def random_angles(count):
    rng = np.random.default_rng(3)
    return np.stack((*rng.uniform(0, 1.55, (2, count)), rng.uniform(0, np.pi, count)))


@pytest.mark.parametrize("roughness", ROUGHNESSES[1:])
def test_it_is_the_published_formula(roughness):
    angles = random_angles(200)
    found = chart_lobes.eon(RHO, roughness, angles)
    wanted = published(RHO, roughness, *angles[:, :, np.newaxis])
    np.testing.assert_allclose(found, wanted, rtol=1e-10)


def test_without_roughness_it_is_lambert():
    found = chart_lobes.eon(RHO, 0.0, random_angles(50))
    np.testing.assert_allclose(found, np.tile(RHO, (50, 1)), rtol=1e-14)


@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_light_and_view_may_change_places(roughness):
    light, view, azimuth = random_angles(100)
    there = chart_lobes.eon(RHO, roughness, np.stack((light, view, azimuth)))
    back = chart_lobes.eon(RHO, roughness, np.stack((view, light, azimuth)))
    np.testing.assert_allclose(there, back, rtol=1e-12)


@pytest.mark.parametrize("roughness", ROUGHNESSES)
@pytest.mark.parametrize("light", [0.0, 0.7, 1.3])
def test_a_white_surface_sends_all_light_back(roughness, light):
    """Integrated over the view: dω cos θ / π = d(sin² θ) dφ / 2π. Exact with exact albedos."""
    nodes, weights = np.polynomial.legendre.leggauss(64)
    square, azimuth = (nodes + 1) / 2, np.pi * (nodes + 1) / 2
    # Steps crowd toward grazing, where the albedo has a root: x = 1 - (1 - u)².
    sine = np.sqrt(1 - (1 - square) ** 2)
    view, turn = np.meshgrid(np.arcsin(sine), azimuth, indexing="ij")
    found = chart_lobes.eon(
        np.ones(1), roughness, np.stack((np.full_like(view, light), view, turn))
    )[..., 0]
    share = (weights * (1 - square))[:, np.newaxis] * (weights / 2)
    assert np.sum(found * share) == pytest.approx(1, abs=2e-4)
    # Cycles' cube of the color is 1 as well: they differ below white only.
    same = cycles.reflectance(np.ones(1), roughness, light, 0.4, 1.0)
    eon = chart_lobes.eon(np.ones(1), roughness, np.array([light, 0.4, 1.0]))
    np.testing.assert_allclose(eon, same, rtol=1e-12)


@pytest.mark.parametrize("key", chart_lobes.LOBES)
@pytest.mark.parametrize("roughness", ROUGHNESSES)
def test_the_color_of_a_reading_reads_so(key, roughness):
    of = chart_lobes.LOBES[key]
    wanted = np.array([0.03, 0.4, 0.93])
    color = of.color(wanted, roughness)
    np.testing.assert_allclose(of.reflectance(color, roughness, np.array(RING)), wanted, rtol=1e-9)


@pytest.mark.parametrize("key", chart_lobes.LOBES)
def test_matching_finds_the_slider_that_made_the_surface(key):
    of, slider = chart_lobes.LOBES[key], 0.6
    color, angles = np.array([[0.2, 0.5, 0.8]]), random_angles(40)
    truth = of.reflectance(color[np.newaxis], slider, angles[:, :, np.newaxis])
    readings = of.reflectance(color, slider, np.array(RING))
    answer, found = chart_lobes.match(
        of, readings, angles, lambda seen: float(np.abs(seen - truth).mean())
    )
    assert found == pytest.approx(slider)
    np.testing.assert_allclose(answer, truth, rtol=1e-9)
