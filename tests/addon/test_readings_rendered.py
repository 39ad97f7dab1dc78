# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The main promise: assigned materials, measured in Cycles at 45°/0°, read what they should.

The target is computed here from the spectrum by colour-science and the published model alone, so
an error in the extension's own way from spectrum to RGB shows.
"""

import math
import warnings

import bpy
import numpy as np
import pytest
from rough_spectra.addon.instrument.measure import RING_45_0, Geometry, measure
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive
from rough_spectra.addon.samples import presets
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core import reading

SIGMAS = (0, 15, 30, 45)
LIMIT = 0.05
"""ΔE00. Cycles in float32 comes to 1e-4; nobody sees 0.3."""

SPACES = {
    "Linear Rec.709": "sRGB",
    "Linear Rec.2020": "ITU-R BT.2020",
    "ACEScg": "ACEScg",
}


def published_reading(sample, degrees):
    """The two-bounce model at 45°/0°, in its plain form, for an albedo; else what was read."""
    if sample.kind == "reading":
        return sample.values
    s2 = math.radians(degrees) ** 2
    f1, f2 = 1 - 0.5 * s2 / (s2 + 0.33), 0.17 * s2 / (s2 + 0.13)
    return f1 * sample.values + f2 * sample.values**2


def peer_xyz(values, wavelengths, illuminant="D65"):
    science = colour()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return (
            science.sd_to_XYZ(
                science.SpectralDistribution(values, wavelengths),
                illuminant=science.SDS_ILLUMINANTS[illuminant],
                method="ASTM E308",
            )
            / 100
        )


def scene_to_xyz(rgb, space, white):
    """Scene-linear RGB to XYZ under `white`: colour-science's own primaries and Bradford."""
    science = colour()
    model = science.RGB_COLOURSPACES[SPACES[space]]
    own_white = science.xy_to_XYZ(model.whitepoint)
    xyz = np.asarray(rgb) @ model.matrix_RGB_to_XYZ.T
    adapt = science.adaptation.matrix_chromatic_adaptation_VonKries(
        own_white, white, transform="Bradford"
    )
    return xyz @ adapt.T


def delta_e(xyz_a, xyz_b, white):
    science = colour()
    light = science.XYZ_to_xy(white)
    return science.delta_E(
        science.XYZ_to_Lab(xyz_a, light), science.XYZ_to_Lab(xyz_b, light), method="CIE 2000"
    )


def assign_and_measure(samples, request_for, illuminant="D65", **settings):
    """Assign each sample at each σ; gives requests, solutions and the measured RGB."""
    requests = [
        request_for(sample, degrees, illuminant=illuminant, **settings)
        for sample in samples
        for degrees in SIGMAS
    ]
    materials = [bpy.data.materials.new(request.sample.name) for request in requests]
    solutions = derive.assign(list(zip(materials, requests, strict=True)), keep_gloss=False)
    seen = measure(materials, [RING_45_0])[0]
    assert seen[:, 1].max() < 1e-6  # rounding: each sample picks one of the eight lights
    return requests, solutions, seen[:, 0]


def apart(requests, rgb, space, illuminant="D65"):
    """ΔE00 between what Cycles showed and what the spectrum says, in colour-science alone."""
    white = peer_xyz(np.ones(43), np.arange(360.0, 781.0, 10.0), illuminant)
    targets, seen = [], scene_to_xyz(rgb, space, white)
    for request in requests:
        sample, degrees = request.sample, math.degrees(request.sigma)
        own = peer_xyz(np.ones(sample.values.size), sample.wavelengths, illuminant)
        # Each grid's weights have their own white, which the perfect diffuser has to reach.
        values = published_reading(sample, degrees)
        targets.append(peer_xyz(values, sample.wavelengths, illuminant) * white / own)
    return delta_e(seen, np.array(targets), white)


def in_gamut(solutions):
    return np.array([not any("misses its target" in w for w in s.warnings) for s in solutions])


@pytest.mark.parametrize("space", SPACES)
def test_presets_and_nix_samples_read_their_target(space, nix, request_for, request):
    if space != "Linear Rec.709":
        request.getfixturevalue("set_working_space")(space)
    samples = [*presets.load_all("colorchecker"), *nix.values()]
    requests, solutions, rgb = assign_and_measure(samples, request_for)
    found = apart(requests, rgb, space)
    good = in_gamut(solutions)
    # Only cyan lies outside Rec.709; nothing lies outside the two large spaces.
    outside = {r.sample.name for r, ok in zip(requests, good, strict=True) if not ok}
    assert outside == ({"ColorChecker 18 Cyan"} if space == "Linear Rec.709" else set())
    assert found[good].max() <= LIMIT
    # The report of how far a color out of gamut misses is true too.
    for i in np.flatnonzero(~good):
        assert found[i] > LIMIT
        assert found[i] == pytest.approx(solutions[i].delta_e_instrument, abs=0.01)


def test_with_the_model_left_to_choose_they_read_their_target_too(nix, request_for):
    samples = [*presets.load_all("colorchecker"), *nix.values()]
    requests, solutions, rgb = assign_and_measure(samples, request_for, model=solve.AUTO)
    white = peer_xyz(np.ones(43), np.arange(360.0, 781.0, 10.0))
    wanted = []
    for request in requests:
        sample = request.sample
        own = peer_xyz(np.ones(sample.values.size), sample.wavelengths)
        reading = solve.target_reading(request)
        wanted.append(peer_xyz(reading, sample.wavelengths) * white / own)
    found = delta_e(scene_to_xyz(rgb, "Linear Rec.709", white), np.array(wanted), white)
    assert found[in_gamut(solutions)].max() <= LIMIT
    assert {solution.model for solution in solutions} == {"surface"}


@pytest.mark.parametrize("illuminant", ["A", "D50"])
def test_color_is_right_under_another_light(colorchecker, request_for, illuminant):
    requests, solutions, rgb = assign_and_measure(colorchecker[::5], request_for, illuminant)
    found = apart(requests, rgb, "Linear Rec.709", illuminant)
    assert found[in_gamut(solutions)].max() <= LIMIT


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("illuminant", ["D65", "A", "F11"])
def test_neutral_spectra_have_equal_channels(space, illuminant, request_for, request):
    if space != "Linear Rec.709":
        request.getfixturevalue("set_working_space")(space)
    wavelengths = np.arange(380.0, 781.0, 10.0)
    grays = [Sample(f"gray {v}", wavelengths, np.full(41, v), "albedo") for v in (0.05, 0.5, 1.0)]
    _, _, rgb = assign_and_measure(grays, request_for, illuminant)
    # Blender's own matrix has six digits.
    assert np.ptp(rgb, axis=-1).max() < 5e-6
    expected = [published_reading(gray, degrees)[0] for gray in grays for degrees in SIGMAS]
    np.testing.assert_allclose(rgb[:, 1], expected, rtol=1e-5)


@pytest.mark.parametrize("model", ["first-order", "closure"])
def test_other_models_read_their_own_target(colorchecker, request_for, model):
    gray = Sample("gray", np.arange(380.0, 781.0, 10.0), np.full(41, 0.8), "albedo")
    _, _, rgb = assign_and_measure([gray], request_for, model=model)
    for degrees, seen in zip(SIGMAS, rgb, strict=True):
        s2 = math.radians(degrees) ** 2
        expected = {
            "first-order": (1 - 0.5 * s2 / (s2 + 0.33)) * 0.8,
            "closure": reading.from_albedo([0.8], math.radians(degrees), "closure")[0],
        }
        np.testing.assert_allclose(seen, expected[model], rtol=1e-5)


def test_principled_reads_as_diffuse_does(colorchecker, request_for):
    work = [(bpy.data.materials.new("m"), request_for(s)) for s in colorchecker[:4] * 2]
    derive.assign(work[:4], shader="DIFFUSE", keep_gloss=False)
    derive.assign(work[4:], shader="PRINCIPLED", keep_gloss=False)
    oblique = Geometry(((1.1, 2.0),), 0.9)
    seen = measure([material for material, _ in work], [RING_45_0, oblique])[:, :, 0]
    np.testing.assert_allclose(seen[:, :4], seen[:, 4:], rtol=2e-6)


def test_infeasible_readings_are_met_and_reported(request_for):
    """A white paper cannot be this rough, yet the material reads what the instrument printed."""
    white = Sample("paper", np.arange(380.0, 781.0, 10.0), np.full(41, 0.95), "reading")
    _, solutions, rgb = assign_and_measure([white], request_for)
    np.testing.assert_allclose(rgb, 0.95, rtol=1e-5)
    told = [bool(s.warnings) for s in solutions]
    assert told == [False, False, True, True]
    assert "'paper' reads 0.950 at 380 nm, but white facets give " in solutions[2].warnings[0]
    assert "at most 19.5° would fit" in solutions[2].warnings[0]
