# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gloss from what instruments read of it: materials are found again from their own renders."""

import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.instrument import arrangement
from rough_spectra.addon.instrument import gloss as meter
from rough_spectra.addon.instrument.measure import measure
from rough_spectra.core.color import color_difference
from rough_spectra.core.cycles import gloss_estimate, gloss_reading
from rough_spectra.core.cycles.gloss_estimate import GlossReadings
from rough_spectra.core.errors import DomainError
from rough_spectra.core.gloss import Gloss

ROUGHNESS, BODY = (0.15, 0.35, 0.6), 0.3


@pytest.fixture(scope="module")
def rendered():
    """SCI, SCE and gloss units at 60° of gray materials of level 0.5."""
    import bpy

    from tools.checks import check_gloss

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    materials = [check_gloss.principled(0.5, roughness, 0.0) for roughness in ROUGHNESS]
    for material in materials:
        material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (
            *(BODY, BODY, BODY),
            1,
        )
    work = [arrangement.of("di:8"), arrangement.of("de:8"), meter.arrangement(60)]
    seen = measure(materials, work, rays=16384)[:, :, 0]
    units = meter.units(seen[2], 60, working_space.current())
    return seen[0].mean(axis=-1), seen[1].mean(axis=-1), units


@pytest.mark.parametrize("place", range(len(ROUGHNESS)))
def test_a_material_is_found_again_from_its_own_renders(rendered, place):
    sci, sce, units = (float(values[place]) for values in rendered)
    made = Gloss(level=0.5, roughness=ROUGHNESS[place])
    found = gloss_estimate.estimate(GlossReadings(sci, sce, {60: units}))
    assert found.level_is_known
    assert found.gloss.roughness == pytest.approx(made.roughness, abs=0.03)
    alone = gloss_estimate.estimate(GlossReadings(sci, units={60: units}))
    assert not alone.level_is_known
    assert alone.gloss.roughness == pytest.approx(made.roughness, abs=0.02)
    # Its reading at 45°/0°, with the body that SCI leaves below it.
    space = working_space.current()
    read = [
        gloss_reading.at_instrument(each, "45a:0").over(
            gloss_reading.at_instrument(each, "di:8").below(np.full(3, sci))
        )
        for each in (made, found.gloss)
    ]
    first, second = (space.to_lab(rgb, "D65") for rgb in read)
    assert color_difference.delta_e(first, second) < 0.3


def test_predicted_readings_are_those_of_renders(rendered):
    for roughness, *seen in zip(ROUGHNESS, *rendered, strict=True):
        found = gloss_estimate.readings(Gloss(roughness=roughness), BODY)
        told = (found.sci, found.sce, found.units[60])
        np.testing.assert_allclose(told, seen, rtol=0.02, atol=0.001)


def test_what_has_no_gloss_is_said():
    for read in (GlossReadings(0.3, 0.3), GlossReadings(0.3, units={60: 0.0})):
        with pytest.raises(DomainError, match="no gloss"):
            gloss_estimate.estimate(read)
    with pytest.raises(DomainError, match="nothing to tell gloss from"):
        gloss_estimate.estimate(GlossReadings(0.3))
    with pytest.raises(DomainError, match="45° is not known"):
        gloss_estimate.estimate(GlossReadings(0.3, units={45: 20.0}))
