# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors of lights and of materials in a scene, held against real renders.

Truth is computed here by colour-science, the published model in its plain form and Planck's law.
"""

import math
import warnings

import bpy
import numpy as np
import pytest
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive
from rough_spectra.addon.scene import analysis, follow_scene
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.addon.support.openimageio import openimageio
from rough_spectra.core import oren_nayar

SIGMA = math.radians(30)
LIGHT, VIEW = math.radians(50), math.radians(25)
LIMIT = 0.3
"""ΔE00 that nobody sees side by side."""


@pytest.fixture
def render(tmp_path):
    """Render the scene as it is; gives scene-linear pixels, the first row at the top."""

    def run(width, height, samples):
        scene = bpy.context.scene
        scene.render.engine = "CYCLES"
        scene.render.resolution_x, scene.render.resolution_y = width, height
        scene.render.image_settings.file_format = "OPEN_EXR"
        scene.render.image_settings.color_depth = "32"
        cycles = scene.cycles
        cycles.samples, cycles.max_bounces = samples, 0
        cycles.use_denoising = cycles.use_adaptive_sampling = False
        cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
        scene.render.filepath = str(tmp_path / "picture.exr")
        bpy.ops.render.render(write_still=True)
        library = openimageio()
        image = library.ImageInput.open(scene.render.filepath)
        try:
            return np.asarray(image.read_image(library.FLOAT), np.float64)[..., :3]
        finally:
            image.close()

    return run


def look_down(width, angle=0.0, distance=50.0):
    """Put an orthographic camera above the origin, `angle` away from the normal towards +X."""
    lens = bpy.data.cameras.new("View")
    lens.type, lens.ortho_scale = "ORTHO", width
    camera = bpy.data.objects.new("View", lens)
    camera.location = (distance * math.sin(angle), 0, distance * math.cos(angle))
    camera.rotation_euler = (0, angle, 0)
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def put_lamp(kind, name="Lamp", place=(0.0, 0.0, 3.0), turn=(0.0, 0.0, 0.0), **settings):
    light = bpy.data.lights.new(name, kind)
    for key, value in settings.items():
        setattr(light, key, value)
    lamp = bpy.data.objects.new(name, light)
    lamp.location, lamp.rotation_euler = place, turn
    bpy.context.scene.collection.objects.link(lamp)
    return light


def put_square(material, size=1.0, place=(0.0, 0.0, 0.0)):
    bpy.ops.mesh.primitive_plane_add(size=size, location=place)
    bpy.context.object.data.materials.append(material)
    return bpy.context.object


def look():
    return analysis.analyze(bpy.context.evaluated_depsgraph_get(), bpy.context.scene)


def to_xyz(rgb):
    return np.asarray(rgb) @ np.asarray(colour().RGB_COLOURSPACES["sRGB"].matrix_RGB_to_XYZ).T


def chart_errors(render, truths, white, samples=1):
    """ΔE00 of the rendered patches from spectral truth, under a light of that XYZ."""
    pixels = (
        render(6 * 4, 4 * 4, samples).reshape(4, 4, 6, 4, 3)[:, 1:-1, :, 1:-1].mean(axis=(1, 3))
    )
    # The sun's strength is π: a white diffuser would show the light itself, times its cosine.
    xyz = to_xyz(pixels[::-1].reshape(-1, 3)) / math.cos(LIGHT)
    science = colour()
    found = []
    for seen, true in zip(xyz, truths, strict=True):
        labs = [science.XYZ_to_Lab(value, science.XYZ_to_xy(white)) for value in (seen, true)]
        found.append(float(science.delta_E(*labs, method="CIE 2000")))
    return np.array(found)


def lay_chart(materials):
    """Lay 6 x 4 squares under a camera that sees them evenly from the side."""
    for number, material in enumerate(materials):
        put_square(material, 1.0, (number % 6 - 2.5, number // 6 - 1.5, 0))
    look_down(6.0, VIEW)
    stretch = bpy.data.objects.new("Stretch", None)
    bpy.context.scene.collection.objects.link(stretch)
    for thing in list(bpy.context.scene.objects):
        if thing.type == "MESH":
            thing.parent = stretch
    stretch.scale = (1 / math.cos(VIEW), 1, 1)


def put_sun(name, kelvin, share=1.0):
    """Put a sun on the other side than the camera; π is the strength of all together."""
    turn = (0, LIGHT, math.radians(180))
    settings = {"energy": share * math.pi, "angle": 0.0, "use_temperature": True}
    put_lamp("SUN", name, turn=turn, temperature=kelvin, **settings)


def truths_under(light, samples):
    """XYZ of rough samples under a spectrum, Y = 1 for white."""
    science, found = colour(), []
    for sample in samples:
        r = oren_nayar.reflectance(sample.values, LIGHT, VIEW, math.pi, SIGMA)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            sd = science.SpectralDistribution(r, sample.wavelengths)
            found.append(science.sd_to_XYZ(sd, illuminant=light, method="ASTM E308") / 100)
    return found


def test_lights_that_mix_everywhere_count_as_their_mixture(render, colorchecker, make_material):
    """Each in-gamut patch is right in a render under two suns at once."""
    materials = [make_material(sample.name) for sample in colorchecker]
    lay_chart(materials)
    science, temperatures = colour(), (2856, 8000)
    parts = []
    for name, kelvin in zip(("Warm", "Cold"), temperatures, strict=True):
        put_sun(name, kelvin, 0.5)
        shape = science.SpectralShape(360, 780, 1)
        part = science.sd_blackbody(kelvin, shape)
        parts.append(part / science.sd_to_XYZ(part)[1])
    light = parts[0] + parts[1]
    white = science.sd_to_XYZ(light) / science.sd_to_XYZ(light)[1]
    requests = [solve.Request(sample, SIGMA, "two-bounce") for sample in colorchecker]
    derive.assign(list(zip(materials, requests, strict=True)), keep_gloss=False)
    changes = follow_scene.follow(look())
    inside = np.array([not any("gamut" in w for w in c.solution.warnings) for c in changes])
    order = [materials.index(change.material) for change in changes]
    # Each of Cycles' samples asks one sun.
    errors = chart_errors(render, truths_under(light, colorchecker), white, 1024)[order]
    print(f"in gamut {inside.sum()}: at most {errors[inside].max():.3f}")
    assert inside.sum() >= 18
    assert errors[inside].max() <= LIMIT


def test_incandescent_light_shows_the_spectral_colors(render, colorchecker, make_material):
    """Each in-gamut patch is right under A in a render, where the color for D65 is not."""
    materials = [make_material(sample.name) for sample in colorchecker]
    lay_chart(materials)
    put_sun("Bulb", 2855.5)
    science = colour()
    truths = truths_under(science.SDS_ILLUMINANTS["A"], colorchecker)
    white = science.xy_to_XYZ(science.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["A"])
    requests = [solve.Request(sample, SIGMA, "two-bounce") for sample in colorchecker]
    derive.assign(list(zip(materials, requests, strict=True)), keep_gloss=False)
    plain = chart_errors(render, truths, white)
    changes = follow_scene.follow(look())
    inside = np.array([not any("gamut" in w for w in c.solution.warnings) for c in changes])
    order = [materials.index(change.material) for change in changes]
    errors = chart_errors(render, truths, white)[order]
    print(
        f"incandescent: {inside.sum()} patches in gamut, ΔE00 at most {errors[inside].max():.3f}; "
        f"for D65 {plain[order][inside].mean():.2f} on average, at most {plain.max():.2f}"
    )
    assert inside.sum() >= 18
    assert errors[inside].max() <= LIMIT
    assert plain[order][inside].mean() > 2


def lamp_case(make):
    return pytest.param(make, id=make.__name__.removeprefix("of_"))


def of_rgb():
    put_lamp("POINT", place=(0, 0.5, 2), color=(1, 0.3, 0.1), energy=20)


def of_temperature():
    put_lamp("AREA", use_temperature=True, temperature=2856, energy=20)


def of_temperature_and_color():
    put_lamp("SPOT", use_temperature=True, temperature=3500, color=(0.5, 1, 0.6), energy=20)


def of_blackbody_node():
    light = put_lamp("POINT", energy=20)
    shader = tree_of(light, "ShaderNodeOutputLight", "ShaderNodeEmission")
    body = light.node_tree.nodes.new("ShaderNodeBlackbody")
    body.inputs["Temperature"].default_value = 3200
    light.node_tree.links.new(body.outputs[0], shader.inputs["Color"])


def of_sun():
    put_lamp("SUN", color=(1, 0.9, 0.7), energy=1)


def of_emitter():
    material = bpy.data.materials.new("Glow")
    shader = tree_of(material, "ShaderNodeOutputMaterial", "ShaderNodeEmission")
    shader.inputs["Color"].default_value = (0.2, 1, 0.5, 1)
    shader.inputs["Strength"].default_value = 5
    put_square(material, 0.5, (0, 0.8, 1))


def of_even_world():
    put_world().inputs["Color"].default_value = (0.3, 0.6, 1, 1)


def of_picture():
    across, down = np.meshgrid(np.linspace(0, 1, 64), np.linspace(0, 1, 32))
    put_picture(np.stack((down, 0.2 + across, 1 - down * across), axis=-1))


def of_mixed():
    put_lamp("AREA", name="Warm", use_temperature=True, temperature=3000, energy=10)
    put_lamp("SPOT", name="Blue", place=(0.5, 0, 2), color=(0.2, 0.4, 1), energy=15)
    put_lamp("SUN", name="Sun", turn=(0, 0.5, 0), energy=0.4, color=(1, 1, 0.8))


def of_portal_and_world():
    put_world().inputs["Color"].default_value = (1, 0.6, 0.3, 1)
    put_lamp("AREA", color=(0.2, 0.4, 1), energy=20).cycles.is_portal = True


def of_lamp_seen_only_in_gloss():
    of_rgb()
    put_lamp("AREA", name="Rim", color=(0.2, 0.4, 1), energy=50)
    bpy.data.objects["Rim"].visible_diffuse = False


def of_emitter_seen_only_in_gloss():
    of_emitter()
    bpy.context.object.visible_diffuse = False
    of_rgb()


def of_world_seen_only_in_gloss():
    put_world().inputs["Color"].default_value = (0.3, 0.6, 1, 1)
    bpy.context.scene.world.cycles_visibility.diffuse = False
    of_rgb()


def of_lamp_without_shadow():
    put_square(None, 5, (0, 0, 1)).visible_camera = False
    put_lamp("AREA", color=(1, 0.3, 0.1), energy=20).use_shadow = False
    put_lamp("AREA", name="Shaded", color=(0.2, 0.4, 1), energy=20)


def of_backdrop():
    """The camera sees one color of the world, and surfaces get another."""
    shown = put_world()
    tree = bpy.context.scene.world.node_tree
    lit, mix, path = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("Background", "MixShader", "LightPath")
    )
    lit.inputs["Color"].default_value = (1, 0.6, 0.3, 1)
    shown.inputs["Color"].default_value = (0, 0.1, 1, 1)
    tree.links.new(path.outputs["Is Camera Ray"], mix.inputs[0])
    tree.links.new(lit.outputs[0], mix.inputs[1])
    tree.links.new(shown.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.get_output_node("CYCLES").inputs["Surface"])


def of_group():
    """A group with a color of its own, and a strength from outside."""
    light = put_lamp("POINT", energy=5)
    tree_of(light, "ShaderNodeOutputLight", "ShaderNodeEmission")
    group = bpy.data.node_groups.new("Shade", "ShaderNodeTree")
    group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    group.interface.new_socket("Power", in_out="INPUT", socket_type="NodeSocketFloat")
    shader = group.nodes.new("ShaderNodeEmission")
    shader.inputs["Color"].default_value = (0.3, 1, 0.4, 1)
    start, end = (group.nodes.new(f"NodeGroup{kind}") for kind in ("Input", "Output"))
    group.links.new(start.outputs[0], shader.inputs["Strength"])
    group.links.new(shader.outputs[0], end.inputs[0])
    tree = light.node_tree
    used = tree.nodes.new("ShaderNodeGroup")
    used.node_tree = group
    used.inputs[0].default_value = 4
    tree.links.new(used.outputs[0], tree.nodes["Light Output"].inputs["Surface"])
    put_lamp("SUN", color=(1, 0.5, 0.5), energy=0.3)


def of_what_renders_show():
    """A lamp in a collection that is hidden in renders, and one by its empty."""
    of_rgb()
    for name in ("Lamps", "Placed"):
        put_lamp("AREA", name=name, color=(0.2, 0.4, 1), energy=50)
        collection = bpy.data.collections.new(name)
        collection.objects.link(bpy.data.objects[name])
        bpy.context.scene.collection.objects.unlink(bpy.data.objects[name])
    bpy.context.scene.collection.children.link(bpy.data.collections["Lamps"])
    bpy.data.collections["Lamps"].hide_render = True
    empty = bpy.data.objects.new("Empty", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", bpy.data.collections["Placed"]
    empty.hide_render = True
    bpy.context.scene.collection.objects.link(empty)


def put_sky(kind, elevation, **settings):
    background = put_world()
    tree = bpy.context.scene.world.node_tree
    sky = tree.nodes.new("ShaderNodeTexSky")
    tree.links.new(sky.outputs[0], background.inputs["Color"])
    sky.sky_type = kind
    angle = math.radians(elevation)
    sky.sun_elevation = angle
    if kind in {"PREETHAM", "HOSEK_WILKIE"}:
        sky.sun_direction = (math.cos(angle), 0, math.sin(angle))
    for key, value in settings.items():
        setattr(sky, key, value)


def of_old_sky():
    put_sky("PREETHAM", 25)


def of_older_sky():
    put_sky("HOSEK_WILKIE", 25)


def of_sky():
    put_sky(PHYSICAL, 25, sun_disc=False)


def of_sky_and_sun():
    put_sky(PHYSICAL, 25)


PHYSICAL = "MULTIPLE_SCATTERING" if bpy.app.version >= (5, 0, 0) else "NISHITA"

LAMPS = (of_rgb, of_temperature, of_temperature_and_color, of_blackbody_node, of_sun, of_emitter)
WORLDS = (of_even_world, of_picture, of_old_sky, of_older_sky, of_sky, of_sky_and_sun)
TOLERANCES = {
    **dict.fromkeys(LAMPS, 2e-4),
    of_even_world: 2e-4,
    of_picture: 4e-3,
    of_mixed: 8e-3,
    **dict.fromkeys((of_portal_and_world, of_lamp_seen_only_in_gloss, of_backdrop), 2e-4),
    **dict.fromkeys((of_emitter_seen_only_in_gloss, of_world_seen_only_in_gloss), 2e-4),
    **dict.fromkeys((of_lamp_without_shadow, of_what_renders_show), 2e-4),
    of_group: 8e-3,
    of_old_sky: 4e-3,
    of_older_sky: 4e-3,
    of_sky: 4e-3,
    of_sky_and_sun: 4e-3,
}
"""Distance in u'v'; eyes tell apart about 0.002. Pictures and mixtures of lamps are
estimated from a few hundred rays; skies come from a table."""


def put_world():
    world = bpy.data.worlds.new("World")
    bpy.context.scene.world = world
    return tree_of(world, "ShaderNodeOutputWorld", "ShaderNodeBackground")


def put_picture(rgb):
    background = put_world()
    tree = bpy.context.scene.world.node_tree
    rows, columns, _ = rgb.shape
    image = bpy.data.images.new("Around", columns, rows, float_buffer=True)
    pixels = np.ones((rows, columns, 4), np.float32)
    pixels[..., :3] = rgb[::-1]
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    node = tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = image
    tree.links.new(node.outputs[0], background.inputs["Color"])


def tree_of(data, output, shader):
    if bpy.app.version < (5, 0, 0):
        data.use_nodes = True
    tree = data.node_tree
    tree.nodes.clear()
    made = tree.nodes.new(shader)
    tree.links.new(made.outputs[0], tree.nodes.new(output).inputs["Surface"])
    return made


@pytest.mark.parametrize("make", [lamp_case(make) for make in TOLERANCES])
def test_color_of_light_is_that_of_a_white_diffuser(make, render, make_material):
    white = make_material("White", Color=(1, 1, 1, 1))
    put_square(white, 0.4)
    look_down(0.1, distance=0.5)
    make()
    rendered = render(4, 4, 256).mean(axis=(0, 1))
    view = look().views[white]
    found = sum(light.share * light.white for light in view.lights)
    apart = illuminant_spectra.to_uv(found) - illuminant_spectra.to_uv(to_xyz(rendered))
    assert np.linalg.norm(apart) < TOLERANCES[make]


def test_picture_is_turned_as_cycles_turns_it(render, make_material):
    """Half of the surroundings are red: two tilted squares see which half is where."""
    around = np.full((16, 32, 3), 0.02)
    around[:, :16, 0] = 1
    put_picture(around)
    left, right = (make_material(name, Color=(1, 1, 1, 1)) for name in ("Left", "Right"))
    for material, side in ((left, -1), (right, 1)):
        square = put_square(material, 0.4, (0, 0.3 * side, 0))
        square.rotation_euler = (-1.2 * side, 0, 0)
    look_down(1.0)
    pixels = render(50, 50, 16)
    upper, lower = (pixels[row - 2 : row + 2, 22:28, 0].mean() for row in (10, 40))
    assert max(upper, lower) > 3 * min(upper, lower)
    brightest = right if upper > lower else left
    report = look()
    assert brightest in report.views
    # Red falls on that one from the front: light from nearer its normal.
    angles = {m: np.average(v.angles[0], weights=v.weights) for m, v in report.views.items()}
    other = left if brightest is right else right
    assert angles[brightest] < angles[other]
