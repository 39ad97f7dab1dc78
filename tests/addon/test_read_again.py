# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A material made from a set of readings is held to each of them, and reads them again."""

from dataclasses import replace
from math import radians

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.material import derivation, state
from rough_spectra.addon.samples import gloss_of_set, sets
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.core import cycles
from rough_spectra.core import reading as core_reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.cycles import gloss_estimate
from rough_spectra.core.errors import DomainError
from rough_spectra.core.gloss import Gloss
from rough_spectra.core.instruments import REGISTRY, quadrature

from tools.checks import check_gloss, check_sets

NM = np.arange(400.0, 701.0, 20.0)


def reading(instrument, level, **fields):
    specular = {"di:8": "SCI", "de:8": "SCE"}.get(instrument, "")
    values = level * np.linspace(0.5, 1.5, NM.size)
    return Sample("T", NM, values, "reading", instrument=instrument, specular=specular, **fields)


SCI = reading("di:8", 0.36)
SET = replace(
    reading("45a:0", 0.30, sigma_degrees=20.0),
    others=(
        reading("de:8", 0.32),
        replace(
            reading("di:8", 0.36), wavelengths=NM[::2], values=reading("di:8", 0.36).values[::2]
        ),
        reading("45as15", 0.5, surface="smooth"),
        replace(reading("45as110", 0.4), geometry="15as110"),
    ),
    gloss=((60.0, 12.0),),
)


@pytest.mark.parametrize(("at", "level"), [("45a:0", 0.30), ("de:8", 0.32), ("di:8", 0.36)])
def test_the_target_is_what_was_read_there(at, level, extension):
    material = bpy.data.materials.new("T")
    [solution] = api.assign([(material, api.request(SET, radians(20), read_at=at))], gloss="none")
    wanted = reading(at, level)
    assert not [text for text in solution.warnings if "misses its target" in text]
    settled = api.settle(material).request.sample
    np.testing.assert_allclose(settled.values, np.interp(settled.wavelengths, NM, wanted.values))
    [entry] = api.bake([material], measure=False, read_at=[at]).entries
    lab = tristimulus.spectrum_to_lab(wanted.values, NM)
    np.testing.assert_allclose(entry.predicted.lab, lab, atol=0.3)  # of two grids
    # Stored is the set as it was, and any of its readings can be asked for again.
    for other in ("de:8", "45a:0"):
        [entry] = api.bake([material], measure=False, read_at=[other]).entries
        stated = next(s for s in SET.readings if s.instrument == other)
        np.testing.assert_allclose(entry.predicted.values, stated.values, atol=1e-6)


@pytest.mark.parametrize("at", ["45as15", "45as110", "0:45a"])
def test_of_no_reading_there_a_model_predicts(at):
    """The smooth surface's does not count, nor one whose geometry only comes near."""
    assert sets.at(SET, at) is SET


def test_a_set_turned_to_another_reading_keeps_all(extension):
    turned = sets.at(SET, "di:8")
    assert (turned.name, turned.instrument, turned.sigma_degrees) == ("T", "di:8", 20.0)
    assert sorted(s.instrument for s in turned.readings) == sorted(
        s.instrument for s in SET.readings
    )
    assert turned.gloss == SET.gloss
    back = sets.at(turned, "45a:0")
    assert back.values.tolist() == SET.values.tolist()
    assert sets.at(SET.taken_as("albedo"), "di:8").instrument == "45a:0"


def glossy(gloss, body=0.3, **fields):
    """A gray paint as a sphere and a gloss meter read it."""
    read = gloss_estimate.readings(gloss, body, (20, 60))
    sce, sci = (
        Sample("Paint", NM, np.full(NM.size, value), "reading", instrument=at, specular=at_says)
        for value, at, at_says in ((read.sce, "de:8", "SCE"), (read.sci, "di:8", "SCI"))
    )
    return replace(sce, others=(sci,), gloss=tuple((float(a), u) for a, u in read.units.items()))


def sockets_of(material):
    inputs = shader_nodes.shader_node(material).inputs
    return inputs["Specular IOR Level"].default_value, inputs["Roughness"].default_value


def test_a_material_gets_the_gloss_that_its_sample_was_read_with(extension):
    made = Gloss(level=0.5, roughness=0.3)
    material, plain = (bpy.data.materials.new(name) for name in "AB")
    pairs = [(material, api.request(glossy(made), read_at="de:8")), (plain, SET.readings[1])]
    api.assign(pairs, gloss="read")
    assert sockets_of(material) == pytest.approx((0.5, 0.3), abs=0.02)
    assert state.state(material).kind == "fresh"
    for at, level in (("de:8", 0), ("di:8", 1)):
        [entry] = api.bake([material], measure=False, read_at=[at]).entries
        wanted = glossy(made).readings[level].values
        np.testing.assert_allclose(entry.predicted.values, wanted, atol=1e-6)


def test_readings_without_gloss_leave_the_gloss_and_say_so(extension):
    material = check_gloss.principled(0.4, 0.6, 0.0)
    sample = glossy(Gloss(roughness=0.3))
    level = replace(sample, others=(replace(sample.others[0], values=sample.values),), gloss=())
    [solution] = api.assign([(material, level)], gloss="read")
    assert sockets_of(material) == pytest.approx((0.4, 0.6))
    assert any("The gloss stays as it was" in text for text in solution.warnings)
    odd = replace(sample, gloss=((20.0, 90.0), (60.0, 1.0)))
    [solution] = api.assign([(material, odd)], gloss="read")
    assert any("No gloss of one lobe reads all" in text for text in solution.warnings)
    before = material.rough_spectra.stamp
    with pytest.raises(DomainError, match="DIFFUSE BSDF has no gloss"):
        api.assign([(material, sample)], "diffuse", gloss="read")
    assert material.rough_spectra.stamp == before


def test_all_readings_of_a_set_are_rendered_as_they_were_read(extension):
    """The one of the check that takes least; the others are in its table."""
    read = check_sets.check([replace(glossy(Gloss(level=0.5, roughness=0.3)), gloss=())])
    assert [each.at for each in read] == ["de:8", "di:8"]
    assert max(each.apart for each in read) < check_sets.BOUND


def test_angles_tell_gloss_too():
    """Of as15 and as-15 beside the others; a matte surface's readings do not."""
    at = tuple(name for name in REGISTRY if REGISTRY[name].aspecular is not None)
    seen = gloss_estimate.readings(Gloss(roughness=0.4), 0.2, (), at).angles

    def of(levels):
        flat = {n: replace(reading(n, v), values=np.full(NM.size, v)) for n, v in levels.items()}
        return replace(flat.pop("45as45"), others=tuple(flat.values()))

    found = api.estimate_gloss(of(seen)).gloss
    assert (found.level, found.roughness) == pytest.approx((0.5, 0.4), abs=0.03)
    gray = np.full(NM.size, 0.5)
    rough = {name: core_reading.from_albedo(gray, radians(30), "surface", name)[0] for name in at}
    assert not gloss_of_set.tells(of(rough))


def test_a_reading_that_is_missed_elsewhere_is_met_where_it_was_read(extension):
    """Under gloss a sphere's reading is not met at 45°/0°, and what to do about it is said."""
    shining = glossy(Gloss(level=0.5, roughness=0.3))
    material = bpy.data.materials.new("T")
    [solution] = api.assign([(material, api.request(shining))], gloss="read")
    [told] = [text for text in solution.warnings if "readings it misses" in text]
    assert told.endswith("; let it be read at de:8° Sphere to meet that one.")
    material.rough_spectra.read_at = "de:8"
    [solution] = api.renew([material])
    assert not [text for text in solution.warnings if "readings it misses" in text]


def test_readings_that_one_lobe_cannot_meet_are_named(extension):
    """Rough surfaces send more back to the light than Cycles' lobe; here by its own formula."""
    at = ("45as45", "45as-15", "45as15", "45as110")
    values = {n: core_reading.from_albedo(SCI.values, radians(30), "surface", n) for n in at}
    main, *others = (replace(reading(n, 1), values=values[n]) for n in at)
    material = bpy.data.materials.new("T")
    rough = replace(main, others=tuple(others))
    wanted = api.request(rough, radians(30), read_at="45as45")
    [solution] = api.assign([(material, wanted)], gloss="none")
    [told] = [text for text in solution.warnings if "other readings it misses" in text]
    space, named = working_space.current(), set()
    for other in others:
        of = quadrature.of(other.instrument)
        angles = of.theta_i, of.theta_r, of.delta_phi
        seen = of.weights @ cycles.reflectance(solution.color, solution.roughness, *angles)
        stated = other.values @ space.rgb_weights(NM, "D65")
        labs = (space.to_lab(rgb, "D65") for rgb in (seen, stated))
        words = f"ΔE00 {color_difference.delta_e(*labs):.2f} at {sets.label(other)}"
        named |= {other.instrument} if words in told else set()
    assert "45as-15" in named
    assert told.count("ΔE00") == len(named)
    assert told in api.renew([material])[0].warnings
    material.rough_spectra.sigma = radians(35)  # as a slider does
    dragged = derivation.get_stamp(material).warnings
    assert [text for text in dragged if "other readings it misses" in text] == list(dragged)
    assert tuple(api.renew([material])[0].warnings) == tuple(dragged)
    level = replace(main, others=tuple(replace(each, values=main.values) for each in others))
    [solution] = api.assign([(material, api.request(level, 0.0, read_at="45as45"))], gloss="none")
    assert not [text for text in solution.warnings if "other readings" in text]
