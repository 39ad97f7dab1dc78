# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The core's formula of Cycles' Diffuse closure, against Cycles."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, sockets
from rough_spectra.addon.instrument.measure import RING_45_0, Geometry, measure
from rough_spectra.core import cycles
from rough_spectra.core.errors import MaterialError

STEEPEST = np.radians(85)
PRINCIPLED = {
    "node": "ShaderNodeBsdfPrincipled",
    "Specular_IOR_Level": 0.0,
    "Base_Color": (0.3, 0.5, 0.7, 1.0),
    "Diffuse_Roughness": 0.6,
}


def single(values):
    """Round to what a socket can hold."""
    return np.asarray(values, np.float32).astype(np.float64)


def random_geometries(rng, count):
    sine = np.sqrt(rng.uniform(0, np.sin(STEEPEST) ** 2, (2, count)))
    return (*np.arcsin(sine), rng.uniform(0, 2 * np.pi, count))


def to_measure(theta_i, theta_r, delta_phi):
    return [
        Geometry(((float(light), float(phi)),), float(view))
        for light, view, phi in zip(theta_i, theta_r, delta_phi, strict=True)
    ]


def test_formula_agrees_with_renders(make_material):
    """400 random sets of color, roughness and geometry, each for both shaders."""
    rng = np.random.default_rng(20)
    colors, roughness = single(rng.uniform(0, 1, (10, 3))), single(rng.uniform(0, 1, 10))
    colors[0], roughness[0] = 1, 1
    colors[1], roughness[1] = 1, 0
    geometries = random_geometries(rng, 40)
    diffuse = [
        make_material(Color=(*c, 1), Roughness=s) for c, s in zip(colors, roughness, strict=True)
    ]
    principled = [
        make_material(
            node="ShaderNodeBsdfPrincipled",
            Base_Color=(*c, 1),
            Diffuse_Roughness=s,
            Specular_IOR_Level=0,
        )
        for c, s in zip(colors, roughness, strict=True)
    ]
    # One ray a pixel: an even material gives the same for each.
    seen = measure([*diffuse, *principled], to_measure(*geometries), samples=1)
    rendered = seen[:, :, 0].reshape(40, 2, 10, 3)
    expected = cycles.reflectance(colors, roughness, *(g[:, np.newaxis] for g in geometries))
    # Cycles computes in float32: some ten roundings of 6e-8.
    np.testing.assert_allclose(
        rendered, np.broadcast_to(expected[:, np.newaxis], rendered.shape), rtol=2e-6
    )
    assert seen[:, :, 1].max() == 0  # an even sample is even to the last bit


def test_no_geometry_loses_a_sample(make_material):
    """Where two triangles of the sample meet, one once shaded the other: 1/256 of light was lost.

    The first such geometry that random ones came upon, with 72 tiles in one picture; tiles that
    are named alike would have one each.
    """
    rng = np.random.default_rng(7)
    rng.uniform(0, 1, 72 * 4)
    sine = np.sqrt(rng.uniform(0, np.sin(np.radians(80)) ** 2, (2, 40)))
    light, view = np.arcsin(sine[:, 27:28])
    phi = rng.uniform(0, 2 * np.pi, 40)[27:28]
    materials = [make_material(str(n), Color=(0.8, 0.5, 0.2, 1), Roughness=0.5) for n in range(72)]
    seen = measure(materials, to_measure(light, view, phi))
    assert seen[:, :, 1].max() == 0
    assert np.ptp(seen[0, :, 0], axis=0).max() == 0


def test_ring_reads_what_one_light_at_45_degrees_reads(make_material):
    material = make_material(Color=(0.2, 0.5, 0.8, 1), Roughness=1.0)
    ring, one = measure([material], [RING_45_0, Geometry(((np.pi / 4, 0.3),), 0.0)])[:, 0, 0]
    expected = cycles.reflectance(single([0.2, 0.5, 0.8]), 1.0, np.pi / 4, 0.0, 0.0)
    np.testing.assert_allclose(ring, expected, rtol=2e-6)
    np.testing.assert_allclose(one, expected, rtol=2e-6)
    # The same numbers as printed by Cycles in a scene made by hand.
    np.testing.assert_array_equal(np.round(ring, 5), [0.15700, 0.41614, 0.74201])


def changed(socket):
    """Give another valid value of a socket."""
    if socket.name == "Thin Film Thickness":
        return 400.0  # nanometers
    if socket.type == "VALUE":
        return 0.5 if socket.default_value != 0.5 else 1.0
    if socket.type == "INT":
        return socket.default_value + 1
    if socket.type == "BOOLEAN":
        return not socket.default_value
    if socket.type == "RGBA":
        return (0.9, 0.1, 0.4, 1.0)
    return (0.3, 0.4, 0.5)


WRITTEN = {"Base Color", "Diffuse Roughness"}
COUNTED = {"Specular IOR Level", "Coat Weight"}
"""Of these `test_gloss_rendered` tells."""
DIRECTIONS = {"Normal", "Tangent", "Coat Normal"}


def test_each_principled_socket_is_refused_or_changes_no_reading(make_material):
    """What `find` accepts has to read as if the other sockets were new."""
    base = make_material(**PRINCIPLED)
    accepted = []
    for socket in list(base.node_tree.nodes["Principled BSDF"].inputs):
        if socket.name in WRITTEN | COUNTED | DIRECTIONS or not hasattr(socket, "default_value"):
            continue
        if not socket.enabled:  # Blender hides Weight, which belongs to the old renderer
            continue
        material = make_material(socket.name, **PRINCIPLED)
        socket = material.node_tree.nodes["Principled BSDF"].inputs[socket.identifier]
        socket.default_value = changed(socket)
        try:
            shader_nodes.find(material)
        except MaterialError:
            continue  # the next test measures these
        accepted.append(material)
    assert {"Roughness", "IOR", "Specular Tint"} <= {material.name for material in accepted}
    oblique = Geometry(((1.2, 0.4),), 1.0)
    seen = measure([base, *accepted], [RING_45_0, oblique])[:, :, 0]
    apart = np.abs(seen[:, 1:] / seen[:, :1] - 1).max(axis=(0, 2))
    named = dict(zip((material.name for material in accepted), apart.tolist(), strict=True))
    assert {name: difference for name, difference in named.items() if difference > 2e-6} == {}


@pytest.mark.parametrize("neutral", sorted(sockets.OF_SHADER["PRINCIPLED"].neutral))
def test_a_refused_socket_does_change_the_reading(make_material, neutral):
    base, other = make_material(**PRINCIPLED), make_material(**PRINCIPLED)
    socket = other.node_tree.nodes["Principled BSDF"].inputs[neutral]
    socket.default_value = changed(socket)
    with pytest.raises(MaterialError, match=neutral):
        shader_nodes.find(other)
    seen = measure([base, other], [RING_45_0])[0, :, 0]
    assert np.abs(seen[1] / seen[0] - 1).max() > 1e-3
    assert len(bpy.data.materials) == 2
