# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A textured material keeps its texture, whose mean reading is then the sample's, measured."""

import math

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, texture_colors, texture_scale, working_space
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.instrument import measure
from rough_spectra.addon.matching import scene_view
from rough_spectra.addon.matching import texture_scale as solving
from rough_spectra.addon.matching.solve import Request
from rough_spectra.addon.material import derive, state
from rough_spectra.addon.samples import presets
from rough_spectra.core.color import color_difference
from rough_spectra.core.cycles import instrument_lobe
from rough_spectra.core.errors import MaterialError
from rough_spectra.core.numerics import direction_grid

from tools.checks.textures import image, pictures

SAMPLES = 256
"""Rays a pixel, of 16: 4096 places on the texture."""


def socket(material):
    return shader_nodes.color_socket(shader_nodes.shader_node(material))


def textured(make_material, kind="image", node="ShaderNodeBsdfDiffuse", name="Wall"):
    material = make_material(name, node=node)
    tree = material.node_tree
    if kind == "image":
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = image("bricks", pictures()["bricks"][::8, ::8])
    else:
        texture = tree.nodes.new(kind)
    tree.links.new(texture.outputs["Color"], socket(material))
    return material


def request(name="terracotta", degrees=25.0, **settings):
    return Request(presets.load(name), math.radians(degrees), **settings)


def scale_of(material):
    return texture_scale.node_of(socket(material))


def b_of(node):
    return next(each for each in node.inputs if each.identifier == "B_Color")


def names(material):
    return sorted(node.name for node in material.node_tree.nodes)


@pytest.fixture
def looks(monkeypatch):
    """How often a second Blender looks; it sees a spread of reds that are known."""
    found = []
    colors = np.random.default_rng(1).uniform(0.1, 0.6, (4000, 3)) ** 2

    def seen(sockets):
        found.append(len(sockets))
        return [colors for _ in sockets]

    monkeypatch.setattr(texture_colors, "seen", seen)
    return found


def test_the_mean_of_images_and_procedurals_measures_as_the_sample(make_material):
    """Eight textures, both shaders, in one look and one measurement."""
    cases = [
        (kind, node, degrees)
        for kind in ("image", "ShaderNodeTexNoise")
        for node in ("ShaderNodeBsdfDiffuse", "ShaderNodeBsdfPrincipled")
        for degrees in (0.0, 40.0)
    ]
    pairs = [
        (textured(make_material, kind, node, f"{kind} {i}"), request(degrees=degrees))
        for i, (kind, node, degrees) in enumerate(cases)
    ]
    solutions = derive.assign(pairs)
    materials = [material for material, _ in pairs]
    space = working_space.current()
    [found] = measure.measure(materials, samples=SAMPLES)
    targets = np.array([solution.target for solution in solutions])
    labs = (space.to_lab(rgb, "D65") for rgb in (found[:, 0], targets))
    assert color_difference.delta_e(*labs).max() < 0.1
    assert found[:, 1].max() > 0.05  # it is no even color
    for material, solution in zip(materials, solutions, strict=True):
        assert state.state(material).kind == "fresh"
        assert scale_of(material).name.startswith("Rough Spectra Scale")
        assert any("its mean reads as the sample" in note for note in solution.warnings)


def test_another_blender_sees_the_colors_of_an_image(make_material):
    """Encoded 8-bit colors arrive linear; each of four texels covers a quarter."""
    material = textured(make_material)
    texture = material.node_tree.nodes["Image Texture"]
    texture.interpolation = "Closest"
    encoded = np.array([[[0, 51, 100], [255] * 3], [[200, 150, 120], [20, 70, 230]]]) / 255
    texture.image = image("four", encoded)
    [found] = texture_colors.seen([socket(material)])
    bytes_ = encoded.reshape(4, 3)
    linear = np.where(bytes_ <= 0.04045, bytes_ / 12.92, ((bytes_ + 0.055) / 1.055) ** 2.4)
    different, counts = np.unique(found.round(5), axis=0, return_counts=True)
    order = np.lexsort(linear.T[::-1])
    assert different == pytest.approx(linear[order], abs=2e-5)
    assert counts == pytest.approx(np.full(4, len(found) / 4), rel=0.01)


def test_it_looks_between_the_texels_too(make_material):
    """Black and white columns: of 8 bits Cycles interpolates what is encoded, and then decodes."""
    material = textured(make_material)
    columns = np.zeros((4, 512, 3))
    columns[:, ::2] = 1
    material.node_tree.nodes["Image Texture"].image = image("columns", columns)
    [found] = texture_colors.seen([socket(material)])
    evenly = (np.arange(10_000) + 0.5) / 10_000
    between = np.where(evenly <= 0.04045, evenly / 12.92, ((evenly + 0.055) / 1.055) ** 2.4)
    assert found.mean(axis=0) == pytest.approx(np.full(3, between.mean()), rel=0.005)


def test_dragging_scales_anew_without_looking_again(make_material, looks):
    material = textured(make_material)
    derive.assign([(material, request())])
    group, before = material.rough_spectra, b_of(scale_of(material)).default_value[:3]
    group.sigma = math.radians(45)
    after = b_of(scale_of(material)).default_value[:3]
    assert looks == [1]
    assert state.state(material).kind == "fresh"
    assert max(abs(a - b) for a, b in zip(before, after, strict=True)) > 0.01
    group.illuminant = "A"
    assert state.state(material).kind == "fresh"
    assert b_of(scale_of(material)).default_value[:3] != after
    assert looks == [1]
    count = len(material.node_tree.nodes)
    derive.renew([material])
    assert looks == [1, 1]
    assert len(material.node_tree.nodes) == count


def test_the_light_of_a_scene_scales_anew_without_looking_again(make_material, looks):
    material = textured(make_material)
    derive.assign([(material, request())])
    before = tuple(b_of(scale_of(material)).default_value)
    warm = illuminant_spectra.planck(2856.0)
    light = scene_view.make_light("Lamp", "A", warm / illuminant_spectra.to_xyz(warm)[1], 1.0)
    rows = np.column_stack(direction_grid.hemisphere(8)).tolist()
    view = scene_view.SceneView("Scene", (light,), tuple((*row, 0, 1 / 8) for row in rows))
    derive.follow_scene({material: view})
    assert looks == [1]
    assert state.state(material).kind == "fresh"
    assert tuple(b_of(scale_of(material)).default_value) != before


def test_another_texture_is_looked_at_while_dragging(make_material, looks):
    material = textured(make_material)
    derive.assign([(material, request())])
    tree = material.node_tree
    other = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(other.outputs["Color"], texture_scale.source(socket(material)))
    material.rough_spectra.sigma = math.radians(30)
    assert looks == [1, 1]


@pytest.mark.parametrize(
    "edit",
    [
        lambda node: b_of(node).default_value.__setitem__(0, 0.1),
        lambda node: setattr(node, "blend_type", "ADD"),
        lambda node: setattr(node, "mute", True),
        lambda node: node.inputs[0].__setattr__("default_value", 0.5),
    ],
)
def test_a_scale_edited_by_hand_is_stale_and_does_not_follow(make_material, looks, edit):
    material = textured(make_material)
    derive.assign([(material, request())])
    written = tuple(b_of(scale_of(material)).default_value)
    edit(scale_of(material))
    assert state.state(material).kind == "stale"
    edited = tuple(b_of(scale_of(material)).default_value)
    material.rough_spectra.sigma = math.radians(40)
    assert tuple(b_of(scale_of(material)).default_value) == edited
    material.rough_spectra.sigma = math.radians(25)
    derive.renew([material])
    assert state.state(material).kind == "fresh"
    assert tuple(b_of(scale_of(material)).default_value) == pytest.approx(written)


def test_the_scale_is_taken_away_and_the_texture_stays(make_material, looks):
    material = textured(make_material)
    before = names(material)
    hidden = tuple(socket(material).default_value)
    derive.assign([(material, request())])
    assert tuple(socket(material).default_value) == hidden
    assert shader_nodes.unscale(material)
    assert names(material) == before
    assert socket(material).links[0].from_node.name == "Image Texture"
    assert state.state(material).kind == "stale"
    assert not shader_nodes.unscale(material)


def test_another_shader_takes_the_texture_over(make_material, looks):
    """To and fro, and no node more each time."""
    material = textured(make_material)
    derive.assign([(material, request())])
    for _ in range(2):
        for shader in ("PRINCIPLED", "DIFFUSE"):
            derive.assign([(material, request())], shader)
            assert state.state(material).kind == "fresh"
            assert scale_of(material) is not None
    assert len(material.node_tree.nodes) == 5


def test_a_black_texture_is_refused_and_nothing_changes(make_material, monkeypatch):
    material = textured(make_material)
    before = names(material)
    monkeypatch.setattr(texture_colors, "seen", lambda sockets: [np.zeros((9, 3))])
    with pytest.raises(MaterialError, match="its texture is black wherever it was looked at"):
        derive.assign([(material, request())])
    assert names(material) == before
    assert not material.rough_spectra.spectrum


def test_a_copy_of_the_material_has_a_scale_of_its_own(make_material, looks):
    material = textured(make_material)
    derive.assign([(material, request())])
    copy = material.copy()
    copy.rough_spectra.sigma = math.radians(45)
    assert state.state(copy).kind == state.state(material).kind == "fresh"
    theirs, ours = (tuple(b_of(scale_of(m)).default_value) for m in (copy, material))
    assert theirs != ours


def colors(count=3000, highest=0.9):
    return np.random.default_rng(5).uniform(0.02, highest, (count, 3)) ** 2


def test_a_palette_keeps_mean_and_readings():
    """Also of what is clipped, and where much is black."""
    every = colors(50_000) * (np.random.default_rng(2).uniform(size=(50_000, 1)) > 0.13)
    channels, few, weights = solving.palette(every)
    assert len(channels) == solving.MOST_VALUES
    assert channels.mean(axis=0) == pytest.approx(every.mean(axis=0), rel=1e-12)
    assert weights @ few == pytest.approx(every.mean(axis=0), rel=1e-12)
    for roughness, factor in ((0.3, 1), (1.0, 1), (0.5, 50)):
        shown = (np.minimum(each * factor, 1) for each in (every, channels))
        exact, found = (
            instrument_lobe.reflectance(each, roughness, "45a:0").mean(axis=0) for each in shown
        )
        assert found == pytest.approx(exact, rel=1e-3 if factor > 1 else 1e-5)


@pytest.mark.parametrize("count", [1, 7, 513, 1000])
def test_a_palette_of_any_number_of_colors(count):
    every = colors(count)
    channels, few, weights = solving.palette(every)
    assert channels.mean(axis=0) == pytest.approx(every.mean(axis=0))
    assert weights @ few == pytest.approx(every.mean(axis=0))


def test_the_palette_of_few_colors_is_these():
    some = np.repeat([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]], [30, 10], axis=0)
    _, few, weights = solving.palette(some)
    few = few.round(9)
    shares = {tuple(c.tolist()): weights[(few == c).all(axis=1)].sum() for c in few}
    assert shares == pytest.approx({(0.1, 0.2, 0.3): 0.75, (0.4, 0.5, 0.6): 0.25})


@pytest.mark.parametrize("roughness", [0.0, 0.5, 1.0])
def test_the_scale_is_right_where_it_clips_too(roughness):
    every, target = colors(), np.array([0.5, 0.7, 0.1])
    weights = np.full(len(every), 1 / len(every))
    found = solving.solve(
        every, every, weights, target, roughness, working_space.current(), "D65", "45a:0"
    )
    shown = np.minimum(every * found.factors, 1)
    read = instrument_lobe.reflectance(shown, roughness, "45a:0").mean(axis=0)
    assert read == pytest.approx(target, rel=1e-6)
    assert found.clipped == pytest.approx((every * found.factors > 1).any(axis=1).mean())
    assert found.clipped > 0.1
    assert any("is clipped" in note for note in found.notes)
    assert 0 < found.spread_mean < found.spread_95


def test_a_channel_that_is_black_is_told():
    every = colors() * [1, 1, 0]
    weights = np.full(len(every), 1 / len(every))
    target = np.array([0.2, 0.2, 0.2])
    found = solving.solve(
        every, every, weights, target, 0.5, working_space.current(), "D65", "45a:0"
    )
    assert found.factors[2] == 1
    assert found.delta_e > 5
    assert any("too dark in blue" in note for note in found.notes)


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        (None, r"'Image Texture' has no image; choose one, or unlink"),
        ("//gone/wall.png", r"the file of image 'wall.png' is missing; find it"),
    ],
)
def test_an_image_that_is_missing_is_refused(make_material, path, sentence):
    """Renders show magenta in its place, and the scale was that of magenta."""
    material = make_material("Wall")
    tree, shader = material.node_tree, socket(material)
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = None if path is None else bpy.data.images.new("wall.png", 1, 1)
    if path is not None:
        node.image.source, node.image.filepath = "FILE", path
    tree.links.new(node.outputs["Color"], shader)
    with pytest.raises(MaterialError, match=sentence):
        derive.assign([(material, request())])
    assert not material.rough_spectra.stamp
    assert [each.bl_idname for each in tree.nodes].count("ShaderNodeMix") == 0
