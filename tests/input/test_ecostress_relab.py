# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the ECOSTRESS and RELAB libraries: what they say, and what can be wrong with one."""

from pathlib import Path

import pytest
from rough_spectra.addon.samples import readers

from tests.input.refused import refusal

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures"
CONCRETE = (FIXTURES / "ecostress" / "concrete.spectrum.txt").read_text()
RELAB = (FIXTURES / "relab" / "test.txt").read_text()
COUNTED = (FIXTURES / "relab" / "test.asc").read_text()


def write(tmp_path, text):
    path = tmp_path / "spectrum.txt"
    path.write_text(text)
    return path


@pytest.mark.parametrize("name", ["concrete", "descending"])
def test_ecostress_in_either_order_has_the_same_numbers(name):
    (sample,) = readers.read(FIXTURES / "ecostress" / f"{name}.spectrum.txt")
    assert sample.wavelengths.tolist() == [400, 500, 570, 700, 14000]
    assert sample.values.tolist() == [0.125, 0.25, 0.375, 0.5, -0.0025]
    assert sample.name == "Test Concrete"
    assert sample.position == "lines 22 to 26"
    assert any("order" in text for text in sample.altered) is (name == "descending")


def test_ecostress_geometry_is_kept_and_the_nearest_is_named():
    (sample,) = readers.read(FIXTURES / "ecostress" / "concrete.spectrum.txt")
    assert sample.geometry == "Directional (10 Degree) Hemispherical Reflectance"
    assert sample.quantity == "directional-hemispherical reflectance"
    assert sample.instrument == "di:8"
    assert any("di:8°" in note for note in sample.notes)
    (sample,) = readers.read(FIXTURES / "ecostress" / "descending.spectrum.txt")
    assert (sample.quantity, sample.instrument) == ("bidirectional reflectance", "45a:0")


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("Reflectance (percent)", "Transmittance (percent)", ["line 16", "transmittance"]),
        ("Reflectance (percent)", "Emissivity", ["line 22", "percent"]),
        ("Hemispherical Reflectance", "Emissivity", ["line 16", "both reflectance and emissivity"]),
        ("Reflectance (percent)", "Reflectance or emissivity (percent)", ["line 16", "both"]),
        ("Hemispherical Reflectance", "Transmittance", ["line 12", "transmittance"]),
        ("Reflectance (percent)", "Reflectance", ["line 16", "neither percent nor fraction"]),
        ("Reflectance (percent)", "Counts", ["line 16", "'Counts'", "neither reflectance nor"]),
        ("(micrometers)", "(furlongs)", ["line 15", "furlongs", "micrometers"]),
        (" 0.7000\t50.0000\n", "", []),
        ("14.0000\t-0.2500\n", "", ["line 25", "'5' values but 4"]),
        ("25.0000", "2x", ["line 23", "'2x' is not a number"]),
        ("25.0000", "", ["line 23", "before column 'value'"]),
        ("0.5000", "0.4000", ["400 nm stands twice", "line 22", "line 23"]),
    ],
)
def test_each_fault_of_an_ecostress_file_is_named(tmp_path, old, new, parts):
    assert old in CONCRETE
    path = write(tmp_path, CONCRETE.replace(old, new, 1))
    if not parts:  # fewer rows, but to the stated end: the file is whole, its count is wrong
        (sample,) = readers.read(path)
        assert "The header says 5 values, and 4 follow, to the stated end." in sample.notes
        return
    sentence = refusal(path)
    for part in parts:
        assert part in sentence


def test_ecostress_emissivity_is_read_as_what_it_is():
    (sample,) = readers.read(FIXTURES / "ecostress" / "emissivity.spectrum.txt")
    assert (sample.kind, sample.quantity) == ("emissivity", "directional emissivity")
    # As the file states them, in the order of wavelengths; computing takes what is not emitted.
    assert sample.wavelengths.tolist() == [8000, 9000, 11000, 12500, 14000]
    assert sample.values.tolist() == [0.85, 0.75, 0.95, 1.002, 0.965]
    assert sample.reflectance == pytest.approx([0.15, 0.25, 0.05, 0, 0.035])
    assert (sample.geometry, sample.instrument) == ("Directional (8 to 14 µm)", "di:8")
    notes = " ".join(sample.notes)
    assert "does not say percent" in notes
    assert "near the normal" in notes
    assert "not known" not in notes


def test_ecostress_emissivity_in_percent(tmp_path):
    text = CONCRETE.replace("Y Units: Reflectance (percent)", "Y Units: Emissivity (percent)")
    (sample,) = readers.read(write(tmp_path, text))
    assert sample.kind == "emissivity"
    assert sample.values.tolist() == [0.125, 0.25, 0.375, 0.5, -0.0025]
    assert not any("does not say percent" in note for note in sample.notes)


def test_ecostress_fractions_are_not_divided(tmp_path):
    text = CONCRETE.replace("(percent)", "(fraction)").replace("0\n", "\n")
    text = text.replace("37.500", "0.375").replace("12.500", "0.125").replace("25.000", "0.25")
    (sample,) = readers.read(write(tmp_path, text.replace("50.000", "0.5")))
    assert sample.values.tolist() == [0.125, 0.25, 0.375, 0.5, -0.25]


def test_relab_text_is_in_micrometers():
    (sample,) = readers.read(FIXTURES / "relab" / "test.txt")
    assert sample.wavelengths.tolist() == [400, 500, 570, 25050]
    assert sample.values.tolist() == [0.125, 0.25, 0.375, -0.001]
    assert sample.name == "XX-TST-001/TEST1"
    assert (sample.geometry, sample.instrument) == ("30°/0°", "45a:0")
    assert any("does not say the geometry" in note for note in sample.notes)


@pytest.mark.parametrize("ending", ["asc", "tab"])
def test_relab_with_a_count_is_in_nanometers(ending):
    (sample,) = readers.read(FIXTURES / "relab" / f"test.{ending}")
    assert sample.wavelengths.tolist() == [400, 500, 570, 2550]
    assert sample.values.tolist() == [0.125, 0.25, 0.375, 0.5]
    notes = " ".join(sample.notes)
    assert ("standard deviations" in notes) is (ending == "tab")
    assert ("Invented rock" in notes) is (ending == "asc")
    assert ("does not say the geometry" in notes) is (ending == "tab")


def test_relab_angles_are_those_of_the_file(tmp_path):
    path = write(tmp_path, COUNTED.replace("Source Ang: 30.00", "Source Ang: 45.00"))
    (sample,) = readers.read(path)
    assert (sample.geometry, sample.instrument) == ("45°/0°", "45a:0")
    assert not any("not among" in note for note in sample.notes)


@pytest.mark.parametrize(
    ("text", "old", "new", "parts"),
    [
        (RELAB, "(micron)", "", ["line 2", "names neither micrometers nor nanometers"]),
        (RELAB, "\tReflectance", "\tTransmittance", ["line 2", "Transmittance"]),
        (RELAB, "0.25000", "high", ["line 4", "'reflectance'", "'high' is not a number"]),
        (COUNTED, "  4\n", "  9\n", ["line 8", "'TEST1' is not a number"]),
        (COUNTED, "0.25000", "", ["line 3", "before column 'reflectance'"]),
        (COUNTED[:60], "  4\n", "  4\n", ["line 1 says 4 rows but 3 follow"]),
    ],
)
def test_each_fault_of_a_relab_file_is_named(tmp_path, text, old, new, parts):
    assert old in text
    sentence = refusal(write(tmp_path, text.replace(old, new, 1)))
    for part in parts:
        assert part in sentence


def test_a_commented_title_is_none():
    """Found by fuzzing: the title was seen, and then skipped as a comment."""
    refusal(FIXTURES / "relab" / "commented-title.txt")
