# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What lamps send, from files: each format of light, and what can be none."""

from pathlib import Path

import pytest
from rough_spectra.addon.samples import light_source
from rough_spectra.core.errors import InputError

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "spdx"
LAMP = (FOLDER / "lamp.spdx").read_text(encoding="utf-8")
DATA = '    <SpectralData wavelength="403.1">0.25</SpectralData>\n'


def read(tmp_path, text, name="lamp.spdx"):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return light_source.read(path)


def test_a_tm_27_file_is_read_as_colour_science_reads_it():
    colour = pytest.importorskip("colour")
    path = FOLDER / "lamp.spdx"
    theirs = colour.SpectralDistribution_IESTM2714(str(path)).read()
    ours = light_source.read(path)
    assert ours.name == "lamp.spdx"
    assert ours.wavelengths.tolist() == theirs.wavelengths.tolist() == [400, 403.1, 700]
    assert ours.power.tolist() == theirs.values.tolist()


def test_its_bands_may_stand_in_any_order(tmp_path):
    end = "  </SpectralDistribution>"
    found = read(tmp_path, LAMP.replace(DATA, "").replace(end, DATA + end))
    assert found.power.tolist() == [0.125, 0.25, 0.5]


@pytest.mark.parametrize("quantity", ["flux", "Intensity", "irradiance", "radiance", "exitance"])
def test_all_its_quantities_of_light_are_read(tmp_path, quantity):
    assert read(tmp_path, LAMP.replace(">relative<", f">{quantity}<")).power.max() == 0.5


def test_light_is_told_from_reflectance_in_one_file(tmp_path):
    inner = LAMP[LAMP.index("  <SpectralDistribution>") : LAMP.index("</IESTM2714>")]
    tile = inner.replace(">relative<", ">reflectance<").replace("0.125", "0.9")
    found = read(tmp_path, LAMP.replace("</IESTM2714>", tile + "</IESTM2714>"))
    assert found.power[0] == 0.125


def test_a_table_of_two_columns(tmp_path):
    found = read(tmp_path, "nm;W\n400;1,5\n500;2\n600;-0,01\n", "lamp.csv")
    assert found.wavelengths.tolist() == [400, 500, 600]
    assert found.power.tolist() == [1.5, 2, 0]  # noise below 0


@pytest.mark.parametrize(
    ("text", "name", "words"),
    [
        (LAMP.replace(">relative<", ">T-Factor<"), "a.spdx", "holds no spectrum of light"),
        (LAMP.replace(">0.25<", ">-0.25<"), "a.spdx", "at 403.1 nm is -0.25, which is below 0"),
        (LAMP.replace("0.125", "0").replace("0.25", "0").replace("0.5<", "0<"), "a.spdx", "above"),
        (LAMP.replace("403.1", "400"), "a.spdx", "have to increase"),
        (LAMP.replace(DATA, "").replace('"400.0">0.125', '"400.0">'), "a.spdx", "is not a number"),
        ("nm,a,b\n400,1,2\n500,1,2\n", "a.csv", "a.csv"),
    ],
)
def test_what_is_no_light_is_refused_with_the_place(tmp_path, text, name, words):
    with pytest.raises(InputError, match=words):
        read(tmp_path, text, name)


ARGYLL = """SPECT

ORIGINATOR "Argyll CMS"
MEAS_TYPE "EMISSION"
SPECTRAL_BANDS "4"
SPECTRAL_START_NM "400.000000"
SPECTRAL_END_NM "700.000000"
SPECTRAL_NORM "1.000000"

NUMBER_OF_FIELDS 4
BEGIN_DATA_FORMAT
SPEC_400 SPEC_500 SPEC_600 SPEC_700
END_DATA_FORMAT

NUMBER_OF_SETS 1
BEGIN_DATA
12.5 140.25 300.0 7.75
END_DATA
"""


def test_an_illuminant_of_argyll_is_read_whatever_its_scale(tmp_path):
    found = read(tmp_path, ARGYLL, "lamp.sp")
    assert found.wavelengths.tolist() == [400, 500, 600, 700]
    assert found.power / found.power[0] == pytest.approx([1, 11.22, 24, 0.62])
    ambient = ARGYLL.replace("EMISSION", "AMBIENT")
    assert read(tmp_path, ambient, "ambient.sp").power.tolist() == found.power.tolist()
    with pytest.raises(InputError, match="holds no spectrum of light"):
        read(tmp_path, ARGYLL.replace("EMISSION", "REFLECTIVE"), "paper.sp")
    twice = ARGYLL.replace("SETS 1", "SETS 2").replace("END_DATA\n", "1 2 3 4\nEND_DATA\n")
    twice = twice.replace("SPEC_700\n1 2 3 4\nEND_DATA_FORMAT", "SPEC_700\nEND_DATA_FORMAT")
    with pytest.raises(InputError, match="holds 2 spectra of light"):
        read(tmp_path, twice, "two.sp")


def test_two_lights_in_one_file_are_one_too_many(tmp_path):
    inner = LAMP[LAMP.index("  <SpectralDistribution>") : LAMP.index("</IESTM2714>")]
    with pytest.raises(InputError, match="holds 2 spectra of light"):
        read(tmp_path, LAMP.replace("</IESTM2714>", inner + "</IESTM2714>"))
