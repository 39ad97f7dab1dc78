# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps that are set after the render, against sums over the spectrum and against new renders."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.picture import relight, render
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics import wavelength_grid

from tests.addon.test_spectral_picture import PATCHES, from_above, new_material, strip, sun

pytestmark = pytest.mark.usefixtures("empty_file")
WARM, COLD = 2856.0, 9000.0


@pytest.fixture(scope="module")
def made(extension, tmp_path_factory):
    """Measured patches under two suns, and a picture with other lamps of the same scene."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = from_above(len(PATCHES))
    samples = [api.find("white 9.5" if name == "white" else name) for name in PATCHES]
    materials = [new_material(name) for name in PATCHES]
    api.assign(
        [(m, api.request(s, 0.0)) for m, s in zip(materials, samples, strict=True)], gloss="none"
    )
    for column, material in enumerate(materials):
        strip(column, material)
    for name, kelvin, energy in (("Warm", WARM, 0.6), ("Cold", COLD, 0.3)):
        light = sun(scene)
        light.name, light.temperature, light.energy = name, kelvin, energy * np.pi
    lights = api.picture_lights(scene, bands=12)
    scene.objects["Sun"].data.energy /= 2  # Warm
    wanted = render.Wanted(bands=12, plain=False, steady=True, lights={"Warm": "F11"})
    again = render.render(scene, wanted)
    spectra = [
        wavelength_grid.resample(
            s.reflectance, s.wavelengths, illuminant_spectra.GRID, method="linear", ends="hold"
        )
        for s in samples
    ]
    return lights, again, np.array(spectra)


def planck(kelvin):
    spd = illuminant_spectra.planck(kelvin)
    return spd / illuminant_spectra.to_xyz(spd)[1]


def seen(spectra, light, observer=2):
    return spectra * light @ illuminant_spectra.observer(observer) * 5


def apart(shown, truth, white=(0.95, 1.0, 1.09)):
    labs = (color_difference.xyz_to_lab(each, np.array(white)) for each in (shown, truth))
    return color_difference.delta_e(*labs)


def pixels(desk):
    return desk.xyz()[:, 0].T.astype(float)


def test_as_it_was_it_is_the_sum_over_the_spectrum(made):
    lights, _, spectra = made
    assert lights.names == ("Warm", "Cold")
    truth = seen(spectra, 0.6 * planck(WARM) + 0.3 * planck(COLD))
    assert apart(pixels(relight.Desk(lights)), truth).max() < 0.2


@pytest.mark.parametrize("observer", [2, 10])
def test_other_spectra_intensities_and_observers(made, observer):
    lights, _, spectra = made
    desk = relight.Desk(lights, observer)
    relight.set_all(desk, {"Warm": "F11", "Cold": "A"}, {"Warm": 2.0, "Cold": 0.5})
    light = 1.2 * illuminant_spectra.cie("F11") + 0.15 * illuminant_spectra.cie("A")
    assert apart(pixels(desk), seen(spectra, light, observer)).max() < 0.3
    desk.set_intensity("Warm", 0)
    light = 0.15 * illuminant_spectra.cie("A")
    assert apart(pixels(desk), seen(spectra, light, observer)).max() < 0.3


def test_it_equals_a_new_render(made):
    lights, again, _ = made
    picture = api.relight(lights, {"Warm": "F11"}, {"Warm": 0.5})
    assert picture.xyz.mean(axis=(0, 1)) == pytest.approx(again.xyz.mean(axis=(0, 1)), rel=2e-3)
    assert apart(picture.xyz, again.xyz).max() < 0.3
    assert picture.rgb[..., 3] == pytest.approx(again.rgb[..., 3])


def test_white_stays_white(made):
    """A spectrum of 1 is exactly the light's color, whatever the light."""
    lights, *_ = made
    for name in ("A", "F11", "LED-B3"):
        weights, _ = lights.weights(illuminant_spectra.cie(name))
        white = illuminant_spectra.to_xyz(illuminant_spectra.cie(name))
        assert weights.sum(axis=0) == pytest.approx(white, rel=1e-6)


def test_metamerism_of_two_places(made):
    lights, _, spectra = made
    found = relight.metamerism(relight.Desk(lights), (0, 1), (3, 1), around=0)
    assert [*found] == [*relight.ILLUMINANTS]
    for name, delta_e in found.items():
        light = illuminant_spectra.cie(name)
        pair = seen(0.9 * spectra[[0, 3]], light)
        truth = apart(pair[0], pair[1], illuminant_spectra.to_xyz(light))
        assert delta_e == pytest.approx(truth, abs=0.4)
    assert np.ptp([*found.values()]) > 1


def test_lights_are_kept_in_a_file(made, tmp_path):
    lights, *_ = made
    path = tmp_path / "room.npz"
    relight.write(lights, path)
    back = relight.read(path)
    assert (back.names, back.space) == (lights.names, lights.space)
    assert np.array_equal(back.parts, lights.parts)
    assert np.array_equal(relight.Desk(back).xyz(), relight.Desk(lights).xyz())
    whole = path.read_bytes()
    for damaged in (whole[:1000], b"", whole[:-200]):
        path.write_bytes(damaged)
        with pytest.raises(api.InputError, match="render them again"):
            relight.read(path)
    np.savez(path, format="rough-spectra-lights 1", space="", names=np.array([[1]]))
    with pytest.raises(api.InputError, match="render them again"):
        relight.read(path)


def test_what_cannot_be_set_is_refused(made):
    lights, *_ = made
    desk = relight.Desk(lights)
    with pytest.raises(api.DomainError, match="no light 'Moon' in the picture; there are Warm"):
        desk.set_light("Moon", "A")
    with pytest.raises(api.DomainError, match="give 0 or more"):
        desk.set_intensity("Warm", -1)
    with pytest.raises(api.DomainError, match="no pixel 99, 0"):
        desk.at(99, 0)
    with pytest.raises(api.DomainError, match="2 or 10"):
        relight.Desk(lights, 5)
