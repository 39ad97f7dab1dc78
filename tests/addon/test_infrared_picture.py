# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Infrared pictures against sums over the spectrum, in scenes where these are known in closed form.

Each scene is rendered once, in a second Blender, and has nothing to estimate.
"""

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.picture import infrared, infrared_light, infrared_wanted
from rough_spectra.addon.samples.light_source import LightSource
from rough_spectra.addon.scene import chosen_light
from rough_spectra.core import emissivity

from tests.addon.test_spectral_picture import KELVIN, ROWS, from_above, new_material, strip, sun

pytestmark = pytest.mark.usefixtures("empty_file")

BAND = 700.0, 1000.0
REACHING = np.array([400.0, 700.0, 800.0, 900.0, 1000.0])


def eye():
    """Luminosity at 1 nm from 360 nm, from colour-science itself."""
    import colour

    shape = colour.SpectralShape(360, 780, 1)
    return colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape).values[:, 1]


def lamp(nm, kelvin=KELVIN):
    """Of luminance 1, in units in which light of even power has 1."""
    seen = emissivity.radiance(np.arange(360.0, 781.0), kelvin) @ eye()
    return emissivity.radiance(nm, kelvin) / seen * eye().sum()


def mean(values):
    """Of what is known at even steps."""
    return ((values[1:] + values[:-1]) / 2).mean()


def worlds_color(color):
    world = bpy.context.scene.world = bpy.data.worlds.new("Sky")
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (*color, 1)
    return world


def test_a_plane_under_a_blackbody_has_the_mean_of_albedo_times_radiance():
    scene = from_above(ROWS)
    names = ("Leaf", "Eye", "Told", "Gray")
    leaf = api.Sample("Leaf", REACHING, np.array([0.05, 0.1, 0.7, 0.5, 0.6]), "albedo")
    seen = api.Sample("Seen", REACHING[:2], np.array([0.3, 0.3]), "albedo")
    made = [new_material(name, (0.2, 0.2, 0.2)) for name in names]
    for column, material in enumerate(made):
        strip(column, material)
    api.assign([(made[0], api.request(leaf, 0.0)), (made[1], api.request(seen, 0.0))], gloss="none")
    sun(scene)
    spot = bpy.data.lights.new("Colored", "POINT")
    spot.color = (1.0, 0.2, 0.1)
    scene.collection.objects.link(bpy.data.objects.new("Colored", spot))
    found = infrared.render(scene, infrared_wanted.Wanted(BAND, 6, materials={"Told": 0.8}))
    nm = np.linspace(*BAND, 30_001)
    light = lamp(nm)
    albedo = np.interp(nm, REACHING, leaf.values)
    truth = [mean(light * albedo), *(mean(light) * each for each in (0.3, 0.8, 0.2))]
    assert found.gray[1] == pytest.approx(truth, rel=1e-3)
    ends = slice(25_000, 30_001)
    assert found.parts[1, 0, -1] == pytest.approx(mean((light * albedo)[ends]), rel=1e-3)
    longest = slice(20_000, 30_001)
    assert found.false_color[1, 2, 0] == pytest.approx(0.8 * mean(light[longest]), rel=1e-3)
    assert set(found.assumed) == {"Material 'Eye'", "Material 'Gray'"}
    assert "covers 400 to 700 nm" in found.assumed["Material 'Eye'"]
    assert set(found.dark) == {"Light 'Colored'"}
    assert found.told["Light 'Sun'"] == "blackbody of 2856 K"


def test_a_white_furnace_stays_white_and_lamps_may_be_unseen():
    """Balls of white in a light from everywhere are not to be seen in it."""
    scene = from_above(ROWS)
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = 32
    scene.cycles.min_light_bounces = 32
    worlds_color((0.7, 0.7, 0.7))
    bpy.ops.mesh.primitive_torus_add(location=(2, 2, -1), major_radius=1.2, minor_radius=0.6)
    bpy.context.object.data.materials.append(new_material("White", (1, 1, 1)))
    nm = np.array([700.0, 840.0, 850.0, 860.0, 2600.0])
    led = LightSource("LED", nm, np.array([0.0, 0.0, 1.0, 0.0, 0.0]))
    chosen_light.keep(scene.world, led, "led.csv")
    found = infrared.render(scene, infrared_wanted.Wanted((800.0, 900.0)))
    # A power of 0.7 in 100 nm, where even light of luminance 1 has 1 in as many as its eye sees.
    assert found.gray == pytest.approx(0.7 / 100 * eye().sum(), rel=2e-3)
    assert found.parts[..., 0].max() == 0
    assert "as it is not seen" in found.told["World 'Sky'"]


def test_through_a_filter_and_by_what_a_user_says():
    """A texture of light is as bright as to the eye."""
    scene = from_above(ROWS)
    strip(0, new_material("Gray", (0.5, 0.5, 0.5)))
    world = worlds_color((0, 0, 0))
    tree = world.node_tree
    texture = tree.nodes.new("ShaderNodeCombineXYZ")
    for number, value in enumerate((0.4, 0.6, 0.1)):
        texture.inputs[number].default_value = value
    tree.links.new(texture.outputs[0], tree.nodes["Background"].inputs["Color"])
    through = emissivity.Filter([720.0, 800.0, 900.0], [0.0, 1.0, 0.0])
    found = infrared.render(scene, infrared_wanted.Wanted(through, lights={"Sky": "3200 K"}))
    nm = np.linspace(720.0, 900.0, 18_001)
    response = np.interp(nm, through.wavelengths, through.response)
    truth = mean(lamp(nm, 3200.0) * response) / mean(response)
    bright = float(np.array([0.2126390, 0.7151687, 0.0721923]) @ (0.4, 0.6, 0.1))
    assert found.gray[:, 1:] == pytest.approx(truth * bright, rel=1e-3)
    assert found.ends == (720.0, 900.0)


def test_where_nothing_is_known_to_shine_nothing_is_rendered():
    scene = from_above(ROWS)
    worlds_color((1, 1, 1)).rough_spectra.spectrum = "F11"
    with pytest.raises(api.MaterialError, match="Nothing in the scene is known to shine at 700"):
        infrared.render(scene, infrared_wanted.Wanted())
    with pytest.raises(api.MaterialError, match="called 'Lamp' shines"):
        infrared.render(scene, infrared_wanted.Wanted(lights={"Lamp": "2856K"}))
    with pytest.raises(api.MaterialError, match="no material 'Leaf'"):
        infrared.render(
            scene, infrared_wanted.Wanted(lights={"Sky": "5000"}, materials={"Leaf": 0.5})
        )


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"band": (900.0, 800.0)}, "give its ends in nm"),
        ({"parts": 4}, "3, 6, 9"),
        ({"materials": {"Leaf": 1.5}}, "0 to 1"),
        (
            {"materials": {"Leaf": api.Sample("Leaf", REACHING[:2], [0.1, 0.2], "albedo")}},
            "covers 400 to 700 nm",
        ),
    ],
)
def test_what_is_no_camera_is_refused(change, words):
    with pytest.raises(api.DomainError, match=words):
        infrared_wanted.Wanted(**change)


def test_what_tells_nothing_of_the_infrared_is_refused():
    with pytest.raises(api.DomainError, match="CIE F11 is defined where eyes see"):
        infrared_light.find("F11")
    with pytest.raises(api.DomainError, match="neither a file nor a temperature"):
        infrared_light.find("nowhere.csv")
    with pytest.raises(api.DomainError, match="A lamp of 20 K is none"):
        infrared_light.find("20K")
