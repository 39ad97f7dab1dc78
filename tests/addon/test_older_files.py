# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of earlier versions: another model derived the color, and σ went up to 90°."""

import json
import math

import bpy
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.addon.interface.operators import giving
from rough_spectra.addon.material import derivation, snapshot, state
from rough_spectra.addon.samples import quality
from rough_spectra.core.errors import MaterialError

OPS = bpy.ops.rough_spectra
SINCE = "the model has changed since Rough Spectra 0.0.9 derived it: "


def make(name="Wall"):
    """Make a material with a spectrum, on an active object."""
    material = bpy.data.materials.new(name)
    material.use_fake_user = True
    thing = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    thing.data.materials.append(material)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    api.assign([(material, api.request(api.find("plaster"), math.radians(30)))])
    return material


def age(material, node_color=0.25):
    """Let an earlier version have derived it, with another color."""
    group = material.rough_spectra
    data = json.loads(group.stamp)
    shown = shader_nodes.color_socket(shader_nodes.shader_node(material))
    shown.default_value = (node_color, node_color, node_color, 1)
    data |= {"derivation": 1, "version": "0.0.9", "color": [node_color] * 3}
    group.stamp = json.dumps(data)


def steepen(material, degrees=75.0):
    """Store a σ that only an earlier version's slider gave."""
    group = material.rough_spectra
    stored = group.bl_system_properties_get() if bpy.app.version >= (5, 0, 0) else group
    stored["sigma"] = math.radians(degrees)


def color(material):
    node = shader_nodes.shader_node(material)
    return tuple(shader_nodes.color_socket(node).default_value)[:3]


def saved(tmp_path, link=None):
    """Save the file, and open it again, or bring its material into an empty one."""
    path = str(tmp_path / "old.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    if link is None:
        bpy.ops.wm.open_mainfile(filepath=path)
        return bpy.data.materials["Wall"]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=link) as (_, wanted):
        wanted.materials = ["Wall"]
    return wanted.materials[0]


def test_every_version_says_what_changed():
    assert max(derivation.WHAT_CHANGED) == derivation.DERIVATION
    assert sorted(derivation.WHAT_CHANGED) == list(range(2, derivation.DERIVATION + 1))


@pytest.mark.parametrize("link", [None, False])
def test_what_another_model_derived_is_stale_and_renewed_with_one_click(tmp_path, link):
    material = make()
    fresh = color(material)
    age(material)
    material = saved(tmp_path, link)
    known = state.state(material)
    assert known.kind == "stale"
    [reason] = known.reasons
    assert reason.startswith(SINCE)
    assert derivation.WHAT_CHANGED[2] in reason
    # A slider does not touch it unasked.
    material.rough_spectra.illuminant = "A"
    assert color(material) == pytest.approx((0.25,) * 3)
    material.rough_spectra.illuminant = "D65"
    material.use_fake_user = True
    assert OPS.renew(scope="ALL_STALE") == {"FINISHED"}
    assert state.state(material).kind == "fresh"
    assert color(material) == pytest.approx(fresh, abs=1e-6)
    assert derivation.get_stamp(material).derivation == derivation.DERIVATION


def test_linked_it_says_so_and_is_renewed_where_it_belongs(tmp_path):
    age(make())
    material = saved(tmp_path, link=True)
    known = state.state(material)
    assert known.kind == "linked"
    assert known.reasons[0].endswith("make it local to change it, or change it there")
    assert known.reasons[1].startswith(SINCE)
    local = material.make_local()
    assert state.state(local).kind == "stale"
    api.renew([local])
    assert state.state(local).kind == "fresh"


def test_what_was_kept_by_hand_stays_kept():
    material = make()
    shader_nodes.color_socket(shader_nodes.shader_node(material)).default_value[0] = 0.9
    api.keep(material)
    data = json.loads(material.rough_spectra.stamp) | {"derivation": 1}
    material.rough_spectra.stamp = json.dumps(data)
    assert state.state(material).kind == "kept"


@pytest.mark.parametrize("link", [None, False])
def test_a_sigma_beyond_the_models_is_kept_and_told(tmp_path, link):
    make()
    steepen(bpy.data.materials["Wall"])
    material = saved(tmp_path, link)
    group, shown = material.rough_spectra, color(material)
    assert snapshot.sigma_degrees(group) == 75
    known = state.state(material)
    assert known.kind == "stale"
    assert known.reasons[0] == (
        "σ is 75°, and materials are matched up to 60° only; set σ to 60° or less, or keep what "
        "the node shows"
    )
    for act in (lambda: api.renew([material]), lambda: api.settle(material)):
        with pytest.raises(MaterialError, match=r"'Wall': σ is 75°.*set σ to 60° or less"):
            act()
    group.illuminant = "A"
    group.illuminant = "D65"
    assert (snapshot.sigma_degrees(group), color(material)) == (75, shown)
    entry = api.bake([material], measure=False).entries[0]
    assert entry.fault.startswith("Material 'Wall': σ is 75°")
    # What the user then does.
    group.sigma = math.radians(55)
    assert state.state(material).kind == "fresh", state.state(material)
    assert color(material) != shown


def test_a_sigma_beyond_the_models_may_be_kept_as_it_looks(tmp_path):
    material = make()
    steepen(material)
    api.keep(material)
    assert state.state(material).kind == "kept"
    material = saved(tmp_path)
    assert state.state(material).kind == "kept"
    assert snapshot.sigma_degrees(material.rough_spectra) == 75


def test_another_sample_does_not_lose_it():
    material = make()
    steepen(material)
    with pytest.raises(RuntimeError, match="set σ to 60° or less"):
        OPS.choose_sample(sample="everyday/brick")
    assert snapshot.sigma_degrees(material.rough_spectra) == 75
    assert material.rough_spectra.sample_name == "Plaster, gypsum"


def test_a_sample_that_states_more_is_refused_by_its_name(tmp_path):
    steep = api.Sample(
        *("Moss", range(400, 710, 10), [0.2] * 31, "reading"), sigma_degrees=75, source="moss.json"
    )
    with pytest.raises(api.InputError, match=r"moss.json, 'Moss': σ is 75°.*up to 60°"):
        giving.new_request(steep, math.radians(75))


def test_the_end_of_the_slider_is_taken_everywhere():
    """The property is single precision: π/3 comes back as a little more."""
    material = make()
    material.rough_spectra.sigma = 2.0
    assert snapshot.sigma_degrees(material.rough_spectra) == 60
    assert state.state(material).kind == "fresh"
    assert OPS.assign_preset(preset="everyday/brick", sigma=math.radians(60)) == {"FINISHED"}
    assert api.settle(material).request.sigma == math.radians(60)


def test_a_sample_that_states_more_is_named_when_imported():
    steep = api.Sample("Moss", range(400, 710, 10), [0.2] * 31, "reading", sigma_degrees=75)
    told = "'Moss' states a roughness that no material has: σ is 75°, and materials are matched"
    assert [sentence[: len(told)] for sentence in quality.check([steep])[0]] == [told]
    assert quality.check_each([steep]) == [()]  # of a material, σ is a setting
