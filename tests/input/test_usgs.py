# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the USGS Spectral Library, whose wavelengths stand in another file."""

import shutil
from pathlib import Path

import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.core.errors import InputError

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "usgs"
BECKMAN = "splib07a_Testite_HS1.1B_BECKb_AREF.txt"
WAVELENGTHS = "splib07a_Wavelengths_BECK_Beckman_0.2-3.0_microns.txt"


def refusal(path):
    with pytest.raises(InputError) as caught:
        readers.read(path)
    sentence = str(caught.value)
    assert sentence.endswith(".")
    return sentence


def column(name):
    return [float(line) for line in (FOLDER / name).read_text().splitlines()[1:]]


def test_values_and_wavelengths_come_together_without_deleted_channels():
    (sample,) = readers.read(FOLDER / BECKMAN)
    pairs = zip(column(WAVELENGTHS), column(BECKMAN), strict=True)
    kept = [(round(1000 * um, 9), value) for um, value in pairs if value > -1]
    assert list(zip(sample.wavelengths, sample.values, strict=True)) == kept
    assert len(kept) == 3
    assert sample.altered == (
        "2 of 5 channels are marked as deleted (-1.23e34) and were left out.",
    )
    assert (sample.name, sample.device) == ("Testite HS1.1B", "Beckman 5270")
    assert (sample.quantity, sample.instrument) == ("absolute reflectance", "di:8")
    assert any(WAVELENGTHS in note for note in sample.notes)
    assert any("'b'" in note for note in sample.notes)


def test_detectors_that_overlap_are_sorted_and_it_is_said():
    (sample,) = readers.read(FOLDER / "splib07a_Field_AVIRISb_RTGC.txt")
    assert sample.wavelengths.tolist() == [400, 660, 670, 700]
    assert sample.values.tolist() == [0.125, 0.25, 0.375, 0.5]
    assert "order" in sample.altered[0]


def test_a_library_at_the_bands_of_one_sensor_has_one_file_of_wavelengths():
    (sample,) = readers.read(FOLDER / "s07_ASD_Testite_HS1.1B_BECKb_AREF.txt")
    assert sample.wavelengths.tolist() == [400, 500, 700]
    assert any("computed s07_ASD" in note for note in sample.notes)


def test_version_6_has_its_wavelengths_in_it():
    (sample,) = readers.read(FOLDER / "splib06a-testite.txt")
    assert sample.wavelengths.tolist() == [400, 570, 700]
    assert sample.values.tolist() == [0.125, 0.25, 0.5]
    assert sample.name == "Testite HS1.1B"
    assert sample.altered[0].startswith("1 of 4 channels")


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        (BECKMAN, f"copy '{WAVELENGTHS}'"),
        (
            "splib07a_Field_AVIRISb_RTGC.txt",
            "copy 'splib07a_Wavelengths_AVIRIS_1996_0.37-2.5_microns.txt'",
        ),
        (
            "s07_ASD_Testite_HS1.1B_BECKb_AREF.txt",
            "copy 's07_ASD_Wavelengths_ASD_0.35-2.5_microns_2151_ch.txt'",
        ),
        (
            "splib07a_Testite_HS1.1B_NIC4bb_RREF.txt",
            "copy 'splib07a_Wavelengths_NIC4_Nicolet_1.12-216microns.txt'",
        ),
    ],
)
def test_the_missing_file_is_named(tmp_path, name, wanted):
    shutil.copy(FOLDER / name, tmp_path)
    assert wanted in refusal(tmp_path / name)


def test_a_file_of_wavelengths_with_another_name_is_found(tmp_path):
    shutil.copy(FOLDER / BECKMAN, tmp_path)
    shutil.copy(FOLDER / WAVELENGTHS, tmp_path / "splib07a_Wavelengths_BECK_copy.txt")
    assert readers.read(tmp_path / BECKMAN)[0].wavelengths[-1] == 700


def test_wavelengths_stand_in_the_folder_above_as_the_library_unpacks(tmp_path):
    chapter = tmp_path / "ChapterM_Minerals"
    chapter.mkdir()
    shutil.copy(FOLDER / BECKMAN, chapter)
    shutil.copy(FOLDER / WAVELENGTHS, tmp_path)
    (found,) = readers.read(chapter / BECKMAN)
    (beside,) = readers.read(FOLDER / BECKMAN)
    assert found.wavelengths.tolist() == beside.wavelengths.tolist()
    assert found.values.tolist() == beside.values.tolist()


def test_the_wrong_number_of_wavelengths_is_refused(tmp_path):
    shutil.copy(FOLDER / BECKMAN, tmp_path)
    (tmp_path / WAVELENGTHS).write_text(
        (FOLDER / WAVELENGTHS).read_text().replace(" 7.0000000e-001\n", "")
    )
    assert "it has 5 channels, but" in refusal(tmp_path / BECKMAN)


def test_a_fault_in_the_wavelengths_names_their_file(tmp_path):
    shutil.copy(FOLDER / BECKMAN, tmp_path)
    (tmp_path / WAVELENGTHS).write_text(
        (FOLDER / WAVELENGTHS).read_text().replace("5.0000000e-001", "half")
    )
    assert f"{WAVELENGTHS}, line 4: 'half' is not a number" in refusal(tmp_path / BECKMAN)


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*_Wavelengths_*")), ids=lambda path: path.name)
def test_wavelengths_alone_are_no_spectrum(path):
    assert "no spectrum; leave it where it is" in refusal(path)


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("BECKb AREF", "BECKb TRAN", ["line 1", "transmittance"]),
        ("BECKb AREF", "BECKb EMIT", ["line 1", "'EMIT'", "AREF"]),
        ("2.5000000e-001", "2.50x", ["line 4", "'2.50x' is not a number"]),
        ("2.5000000e-001", "nan", ["line 4", "NaN"]),
        ("2.5000000e-001", "25", ["line 4", "times white"]),
    ],
)
def test_each_fault_is_named(tmp_path, old, new, parts):
    text = (FOLDER / BECKMAN).read_text()
    assert old in text
    shutil.copy(FOLDER / WAVELENGTHS, tmp_path)
    path = tmp_path / BECKMAN
    path.write_text(text.replace(old, new))
    sentence = refusal(path)
    for part in parts:
        assert part in sentence
