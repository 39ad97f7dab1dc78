# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tolerance of the automatic choice belongs to the material."""

import numpy as np
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.matching import solve
from rough_spectra.addon.matching.solve import Request
from rough_spectra.addon.material import (
    derivation,
    derive,
    state,
    storage,
)

SIGMA = np.radians(30.0)


def test_each_request_gets_the_shader_of_its_own_tolerance(colorchecker):
    requests = [Request(colorchecker[13], SIGMA, tolerance=value) for value in (20.0, 1.0)]
    loose, usual = solve.solve(requests, working_space.current())
    assert loose.model == usual.model == "surface"
    assert loose.roughness == 0.0
    assert loose.shader_reason.startswith("lambert: within ΔE00 20 in all directions")
    assert usual.roughness > 0.1


def test_it_is_stored_and_counts_as_a_setting(make_material, colorchecker):
    material = make_material("Wall")
    derive.assign([(material, Request(colorchecker[13], SIGMA, tolerance=1.2))])
    group = material.rough_spectra
    assert storage.load(material).tolerance == 1.2
    assert state.state(material).kind == "fresh"
    group.tolerance = 20.0
    assert derivation.get_stamp(material).roughness == 0.0


def test_materials_of_before_are_still_up_to_date(make_material, colorchecker):
    """A digest without the tolerance is that of the usual one."""
    material = make_material("Wall")
    derive.assign([(material, Request(colorchecker[13], SIGMA))])
    before = derivation.inputs_digest(material.rough_spectra)
    assert material.rough_spectra.tolerance == 1.0
    material.rough_spectra.tolerance = 1.5
    assert derivation.inputs_digest(material.rough_spectra) != before
