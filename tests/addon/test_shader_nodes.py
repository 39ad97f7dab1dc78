# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a material's color is written, on trees as people leave them, and what is refused."""

import time

import bpy
import pytest
from rough_spectra.addon.blender import shader_nodes, sockets
from rough_spectra.addon.matching import shaders
from rough_spectra.core.errors import DomainError, MaterialError

COLOR, ROUGHNESS = (0.25, 0.5, 0.75), 0.625  # exact in single precision


def surface(material):
    """The node that Cycles takes the surface from."""
    return material.node_tree.get_output_node("CYCLES").inputs["Surface"].links[0].from_node


def described(material):
    """Everything about a tree that an assignment could change."""
    tree = material.node_tree
    if tree is None:
        return None
    return (
        getattr(material, "use_nodes", None) if bpy.app.version < (5, 0, 0) else None,
        sorted(
            (
                node.name,
                node.bl_idname,
                node.mute,
                tuple(node.location),
                tuple((s.identifier, value(s)) for s in node.inputs if hasattr(s, "default_value")),
            )
            for node in tree.nodes
        ),
        sorted(
            (link.from_node.name, link.to_node.name, link.to_socket.identifier, link.is_muted)
            for link in tree.links
        ),
    )


def value(socket):
    content = socket.default_value
    return str(tuple(content) if hasattr(content, "__len__") else content)


def refused(material, sentence, shader="AUTO"):
    before = described(material)
    with pytest.raises(MaterialError) as caught:
        shader_nodes.find(material, shader)
    told = str(caught.value)
    assert sentence in told
    assert repr(material.name) in told
    assert told.endswith(".")
    assert described(material) == before


def written(material, shader="AUTO"):
    """Find, see that finding changed nothing, and write."""
    before = described(material)
    place = shader_nodes.find(material, shader)
    assert described(material) == before
    name = shader_nodes.write(place, COLOR, ROUGHNESS)
    node = material.node_tree.nodes[name]
    assert surface(material) == node
    assert tuple(shader_nodes.color_socket(node).default_value)[:3] == COLOR
    assert shader_nodes.roughness_socket(node).default_value == ROUGHNESS
    return node


def test_diffuse_made_by_hand_is_set_where_it_is(make_material):
    material = make_material(Color=(0.1, 0.2, 0.3, 0.5))
    node = written(material)
    assert node.bl_idname == "ShaderNodeBsdfDiffuse"
    assert node.inputs["Color"].default_value[3] == 0.5
    assert len(material.node_tree.nodes) == 2


def test_principled_made_by_hand_keeps_its_gloss(make_material):
    material = make_material(node="ShaderNodeBsdfPrincipled", Roughness=0.2, Coat_Weight=0.5)
    node = written(material)
    assert node.bl_idname == "ShaderNodeBsdfPrincipled"
    values = [node.inputs[name].default_value for name in ("Specular IOR Level", "Roughness")]
    assert values == pytest.approx([0.5, 0.2])
    assert len(material.node_tree.nodes) == 2
    found = shader_nodes.gloss_at(shader_nodes.find(material))
    told = (found.level, found.roughness, found.coat, found.coat_ior)
    assert told == pytest.approx((0.5, 0.2, 0.5, 1.5))
    shader_nodes.remove_gloss(shader_nodes.find(material, keep_gloss=False))
    assert shader_nodes.gloss_of(node) is None
    assert node.inputs["Roughness"].default_value == pytest.approx(0.2)


def test_a_principled_that_is_made_has_no_gloss(make_material):
    node = written(make_material(), "PRINCIPLED")
    assert shader_nodes.gloss_of(node) is None


GLOSS = sockets.OF_SHADER["PRINCIPLED"].gloss


@pytest.mark.parametrize("field", GLOSS)
def test_gloss_is_read_from_the_sockets_of_these_names(make_material, field):
    material = make_material(node="ShaderNodeBsdfPrincipled", Coat_Weight=1.0)
    node, before = surface(material), shader_nodes.surface(material).gloss
    socket = node.inputs[GLOSS[field]]
    is_tint = hasattr(socket.default_value, "__len__")
    socket.default_value = (0.25, 0.5, 0.75, 1.0) if is_tint else 0.25
    expected = before._replace(**{field: (0.25, 0.5, 0.75) if is_tint else 0.25})
    assert shader_nodes.surface(material).gloss == expected
    kind = "ShaderNodeRGB" if is_tint else "ShaderNodeValue"
    material.node_tree.links.new(material.node_tree.nodes.new(kind).outputs[0], socket)
    assert shader_nodes.surface(material).disturbing == (socket.name,)
    refused(material, f"{socket.name} comes from another node")
    if field not in ("level", "coat"):
        shader_nodes.find(material, keep_gloss=False)


def test_what_goes_with_no_gloss_does_not_count(make_material):
    material = make_material(
        node="ShaderNodeBsdfPrincipled",
        Specular_IOR_Level=0.0,
        Coat_Weight=0.0,
        Roughness=0.1,
        Anisotropic=0.7,
    )
    assert shader_nodes.surface(material).gloss is None
    assert shader_nodes.surface(material).disturbing == ()
    surface(material).inputs["Specular IOR Level"].default_value = 0.5
    assert shader_nodes.surface(material).disturbing == ("Anisotropic",)
    refused(material, "Anisotropic is in use, which turns its gloss")
    shader_nodes.find(material, keep_gloss=False)


def test_the_distribution_counts(make_material):
    material = make_material(node="ShaderNodeBsdfPrincipled")
    surface(material).distribution = "GGX"
    assert not shader_nodes.surface(material).gloss.multiscatter


def test_new_material_gets_a_shader():
    material = bpy.data.materials.new("new")
    node = written(material)
    expected = "Diffuse" if bpy.app.version < (5, 0, 0) else "Principled"
    assert expected in node.bl_idname


@pytest.mark.parametrize("shader", ["DIFFUSE", "PRINCIPLED"])
def test_empty_tree_gets_output_and_shader(make_material, shader):
    material = make_material()
    material.node_tree.nodes.clear()
    node = written(material, shader)
    assert node.bl_idname.lower().endswith(shader.lower())
    assert {n.bl_idname for n in material.node_tree.nodes} == {
        node.bl_idname,
        "ShaderNodeOutputMaterial",
    }


def test_shader_without_an_output_is_kept_and_a_new_one_linked(make_material):
    material = make_material()
    tree = material.node_tree
    tree.nodes.remove(tree.get_output_node("CYCLES"))
    written(material)
    assert len(tree.nodes) == 3


def test_unlinked_output_gets_a_diffuse(make_material):
    material = make_material()
    tree = material.node_tree
    tree.links.clear()
    old = tree.nodes["Diffuse BSDF"]
    node = written(material)
    assert node != old
    assert node.location.x < tree.get_output_node("CYCLES").location.x + 1


@pytest.mark.skipif(bpy.app.version >= (5, 0, 0), reason="all materials have nodes from 5.0 on")
def test_material_without_nodes_gets_them():
    material = bpy.data.materials.new("plain")
    assert not material.use_nodes
    written(material)
    material.use_nodes = False
    written(material)
    assert material.use_nodes


@pytest.mark.parametrize("shader", ["DIFFUSE", "PRINCIPLED"])
def test_asking_for_the_other_shader_keeps_the_old_one_in_the_tree(make_material, shader):
    other = "ShaderNodeBsdfPrincipled" if shader == "DIFFUSE" else "ShaderNodeBsdfDiffuse"
    material = make_material(node=other)
    old = surface(material)
    node = written(material, shader)
    assert node.bl_idname != other
    assert node.location != old.location
    assert len(material.node_tree.nodes) == 3
    # Once it is there it is used again.
    assert written(material, shader) == node


DIFFUSE, PRINCIPLED_NODE = "ShaderNodeBsdfDiffuse", "ShaderNodeBsdfPrincipled"


@pytest.fixture
def bumpy(make_material):
    """A Principled BSDF as an artist leaves it: with gloss of its own, and a bump map."""
    material = make_material(node=PRINCIPLED_NODE, Roughness=0.25, Coat_Roughness=0.5, IOR=1.75)
    tree, node = material.node_tree, surface(material)
    node.name = "Plaster"
    node.inputs["Base Color"].default_value = (0.1, 0.2, 0.3, 0.5)
    noise, bump = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeBump")
    tree.links.new(noise.outputs[0], bump.inputs["Height"])
    tree.links.new(bump.outputs[0], node.inputs["Normal"])
    return material


def bump_of(node):
    """Name of the node behind a shader's normal, or None."""
    links = node.inputs["Normal"].links
    return links[0].from_node.name if links else None


def test_changing_the_shader_back_and_forth_loses_and_adds_nothing(bumpy):
    first = surface(bumpy)
    for _ in range(3):
        diffuse = written(bumpy, "DIFFUSE")
        assert (bump_of(diffuse), shader_nodes.color_socket(diffuse).default_value[3]) == (
            "Bump",
            0.5,
        )
        principled = written(bumpy, "PRINCIPLED")
        assert principled == first
        assert bump_of(principled) == "Bump"
        gloss = [principled.inputs[name].default_value for name in ("Roughness", "IOR")]
        assert gloss == [0.25, 1.75]
        assert len(bumpy.node_tree.nodes) == 5


def test_what_happened_to_the_bump_meanwhile_is_carried_back(bumpy):
    tree, first = bumpy.node_tree, surface(bumpy)
    diffuse = written(bumpy, "DIFFUSE")
    tree.links.remove(diffuse.inputs["Normal"].links[0])
    assert written(bumpy, "PRINCIPLED") == first
    assert bump_of(first) is None
    other = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(other.outputs[0], first.inputs["Normal"]).is_muted = True
    assert written(bumpy, "DIFFUSE") == diffuse
    [link] = diffuse.inputs["Normal"].links
    assert (link.from_node, link.is_muted) == (other, True)


def use_in_a_mix(tree, node):
    tree.links.new(node.outputs[0], tree.nodes.new("ShaderNodeMixShader").inputs[1])


def use_in_another_output(tree, node):
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.target = "EEVEE"
    tree.links.new(node.outputs[0], output.inputs["Surface"])


def use_behind_a_reroute(tree, node):
    reroute = tree.nodes.new("NodeReroute")
    tree.links.new(node.outputs[0], reroute.inputs[0])
    use_in_a_mix(tree, reroute)


def replace_by_a_copy(tree, node):
    """As with Shift D: the copy takes along custom properties, under a name of its own."""
    other = tree.nodes.new(node.bl_idname)
    for key, value in node.items():
        other[key] = value
    tree.nodes.remove(node)


def make_metal(_tree, node):
    node.inputs["Metallic"].default_value = 1.0


def link_color(tree, node):
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs[0], node.inputs["Base Color"])


@pytest.mark.parametrize(
    "use",
    [
        *(use_in_a_mix, use_in_another_output, use_behind_a_reroute),
        *(replace_by_a_copy, make_metal, link_color),
    ],
)
def test_a_node_that_somebody_uses_or_that_cannot_be_set_is_left_alone(bumpy, use):
    first, tree = surface(bumpy), bumpy.node_tree
    written(bumpy, "DIFFUSE")
    use(tree, first)
    before, count = described(bumpy)[1], len(tree.nodes)
    node = written(bumpy, "PRINCIPLED")
    left = [row for row in described(bumpy)[1] if row[0] != node.name]
    kept = [row for row in before if row[1] != DIFFUSE]
    assert [row for row in left if row[1] != DIFFUSE] == kept
    # The one that was made instead is used from now on.
    for _ in range(2):
        written(bumpy, "DIFFUSE")
        assert written(bumpy, "PRINCIPLED") == node
        assert len(tree.nodes) == count + 1


def test_a_shader_that_was_never_in_use_is_not_taken(bumpy):
    """Prepared by hand and not linked yet."""
    own = bumpy.node_tree.nodes.new(DIFFUSE)
    own.inputs["Color"].default_value = (1.0, 0.0, 0.0, 1.0)
    assert written(bumpy, "DIFFUSE") != own
    assert tuple(own.inputs["Color"].default_value) == (1.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize("reroutes", [1, 2])
def test_behind_reroutes_the_shader_that_was_there_is_used_again(make_material, reroutes):
    material = make_material()
    tree, first = material.node_tree, surface(material)
    source = first.outputs[0]
    for _ in range(reroutes):
        reroute = tree.nodes.new("NodeReroute")
        tree.links.new(source, reroute.inputs[0])
        source = reroute.outputs[0]
    tree.links.new(source, tree.get_output_node("CYCLES").inputs["Surface"])
    written(material, "PRINCIPLED")
    assert written(material, "DIFFUSE") == first


def test_a_copied_material_uses_its_own_nodes_again(bumpy):
    written(bumpy, "DIFFUSE")
    copy = bumpy.copy()
    assert written(copy, "PRINCIPLED") == copy.node_tree.nodes["Plaster"]
    assert surface(bumpy).bl_idname == DIFFUSE


def test_reroutes_are_seen_through(make_material):
    material = make_material()
    tree = material.node_tree
    output, shader = tree.get_output_node("CYCLES"), surface(material)
    first, second = tree.nodes.new("NodeReroute"), tree.nodes.new("NodeReroute")
    tree.links.new(shader.outputs[0], first.inputs[0])
    tree.links.new(first.outputs[0], second.inputs[0])
    tree.links.new(second.outputs[0], output.inputs["Surface"])
    assert shader_nodes.find(material) == shader_nodes.SocketTarget(material, shader.name, "")


@pytest.mark.parametrize("muted", [0, 1])
def test_muted_link_counts_as_none_also_beside_a_reroute(make_material, muted):
    material = make_material()
    tree = material.node_tree
    output, shader = tree.get_output_node("CYCLES"), surface(material)
    reroute = tree.nodes.new("NodeReroute")
    links = [
        tree.links.new(shader.outputs[0], reroute.inputs[0]),
        tree.links.new(reroute.outputs[0], output.inputs["Surface"]),
    ]
    links[muted].is_muted = True
    assert shader_nodes.find(material).make == "ShaderNodeBsdfDiffuse"
    assert shader_nodes.shader_node(material) is None


def test_the_output_that_cycles_uses_is_the_one(make_material):
    material = make_material()
    tree = material.node_tree
    eevee = tree.nodes.new("ShaderNodeOutputMaterial")
    eevee.target = "EEVEE"
    tree.links.new(tree.nodes.new("ShaderNodeEmission").outputs[0], eevee.inputs["Surface"])
    assert shader_nodes.find(material).node_name == "Diffuse BSDF"
    cycles = tree.nodes.new("ShaderNodeOutputMaterial")
    cycles.target = "CYCLES"
    principled = tree.nodes.new("ShaderNodeBsdfPrincipled")
    tree.links.new(principled.outputs[0], cycles.inputs["Surface"])
    assert shader_nodes.find(material).node_name == principled.name


@pytest.mark.parametrize(
    "kind",
    ["ShaderNodeMixShader", "ShaderNodeEmission", "ShaderNodeBsdfTranslucent", "ShaderNodeGroup"],
)
@pytest.mark.parametrize("shader", ["AUTO", "DIFFUSE"])
def test_other_shaders_are_refused(make_material, kind, shader):
    material = make_material()
    tree = material.node_tree
    node = tree.nodes.new(kind)
    if kind == "ShaderNodeGroup":
        node.node_tree = bpy.data.node_groups.new("group", "ShaderNodeTree")
        node.node_tree.interface.new_socket(
            "Surface", in_out="OUTPUT", socket_type="NodeSocketShader"
        )
    tree.links.new(node.outputs[0], tree.get_output_node("CYCLES").inputs["Surface"])
    refused(material, f"its surface comes from {node.name!r}", shader)
    refused(material, "link a Diffuse or Principled BSDF to the material output, or match", shader)


@pytest.mark.parametrize(
    ("kind", "socket"),
    [
        ("ShaderNodeBsdfDiffuse", "Color"),
        ("ShaderNodeBsdfDiffuse", "Roughness"),
        ("ShaderNodeBsdfPrincipled", "Base Color"),
        ("ShaderNodeBsdfPrincipled", "Diffuse Roughness"),
        ("ShaderNodeBsdfPrincipled", "Specular IOR Level"),
    ],
)
def test_linked_animated_and_driven_sockets_are_refused(make_material, kind, socket):
    def fresh():
        material = make_material(node=kind)
        return material, material.node_tree, surface(material).inputs[socket]

    material, tree, target = fresh()
    link = tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs[0], target)
    link.is_muted = "Color" in socket  # a texture that shows is kept, and scaled
    refused(material, f"{socket} comes from another node; unlink it")

    material, _, target = fresh()
    target.keyframe_insert("default_value", frame=1)
    refused(material, f"{socket} is animated or driven; clear that")

    material, _, target = fresh()
    target.driver_add("default_value")
    refused(material, f"{socket} is animated or driven; clear that")

    # An action may have been pushed down into the NLA.
    material, tree, target = fresh()
    target.keyframe_insert("default_value", frame=1)
    data = tree.animation_data
    data.nla_tracks.new().strips.new("strip", 1, data.action)
    data.action = None
    refused(material, f"{socket} is animated or driven; clear that")


def test_animation_of_another_socket_does_not_matter(make_material):
    material = make_material(node="ShaderNodeBsdfPrincipled")
    surface(material).inputs["Subsurface Scale"].keyframe_insert("default_value", frame=1)
    written(material)


def test_animated_gloss_is_refused_where_there_is_gloss(make_material):
    material = make_material(node="ShaderNodeBsdfPrincipled")
    surface(material).inputs["Roughness"].keyframe_insert("default_value", frame=1)
    refused(material, "Roughness is animated or driven")
    surface(material).inputs["Specular IOR Level"].default_value = 0.0
    written(material)


def test_animation_that_would_add_light_later_is_refused(make_material):
    material = make_material(node="ShaderNodeBsdfPrincipled")
    surface(material).inputs["Metallic"].keyframe_insert("default_value", frame=1)
    refused(material, "Metallic is animated or driven")
    written(material, "DIFFUSE")


def test_muted_shader_is_refused(make_material):
    material = make_material()
    surface(material).mute = True
    refused(material, "is muted; unmute it first")


def test_linked_socket_that_adds_light_is_refused(make_material):
    material = make_material(node="ShaderNodeBsdfPrincipled")
    tree = material.node_tree
    tree.links.new(
        tree.nodes.new("ShaderNodeTexNoise").outputs[0], surface(material).inputs["Metallic"]
    )
    refused(material, "Metallic is in use, which adds light")


def test_grease_pencil_material_is_refused():
    material = bpy.data.materials.new("pencil")
    bpy.data.materials.create_gpencil_data(material)
    refused(material, "is for Grease Pencil; choose a surface material")


@pytest.fixture
def library(make_material, tmp_path):
    """A library file with a material and an object that uses it."""
    material = make_material("Plaster")
    mesh = bpy.data.meshes.new("Wall")
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Wall", mesh))
    path = tmp_path / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return path


def test_linked_material_is_refused_and_stays(library):
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.materials = ["Plaster"]
    (material,) = wanted.materials
    refused(material, f"is linked from {str(library)!r}; make it local first")


def test_override_is_refused_and_stays(library):
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.materials = ["Plaster"]
    (linked,) = wanted.materials
    refused(linked.override_create(), "is a library override, whose nodes Blender resets on load")


def test_local_copy_of_a_linked_material_is_written(library):
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.materials = ["Plaster"]
    written(wanted.materials[0].copy())


PRINCIPLED = tuple(sockets.OF_SHADER["PRINCIPLED"].neutral)


@pytest.mark.parametrize("name", PRINCIPLED)
def test_a_surface_is_read_from_the_sockets_of_these_names(make_material, name):
    material = make_material(node="ShaderNodeBsdfPrincipled", Specular_IOR_Level=0.0)
    node = surface(material)
    node.inputs["Base Color"].default_value = (0.1, 0.2, 0.3, 1.0)
    node.inputs["Diffuse Roughness"].default_value = 0.4
    found = shader_nodes.surface(material)
    assert (*found.color, found.roughness) == pytest.approx((0.1, 0.2, 0.3, 0.4))
    assert (found.node, found.linked, found.muted, found.disturbing) == (node.name, [], False, ())
    node.inputs[name].default_value = 0.5
    assert shader_nodes.surface(material).disturbing == (name,)
    node.inputs[name].default_value = sockets.OF_SHADER["PRINCIPLED"].neutral.get(name, 0.0)
    tree = material.node_tree
    tree.links.new(tree.nodes.new("ShaderNodeValue").outputs[0], node.inputs[name])
    assert shader_nodes.surface(material).disturbing == (name,)


def test_every_target_shader_has_a_map_of_sockets_that_its_node_has(make_material):
    assert set(sockets.OF_SHADER) == set(shaders.REGISTRY)
    nodes = make_material().node_tree.nodes
    for name, shader in shaders.REGISTRY.items():
        map_ = sockets.OF_SHADER[name]
        node = nodes.new(map_.node)
        assert node.bl_rna.name == shader.title
        own = (map_.color, map_.roughness, map_.normal, *map_.zeroed, *map_.neutral)
        assert {*own} <= set(node.inputs.keys())


def test_the_numbers_that_files_hold_are_told_apart_and_stay():
    assert [shaders.REGISTRY[name].number for name in ("DIFFUSE", "PRINCIPLED")] == [1, 2]
    numbers = [0, *(shader.number for shader in shaders.REGISTRY.values())]  # 0: as it is
    assert len(set(numbers)) == len(numbers)
    assert [shader.is_default for shader in shaders.REGISTRY.values()].count(True) == 1


def test_a_shader_that_there_is_not_is_refused(make_material):
    with pytest.raises(DomainError, match="choose one of: AUTO, DIFFUSE, PRINCIPLED"):
        shader_nodes.find(make_material(), "GLASS")


@pytest.mark.parametrize("kind", ["ShaderNodeBsdfDiffuse", "ShaderNodeBsdfPrincipled"])
def test_what_other_nodes_set_is_named_as_the_sockets_are(make_material, kind):
    material = make_material(node=kind)
    node, tree = surface(material), material.node_tree
    sockets = shader_nodes.color_socket(node), shader_nodes.roughness_socket(node)
    for socket in sockets:
        tree.links.new(tree.nodes.new("ShaderNodeValue").outputs[0], socket)
    assert shader_nodes.surface(material).linked == [socket.name for socket in sockets]
    node.mute = True
    assert shader_nodes.surface(material).muted


def test_the_link_is_found_among_those_of_a_large_tree(make_material):
    material = make_material()
    tree, node = material.node_tree, surface(material)
    for _ in range(50):
        first, second = (tree.nodes.new("ShaderNodeMath") for _ in range(2))
        tree.links.new(first.outputs[0], second.inputs[0])
    tree.links.remove(tree.get_output_node("CYCLES").inputs["Surface"].links[0])
    tree.links.new(node.outputs[0], tree.get_output_node("CYCLES").inputs["Surface"])
    assert shader_nodes.shader_node(material) == node


@pytest.mark.parametrize("kind", ["ShaderNodeBsdfDiffuse", "ShaderNodeBsdfPrincipled"])
def test_writing_leaves_all_other_sockets_as_they_are_to_the_bit(make_material, kind):
    material = make_material(node=kind)
    node = shader_nodes.shader_node(material)
    for number, socket in enumerate(node.inputs):
        value = socket.default_value
        if isinstance(value, bool):
            socket.default_value = not value
        elif hasattr(value, "__len__"):
            socket.default_value = [0.1 + number / 31 + i / 7 for i in range(len(value))]
        elif socket.name not in ("Anisotropic", *sockets.OF_SHADER["PRINCIPLED"].neutral):
            socket.default_value = 0.1 + number / 31
    before = [(s.name, s.default_value) for s in node.inputs]
    before = [(name, tuple(v) if hasattr(v, "__len__") else v) for name, v in before]
    shader_nodes.write(shader_nodes.find(material), (0.25, 0.5, 0.75), 0.125)
    roughness, color = shader_nodes.roughness_socket(node).name, shader_nodes.color_socket(node)
    for socket, (name, value) in zip(node.inputs, before, strict=True):
        found = socket.default_value
        found = tuple(found) if hasattr(found, "__len__") else found
        if socket == color:
            assert found == (0.25, 0.5, 0.75, value[3])
        elif name == roughness:
            assert found == 0.125
        else:
            assert found == value, name


def test_a_new_node_stands_left_of_the_output_and_moves_no_other(make_material):
    material = make_material()
    output = material.node_tree.get_output_node("CYCLES")
    output.location = (123.0, 45.0)
    shader_nodes.write(shader_nodes.find(material, "PRINCIPLED"), (0.25, 0.5, 0.75), 0.125)
    assert tuple(output.location) == (123.0, 45.0)
    assert tuple(shader_nodes.shader_node(material).location) == (-177.0, -255.0)


@pytest.mark.parametrize("make", [False, True])
def test_a_render_follows_what_is_written(make_material, make, tmp_path):
    """Also one that keeps its data: only what is told to have changed is looked at again."""
    scene = bpy.context.scene
    material = make_material()
    mesh = bpy.data.meshes.new("Plane")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    plane = bpy.data.objects.new("Plane", mesh)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale, camera.location.z = "ORTHO", 1.0, 2.0
    for thing in (plane, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("World")
    if scene.world.node_tree is None:
        scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 4, False
    scene.cycles.max_bounces = 0
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.render.use_persistent_data = True
    scene.render.image_settings.file_format = "OPEN_EXR"

    def seen():
        scene.render.filepath = str(tmp_path / "seen.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        color = list(image.pixels[:3])
        bpy.data.images.remove(image)
        return color

    told = set()

    def note(_scene, depsgraph):
        told.update(update.id.original for update in depsgraph.updates)

    for color in ((0.1, 0.2, 0.3), (0.7, 0.5, 0.2)):
        shader = "PRINCIPLED" if make and color[0] == 0.7 else "AUTO"
        bpy.context.view_layer.update()
        told.clear()
        bpy.app.handlers.depsgraph_update_post.append(note)
        try:
            shader_nodes.write(shader_nodes.find(material, shader), color, 0.0)
            bpy.context.view_layer.update()
        finally:
            bpy.app.handlers.depsgraph_update_post.remove(note)
        assert material in told  # a window shows again what is told there
        assert seen() == pytest.approx(color, rel=0.03)


def test_writing_takes_as_long_in_a_file_of_many_materials(make_material):
    def seconds(materials):
        places = [shader_nodes.find(material) for material in materials]
        start = time.process_time()
        for _ in range(5):
            for place in places:
                shader_nodes.write(place, (0.1, 0.2, 0.3), 0.4)
        return time.process_time() - start

    first = [make_material(f"First {i}") for i in range(60)]
    seconds(first)
    few = seconds(first)
    model = make_material("Model")
    for _ in range(2500):
        model.copy()
    many = seconds(first)
    print(f"{many / few:.2f}")
    assert many < 3 * few  # seen: 1; 20 where each socket is set by its own
