# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rough meshes in real renders of Cycles, against what is known of them without a render.

These are quick; `tools/checks/check_laboratory.py` holds the same to a thousandth.
"""

from math import radians

import numpy as np
import pytest
from rough_spectra.addon.instrument.measure import Geometry
from rough_spectra.addon.laboratory import experiment, kinds, readings
from rough_spectra.addon.laboratory.experiment import spot_readings
from rough_spectra.addon.samples import presets
from rough_spectra.core import heights, vcavity
from rough_spectra.core.errors import DomainError, InputError
from rough_spectra.core.vcavity import slope_law

SPREAD_OF_NOISE = 5
"""Standard errors that a quick render may be off by. Few seeds tell them roughly."""


@pytest.mark.parametrize("kind", ["gaussian", "grooves"])
def test_a_level_sample_reads_its_albedo(kind):
    """As a flat sample does: light, view and pixels are those of the instrument."""
    level = kinds.make(kind, 0.0, cells=32)
    albedos = [0.0, 0.2, 0.5, 1.0]
    found = experiment.measure(level.mesh, albedos, seeds=2, samples=4)
    assert found.reflectance == pytest.approx(albedos, abs=2e-6)
    assert found.noise == pytest.approx(0, abs=2e-6)


def test_a_level_sample_reads_its_albedo_from_aside():
    level = kinds.make("gaussian", 0.0, cells=32)
    aside = Geometry(((radians(60), radians(130)), (radians(10), 0.0)), radians(70))
    found = experiment.measure(level.mesh, [0.5], geometry=aside, seeds=2, samples=4)
    assert found.reflectance == pytest.approx(0.5, abs=1e-5)


def test_a_gaussian_surface_reads_as_one_traced_elsewhere():
    """Rdq = tan 30°, 45°/0°, traced by two programs that know nothing of Blender, ± 0.002."""
    rough = kinds.make("gaussian", radians(30), cells=256)
    found = experiment.measure(rough.mesh, [0.2, 0.5, 0.8], seeds=2, samples=64)
    off = found.reflectance - [0.1680, 0.4471, 0.7676]
    assert np.abs(off).max() < 0.002 + SPREAD_OF_NOISE * found.noise.max()
    assert found.noise.max() < 1e-3


@pytest.mark.parametrize("law", slope_law.LAWS)
def test_grooves_read_as_the_solver_says(law):
    """No random number in common, nor a line: an integral equation against rendered facets."""
    kind = {"gaussian": "grooves", "oren-nayar": "grooves-oren-nayar"}[law]
    rough = kinds.make(kind, radians(30), cells=128)
    assert rough.law == law
    albedos = np.array([0.2, 0.6, 0.95])
    found = experiment.measure(rough.mesh, albedos, seeds=4, samples=96)
    expected = vcavity.reading_from_albedo(albedos, radians(30), slopes=law)
    assert found.noise.max() < 2e-3
    bound = 1e-3 * expected + SPREAD_OF_NOISE * found.noise
    assert (np.abs(found.reflectance - expected) < bound).all()


def test_a_reading_does_not_depend_on_the_unit():
    """Micrometers or meters: facets are brought to one size before they are rendered."""
    one, other = (kinds.make("gaussian", 0.5, length, cells=64) for length in (1.0, 2.0**-14))
    first, second = (
        experiment.measure(rough.mesh, [0.5], seeds=2, samples=4).reflectance
        for rough in (one, other)
    )
    assert first == pytest.approx(second, rel=1e-6)


def test_a_spot_is_round_and_goes_on_at_the_edges():
    picture = np.zeros((40, 60))
    picture[0, 0] = 1.0
    seen = spot_readings(picture, (6.0, 4.0), 2.0)
    assert seen.sum() == pytest.approx(1)
    inside = seen > 1e-9
    assert np.count_nonzero(inside) == pytest.approx(np.pi * 10**2, rel=0.02)
    assert inside[0, 10]
    assert inside[-10, 0]
    assert not inside[8, 8], "the corner of a square"
    assert seen[inside] == pytest.approx(1 / np.count_nonzero(inside))


def test_spread_is_of_places_and_noise_of_random_numbers():
    """Pictures made of a known pattern and known noise give both back, apart."""
    random = np.random.default_rng(1)
    pattern = np.repeat(random.normal(0.5, 0.03, (8, 8)), 8, axis=0).repeat(8, axis=1)
    truth = spot_readings(pattern, (1.0, 1.0), 0.25)
    found = []
    for _ in range(20):
        pictures = pattern + random.normal(0, 0.2, (4, 64, 64))
        found.append(experiment._judged(pictures, (1.0, 1.0), 0.25))
    mean, noise, spread, spot_noise = np.mean(found, axis=0)
    assert mean == pytest.approx(pattern.mean(), abs=0.002)
    assert noise == pytest.approx(0.2 / 64 / 2, rel=0.3)
    assert spread == pytest.approx(truth.std(), rel=0.1)
    assert spot_noise == pytest.approx(0.2 / np.sqrt(np.pi * 8**2) / 2, rel=0.1)


def test_a_small_spot_sees_more_spread():
    rough = kinds.make("gaussian", radians(30), cells=64)
    large, small = (
        experiment.measure(rough.mesh, [0.5], spot, seeds=3, samples=16) for spot in (8.0, 2.0)
    )
    assert small.spread[0] > 2 * large.spread[0] > 0
    assert small.reflectance == pytest.approx(large.reflectance, abs=6 * large.noise[0])


def test_a_small_spot_costs_no_more_rays(monkeypatch, tmp_path):
    """Its picture is four times as fine a side, and would be 16 times as slow."""
    asked = []
    monkeypatch.setattr(
        experiment.Job, "__init__", lambda _self, _worker, prepare: asked.append(prepare)
    )
    rough = kinds.make("gaussian", radians(30), cells=64)
    for spot in (8.0, 8.0 / 32):
        experiment.Experiment(rough.mesh, [0.5], spot, samples=256)
    jobs = [prepare(tmp_path) for prepare in asked]
    large, small = (job["pixels"] ** 2 * job["samples"] for job in jobs)
    assert small <= large
    assert jobs[1]["pixels"] == 4 * jobs[0]["pixels"]


def test_albedos_come_back_in_their_order():
    level = kinds.make("gaussian", 0.0, cells=32)
    albedos = [0.9, 0.1, 0.5, 0.1, 0.7]
    found = experiment.measure(level.mesh, albedos, seeds=2, samples=1)
    assert found.albedos.tolist() == albedos
    assert found.reflectance == pytest.approx(albedos, abs=2e-6)


def test_the_facets_of_a_reading_lose_its_roughness():
    flat = presets.load("colorchecker/14-green")
    assert readings.facets(flat).values == pytest.approx(flat.values)
    brick = presets.load("everyday/brick")
    rough = readings.facets(brick)
    assert rough.kind == "albedo"
    if brick.kind == "reading":
        assert (rough.values > brick.values).all()


def test_the_table_says_what_was_measured():
    rough = kinds.make("grooves", radians(30), cells=32)
    numbers = np.array([[0.2, 0.5], [0.16, 0.45], [1e-4, 2e-4], [3e-4, 4e-4], [5e-4, 6e-4]])
    table = readings.to_csv(rough, experiment.Measured(*numbers, 8.0), np.array([400.0, 700.0]))
    lines = table.decode().splitlines()
    rows = [line for line in lines if not line.startswith("#")]
    assert rows[0] == "wavelength_nm,albedo,reflectance,noise,spread,noise_of_a_spot,predicted"
    assert rows[1].startswith("400,0.200000,0.160000,0.000100,0.000300,0.000500,0.16")
    assert any(line.startswith("# sigma: 30 degrees; Rdq 0.57") for line in lines)


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        ({"albedos": [0.2, 1.2]}, "An albedo is 1.2; give 0 to 1."),
        ({"albedos": [float("nan")]}, "An albedo is nan; give 0 to 1."),
        ({"albedos": []}, "There is no albedo to measure; give one or more."),
        (
            {"spot": 9.0},
            "The spot is 9 wide, and the sample repeats after 8; give a spot of 0.0625",
        ),
        ({"spot": -1.0}, "The spot is -1 wide"),
        ({"spot": float("nan")}, "The spot is nan wide"),
        ({"seeds": 1}, "1 renders tell no noise; give 2 seeds or more."),
        ({"samples": 0}, "There are 0 rays a pixel; give 1 or more."),
    ],
)
def test_what_cannot_be_measured_is_refused(ask, sentence):
    rough = kinds.make("gaussian", 0.3, cells=64)
    with pytest.raises(DomainError) as caught:
        experiment.measure(rough.mesh, **{"albedos": [0.5]} | ask)
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (
            {"kind": "plaster"},
            "The kind of sample 'plaster' is not known; choose one of: gaussian,",
        ),
        ({"sigma": None}, "A sample of the kind 'gaussian' needs a roughness; give σ."),
        ({"sigma": radians(90)}, "σ is 90°; give 0 to below 90 degrees"),
        ({"length": 0.0}, "The correlation length is 0; give a length above 0."),
        ({"cells": 16}, "The grid has 16 cells; give 32 to 2048."),
        ({"seed": -1}, "The seed is -1; give 0 or more."),
        ({"kind": "map"}, "A map of heights needs a file; name an image"),
    ],
)
def test_what_cannot_be_made_is_refused(ask, sentence):
    with pytest.raises((DomainError, InputError)) as caught:
        kinds.make(**{"kind": "gaussian", "sigma": 0.3} | ask)
    assert sentence in str(caught.value)


@pytest.mark.parametrize("kind", ["gaussian", "multiscale", "grains"])
def test_kinds_have_the_slope_that_was_asked_for(kind):
    rough = kinds.make(kind, radians(35), cells=64)
    assert rough.sigma == pytest.approx(radians(35))
    assert rough.mesh.sdq == pytest.approx(np.sqrt(2) * np.tan(radians(35)))
    assert isinstance(rough.mesh, heights.Mesh)
