# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an instrument is put down: by a ray, an empty, a vertex group, or in the middle."""

import math

import bpy
import numpy as np
import pytest
from rough_spectra.addon.instrument import spot, surfaces, unseen
from rough_spectra.addon.instrument.triangles import Triangles
from rough_spectra.core.errors import DomainError, MaterialError

from tests.addon import spot_scene


@pytest.fixture
def paint():
    return spot_scene.colored("Paint", (0.4, 0.25, 0.1))


def near(place):
    return pytest.approx(place, abs=1e-6)


def test_a_material_is_measured_in_the_middle_of_its_faces(paint):
    other = spot_scene.colored("Other", (0.1, 0.2, 0.3))
    thing = spot_scene.square("Two", paint, other, location=(3, 2, 1))
    thing.data.materials.append(spot_scene.colored("Left over", (1, 1, 1)))
    left, right = spot.on_materials(thing)
    assert (left.material, right.material) == (paint, other)
    assert left.point == near((2.75, 2, 1))
    assert right.point == near((3.25, 2, 1))
    assert left.normal == near((0, 0, 1))
    assert left.toward == near((1, 0, 0))
    assert left.surface == ("Two", paint)


def test_a_cube_is_measured_on_the_middle_of_a_face_and_outside_where_it_is_mirrored(paint):
    thing = spot_scene.cube("Cube", paint, location=(5, 0, 0), scale=(-1, 2, 3))
    [found] = spot.on_materials(thing)
    away = np.array(found.point) - (5, 0, 0)
    assert np.abs(away).max() == pytest.approx(np.abs(away).sum(), abs=1e-6)
    assert found.normal == near(tuple(away / np.linalg.norm(away)))
    assert abs(np.dot(found.toward, found.normal)) < 1e-6


def test_modifiers_count(paint):
    thing = spot_scene.square("Square", paint)
    modifier = thing.modifiers.new("Away", "DISPLACE")
    modifier.direction, modifier.strength, modifier.mid_level = "Z", 0.25, 0.0
    [found] = spot.on_materials(thing)
    assert found.point == near((0, 0, 0.25))


def test_a_vertex_group_is_measured_at_its_weighted_middle(paint):
    thing = spot_scene.square("Square", paint, size=2.0)
    group = thing.vertex_groups.new(name="Here")
    group.add([0, 3], 1.0, "REPLACE")
    found = spot.at_group(thing, "Here")
    # Weights run from 1 at x = -1 to 0 at x = 0: a third of the way.
    assert found.point == near((-2 / 3, 0, 0))
    with pytest.raises(MaterialError, match="no vertex group 'There'; it has Here"):
        spot.at_group(thing, "There")
    thing.vertex_groups.new(name="Nothing")
    with pytest.raises(MaterialError, match="'Nothing' of object 'Square' holds no face"):
        spot.at_group(thing, "Nothing")


def test_an_empty_tells_place_side_and_azimuth(paint):
    thing = spot_scene.cube("Cube", paint)
    empty = bpy.data.objects.new("Empty", None)
    bpy.context.scene.collection.objects.link(empty)
    empty.location, empty.rotation_euler = (0.3, 0.1, 1.2), (0, 0, math.pi / 2)
    found = spot.at_empty(thing, empty)
    assert (found.point, found.normal) == (near((0.3, 0.1, 1)), near((0, 0, 1)))
    assert found.toward == near((0, 1, 0))
    # From within, or below: what the z axis points to is where the instrument is.
    empty.rotation_euler = (math.pi, 0, 0)
    assert spot.at_empty(thing, empty).normal == near((0, 0, -1))
    empty.location.x = 4
    with pytest.raises(MaterialError, match="'Empty' does not meet object 'Cube'"):
        spot.at_empty(thing, empty)


def test_a_ray_finds_the_side_that_is_seen(paint):
    spot_scene.square("Square", paint)
    bpy.context.view_layer.update()
    below = spot.at_ray(bpy.context, (0.2, 0, -5), (0, 0, 1))
    assert (below.point, below.normal) == (near((0.2, 0, 0)), near((0, 0, -1)))
    assert spot.at_ray(bpy.context, (3, 0, 5), (0, 0, -1)) is None


def test_the_diameter_is_in_millimeters_whatever_the_scenes_unit(paint):
    [found] = spot.on_materials(spot_scene.square("Square", paint), diameter=4)
    assert found.units == pytest.approx(0.004)
    bpy.context.scene.unit_settings.scale_length = 0.001
    assert found.units == pytest.approx(4)
    with pytest.raises(DomainError, match="is -1 mm; give more than 0"):
        spot.on_materials(bpy.data.objects["Square"], diameter=-1)


def test_what_has_no_surface_is_refused_by_what_it_is(paint):
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    with pytest.raises(MaterialError, match="'Lamp' is a light, and has no surface"):
        spot.on_materials(lamp)
    bare = spot_scene.add("Bare", [(0, 0, 0), (1, 0, 0)], [], paint)
    with pytest.raises(MaterialError, match="'Bare' has no face"):
        spot.on_materials(bare)
    with pytest.raises(MaterialError, match="'Naked' has no material"):
        spot.on_materials(spot_scene.square("Naked"))
    fine = spot_scene.square("Fine", paint)
    modifier = fine.modifiers.new("Fine", "SUBSURF")
    if hasattr(modifier, "use_adaptive_subdivision"):
        modifier.use_adaptive_subdivision = True
    else:
        bpy.context.scene.cycles.feature_set = "EXPERIMENTAL"
        fine.cycles.use_adaptive_subdivision = True
    with pytest.raises(MaterialError, match="a fixed number of levels"):
        spot.on_materials(fine)


def test_a_curve_has_a_surface_and_a_thing_being_edited_the_edited_one(paint):
    curve = bpy.data.curves.new("Text", "FONT")
    curve.body = "I"
    curve.materials.append(paint)
    text = bpy.data.objects.new("Text", curve)
    bpy.context.scene.collection.objects.link(text)
    assert abs(spot.on_materials(text)[0].normal[2]) == pytest.approx(1)


def test_shards_with_other_spots_do_not_belong_together(paint):
    thing = spot_scene.square("Square", paint)
    digests = {
        surfaces.digest(spot.on_materials(thing, diameter=size), True) for size in (4, 8)
    } | {surfaces.digest([("Square", paint)], True)}
    assert len(digests) == 3


def test_the_nearest_place_is_that_of_a_search_among_many_places():
    random = np.random.default_rng(7)
    corners = random.normal(size=(40, 3, 3))
    triangles = Triangles(corners, np.zeros(40, int), np.ones((40, 3)))
    parts = random.dirichlet((0.5, 0.5, 0.5), 20000)
    places = np.einsum("pc,tcx->tpx", parts, corners)
    for point in random.normal(size=(8, 3)) * 2:
        number, found = triangles.nearest(point)
        distances = np.linalg.norm(places - point, axis=-1)
        assert np.linalg.norm(found - point) <= distances.min() + 1e-9
        assert np.linalg.norm(found - point) == pytest.approx(distances.min(), abs=0.02)
        assert distances[number].min() == pytest.approx(distances.min(), abs=0.02)


def reach(material, socket):
    """Let a socket of a node have a say in the color."""
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    add = tree.nodes.new("ShaderNodeVectorMath")
    color = shader.inputs["Color"]
    if color.is_linked:
        tree.links.new(color.links[0].from_socket, add.inputs[0])
    tree.links.new(socket, add.inputs[1])
    tree.links.new(add.outputs[0], color)


def test_what_the_second_blender_sees_otherwise_is_told(paint):
    tree = paint.node_tree
    group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    group.interface.new_socket("Far", in_out="OUTPUT")
    instance = tree.nodes.new("ShaderNodeGroup")
    instance.node_tree = group
    seen, end = (group.nodes.new(f"{kind}") for kind in ("ShaderNodeCameraData", "NodeGroupOutput"))
    group.links.new(seen.outputs["View Distance"], end.inputs[0])
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = bpy.data.images.new("Painted", 2, 2)
    texture.image.pixels[0] = 0.5
    script = tree.nodes.new("ShaderNodeScript")
    assert unseen.on_objects(paint) == []  # they reach nothing
    reach(paint, instance.outputs[0])
    reach(paint, texture.outputs[0])
    for told in (" ".join(unseen.on_objects(paint)), " ".join(unseen.on_flat_samples(paint))):
        assert "image 'Painted' has changes that are not saved" in told
        assert "'Paint' follows the camera (Camera Data)" in told
        assert "script" not in told
    if script.outputs:
        reach(paint, script.outputs[0])
    texture.image.pack()
    assert "Painted" not in " ".join(unseen.on_objects(paint))


def test_what_a_flat_sample_lacks_is_told(tmp_path):
    """It read as black, or as flat, without a word."""
    image = spot_scene.udim(tmp_path)
    cases = {
        "has no 'Paint' (Color Attribute)": spot_scene.by_attribute("By attribute"),
        "has no 'Second' (UV Map)": spot_scene.by_image("By map", image, "Second"),
        "shows one tile of ": spot_scene.by_image("By tile", image, "UVMap"),
        "is not displaced": spot_scene.displaced("Displaced", (0.1, 0.1, 0.1), 0.1),
    }
    for said, material in cases.items():
        told = unseen.on_flat_samples(material)
        assert any(said in sentence for sentence in told), said
        assert all(sentence.endswith(f"; {unseen.INSTEAD}") for sentence in told)
    assert len(unseen.on_flat_samples(cases["shows one tile of "])) == 1
    assert unseen.on_flat_samples(spot_scene.colored("Even", (0.1, 0.1, 0.1))) == []


@pytest.mark.parametrize(
    ("kind", "output", "said"),
    [
        ("TexCoord", "Object", "has its own Object (Texture Coordinate)"),
        ("TexCoord", "Generated", "has its own Generated (Texture Coordinate)"),
        ("TexNoise", "Color", "has its own Generated (Noise Texture)"),
        ("NewGeometry", "Position", "has its own Position (Geometry)"),
        ("NewGeometry", "Pointiness", "has its own Pointiness (Geometry)"),
        ("ObjectInfo", "Random", "has its own Random (Object Info)"),
        ("AmbientOcclusion", "Color", "has another shape (Ambient Occlusion)"),
        ("Attribute", "Color", "has no 'Dirt' (Attribute)"),
        ("TexCoord", "UV", ""),
        ("NewGeometry", "Incoming", ""),
        ("ObjectInfo", "Material Index", ""),
        ("TexImage", "Color", ""),
    ],
)
def test_what_follows_the_object_is_told(paint, kind, output, said):
    """It was read at the flat sample's place, as if it were the object's, without a word."""
    node = paint.node_tree.nodes.new(f"ShaderNode{kind}")
    if kind == "Attribute":
        node.attribute_name = "Dirt"
    socket = next(each for each in node.outputs if each.name == output)
    assert unseen.on_flat_samples(paint) == []
    reach(paint, socket)
    told = unseen.on_flat_samples(paint)
    assert told == ([] if not said else [told[0]])
    assert not said or told[0].endswith(f"{said}; {unseen.INSTEAD}")
    node.mute = True
    assert unseen.on_flat_samples(paint) == []


def test_textures_in_a_group_by_uvs_are_right_and_others_told_together(paint):
    group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    group.interface.new_socket("Color", in_out="OUTPUT")
    end = group.nodes.new("NodeGroupOutput")
    kinds = ("Noise", "Voronoi", "Wave", "Magic")
    nodes = [group.nodes.new(f"ShaderNodeTex{kind}") for kind in kinds]
    previous = nodes[0].outputs["Color"]
    for node in nodes[1:]:
        group.links.new(previous, node.inputs["Scale"])
        previous = node.outputs["Color"]
    group.links.new(previous, end.inputs[0])
    instance = paint.node_tree.nodes.new("ShaderNodeGroup")
    instance.node_tree = group
    reach(paint, instance.outputs[0])
    [told] = unseen.on_flat_samples(paint)
    assert "has its own Generated (Magic Texture, Wave Texture, Voronoi Texture, …)" in told
    at = group.nodes.new("ShaderNodeUVMap")
    for node in nodes:
        group.links.new(at.outputs[0], node.inputs["Vector"])
    assert unseen.on_flat_samples(paint) == []
