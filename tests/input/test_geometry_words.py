# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Words for geometries in files: which instrument they mean, and when the user is told."""

import pytest
from rough_spectra.addon.samples.readers.parts.geometry_words import (
    geometry_of_device,
    instrument_of,
    specular_of,
)
from rough_spectra.core.instruments import REGISTRY

from tests import pace


@pytest.mark.parametrize(
    ("text", "name", "specular"),
    [
        ("45/0", "45a:0", ""),
        ("45°a:0°", "45a:0", ""),
        ("45°c:0°", "45a:0", ""),
        ("45:0 annular", "45a:0", ""),
        ("45 deg / 0 deg", "45a:0", ""),
        ("45-0", "45a:0", ""),
        ("0/45", "0:45a", ""),
        ("0°:45°a", "0:45a", ""),
        ("45x:0", "45x:0", ""),
        ("0:45x", "45x:0", ""),
        ("45/0 directional", "45x:0", ""),
        ("D/8 SCI", "di:8", "SCI"),
        ("di:8°", "di:8", "SCI"),
        ("d8 SPIN", "di:8", "SCI"),
        ("8/d specular included", "di:8", "SCI"),
        ("de:8", "de:8", "SCE"),
        ("8°:de", "de:8", "SCE"),
        ("d/8 SPEX", "de:8", "SCE"),
        ("8:h", "di:8", ""),
        ("directional-hemispherical, 8°", "di:8", ""),
        ("45as25", "45as25", ""),
        ("45°:as-15°", "45as-15", ""),
        *((name, name, {"di:8": "SCI", "de:8": "SCE"}.get(name, "")) for name in REGISTRY),
    ],
)
def test_known_geometries_need_no_note(text, name, specular):
    assert instrument_of(text) == (name, "")
    assert specular_of(text) == specular


@pytest.mark.parametrize(
    ("text", "name", "part"),
    [
        ("", "45a:0", "does not say the geometry"),
        ("30/0", "45a:0", "'30/0' is not among"),
        ("i=30, e=0", "45a:0", "not among"),
        ("d/8", "di:8", "does not say whether specular light is included"),
        ("d/8, SCI and SCE", "di:8", "does not say whether specular light is included"),
        ("d/0", "de:8", "not among"),
        ("d:0 SCI", "di:8", "not among"),
        ("sphere", "di:8", "does not name an angle"),
        ("as 20", "45as15", "not among"),
        ("12/05/2013", "45a:0", "not known"),
        ("handheld", "45a:0", "'handheld' is not known"),
        ("x" * 10**6, "45a:0", "not known"),
    ],
)
def test_others_get_the_nearest_and_a_sentence(text, name, part):
    with pace.at_most(50):
        found, note = instrument_of(text)
    assert found == name
    assert part in note
    assert note.endswith(".")
    assert len(note) < 200


def test_what_the_file_says_elsewhere_of_specular_light_counts():
    assert instrument_of("d/8", "SCE") == ("de:8", "")
    assert instrument_of("d/8", "SCI") == ("di:8", "")


@pytest.mark.parametrize(
    ("model", "geometry"),
    [
        ("GretagMacbeth i1 Pro", "45/0"),
        ("i1Pro 2 ; Serial number 1001785", "45/0"),
        ("Spectrolino", "45/0"),
        ("Spectro LFP qb", "45/0"),
        ("X-Rite Ci64", "d/8"),
        ("Ci7800", "d/8"),
        ("CM-700d", "d/8"),
        ("CM-26dG", "d/8"),
        ("X-Rite SP62", "d/8"),
        ("CM-512m3A", ""),
        ("CM-2500c", "45/0"),
        ("HP DesignJet Z9 embedded spectro", ""),
        ("", ""),
    ],
)
def test_devices_whose_geometry_is_known(model, geometry):
    assert geometry_of_device(model) == geometry
