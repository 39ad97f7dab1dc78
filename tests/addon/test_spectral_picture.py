# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral pictures against sums over the spectrum, in scenes where these are known in closed form.

Each scene is rendered once, in a second Blender, and has little to estimate.
"""

from math import radians
from pathlib import Path

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry import illuminant_spectra, rgb_spectra
from rough_spectra.addon.matching import surface_spectra
from rough_spectra.addon.picture import (
    color_spectra,
    colors,
    direct_light,
    files,
    find_colors,
    passes,
    places,
    render,
)
from rough_spectra.addon.samples import light_source
from rough_spectra.addon.samples.readers import open_document
from rough_spectra.addon.samples.readers.formats import spectral_exr
from rough_spectra.addon.scene import chosen_light, light_spectra
from rough_spectra.core import cycles
from rough_spectra.core.color import color_difference
from rough_spectra.core.cycles import gloss_reading, instrument_lobe
from rough_spectra.core.gloss import Gloss
from rough_spectra.core.numerics import wavelength_grid

pytestmark = pytest.mark.usefixtures("empty_file")

NM = np.arange(360.0, 781.0)
KELVIN = 2856.0
PATCHES = ("red", "green", "blue", "yellow", "orange", "white")
BOUNCES = 3
ROWS = 4  # Blender renders no fewer


def functions():
    """Color matching functions at 1 nm, from colour-science itself."""
    import colour

    shape = colour.SpectralShape(360, 780, 1)
    return colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape).values


def planck():
    spd = (NM / 560) ** -5 / np.expm1(1.438776877e7 / (NM * KELVIN))
    return spd / (spd @ functions()[:, 1])


def apart(xyz, truth, white):
    return color_difference.delta_e(
        *(color_difference.xyz_to_lab(each, white) for each in (xyz, truth))
    )


def new_material(name, color=None):
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node = tree.nodes.new("ShaderNodeBsdfDiffuse")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    if color is not None:
        node.inputs["Color"].default_value = (*color, 1)
    return material


def from_above(columns):
    """Let a camera without perspective see strips of one unit, `ROWS` pixels each."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.ortho_scale = "ORTHO", max(columns, ROWS)
    scene.camera = bpy.data.objects.new("Camera", camera)
    scene.collection.objects.link(scene.camera)
    scene.camera.location = (columns / 2, ROWS / 2, 1)
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = columns, ROWS, 100
    cycles = scene.cycles
    cycles.samples, cycles.use_denoising, cycles.use_adaptive_sampling = 4, False, False
    cycles.max_bounces = cycles.diffuse_bounces = BOUNCES
    cycles.min_light_bounces = BOUNCES
    cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 0.01
    return scene


def strip(column, material):
    mesh = bpy.data.meshes.new("Strip")
    corners = [(column, 0, 0), (column + 1, 0, 0), (column + 1, ROWS, 0), (column, ROWS, 0)]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Strip", mesh))


def sun(scene):
    light = bpy.data.lights.new("Sun", "SUN")
    light.angle = 0.0
    light.energy = np.pi  # a white surface then has a radiance of 1
    light.use_temperature, light.temperature = True, KELVIN
    thing = bpy.data.objects.new("Sun", light)
    scene.collection.objects.link(thing)
    return light


@pytest.fixture(scope="module")
def lit(extension, tmp_path_factory):
    """Squares with measured spectra, and some of RGB, under one sun: nothing lights another."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = from_above(len(PATCHES) + 3)
    materials = [new_material(name) for name in PATCHES]
    samples = [api.find("white 9.5" if name == "white" else name) for name in PATCHES]
    rough = [(m, api.request(s, 0.0)) for m, s in zip(materials, samples, strict=True)]
    rough[1] = (materials[1], api.request(samples[1], radians(30)))
    api.assign(rough, gloss="none")
    plain, linked, gray = (
        new_material("Plain", (0.6, 0.2, 0.1)),
        new_material("Linked"),
        new_material("Gray", (0.5, 0.5, 0.5)),
    )
    tree = linked.node_tree
    source = tree.nodes.new("ShaderNodeCombineXYZ")
    for socket, value in zip(source.inputs, (0.6, 0.2, 0.1), strict=True):
        socket.default_value = value
    [diffuse] = (node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    tree.links.new(source.outputs[0], diffuse.inputs["Color"])
    for column, material in enumerate((*materials, plain, linked, gray)):
        strip(column, material)
    light = sun(scene)
    path = tmp_path_factory.mktemp("lit") / "lit.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    before = state_of_file()
    picture = api.spectral_picture(bands=3, direct=True)
    return samples, picture, before, state_of_file(), light.temperature


def state_of_file():
    return {
        "dirty": bpy.data.is_dirty,
        "path": bpy.data.filepath,
        "materials": {
            m.name: [
                tuple(s.default_value)
                for n in m.node_tree.nodes
                for s in n.inputs
                if s.type == "RGBA"
            ]
            for m in bpy.data.materials
        },
        "nodes": {m.name: len(m.node_tree.nodes) for m in bpy.data.materials},
        "lights": {(e.name, e.use_temperature, *e.color) for e in bpy.data.lights},
        "images": len(bpy.data.images),
        "format": bpy.context.scene.render.image_settings.file_format,
        "persistent": bpy.context.scene.render.use_persistent_data,
        "samples": bpy.context.scene.cycles.samples,
    }


def test_direct_light_is_exact_with_three_bands(lit):
    """XYZ of a matte surface is the sum over lamp times spectrum: ΔE00 within 0.05."""
    samples, picture, *_ = lit
    lamp = planck()[:, np.newaxis] * functions()
    for column, sample in enumerate(samples):
        if column == 1:
            continue  # a rough one: not seen as its instrument does
        values = wavelength_grid.resample(
            sample.reflectance, sample.wavelengths, NM, method="cubic", ends="hold"
        )
        found = apart(picture.xyz[0, column], values @ lamp, lamp.sum(axis=0))
        assert found < 0.05, sample.name


def sodium():
    """A line at 589.3 nm, 2 nm wide at half, at 0.1 nm."""
    nm = np.arange(583.0, 596.0, 0.1)
    return nm, np.exp(-4 * np.log(2) * ((nm - 589.3) / 2) ** 2)


@pytest.mark.parametrize("lamp", ["D65", "F11", "LED-B3", "HP1", "sodium"])
def test_one_surface_is_exact_under_any_lamp(lamp, tmp_path):
    """Sums at 1 nm and finer, of tables from colour-science and of a line: within ΔE00 0.05."""
    import colour

    if lamp == "sodium":
        nm, power = sodium()
    else:
        table = colour.SDS_ILLUMINANTS[lamp.replace("F11", "FL11")]
        nm, power = NM, np.interp(NM, table.wavelengths, table.values, 0, 0)
    path = tmp_path / f"{lamp}.csv"
    np.savetxt(path, np.column_stack((nm, power)), "%.8g", ",", header="nm,power", comments="")
    names = ("red", "green", "blue", "orange")
    scene = from_above(len(names))
    sun(scene)
    pairs = [(new_material(name), api.request(api.find(name), 0.0)) for name in names]
    api.assign(pairs, gloss="none")
    for column, (material, _) in enumerate(pairs):
        strip(column, material)
    seen = np.array([np.interp(nm, NM, each) for each in functions().T]).T * power[:, np.newaxis]
    seen /= seen[:, 1].sum()
    white = seen.sum(axis=0)
    for bands in (3, 6, 12):
        picture = api.spectral_picture(
            bands=bands, direct=True, compare=False, lights={"Sun": str(path)}
        )
        assert len(picture.wavelengths) == bands
        # The eye's own table has two digits where Z is a thousandth.
        assert picture.white == pytest.approx(white, rel=1e-3, abs=5e-5)
        for column, (_, request) in enumerate(pairs):
            sample = request.sample
            values = wavelength_grid.resample(
                sample.reflectance, sample.wavelengths, NM, method="cubic", ends="hold"
            )
            truth = color_difference.xyz_to_lab(np.interp(nm, NM, values) @ seen, white)
            shown = color_difference.xyz_to_lab(picture.xyz[0, column], picture.white)
            assert color_difference.delta_e(shown, truth) < 0.05


def test_a_rough_surface_is_matched_at_every_band(lit):
    """Cycles' formula for the lobe, with the color that reads right at each wavelength.

    The formula is held to renders elsewhere.
    """
    samples, picture, *_ = lit
    material = bpy.data.materials.new("Same")
    [solution] = api.assign([(material, api.request(samples[1], radians(30)))], gloss="none")
    request = api.settle(material).request
    [read], _ = surface_spectra.readings_and_albedos([request])
    values = wavelength_grid.resample(read, request.sample.wavelengths, NM, ends="hold")
    gray = np.repeat(values[:, np.newaxis], 3, axis=1)
    color = cycles.color_for_reading(gray, solution.roughness)
    shown = cycles.reflectance(color, solution.roughness, 0.0, 0.0, 0.0)[:, 0]
    lamp = planck()[:, np.newaxis] * functions()
    assert solution.roughness > 0.2
    assert apart(picture.xyz[0, 1], shown @ lamp, lamp.sum(axis=0)) < 0.05


def test_gloss_stays_over_a_color_of_any_band():
    """What the instrument reads of color and gloss in a band is what was measured there."""
    gloss = Gloss(level=0.6, roughness=0.4, tint=(1.0, 0.6, 0.3), coat=0.2)
    nm = illuminant_spectra.GRID
    place = places.Place(("materials", "Any", ""), "Node", 0)
    reading = 0.2 + 0.5 * (nm - 360) / 420
    measured = colors.Measured(place, reading, 0.3, "45a:0", gloss)
    taken = (nm[:, np.newaxis] == [450.0, 550.0, 650.0]).astype(float)
    one = passes.Pass(taken, np.ones((1, 3)), np.eye(3))
    space = working_space.current()
    found = colors.Colors(measured=[measured])
    [edit] = passes.edits(found, passes.Lamps(np.ones((1, nm.size)), ()), [one], space)
    [color] = edit["colors"]
    by_rgb = rgb_spectra.reflectances(space)
    there = gloss._replace(tint=tuple(np.array(gloss.tint) @ by_rgb @ taken))
    diffuse = instrument_lobe.reflectance(np.array(color), 0.3, "45a:0")
    assert gloss_reading.reading(diffuse, there, "45a:0") == pytest.approx(reading @ taken)


def test_a_lamp_with_nodes_has_both_its_colors():
    scene = from_above(4)
    light = sun(scene)
    light.use_temperature = False
    light.color = (0.5, 1.0, 1.0)
    if light.node_tree is None:
        light.use_nodes = True
    emission = next(node for node in light.node_tree.nodes if node.type == "EMISSION")
    emission.inputs["Color"].default_value = (1.0, 0.5, 0.25, 1)
    found = find()
    [shining] = found.shining
    assert shining.place.node == emission.name
    xyz = np.linalg.solve(working_space.current().from_xyz, (0.5, 0.5, 0.25))
    assert shining.strength == pytest.approx([xyz[1]] * 3)
    assert illuminant_spectra.to_xyz(shining.spectrum) * xyz[1] == pytest.approx(xyz, rel=1e-4)
    assert [(place.attribute, value) for place, value in found.reset] == [("color", (1, 1, 1))]


def test_a_color_that_is_linked_has_the_same_spectrum(lit):
    _, picture, *_ = lit
    plain, linked = picture.xyz[0, len(PATCHES)], picture.xyz[0, len(PATCHES) + 1]
    assert linked == pytest.approx(plain, rel=1e-5)
    gray, white = picture.xyz[0, len(PATCHES) + 2], planck() @ functions()
    assert gray == pytest.approx(0.5 * white, rel=2e-4)


def test_a_color_of_rgb_has_the_spectrum_of_the_published_table(lit):
    import colour

    table = colour.recovery.MSDS_BASIS_FUNCTIONS_sRGB_MALLETT2019
    values = table.values @ (0.6, 0.2, 0.1)
    values = np.interp(NM, table.wavelengths, values)
    lamp = planck()[:, np.newaxis] * functions()
    _, picture, *_ = lit
    assert apart(picture.xyz[0, len(PATCHES)], values @ lamp, lamp.sum(axis=0)) < 0.05


def test_the_file_and_its_settings_are_as_they_were(lit):
    _, picture, before, after, _ = lit
    assert picture.touched is None
    assert before == after


def test_the_ordinary_picture_is_compared(lit):
    """In RGB the colors under such a lamp are off by what RGB reflectance under D65 leaves."""
    _, picture, *_ = lit
    found = picture.comparison
    assert found.delta_e.shape == (ROWS, len(PATCHES) + 3)
    assert found.delta_e[0, -1] < 0.05  # gray is gray
    assert found.largest > 3
    assert found.delta_e[found.where[::-1]] == found.largest
    assert found.plain.shape == picture.rgb.shape
    assert picture.rules["Material 'red'"] == ("measured: ColorChecker 15 Red",)
    assert picture.rules["Light 'Sun'"] == ("blackbody of 2856 K",)


def test_it_is_written_and_becomes_an_image(lit, tmp_path):
    from rough_spectra.addon.support.openimageio import openimageio

    _, picture, *_ = lit
    written = api.write_picture(picture, tmp_path / "room.exr")
    assert [path.name for path in written] == ["room.exr", "room-delta-e.exr"]
    oiio = openimageio()
    file = oiio.ImageInput.open(str(written[0]))
    pixels, white = file.read_image(oiio.FLOAT), file.spec().getattribute("chromaticities")[6:]
    file.close()
    assert np.array_equal(pixels[::-1], picture.rgb.astype(np.float32))
    assert white == pytest.approx((0.3127, 0.3290), abs=2e-4)
    image = api.picture_image(picture)
    held = np.array(image.pixels[:]).reshape(picture.rgb.shape)
    assert held == pytest.approx(picture.rgb.astype(np.float32))
    with pytest.raises(api.OutputError, match="no EXR by its name"):
        api.write_picture(picture, tmp_path / "room.png")


def test_without_bounces_no_band_is_rendered_and_all_is_exact(lit):
    """`lit` again, whose light cannot meet a second surface: one render instead of two."""
    _, known, *_ = lit
    scene = from_above(4)
    strip(0, new_material("Plain", (0.6, 0.2, 0.1)))
    strip(1, new_material("Gray", (0.5, 0.5, 0.5)))
    sun(scene)
    scene.cycles.max_bounces = 0
    picture = api.spectral_picture(compare=False)
    assert (picture.direct, len(picture.seconds), picture.wavelengths.size) == (True, 1, 0)
    assert len(picture.processor_seconds) == 1
    assert picture.processor_seconds[0] > 0
    assert list(files.told(picture)) == [
        "no bands, direct light apart, there is no other, so every color is exact"
    ]
    plain = slice(len(PATCHES), len(PATCHES) + 3, 2)
    assert picture.xyz[0, :2] == pytest.approx(known.xyz[0, plain], rel=1e-4)
    assert (picture.predicted.largest, picture.enough) == (0, True)


class Foretold:
    """Bands as `choose` gives them, as far as deciding needs them."""

    def __init__(self, count, enough):
        self.wavelengths, self.enough = np.zeros(count), enough


@pytest.mark.parametrize(
    ("together", "apart", "lamps", "words"),
    [
        ((12, True), (6, True), 1, "as bands alone need 4 renders"),
        ((9, True), (6, True), 3, None),  # 3 against 2 and three halves
        ((6, True), (3, True), 2, None),
        ((36, False), (9, True), 6, "bands alone are not within the tolerance"),
        ((36, False), (36, False), 1, None),
    ],
)
def test_direct_light_is_apart_where_that_needs_fewer_renders(together, apart, lamps, words):
    scene = from_above(4)
    found = {False: Foretold(*together), True: Foretold(*apart)}
    choice = direct_light.decide(scene, None, lamps, False, found.__getitem__)
    assert (choice.apart, choice.words, choice.is_all) == (words is not None, words or "", False)
    assert choice.bands is found[choice.apart]
    # Who says what to do, or how many bands, gets that; parts of a picture cannot be denoised.
    assert not direct_light.decide(scene, False, lamps, False, found.__getitem__).apart
    assert not direct_light.decide(scene, None, lamps, True, found.__getitem__).apart
    scene.cycles.use_denoising = True
    assert not direct_light.decide(scene, None, lamps, False, found.__getitem__).apart


@pytest.mark.parametrize(
    ("space", "bands"),
    [*(("Linear Rec.709", count) for count in (3, 6, 9, 12)), ("Linear Rec.2020", 6)],
)
def test_a_white_furnace_is_neutral(space, bands):
    """White of any kind in a white world, its light from a texture: neutral to 1e-4."""
    if space != working_space.working_space_name():
        if bpy.app.version < (5, 0, 0):
            pytest.skip("Blender 4.5 has one working space")
        bpy.ops.wm.set_working_color_space(convert_colors=True, working_space=space)
    scene = from_above(4)
    measured = new_material("Measured")
    white = api.Sample("White", np.arange(380.0, 781.0, 10), np.ones(41), "albedo")
    api.assign([(measured, api.request(white, 0.0))], gloss="none")
    textured = new_material("Textured")
    glowing(textured.node_tree, textured.node_tree.nodes["Diffuse BSDF"].inputs["Color"])
    for column, each in enumerate((measured, new_material("White", (1, 1, 1)), textured)):
        strip(column, each)
    world = scene.world = bpy.data.worlds.new("World")
    if world.node_tree is None:
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    background = tree.nodes.new("ShaderNodeBackground")
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(background.outputs[0], output.inputs["Surface"])
    glowing(tree, background.inputs["Color"])
    picture = api.spectral_picture(bands=bands, compare=False)
    rgb = picture.rgb[0, :3, :3]
    assert rgb == pytest.approx(np.repeat(rgb[:, 1:2], 3, axis=1), rel=1e-4)
    assert rgb == pytest.approx(1, rel=1e-3)
    assert all("three spectra" in rule for rule in picture.rules["World 'World'"])


def test_faint_light_is_no_noise_of_color():
    """Gray below a dim lamp: Cycles would leave out its light by chance, in each band otherwise."""
    scene = from_above(16)
    scene.cycles.use_light_tree, scene.cycles.light_sampling_threshold = False, 0.5
    for column in range(16):
        strip(column, new_material("Gray", (0.5, 0.5, 0.5)))
    light = bpy.data.lights.new("Panel", "AREA")
    light.size, light.energy = 4, 20
    light.use_temperature, light.temperature = True, KELVIN
    scene.collection.objects.link(bpy.data.objects.new("Panel", light))
    bpy.data.objects["Panel"].location = (8, ROWS / 2, 5)
    picture = api.spectral_picture(bands=6, samples=2)
    assert picture.xyz[..., 1].min() > 0
    assert picture.comparison.largest < 0.2


def test_lamps_of_two_colors_are_no_noise_of_color():
    """Gray below a red and a blue lamp: Cycles' light tree picks lamps by what they send."""
    scene = from_above(16)
    for column in range(16):
        strip(column, new_material("Gray", (0.5, 0.5, 0.5)))
    for place, color in ((4, (1, 0.1, 0.1)), (12, (0.1, 0.1, 1))):
        light = bpy.data.lights.new("Panel", "AREA")
        light.size, light.energy, light.color = 1, 500, color
        thing = bpy.data.objects.new("Panel", light)
        scene.collection.objects.link(thing)
        thing.location = (place, ROWS / 2, 4)
    picture = api.spectral_picture(bands=6, samples=4)
    assert picture.xyz[..., 1].min() > 0
    assert picture.comparison.largest < 0.3


def test_many_lamps_are_picked_alike_in_all_renders():
    """Gray below lamps of many colors and kinds: the light tree goes by strength times color."""
    scene = from_above(16)
    scene.cycles.use_light_tree = True
    for column in range(16):
        strip(column, new_material("Gray", (0.5, 0.5, 0.5)))
    rng = np.random.default_rng(3)
    for number in range(10):
        light = bpy.data.lights.new("Bulb", "POINT")
        light.energy, light.color = 300, rng.uniform(0.02, 1, 3)
        thing = bpy.data.objects.new("Bulb", light)
        scene.collection.objects.link(thing)
        thing.location = (rng.uniform(0, 16), rng.uniform(0, ROWS), 3)
        if number < 3 and light.node_tree is None:
            light.use_nodes = True
    for kind, color, strength in (
        ("ShaderNodeEmission", "Color", "Strength"),
        ("ShaderNodeBsdfPrincipled", "Emission Color", "Emission Strength"),
    ):
        panel = new_material("Panel")
        tree = panel.node_tree
        node = tree.nodes.new(kind)
        node.inputs[color].default_value = (*rng.uniform(0.02, 1, 3), 1)
        node.inputs[strength].default_value = 3
        if "Base Color" in node.inputs:
            node.inputs["Base Color"].default_value = (0, 0, 0, 1)
        tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
        strip(int(rng.uniform(0, 16)), panel)
        [above] = [o for o in bpy.data.objects if o.material_slots and o.active_material == panel]
        above.location.z = 5
    scene.world = bpy.data.worlds.new("World")
    picture = api.spectral_picture(bands=6, samples=4)
    assert picture.xyz[..., 1].min() > 0
    assert picture.comparison.largest < 0.3


def test_a_colored_emitter_is_no_noise_of_color():
    """Gray below a red panel: Cycles samples what shines by how much it does, in each band anew."""
    from_above(16)
    for column in range(16):
        strip(column, new_material("Gray", (0.5, 0.5, 0.5)))
    panel = new_material("Panel")
    tree = panel.node_tree
    glow = tree.nodes.new("ShaderNodeEmission")
    glow.inputs["Color"].default_value = (1, 0.05, 0.02, 1)
    glow.inputs["Strength"].default_value = 2
    tree.links.new(glow.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    strip(8, panel)
    [above] = [o for o in bpy.data.objects if o.material_slots and o.active_material == panel]
    above.location.z = 5
    picture = api.spectral_picture(bands=6, samples=4)
    assert picture.xyz[..., 1].min() > 0
    assert picture.comparison.largest < 0.3


def glowing(tree, socket):
    """Let white come from a node that is no plain color."""
    ramp = tree.nodes.new("ShaderNodeCombineXYZ")
    for each in ramp.inputs:
        each.default_value = 1
    tree.links.new(ramp.outputs[0], socket)


def test_light_between_surfaces_is_that_of_the_spectrum():
    """In a closed box of one color that glows alike everywhere, each bounce adds ρ times the last.

    So the radiance is S (1 + ρ + ρ² + …), whatever the directions, up to the bounces of Cycles.
    """
    import colour

    from_above(4)
    rgb = (0.8, 0.25, 0.1)
    material = new_material("Box", rgb)
    tree = material.node_tree
    glow, both = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeAddShader")
    kelvin = tree.nodes.new("ShaderNodeBlackbody")
    kelvin.inputs["Temperature"].default_value = KELVIN
    tree.links.new(kelvin.outputs[0], glow.inputs["Color"])
    output, diffuse = tree.nodes["Material Output"], tree.nodes["Diffuse BSDF"]
    tree.links.new(diffuse.outputs[0], both.inputs[0])
    tree.links.new(glow.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], output.inputs["Surface"])
    material.cycles.emission_sampling = "NONE"
    bpy.ops.mesh.primitive_cube_add(size=4)
    bpy.context.object.data.materials.append(material)
    picture = api.spectral_picture(bands=9)
    table = colour.recovery.MSDS_BASIS_FUNCTIONS_sRGB_MALLETT2019
    rho = np.interp(NM, table.wavelengths, table.values @ rgb)
    bounces = sum(rho**count for count in range(BOUNCES + 2))  # the last may meet a lamp
    spectrum = planck()[:, np.newaxis] * functions()
    # Cycles' blackbody has a luminance of 1 by the working space's primaries.
    truth, white = bounces @ spectrum, spectrum.sum(axis=0)
    level = picture.xyz[0, 0, 1] / truth[1]
    assert level == pytest.approx(1, abs=5e-3)
    assert apart(picture.xyz[0, 0], level * truth, white) < 0.1
    # And so is each wavelength's, from nine bands of some, and every band itself.
    whole = every_10(level * bounces * planck())
    assert picture.spectra.at(0, 0)[4:37] == pytest.approx(whole[4:37], rel=0.05)
    held = picture.spectra
    there = held.channels.at(0, 0).astype(float) @ held.to_bands
    exact = level * bounces * planck()
    assert there == pytest.approx(exact[(held.bands - NM[0]).astype(int)], rel=5e-3)
    assert picture.comparison.mean > 1  # which three channels are not


TEN = np.arange(360.0, 781.0, 10.0)


def every_10(spectrum):
    """Means around every tenth nanometer, of values at 1 nm."""
    near = np.maximum(1 - np.abs(NM[:, np.newaxis] - TEN) / 10, 0)
    return spectrum @ (near / near.sum(axis=0))


def test_where_direct_light_is_apart_its_three_channels_tell_spectra_roughly(lit):
    """X, Y and Z of known surfaces: within a tenth of the lamp's light, root mean square."""
    samples, picture, *_ = lit
    lamp = every_10(planck())[4:37]  # 400 to 720 nm: beyond them nothing is seen, or known
    missed = []
    for column, sample in enumerate(samples):
        values = wavelength_grid.resample(
            sample.reflectance, sample.wavelengths, NM, method="cubic", ends="hold"
        )
        found = picture.spectra.at(column, 0)[4:37]
        if column != 1:  # a rough one: not seen as its instrument does
            missed.append((found - every_10(values * planck())[4:37]) / lamp.max())
    assert np.sqrt(np.mean(np.square(missed))) < 0.1


def test_a_spectral_image_is_read_again_and_has_the_colors_of_the_picture(lit, tmp_path):
    """Every pixel's XYZ, summed from the file by the CIE's functions, is the picture's."""
    _, picture, *_ = lit
    path = tmp_path / "room.spectral.exr"
    written = api.write_picture(picture, tmp_path / "room.exr", path)
    assert [each.name for each in written] == ["room.exr", "room-delta-e.exr", path.name]
    rows, columns = picture.xyz.shape[:2]
    for column in range(columns):
        nm, values = spectral_exr.emission(open_document(path, (column, rows - 1, 1, 1)))
        assert nm.tolist() == TEN.tolist()
        assert values == pytest.approx(picture.spectra.at(column, 0), rel=1e-5, abs=1e-9)
        xyz = np.interp(NM, nm, values) @ functions()
        assert xyz == pytest.approx(picture.xyz[0, column], rel=1e-4)
        # Whoever just adds up every 10 nm is as near as bands are.
        added = 10 * values @ functions()[::10]
        white = planck() @ functions()
        assert apart(added, picture.xyz[0, column], white) < 0.25
    with pytest.raises(api.InputError, match=r"radiance \(an image of light"):
        api.read(path)  # which is no reflectance
    again = tmp_path / "again.spectral.exr"
    api.write_picture(picture, tmp_path / "room.exr", again)
    assert again.read_bytes() == path.read_bytes()


def test_a_spectral_image_says_its_layout_and_units(lit, tmp_path):
    from rough_spectra.addon.support.openimageio import openimageio

    _, picture, *_ = lit
    path = tmp_path / "room.spectral.exr"
    api.write_picture(picture, tmp_path / "room.exr", path, at_bands=True)
    file = openimageio().ImageInput.open(str(path))
    spec = file.spec()
    pixels = file.read_image(0, 0, 0, spec.nchannels, "float")
    file.close()
    assert spec.getattribute("spectralLayoutVersion") == "1.0"
    assert "per nm" in spec.getattribute("emissiveUnits")
    names = [f"S0.{nm:.0f},000000nm" for nm in picture.wavelengths]
    assert [*spec.channelnames] == ["R", "G", "B", "A", *names]
    assert pixels[::-1, :, :4] == pytest.approx(picture.rgb.astype(np.float32))


@pytest.mark.parametrize(
    ("path", "beside", "words"),
    [
        ("room.spectral.exr", None, "called like a spectral image"),
        ("room.exr", "spectra.exr", "no spectral image by its name"),
    ],
)
def test_names_of_files_that_mislead_are_refused(lit, path, beside, words, tmp_path):
    _, picture, *_ = lit
    with pytest.raises(api.OutputError, match=words):
        api.write_picture(picture, tmp_path / path, beside and tmp_path / beside)
    assert not list(tmp_path.iterdir())


def tree_with(kind, **inputs):
    material = new_material(kind)
    tree = material.node_tree
    node = tree.nodes.new(kind)
    for name, value in inputs.items():
        node.inputs[name].default_value = value
    output = tree.nodes["Material Output"]
    socket = "Volume" if "Volume" in kind else "Surface"
    tree.links.new(node.outputs[0], output.inputs[socket])
    return material, node


def find():
    return find_colors.find(
        bpy.context.evaluated_depsgraph_get(), bpy.context.scene, working_space.current()
    )


def test_rules_are_told_and_what_has_none_is_named():
    scene = from_above(4)
    sun(scene)
    glass, _ = tree_with("ShaderNodeBsdfGlass", Color=(0.2, 0.9, 0.3, 1))
    film, node = tree_with("ShaderNodeBsdfPrincipled")
    node.inputs["Thin Film Thickness"].default_value = 300
    edited = new_material("Edited")
    api.assign([(edited, api.request(api.find("red"), 0.0))], gloss="none")
    edited.node_tree.nodes["Diffuse BSDF"].inputs["Color"].default_value = (0.1, 0.2, 0.3, 1)
    for column, each in enumerate((glass, film, edited)):
        strip(column, each)
    found = find()
    assert found.told[f"Material {glass.name!r}"] == [color_spectra.LINEAR]
    assert found.untranslated == {f"Material {film.name!r}": ["its thin film"]}
    assert found.told["Material 'Edited'"][0].startswith("its measured spectrum is not used: ")
    assert "by hand" in found.told["Material 'Edited'"][0]
    assert not found.measured
    assert [s.strength.round(6).tolist() for s in found.shining] == [
        pytest.approx([1, 1, 1], abs=5e-3)
    ]


def test_what_stays_rgb_is_told_with_its_part_of_the_picture():
    scene = from_above(4)
    sun(scene)
    film, node = tree_with("ShaderNodeBsdfPrincipled")
    node.inputs["Thin Film Thickness"].default_value = 300
    for column, each in enumerate((film, new_material("Gray", (0.5, 0.5, 0.5)), film)):
        strip(column, each)
    picture = api.spectral_picture(bands=3, direct=True, compare=False)
    assert picture.touched == 0.5
    told = "materials with something that stays RGB take 50 % of the picture"
    assert told in list(files.told(picture))
    assert picture.xyz[0, 1] == pytest.approx(0.5 * planck() @ functions(), rel=2e-4)


def test_a_radius_counts_only_where_light_scatters():
    scene = from_above(4)
    sun(scene)
    material, node = tree_with("ShaderNodeBsdfPrincipled")
    node.inputs["Base Color"].default_value = (0.5, 0.5, 0.5, 1)
    strip(0, material)
    assert not find().colored
    node.inputs["Subsurface Weight"].default_value = 0.1
    [found] = find().colored
    assert node.inputs[found.place.socket].name == "Subsurface Radius"


def test_nodes_that_reach_no_output_do_not_count():
    scene = from_above(4)
    sun(scene)
    material = new_material("Loose", (0.5, 0.5, 0.5))
    material.node_tree.nodes.new("ShaderNodeBsdfGlass").inputs["Color"].default_value = (1, 0, 0, 1)
    strip(0, material)
    assert not find().colored


def test_colors_of_lobes_that_are_not_there_do_not_count():
    """A gray Principled BSDF has a Subsurface Radius of three lengths, and a weight of 0."""
    scene = from_above(4)
    sun(scene)
    material, node = tree_with("ShaderNodeBsdfPrincipled")
    strip(0, material)
    node.inputs["Coat Tint"].default_value = (1, 0.2, 0.1, 1)
    assert not find().colored
    node.inputs["Subsurface Weight"].default_value = 0.5
    node.inputs["Coat Weight"].default_value = 0.5
    places = [node.inputs[each.place.socket].name for each in find().colored]
    assert places == ["Subsurface Radius", "Coat Tint"]


def test_colors_in_groups_count_where_they_enter_a_shader():
    scene = from_above(4)
    sun(scene)
    group = bpy.data.node_groups.new("Paint", "ShaderNodeTree")
    group.interface.new_socket("Color", in_out="INPUT", socket_type="NodeSocketColor")
    group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    inside, outside, diffuse = (
        group.nodes.new(kind)
        for kind in ("NodeGroupInput", "NodeGroupOutput", "ShaderNodeBsdfDiffuse")
    )
    group.links.new(inside.outputs[0], diffuse.inputs["Color"])
    group.links.new(diffuse.outputs[0], outside.inputs[0])
    material = new_material("Grouped")
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    strip(0, material)
    [found] = find().colored
    assert found.rgb is None
    assert found.place.of == ("node_groups", "Paint", "")


def test_a_group_is_told_of_all_that_use_it_and_its_colors_count_once():
    scene = from_above(4)
    sun(scene)
    group = bpy.data.node_groups.new("Film", "ShaderNodeTree")
    group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    outside, coated = (
        group.nodes.new("NodeGroupOutput"),
        group.nodes.new("ShaderNodeBsdfPrincipled"),
    )
    coated.inputs["Base Color"].default_value = (0.8, 0.3, 0.1, 1)
    coated.inputs["Thin Film Thickness"].default_value = 300
    group.links.new(coated.outputs[0], outside.inputs[0])
    for column, name in enumerate(("One", "Other")):
        tree = new_material(name).node_tree
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = group
        tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
        strip(column, bpy.data.materials[name])
    found = find()
    [colored] = found.colored
    assert colored.place.of == ("node_groups", "Film", "")
    left = ["its thin film"]
    assert found.untranslated == {"Material 'One'": left, "Material 'Other'": left}
    assert found.told["Material 'One'"] == found.told["Material 'Other'"] == [color_spectra.LINEAR]


def test_two_lamps_of_one_color_are_one_spectrum():
    scene = from_above(4)
    first, second = sun(scene), sun(scene)
    second.energy = 7
    assert len(passes.lamps_of(find(), working_space.current()).spectra) == 1
    first.temperature = 6500
    assert len(passes.lamps_of(find(), working_space.current()).spectra) == 2


def test_a_lamp_may_have_the_spectrum_of_an_illuminant():
    scene = from_above(4)
    light = sun(scene)
    light.use_temperature = False
    light.color = (1.0, 0.5, 0.2)
    args = bpy.context.evaluated_depsgraph_get(), scene, working_space.current()
    found = find_colors.find(*args, {"Sun": light_spectra.find("F11")})
    [shining] = found.shining
    sd = illuminant_spectra.cie("F11")
    assert shining.spectrum == pytest.approx(sd)
    luminance = np.linalg.solve(working_space.current().from_xyz, light.color)[1]
    assert shining.strength == pytest.approx([luminance] * 3)
    assert found.told["Light 'Sun'"] == ["CIE F11, though its RGB is another color"]
    with pytest.raises(api.MaterialError, match="called 'Moon' shines"):
        find_colors.find(*args, {"Moon": light_spectra.find("F11")})


def test_lamps_and_worlds_keep_their_spectra_in_the_file(tmp_path):
    """The data itself, whole: the file it came from may be gone."""
    path = tmp_path / "lamp.csv"
    path.write_text("nm,power\n400,0.1\n555.123456789,0.7\n700,0.3\n", encoding="utf-8")
    scene = from_above(4)
    light = sun(scene)
    scene.world = bpy.data.worlds.new("World")
    scene.world.rough_spectra.spectrum = "F11"
    if scene.world.node_tree is None:
        scene.world.use_nodes = True
    chosen_light.keep(light, light_source.read(path), str(path))
    wanted = light_spectra.find(str(path))
    path.unlink()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "scene.blend"))
    found = find()
    assert list(found.told) == ["Light 'Sun'", "World 'World'"]
    # A blackbody of 2856 K and gray, which F11 is next to neither.
    other = ", though its RGB is another color"
    assert list(found.told.values()) == [
        [f"measured: lamp.csv{other}"],
        [f"CIE F11{other}"],
    ]
    of_lamp, of_world = found.shining
    assert of_lamp.spectrum.tolist() == wanted[0].tolist()
    assert of_world.spectrum == pytest.approx(illuminant_spectra.cie("F11"))
    # What is asked for by name comes first.
    args = bpy.context.evaluated_depsgraph_get(), bpy.context.scene, working_space.current()
    named = find_colors.find(*args, {"Sun": light_spectra.find("D50")})
    assert named.told["Light 'Sun'"] == [f"CIE D50{other}"]
    bpy.data.lights["Sun"].temperature = 4000
    bpy.context.view_layer.update()
    named = find_colors.find(*args, {"Sun": light_spectra.find("F11")})
    assert named.told["Light 'Sun'"] == ["CIE F11"]


def test_a_world_of_many_colors_says_that_it_has_no_one_spectrum():
    scene = from_above(4)
    scene.world = bpy.data.worlds.new("World")
    scene.world.rough_spectra.spectrum = "F11"
    if scene.world.node_tree is None:
        scene.world.use_nodes = True
    tree = scene.world.node_tree
    background = next(node for node in tree.nodes if node.type == "BACKGROUND")
    glowing(tree, background.inputs["Color"])
    rules = find().told["World 'World'"]
    assert rules == [
        f"{color_spectra.LINEAR}, times that of D65",
        "not CIE F11, as it has many colors",
    ]


@pytest.mark.parametrize(
    ("stored", "words"), [("", "has none"), ("[1", "damaged"), ("[[1, 2], [0, 0]]", "damaged")]
)
def test_a_lamp_without_its_measured_spectrum_is_refused(stored, words):
    light = sun(from_above(4))
    light.rough_spectra.spectrum = "MEASURED"
    light.rough_spectra.measured = stored
    with pytest.raises(api.MaterialError, match=words):
        find()


def test_a_table_of_a_lamp_loses_none_of_its_lines(tmp_path):
    """A line of 0.5 nm between two nodes: its color is that of monochromatic light."""
    path = tmp_path / "sodium.csv"
    path.write_text("nm,power\n588.7,0\n589.2,40\n589.7,0\n", encoding="utf-8")
    spectrum, words = light_spectra.find(str(path))
    assert words == "measured: sodium.csv"
    xyz = illuminant_spectra.to_xyz(spectrum)
    line = functions()[int(589 - NM[0])] * 0.8 + functions()[int(590 - NM[0])] * 0.2
    assert xyz == pytest.approx(line / line[1], rel=5e-3, abs=1e-3)
    with pytest.raises(api.DomainError, match="neither a file nor an illuminant"):
        light_spectra.find("F99")
    path.write_text("nm,power\n1000,1\n1100,1\n", encoding="utf-8")
    with pytest.raises(api.InputError, match="nothing of this light is seen"):
        light_spectra.find(str(path))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("bpy.context.scene.render.engine = 'BLENDER_WORKBENCH'", "needs Cycles"),
        ("bpy.context.scene.camera = None", "has no camera"),
        ("bpy.data.lights.remove(bpy.data.lights[0])", "Nothing in the scene sheds light"),
        ("bpy.context.scene.cycles.use_denoising = True", "is denoised"),
        ("bpy.context.scene.view_layers[0].use = False", "no view layer"),
    ],
)
def test_what_cannot_be_rendered_is_told_before(change, words):
    sun(from_above(4))
    exec(change, {"bpy": bpy})
    with pytest.raises(api.MaterialError, match=words):
        api.spectral_picture(bands=3, direct=True)


@pytest.mark.parametrize(
    "wanted",
    [
        {"bands": 4},
        {"bands": 0},
        {"tolerance": 0.0},
        {"observer": 5},
        {"samples": 0},
    ],
)
def test_what_is_no_number_of_anything_is_refused(wanted):
    with pytest.raises(api.DomainError):
        render.Wanted(**wanted)


def test_nothing_is_left_behind(lit, tmp_path, monkeypatch):
    """A job that is stopped takes its folder along, and writes nothing."""
    import tempfile

    sun(from_above(4))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    job = render.Rendering(bpy.context.scene, render.Wanted(bands=3))
    assert list(tmp_path.iterdir())
    job.close()
    assert not list(Path(tmp_path).iterdir())
