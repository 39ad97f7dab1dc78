# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What gloss adds to a diffuse lobe and takes from it; `test_gloss_rendered` holds it to Cycles."""

import numpy as np
import pytest

from core.cycles import gloss_lobe, gloss_reading, gloss_sphere
from core.gloss import Gloss, from_numbers
from core.instruments import find
from core.instruments.gloss import fresnel

AT = "45a:0"


@pytest.mark.parametrize(
    ("level", "shine"), [(0.5, 0.0222), (1.0, 0.0444)]
)  # rendered by Blender 5.2, at roughness 0.5
def test_reading_of_the_lobe_alone(level, shine):
    np.testing.assert_allclose(
        gloss_reading.at_instrument(Gloss(level), AT).shine, shine, atol=5e-5
    )


def test_no_level_and_no_coat_is_no_gloss():
    angles = np.radians([[0.0, 45, 79], [0, 30, 79], [0, 90, 180]])
    found = gloss_lobe.layer(Gloss(level=0, roughness=0.2), *angles)
    np.testing.assert_array_equal(found.shine, 0)
    np.testing.assert_array_equal(found.passed, 1)


@pytest.mark.parametrize("roughness", [0.3, 0.6, 1.0])
@pytest.mark.parametrize("polar", [0.0, 45.0, 70.0])
def test_what_is_taken_from_below_is_what_the_lobe_sends_on(roughness, polar):
    """The lobe's own integral over the hemisphere of light, against 1 - passed.

    Cycles counts the single scattering between facets, and lights the lobe by what it lost too:
    both agree within some hundredths of the little there is.
    """
    gloss = Gloss(level=1.0, roughness=roughness)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    cosine, around = (nodes + 1) / 2, np.linspace(0, 2 * np.pi, 360, endpoint=False)
    light, azimuth = np.meshgrid(np.arccos(cosine), around, indexing="ij")
    found = gloss_lobe.layer(gloss, light, np.radians(polar), azimuth)
    sent = (weights * cosine) @ found.shine[..., 0].mean(axis=1)
    taken = 1 - found.passed[0, 0, 0]
    assert sent == pytest.approx(taken, rel=0.06)


def test_a_sphere_reads_what_fresnel_says_and_a_trap_takes_the_mirror():
    smooth = Gloss(level=0.5, roughness=0.0)
    found = gloss_reading.at_instrument(smooth, "di:8").shine
    np.testing.assert_allclose(found, fresnel(np.radians(8), 1.5), rtol=2e-3)
    np.testing.assert_array_equal(gloss_reading.at_instrument(smooth, "de:8").shine, 0)


def test_a_lobe_that_absorbs_nothing_reads_white_in_a_sphere():
    """What multiscatter GGX is for; its table is Cycles' own."""
    for roughness in (0.2, 0.6, 1.0):
        found = gloss_reading.at_instrument(Gloss(roughness=roughness, ior=1e6), "di:8").shine
        np.testing.assert_allclose(found, 1, atol=3e-3)


def test_nothing_depends_on_the_azimuth_at_the_normal():
    around = np.linspace(0, 6, 7)
    found = gloss_lobe.layer(Gloss(coat=0.5), np.pi / 4, 0.0, around)
    assert np.ptp(found.shine, axis=0).max() < 1e-12
    np.testing.assert_allclose(
        found.shine[0], gloss_reading.at_instrument(Gloss(coat=0.5), AT).shine, rtol=1e-12
    )


def test_below_undoes_over():
    found = gloss_reading.at_instrument(Gloss(level=0.8, coat=1.0, coat_tint=(0.9, 0.5, 0.2)), AT)
    read = np.array([[0.2, 0.5, 0.8], [0.0, 0.01, 1.0]])
    np.testing.assert_allclose(found.below(found.over(read)), read, atol=1e-15)


def test_largest_gloss_reads_the_darkest_channel():
    black = [0.031, 0.032, 0.033]
    found = gloss_reading.largest(Gloss(level=0.9), black, AT)
    read = gloss_reading.at_instrument(found, AT).shine
    assert 0 < found.level < 0.9
    assert read.max() == pytest.approx(0.031, abs=1e-6)
    assert gloss_reading.largest(found, black, AT) == found
    coated = gloss_reading.largest(Gloss(level=0.9, coat=1.0, coat_roughness=0.5), [0.01] * 3, AT)
    assert coated.level == 0
    assert 0 < coated.coat < 1
    assert gloss_reading.largest(Gloss(), [0.5, 0.0, 0.5], AT) is None


def test_of_the_largest_gloss_a_hair_more_does_not_fit():
    """Whatever the gloss and the reading; in few steps, since it is searched while one drags."""
    random = np.random.default_rng(3)

    def fits(gloss, goal):
        found = gloss_reading.at_instrument(gloss, AT)
        return bool(((found.shine <= goal) & (goal <= found.over(np.ones(3)))).all())

    limited = 0
    for i in range(200):
        tint = tuple(random.uniform(0, 1, 3))
        gloss = Gloss(random.uniform(0.1, 1.5), random.uniform(0.05, 1), 1.5, tint)
        gloss = gloss._replace(coat=float(i % 3 == 0), coat_roughness=random.uniform(0.1, 0.6))
        goal = random.uniform(0.001, 0.06, 3) if i % 2 else random.uniform(0.9, 1, 3)
        gloss_reading._at_instrument.cache_clear()
        found = gloss_reading.largest(gloss, goal, AT)
        assert gloss_reading._at_instrument.cache_info().misses <= 12
        if found == gloss or found.level == found.coat == 0:
            continue
        limited += 1
        assert fits(found, goal)
        more = 3e-5 * (gloss.level if found.level else gloss.coat)
        more = {"level": found.level + more} if found.level else {"coat": found.coat + more}
        assert not fits(found._replace(**more), goal), (found, goal)
    assert limited > 60


@pytest.mark.parametrize("instrument", [AT, "45as-15", "di:8"])
def test_while_one_socket_is_dragged_what_hangs_on_others_is_kept(instrument):
    """The coat while the level is dragged, both lobes while the coat's weight is."""
    found = gloss_sphere._at_instrument if instrument == "di:8" else gloss_lobe._kept_read
    gloss = Gloss(roughness=0.37, coat=1.0, coat_roughness=0.21)
    before = found.cache_info().misses
    for i in range(5):
        gloss_reading.at_instrument(gloss._replace(level=0.3 + 0.1 * i), instrument)
        gloss_reading.at_instrument(gloss._replace(coat=0.9 - 0.1 * i), instrument)
    assert found.cache_info().misses - before == 1 + 5  # one coat, and a lobe of each level


def test_while_the_level_is_dragged_facets_are_spread_once():
    before = gloss_sphere._facets.cache_info().misses
    for i in range(5):
        gloss_reading.at_instrument(Gloss(level=0.3 + 0.1 * i, roughness=0.43), "di:8")
    assert gloss_sphere._facets.cache_info().misses - before == 1


@pytest.mark.parametrize("angles", [np.full((3, 4), 0.6), np.full((3, 400), 0.6)])
@pytest.mark.parametrize("tint", [(0.7, 0.7, 0.7), (0.7, 0.2, 1.0)])
def test_a_channel_is_as_if_it_were_alone(tint, angles):
    """A gray lobe is computed once for all three, a tinted one for each, few or many."""
    gloss = Gloss(level=0.8, roughness=0.3, tint=tint, coat=0.4, coat_tint=(0.9, 0.5, 1.0))
    found = gloss_lobe.layer(gloss, *angles)
    sent = [gloss_lobe.layer(gloss._replace(tint=(part,) * 3), *angles) for part in tint]
    alone = np.stack([each.shine[:, channel] for channel, each in enumerate(sent)], axis=-1)
    np.testing.assert_allclose(found.shine, alone, rtol=1e-13)
    # What passes is of the channel that most is taken of.
    passed = np.stack([each.passed for each in sent]).min(axis=0)
    np.testing.assert_allclose(found.passed, passed, rtol=1e-13)


def test_facets_on_one_side_of_the_view_are_as_those_on_the_other():
    """A sphere lights both alike: the half of them reads as all do through a window on all."""
    theta, phi = np.radians([0.0, 8.0, 70.0]), np.array([0.0, 1.0, -2.0])
    for roughness in (0.0, 0.2, 1.0):
        gloss = Gloss(roughness=roughness, coat=0.5)
        one_side = gloss_sphere.through(gloss, theta, phi)
        both = gloss_sphere.through(gloss, theta, phi, lambda light: light[..., 2] > -1)
        np.testing.assert_allclose(one_side.shine, both.shine, rtol=1e-12)
    assert gloss_sphere._facets(0.1, find("di:8")).half.shape == (8, 24 * 24)
    assert gloss_sphere._facets(0.1, find("de:8")).half.shape == (8, 24 * 48)


def test_a_mirror_shows_no_light_without_width():
    """Cycles takes a lobe this narrow for a mirror; what it takes from below stays."""
    found = gloss_lobe.layer(Gloss(level=1, roughness=0.003), 0.3, 0.3, np.pi)
    np.testing.assert_array_equal(found.shine, 0)
    assert found.passed.max() < 0.95


def test_numbers_come_back():
    gloss = Gloss(0.3, 0.2, 1.4, (0.9, 0.8, 0.7), 0.6, 0.1, 1.6, (0.5, 0.4, 0.3), False)
    assert from_numbers(gloss.numbers()) == gloss
    for row in ((), gloss.numbers()[:-1], (float("nan"), *gloss.numbers()[1:])):
        with pytest.raises(ValueError, match="no gloss"):
            from_numbers(row)
