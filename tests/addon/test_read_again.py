# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A material made from a set of readings is held to each of them, and reads them again."""

from dataclasses import replace
from math import radians

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.samples import sets
from rough_spectra.addon.samples.sample import Sample

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
    assert not [text for text in solution.warnings if "misses" in text]
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
