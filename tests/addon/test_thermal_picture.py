# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Thermal pictures against Kirchhoff's law and cavities known in closed form."""

import bmesh
import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.picture import thermal
from rough_spectra.core import emissivity

pytestmark = pytest.mark.usefixtures("empty_file")


def looking(place, turn=(0, 0, 0), pixels=8):
    scene = bpy.context.scene
    camera = bpy.data.cameras.new("Camera")
    camera.angle, camera.clip_start = np.radians(70), 0.001
    scene.camera = bpy.data.objects.new("Camera", camera)
    scene.camera.location, scene.camera.rotation_euler = place, turn
    scene.collection.objects.link(scene.camera)
    scene.render.resolution_x = scene.render.resolution_y = pixels
    scene.render.resolution_percentage, scene.cycles.samples = 100, 4
    return scene


def square(name, corners, kelvin=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    mesh.materials.append(bpy.data.materials.new(name))
    thing = bpy.data.objects.new(name, mesh)
    if kelvin is not None:
        thing[thermal.PROPERTY] = kelvin
    bpy.context.scene.collection.objects.link(thing)
    return thing


FLOOR = [(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)]


def black(kelvin, band=thermal.BAND):
    """Radiance of a black body in a band, by a plain sum."""
    nm = np.linspace(*band, 20_001)
    sent = emissivity.radiance(nm, kelvin)
    return float(((sent[1:] + sent[:-1]) / 2 * np.diff(nm)).sum() * 1e-3)


def test_a_closed_room_of_one_temperature_looks_like_it_whatever_its_walls():
    scene = looking((0, -0.9, 0.1), (np.pi / 2, 0, 0))
    bpy.ops.mesh.primitive_cube_add()
    room = bpy.context.object
    room[thermal.PROPERTY] = 310.0
    known = dict(zip("ABCDEF", (0.1, 0.95, 0.3, 0.6, 0.2, 0.8), strict=True))
    for name, polygon in zip(known, room.data.polygons, strict=True):
        room.data.materials.append(bpy.data.materials.new(name))
        polygon.material_index = len(room.data.materials) - 1
    nm = np.array([7000.0, 9000.0, 12000.0, 15000.0])
    known["B"] = api.Sample("Quartz", nm, np.array([0.1, 0.8, 0.2, 0.1]), "albedo")
    # Colder outside: what is rendered is all that the room sends beyond that.
    found = thermal.render(scene, thermal.Wanted(sky=150.0, known=known))
    assert found.kelvin == pytest.approx(310.0, abs=0.1)
    assert found.radiance == pytest.approx(black(310.0), rel=1e-3)
    assert found.temperatures == {"Cube": 310.0}
    assert found.assumed == ()


def test_a_plate_reflects_what_it_does_not_emit():
    """Facing nothing but a sky: ε B(T) + (1 - ε) B(sky), as a radiometer tells."""
    scene = looking((0, 0, 1))
    square("Floor", FLOOR, 320.0)
    wanted = thermal.Wanted(sky=240.0, known={"Floor": 0.4}, parts=6)
    found = thermal.render(scene, wanted)
    truth = emissivity.apparent_temperature(
        [0.4, 0.4], [8000.0, 14000.0], 320.0, thermal.BAND, background=240.0
    )
    assert found.kelvin == pytest.approx(float(truth), abs=0.05)
    assert found.radiance == pytest.approx(0.4 * black(320.0) + 0.6 * black(240.0), rel=1e-4)


def test_a_bowl_is_blacker_than_its_wall():
    """Half a sphere: each place sees its wall and the opening alike, and ε' = ε/(ε + (1 - ε)/2).

    The opening is half of the sphere's area, and what leaves any place of a sphere falls evenly
    on all of it.
    """
    scene = looking((0, 0, 3))
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 1.0
    bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64)
    bowl = bpy.context.object
    mesh = bowl.data
    for polygon in mesh.polygons:
        polygon.use_smooth = False
    cut = bmesh.new()
    cut.from_mesh(mesh)
    bmesh.ops.delete(cut, geom=[v for v in cut.verts if v.co.z > 1e-4], context="VERTS")
    cut.to_mesh(mesh)
    cut.free()
    mesh.materials.append(bpy.data.materials.new("Wall"))
    bowl[thermal.PROPERTY] = 330.0
    wanted = thermal.Wanted(sky=0.0, known={"Wall": 0.5}, samples=256)
    found = thermal.render(scene, wanted)
    truth = 0.5 / (0.5 + 0.5 * 0.5) * black(330.0)
    assert found.radiance.mean() == pytest.approx(truth, rel=5e-3)


def grooves(name, slopes, start):
    """V-grooves of slopes, radians, side by side, each one unit wide and long enough."""
    corners, faces = [], []
    for number, slope in enumerate(slopes):
        left, deep = start + number, -0.5 * np.tan(slope)
        first = len(corners)
        for x, z in ((left, 0), (left + 0.5, deep), (left + 1, 0)):
            corners += [(x, -2000, z), (x, 2000, z)]
        faces += [[first, first + 2, first + 3, first + 1]]
        faces += [[first + 2, first + 4, first + 5, first + 3]]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    mesh.materials.append(bpy.data.materials.new(name))
    thing = bpy.data.objects.new(name, mesh)
    thing[thermal.PROPERTY] = 330.0
    bpy.context.scene.collection.objects.link(thing)


def test_grooves_raise_emissivity_as_the_model_says():
    """Plates of facets of ε, whose slopes have the distribution of σ = 30°, looked down on."""
    own, sigma = (0.5, 0.3, 0.1), np.radians(30)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    slopes = (nodes + 1) * np.pi / 4
    weights = weights * np.exp(-(slopes**2) / (2 * sigma**2)) * np.sin(slopes)
    columns, rows = len(own) * len(slopes), 4
    scene = looking((columns / 2, 0, 1))
    for number, epsilon in enumerate(own):
        grooves(f"ε {epsilon}", slopes, number * len(slopes))
    camera = scene.camera.data
    camera.type, camera.ortho_scale, camera.clip_end = "ORTHO", columns, 1e4
    scene.render.resolution_x, scene.render.resolution_y = columns, rows
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1.0
    known = {f"ε {epsilon}": epsilon for epsilon in own}
    found = thermal.render(scene, thermal.Wanted(sky=0.0, known=known, samples=128))
    of_each = found.radiance.mean(axis=0).reshape(len(own), -1) / black(330.0)
    plate = of_each @ weights / weights.sum()
    facets = 1 - np.array(own)
    assert plate == pytest.approx(
        emissivity.directional(facets, 0.0, sigma, slopes="oren-nayar"), abs=3e-3
    )
    assert plate == pytest.approx([0.573, 0.373, 0.142], abs=4e-3)


def test_vertices_have_temperatures_and_unknown_materials_are_named():
    scene = looking((0, 0, 1))
    thing = square("Floor", FLOOR)
    layer = thing.data.attributes.new(thermal.PROPERTY, "FLOAT", "POINT")
    layer.data.foreach_set("value", [300.0, 400.0, 400.0, 300.0])
    found = thermal.render(scene, thermal.Wanted(emissivity=1.0, sky=300.0))
    across = found.kelvin.mean(axis=0)
    # In the middle of the floor, which sends the mean of what its ends send.
    middle = 0.5 * (black(300.0) + black(400.0))
    assert found.radiance.mean() == pytest.approx(middle, rel=2e-3)
    assert (np.diff(across) > 0).all()
    assert found.assumed == ("Floor",)
    assert found.temperatures == {}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"band": (500.0, 900.0)}, "from 700"),
        ({"parts": 4}, "3, 6, 9"),
        ({"emissivity": 1.5}, "0 to 1"),
    ],
)
def test_what_is_no_camera_is_refused(change, words):
    with pytest.raises(api.DomainError, match=words):
        thermal.Wanted(**change)


def test_what_is_no_temperature_is_refused():
    scene = looking((0, 0, 1))
    square("Floor", FLOOR, -5.0)
    with pytest.raises(api.MaterialError, match=r"Object 'Floor' has a temperature of -5\.0"):
        thermal.render(scene, thermal.Wanted())
