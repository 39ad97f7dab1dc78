# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gloss from the readings of virtual instruments, by way of a file as an instrument writes it."""

from dataclasses import replace

import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.instrument import arrangement, gloss
from rough_spectra.addon.instrument.measure import measure
from rough_spectra.addon.matching import own_gloss
from rough_spectra.addon.samples import presets

INDEX = 1.5
F0 = 0.04  # of that index
ROUGHNESSES = (0.0, 0.2, 0.6)


def test_gloss_is_found_in_what_virtual_instruments_read(make_material, tmp_path):
    """SCI, SCE and gloss units of a gray paint, from smooth to satin, in one table."""
    gray = (0.3, 0.3, 0.3, 1.0)
    paints = [
        make_material(f"r {r}", "ShaderNodeBsdfPrincipled", Base_Color=gray, Roughness=r, IOR=INDEX)
        for r in ROUGHNESSES
    ]
    spheres = measure(paints, [arrangement.of("di:8"), arrangement.of("de:8")])[:, :, 0]
    units = gloss.measured(paints, working_space.current(), rays=1024)
    lines = ["name,specular,gloss 20,gloss 60,gloss 85,400 nm,550 nm,700 nm"]
    for specular, read in zip(("SCI", "SCE"), spheres, strict=True):
        for paint, row, of_meters in zip(paints, read, units, strict=True):
            numbers = (*of_meters, *row)
            lines.append(f"{paint.name},{specular}," + ",".join(f"{n:.5f}" for n in numbers))
    path = tmp_path / "paints.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")

    samples = api.read(path)
    assert [sample.name for sample in samples] == [paint.name for paint in paints]
    assert all(sample.specular == "SCE" and len(sample.others) == 1 for sample in samples)
    found = [api.gloss_readings(sample) for sample in samples]
    smooth = found[0]
    assert smooth.sphere.doubt == ""
    assert [told.f0 for told in smooth.told] == pytest.approx([F0] * 4, rel=0.03)
    for rough in found[1:]:
        # Each is the least that F0 can be; what the gray itself sends into a window is hardly any.
        assert all(told.f0 < 1.03 * F0 for told in rough.told)
    for told in zip(*(each.told for each in found), strict=True):
        assert (np.diff([each.reflectance for each in told]) < 0).all(), "rougher has less"
    assert "matte" in found[-1].sphere.doubt
    # A Principled BSDF set from these readings alone is the one that was read.
    for sample, roughness in zip(samples[1:], ROUGHNESSES[1:], strict=True):
        told = own_gloss.of_sample(sample)
        assert told.roughness == pytest.approx(roughness, abs=0.03)
        assert told.level == pytest.approx(0.5, abs=0.1)


def test_what_a_matte_body_sends_into_a_gloss_meter_is_no_gloss():
    white = presets.load("plaster")
    assert own_gloss.of_sample(white) is None
    # White sends 2 units to a meter at 60°.
    assert own_gloss.of_sample(replace(white, gloss=((60.0, 2.0),))) is None
    assert own_gloss.of_sample(replace(white, gloss=((75.0, 30.0),))) is None  # of no known meter
    assert own_gloss.of_sample(replace(white, gloss=((60.0, 12.0),))).roughness < 0.4
