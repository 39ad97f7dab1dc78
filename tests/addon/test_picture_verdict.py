# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verdicts on patches under one lamp, where each rung's color is known in closed form."""

from itertools import pairwise

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.picture import verdict
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics import wavelength_grid

from tests.addon.test_spectral_picture import PATCHES, ROWS, from_above, new_material, strip, sun

pytestmark = pytest.mark.usefixtures("empty_file")


def patches():
    """Measured patches under a sun of an incandescent lamp: nothing lights another."""
    scene = from_above(len(PATCHES))
    samples = [api.find("white 9.5" if name == "white" else name) for name in PATCHES]
    materials = [new_material(name) for name in PATCHES]
    api.assign(
        [(m, api.request(s, 0.0)) for m, s in zip(materials, samples, strict=True)], gloss="none"
    )
    for column, material in enumerate(materials):
        strip(column, material)
    sun(scene)
    return scene, samples


@pytest.fixture(scope="module")
def judged(extension):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene, samples = patches()
    job = verdict.Judging(scene, samples=16)  # blocks of 3 pixels
    try:
        job.wait()
        found = job.verdict()
    finally:
        job.close()
    space = working_space.current()
    really = None
    if bpy.app.version >= (5, 0, 0):
        api_space(verdict.WIDE)
        picture = api.spectral_picture(scene, bands=3, samples=16)
        really = (
            picture.comparison.plain[..., :3] @ np.linalg.inv(working_space.current().from_xyz).T
        )
    return found, samples, space, really


def api_space(name):
    bpy.ops.wm.set_working_color_space(convert_colors=True, working_space=name)
    api.renew(api.materials())


def expected(samples):
    """XYZ of each patch, from spectrum times lamp, and of the lamp."""
    lamp = illuminant_spectra.planck(2856.0)
    lamp = lamp[:, np.newaxis] * illuminant_spectra.observer() / illuminant_spectra.to_xyz(lamp)[1]
    step = illuminant_spectra.GRID[1] - illuminant_spectra.GRID[0]
    spectra = [
        wavelength_grid.resample(
            s.reflectance, s.wavelengths, illuminant_spectra.GRID, method="linear", ends="hold"
        )
        for s in samples
    ]
    return np.array(spectra) @ lamp * step, lamp.sum(axis=0) * step


def by_rgb(samples, space):
    """XYZ of what is right under D65, times the lamp's color."""
    _, white = expected(samples)
    lamp = np.maximum(space.from_xyz @ white, 0)
    colors = [s.reflectance @ space.rgb_weights(s.wavelengths, "D65") for s in samples]
    return np.clip(colors, 0, 1) * lamp @ np.linalg.inv(space.from_xyz).T


def blocks(of_patches):
    """As 4 rows of one pixel a patch come into blocks of 3 by 3."""
    return of_patches.reshape(-1, 3, 3).mean(axis=1)


def apart(shown, truth, white):
    labs = (color_difference.xyz_to_lab(each, white) for each in (shown, truth))
    return color_difference.delta_e(*labs)


def test_rgb_is_off_by_what_three_channels_leave(judged):
    found, samples, space, _ = judged
    truth, white = expected(samples)
    delta_e = apart(blocks(by_rgb(samples, space)), blocks(truth), white)
    rung = found.rungs[0]
    assert rung.kind == "rgb"
    assert rung.largest == pytest.approx(delta_e.max(), abs=0.15)
    assert rung.mean == pytest.approx(delta_e.mean(), abs=0.1)
    assert rung.mean > 2


def test_what_is_matched_to_the_one_light_is_right_as_far_as_its_channels_reach(judged):
    """The lamp's light meets one surface only: a color a channel then is all that is needed."""
    found, samples, space, _ = judged
    truth, white = expected(samples)
    lamp = space.from_xyz @ white
    colors = np.clip(truth @ space.from_xyz.T / lamp, 0, 1)
    shown = colors * lamp @ np.linalg.inv(space.from_xyz).T
    delta_e = apart(blocks(shown), blocks(truth), white)
    rungs = {rung.kind: rung for rung in found.rungs}
    assert rungs["lights"].mean == pytest.approx(delta_e.mean(), abs=0.1)
    if "space" in rungs:  # in a wide space none of the patches is out of gamut
        assert rungs["space and lights"].usual < 0.3


def test_the_first_rung_within_the_tolerance_is_the_verdict(judged):
    found, *_ = judged
    assert not found.enough
    assert found.chosen is next(r for r in found.rungs if r.usual <= 0.85)
    assert found.sentence.startswith("RGB is not enough (95 % of the picture within ΔE00 ")
    assert found.touched == 0


@pytest.mark.skipif(bpy.app.version < (5, 0, 0), reason="Blender 4.5 has one working space")
def test_another_working_space_is_foretold_as_it_comes_out(judged):
    found, samples, _, really = judged
    truth, white = expected(samples)
    shown = really[:ROWS].reshape(ROWS, -1, 3)[0]
    delta_e = apart(blocks(shown), blocks(truth), white)
    rung = next(r for r in found.rungs if r.kind == "space")
    assert rung.mean == pytest.approx(delta_e.mean(), abs=0.1)
    assert rung.largest == pytest.approx(delta_e.max(), abs=0.15)


def test_passes_follow_until_the_tolerance(judged):
    found, *_ = judged
    passes = [rung for rung in found.rungs if rung.kind == "passes"]
    assert [rung.renders for rung in passes] == [*range(1, len(passes) + 1)]
    assert passes[-1].usual <= 0.85
    assert all(rung.usual > 0.85 for rung in passes[:-1])
    assert all(a.seconds < b.seconds for a, b in pairwise(passes))


def test_noise_is_not_taken_for_error():
    """Where all places are alike, 95 % of them are off by the mean, however few paths tell."""
    scene = from_above(32)
    scene.render.resolution_y = 32
    scene.camera.location = (16, 16, 1)
    strip(0, new_material("Wall", (0.7, 0.3, 0.1)))
    bpy.data.objects["Strip"].scale = (40, 40, 1)
    sun(scene)
    # Each path goes to one of the lamps, and no block's are split evenly by three.
    for color in ((0.1, 0.2, 1.0), (0.2, 1.0, 0.1)):
        other = sun(scene)
        other.use_temperature, other.color = False, color
    job = verdict.Judging(scene, samples=2)
    try:
        job.wait()
        rung = job.verdict().rungs[0]
    finally:
        job.close()
    assert rung.mean > 0.5
    assert rung.largest > 1.15 * rung.mean  # noise there is
    assert rung.usual == pytest.approx(rung.mean, rel=0.1)
