# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The virtual gloss meter and the sphere, on materials whose gloss is known."""

import math

import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.instrument import arrangement, gloss
from rough_spectra.addon.instrument.measure import measure
from rough_spectra.core.errors import DomainError
from rough_spectra.core.instruments import gloss as meters


@pytest.fixture
def black(make_material):
    """Make a black dielectric."""

    def make(name, roughness=0.0, ior=1.567, base=0.0, **sockets):
        settings = {"Base_Color": (base, base, base, 1), "Roughness": roughness, "IOR": ior}
        return make_material(name, "ShaderNodeBsdfPrincipled", **settings, **sockets)

    return make


def test_black_glass_reads_100_and_other_glass_what_fresnel_says(black):
    glass, crown, water = (black(f"n {n}", ior=n) for n in (1.567, 1.5, 1.33))
    # Nothing is spread: few rays read what many do, in the fifth digit.
    found = gloss.measured([glass, crown, water], working_space.current(), rays=1024)
    np.testing.assert_allclose(found[0], 100, atol=1)
    # Fresnel in his own words: squares of sines and tangents of sums.
    for row, n in ((1, 1.5), (2, 1.33)):
        for column, degrees in enumerate(gloss.ANGLES):
            parts = []
            for index in (n, 1.567):
                i = math.radians(degrees)
                t = math.asin(math.sin(i) / index)
                s, p = math.sin(i - t) / math.sin(i + t), math.tan(i - t) / math.tan(i + t)
                parts.append(s * s + p * p)
            assert found[row, column] == pytest.approx(100 * parts[0] / parts[1], rel=0.003)


def test_gloss_falls_with_roughness_and_a_matte_tile_keeps_what_the_window_sees(
    black, make_material
):
    rough = [black(f"r {r}", r) for r in (0.15, 0.3, 0.5)]
    tile = make_material("Tile", Color=(0.8, 0.8, 0.8, 1), Roughness=0.0)
    space = working_space.current()
    assert (np.diff(gloss.measured(rough, space, rays=1024), axis=0) < 0).all()
    [found] = gloss.measured([tile], space, rays=4096)
    for column, degrees in enumerate(gloss.ANGLES):
        # An even diffuser: its albedo, and the window's projected solid angle over π.
        meter = meters.find(degrees)
        along, across = (math.radians(w) for w in meter.receptor)
        area = 4 * math.asin(math.sin(along / 2) * math.sin(across / 2))  # of a spherical one
        share = 0.8 * area * math.cos(math.radians(degrees)) / math.pi
        expected = 100 * share / meters.black_glass(meter)
        assert found[column] == pytest.approx(expected, rel=0.1, abs=0.01)


def test_light_the_other_way_round_reads_the_same(black):
    """Helmholtz: the flux through both windows does not ask which of them glows.

    Windows of the receptor's size: through the source's own, few rays pass by chance.
    """
    glossy, small, large = black("Glossy", 0.6), (4.0, 6.0), (8.0, 12.0)
    there, back = (
        gloss.of_meter(meters.GlossMeter(60.0, *windows))
        for windows in ((small, large), (large, small))
    )
    seen = measure([glossy], [there, back], rays=16384)[:, 0, 0, 1]
    area = [math.prod(math.tan(math.radians(w) / 2) for w in window) for window in (small, large)]
    assert seen[0] * area[0] == pytest.approx(seen[1] * area[1], rel=0.03)
    assert seen[0] > 3 * seen[1]


def test_an_angle_that_no_gloss_meter_has_is_refused():
    with pytest.raises(DomainError, match=r"45° is not known; choose one of: 20°, 60°, 85°"):
        gloss.measured([], working_space.current(), [45])


def test_a_white_furnace_reads_1_in_the_sphere(black, make_material):
    white = (1.0, 1.0, 1.0, 1.0)
    furnace = [
        make_material("Diffuse", Color=white, Roughness=0.0),
        *(
            make_material(f"Metal {r}", "ShaderNodeBsdfPrincipled", Base_Color=white)
            for r in (0.0, 0.5)
        ),
        black("Paint", 0.4, base=1.0),
    ]
    for material, roughness in zip(furnace[1:3], (0.0, 0.5), strict=True):
        shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
        shader.inputs["Metallic"].default_value = 1.0
        shader.inputs["Roughness"].default_value = roughness
    found = measure(furnace, [arrangement.of("di:8")])[0, :, 0]
    np.testing.assert_allclose(found, 1, atol=0.005)


def test_the_sphere_sees_gloss_and_its_trap_takes_it(black):
    mirror, satin, matte = (black(f"{r}", r, ior=1.5) for r in (0.0, 0.3, 0.8))
    sci, sce = measure([mirror, satin, matte], [arrangement.of("di:8"), arrangement.of("de:8")])[
        :, :, 0, 1
    ]
    # Crown glass reflects 4 % near the normal. All of a mirror goes into the trap, a part of satin
    # gloss, and next to nothing where gloss is spread over the hemisphere.
    assert sci[:2] == pytest.approx([0.04, 0.04], rel=0.01)
    assert sce[0] == pytest.approx(0.0, abs=1e-6)
    taken = (sci - sce) / sci
    assert taken[0] == 1
    assert 0.1 < taken[1] < 0.4
    assert abs(taken[2]) < 0.01
