# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of spectrometers' software: Ocean, Avantes, Cary, Lambda, Datacolor, Galactic, ENVI."""

import io
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.core.errors import InputError

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures"
VALUES = [0.125, 0.25, 0.375, 0.5, 0.0625]
"""What most of the binary fixtures hold."""


def spectrum(sample):
    return sample.name, sample.wavelengths.tolist(), sample.values.tolist()


def pairs(path, begins):
    """Parse two columns the plain way: what follows a line that begins so, decimal commas too."""
    text = path.read_text("latin-1").split(begins, 1)[1]
    found = re.findall(r"^\s*([-\d.,E]+)\s+([-\d.,E]+)\s*$", text, re.MULTILINE)
    return [tuple(float(cell.replace(",", ".")) for cell in row) for row in found]


def refusal(tmp_path, data):
    path = tmp_path / "wall.txt"
    path.write_bytes(data)
    with pytest.raises(InputError) as caught:
        readers.read(path)
    sentence = str(caught.value)
    assert "wall.txt" in sentence
    assert sentence.endswith(".")
    return sentence


def test_spectrasuite_with_decimal_commas():
    path = FIXTURES / "ocean_optics" / "spectrasuite-decimal-comma.txt"
    (sample,) = readers.read(path)
    expected = pairs(path, "<<<<<")
    assert len(expected) == 30
    assert sample.wavelengths.tolist() == [nm for nm, _ in expected]
    assert sample.values.tolist() == [percent / 100 for _, percent in expected]
    assert sample.device == "USB2+H11150"
    assert "does not name what was measured" in sample.notes[0]


@pytest.mark.parametrize(
    ("line", "instrument", "told"),
    [
        (b"Geometry: d/8 SCE", "de:8", ""),
        (b"Comment: integrating sphere ISP-50-8-R-GT, 8/d, SPIN", "di:8", ""),
        (b"chalk, SCE", "de:8", "SCE, follows from 'chalk, SCE'"),
        (b"Comment: SCI-FI poster of 8/9", "45a:0", "assumed"),
    ],
)
def test_header_lines_of_ocean_optics_tell_the_geometry(tmp_path, line, instrument, told):
    lines = (FIXTURES / "ocean_optics" / "oceanview.txt").read_bytes().split(b"\n")
    path = tmp_path / "chalk.txt"
    path.write_bytes(b"\n".join([lines[0], line, *lines[1:]]))
    [sample] = readers.read(path)
    assert (sample.instrument, sample.device) == (instrument, "USB2+H00001")
    assert told in " ".join(sample.notes)
    path.write_bytes(b"\n".join([lines[0].replace(b"wall", b"wall_d8_SCE"), *lines[1:]]))
    assert readers.read(path)[0].instrument == "de:8", "from the name of the graph"


def test_oceanview_names_its_mode_and_leaves_a_gap():
    (sample,) = readers.read(FIXTURES / "ocean_optics" / "oceanview.txt")
    nm = [399.5, 400.0, 400.5, 401.5]
    assert spectrum(sample) == ("chalk wall_Reflection_00001", nm, [0.5, 0.625, 0.75, 0.875])
    assert sample.altered == ("1 band without a value was left out: 401 nm.",)
    assert not any("does not name what" in note for note in sample.notes)


def test_jaz_takes_the_processed_column():
    (sample,) = readers.read(FIXTURES / "ocean_optics" / "jaz.jaz")
    # 100 (S - D) / (R - D) of the file's own columns.
    assert spectrum(sample) == ("jaz", [500.0, 500.5, 501.0], [0.5, 0.25, 0.75])


BEGIN = b">>>>>Begin Spectral Data<<<<<\n400\t1\n410\t1\n"


@pytest.mark.parametrize(
    ("data", "parts"),
    [
        (b"Data from wall_Absorbance_15-33.txt Node\n" + BEGIN, ["line 1", "absorbance"]),
        (b"Data from wall_Transmission_1.txt Node\n" + BEGIN, ["line 1", "transmittance"]),
        (b"Jaz Absolute Irradiance File\n" + BEGIN, ["line 1", "irradiance"]),
        (b"SpectraSuite Data File\nReference Spectrum Present: No\n" + BEGIN, ["line 2", "counts"]),
        (b"Data from x Node\n>>>>>Begin Spectral Data<<<<<\n1\t2\t3\n", ["line 3", "found 3"]),
        (b"Data from x Node\n>>>>>Begin Spectral Data<<<<<\n400\tx\n", ["line 3", "'x'"]),
        (b"Data from x Node\n>>>>>Begin Spectral Data<<<<<\n", ["no spectrum"]),
        (b"\x00\x00\x8cB\x01\x02\x03\x00\x00", ["binary", "AvaSoft"]),
        (b"AVS82\x01\x02\x03\x00\x00", ["byte 10", "ends early"]),
        (b"AVS89\x01\x02\x03\x00\x00", ["binary", "AvaSoft"]),
        (b"\x1f\x8b\x08\x00\x00\x00", ["gzip", "unpack"]),
        (b"PK\x03\x04\x00 xl/workbook.xml \x00", ["spreadsheet", "CSV"]),
        (b"PK\x03\x04\x00 notes.txt \x00", ["archive", "unpack"]),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\x00", [".xls", "CSV"]),
        (b"\x0a\x0a\xfe\xfe\x00\x00", ["OPUS", "JCAMP"]),
        (b"\x89HDF\r\n\x1a\n\x00", ["HDF5", "CSV"]),
        (b"ENVI\nfile type = ENVI Standard\n", ["image", "Material from Image"]),
        (b"ENVI\nfile type = ENVI Spectral Library\n", ["without its file of numbers"]),
        (b"Wave ;Sample\n[nm] ;[counts]\n400;1\n", ["line 1", "counts"]),
        (
            b"Wave ;Transmittance\n[nm] ;[% transmittance]\n400;1\n",
            ["column 'Transmittance'", "transmittance"],
        ),
        (b"Wave ;Reflectance\n[nm] ;[%]\n400;1;2\n", ["line 3", "found 3"]),
        (b"A,\nWavelength (nm),Abs\n400,1\n410,1\n", ["line 2", "absorbance"]),
        (b"PE UV   SUBTECH SPECTRUM ASCII\n#GR\nnm\n%T\n#DATA\n400 1\n", ["line 4", "transmitt"]),
        (b"PE UV   SUBTECH SPECTRUM ASCII\n#GR\ncm-1\n%R\n#DATA\n", ["line 3", "'cm-1'"]),
        (b"PE UV   SUBTECH SPECTRUM ASCII\n400 1\n", ["#DATA"]),
        (b"[STANDARD_DATA 0]\nSTD_NAME=x\nSTD_L=50\n", ["line 1", "no spectrum"]),
        (b"[STANDARD_DATA 0]\nSTD_R=1,2\nSTD_REFLINTERVAL=10\n", ["STD_REFLLOW is missing"]),
        (
            b"[BATCH_DATA 0]\nBAT_REFLPOINTS=3\nBAT_R=1,2\nBAT_REFLLOW=400\nBAT_REFLINTERVAL=10\n",
            ["line 3", "2 values", "3 are announced"],
        ),
        (b"[BATCH_DATA 0]\nBAT_R=1,x\n", ["line 2", "'x'", "not a number"]),
    ],
)
def test_what_is_no_reflectance_is_refused_by_its_name(tmp_path, data, parts):
    sentence = refusal(tmp_path, data)
    for part in parts:
        assert part in sentence


def test_avasoft_8_and_7():
    (new,) = readers.read(FIXTURES / "avantes" / "avasoft8.txt")
    assert spectrum(new) == ("avasoft8", [400.0, 400.5, 401.0], [0.5, 0.25, 0.75])
    assert new.device == "1200001U1"
    (old,) = readers.read(FIXTURES / "avantes" / "avasoft7-comma.ttt")
    # Zero bytes of the program's buffer are in the file, and are no fault.
    assert spectrum(old) == ("Brick wall", [300.0, 300.5, 301.0], [0.015625, 0.03125, -0.007812])


def test_binary_avasoft_divides_by_the_white_reference():
    """Held to AvaSoft's own exports of files by versions 8.2 and 8.4, which are not ours to ship:
    2,000 bands agreed in all digits that the text had."""
    (old,) = readers.read(FIXTURES / "avasoft_binary" / "one.RFL8")
    nm = [400.0, 410.0, 420.0, 430.0, 440.0]
    assert spectrum(old) == ("one", nm, VALUES)
    assert old.device == "1200001U1"
    first, second = readers.read(FIXTURES / "avasoft_binary" / "two.Rfl8x")
    assert spectrum(first) == ("Brick wall 1", nm, VALUES)
    # A channel whose white reference has no signal has no value.
    assert spectrum(second) == ("two 2", [900.0, 910.0, 930.0, 940.0], [0.125, 0.25, 0.5, 0.0625])
    assert "white reference" in second.altered[0]
    assert second.altered[1] == "1 band without a value was left out: 920 nm."


def test_the_comment_of_an_spc_tells_the_geometry(tmp_path):
    data = bytearray((FIXTURES / "galactic_spc" / "uneven.spc").read_bytes())
    assert data[88:98] == b"Slit 2 nm\0"
    data[88:98] = b"d/8 SCE  \0"
    path = tmp_path / "wall.spc"
    path.write_bytes(data)
    (sample,) = readers.read(path)
    assert (sample.instrument, sample.specular, sample.geometry) == ("de:8", "SCE", "d/8")


def test_spc_in_all_its_layouts():
    """Held to the text export of CRAIC's software, and to another reader's numbers of 20 files."""
    nm = [400.0, 410.0, 420.0, 430.0, 440.0]
    (uneven,) = readers.read(FIXTURES / "galactic_spc" / "uneven.spc")
    assert spectrum(uneven) == ("uneven", [400.0, 410.5, 420.0, 430.0, 440.0], VALUES)
    assert "fractions are assumed" in uneven.notes[0]
    assert uneven.notes[1] == "The file's comment: 'Slit 2 nm'."
    first, second = readers.read(FIXTURES / "galactic_spc" / "whole.spc")
    assert spectrum(first) == ("whole 1", nm, VALUES)
    assert second.values.tolist() == [0.125, 0.0625, 0.03125, 0.015625, 0.0078125]
    (number,) = readers.read(FIXTURES / "galactic_spc" / "wavenumber.spc")
    # 25,000 to 20,000 per cm, in percent by the name of the axis, of 16 bits, big-endian.
    np.testing.assert_allclose(number.wavelengths, 1e7 / np.linspace(25000, 20000, 5), atol=1e-4)
    np.testing.assert_allclose(number.values, VALUES, atol=1e-5)
    first, second = readers.read(FIXTURES / "galactic_spc" / "own.spc")
    assert spectrum(first) == ("own 1", nm, VALUES)
    assert spectrum(second) == ("own 2", [500.0, 600.0, 700.0], [0.5, 0.25, 0.125])


@pytest.mark.parametrize(
    ("along", "quantity", "parts"),
    [
        (3, 128, ["byte 30", "transmittance"]),
        (3, 2, ["byte 30", "absorbance"]),
        (3, 4, ["byte 30", "counts"]),
        (3, 0, ["byte 30", "does not say", "reflectance"]),
        (9, 129, ["byte 29", "no wavelength"]),
    ],
)
def test_spc_of_something_else_is_refused(tmp_path, along, quantity, parts):
    data = bytearray((FIXTURES / "galactic_spc" / "uneven.spc").read_bytes())
    data[28], data[29] = along, quantity
    sentence = refusal(tmp_path, bytes(data))
    for part in parts:
        assert part in sentence


def test_spc_beyond_any_fraction_is_percent(tmp_path):
    data = bytearray((FIXTURES / "galactic_spc" / "uneven.spc").read_bytes())
    data[-20:] = np.array([12.5, 25, 37.5, 50, 6.25], "<f4").tobytes()
    (tmp_path / "percent.spc").write_bytes(data)
    (sample,) = readers.read(tmp_path / "percent.spc")
    assert sample.values.tolist() == VALUES
    assert "percent are assumed" in sample.notes[0]


def test_procspec():
    """Held to 100 (S - D) / (R - D) of a file of SpectraSuite: equal in all digits."""
    (sample,) = readers.read(FIXTURES / "ocean_procspec" / "wall.ProcSpec")
    assert spectrum(sample) == ("wall", [400.0, 410.0, 420.0, 430.0, 440.0], VALUES)
    assert sample.device == "USB4000 USB4C00001"


@pytest.mark.parametrize("damage", ["kind", "broken", "bomb"])
def test_procspec_that_is_none(tmp_path, damage):
    path = FIXTURES / "ocean_procspec" / "wall.ProcSpec"
    with zipfile.ZipFile(path) as archive:
        text = archive.read("ps_0.xml")
    if damage == "kind":
        text = text.replace(b"ReflectionIntensity", b"AbsorbanceIntensity")
    if damage == "bomb":
        text += b" " * 2**23
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("ps_0.xml", text)
    data = packed.getvalue()[: -40 if damage == "broken" else None]
    sentence = refusal(tmp_path, data)
    assert {"kind": "absorbance", "broken": "damaged", "bomb": "unpacks to more"}[
        damage
    ] in sentence


@pytest.mark.parametrize("named", ["walls.hdr", "walls.sli"])
def test_envi_library_by_either_of_its_files(named):
    brick, plaster = readers.read(FIXTURES / "envi_library" / named)
    assert spectrum(brick) == ("Brick wall", [400.0, 410.0, 420.0, 430.0, 440.0], VALUES)
    assert spectrum(plaster) == (
        "Plaster (old)",
        [400.0, 410.0, 430.0, 440.0],
        [0.5, 0.25, 0.75, 0.5],
    )


def test_the_description_of_an_envi_library_tells_the_geometry(tmp_path):
    for name in ("walls.hdr", "walls.sli"):
        data = (FIXTURES / "envi_library" / name).read_bytes()
        (tmp_path / name).write_bytes(data.replace(b"{Invented", b"{By a CM-700d, SCE. Invented"))
    for sample in readers.read(tmp_path / "walls.hdr"):
        assert (sample.instrument, sample.specular) == ("de:8", "SCE")
        assert any("follows from 'By a CM-700d, SCE." in note for note in sample.notes)


def envi_with(folder, **words):
    """The library with further words in its header, or other ones in their place."""
    for name in ("walls.hdr", "walls.sli"):
        (folder / name).write_bytes((FIXTURES / "envi_library" / name).read_bytes())
    header = folder / "walls.hdr"
    lines = header.read_text().split("wavelength = ")[0]
    for key, value in words.items():
        key = key.replace("_", " ")
        lines = re.sub(rf"^{key} = .*\n", "", lines, flags=re.MULTILINE) + f"{key} = {value}\n"
    header.write_text(lines)
    return header


MICROMETERS = "{0.40, 0.41, 0.42, 0.43, 0.44}"


def test_what_envi_calls_the_ordinate_counts(tmp_path):
    head = envi_with(tmp_path, wavelength=MICROMETERS, z_plot_titles="{Wavelength, Radiance}")
    with pytest.raises(InputError, match=r"'z plot titles'.*radiance"):
        readers.read(head)
    titles = "{Wavelength, Reflectance (%)}"
    first, _ = readers.read(envi_with(tmp_path, wavelength=MICROMETERS, z_plot_titles=titles))
    np.testing.assert_allclose(first.values * 100, VALUES, rtol=1e-6)


def test_envi_libraries_say_sensor_and_geometry_in_words_of_their_own(tmp_path):
    head = envi_with(tmp_path, wavelength=MICROMETERS, sensor_type="CM-700d", specular="SCE")
    assert {(s.instrument, s.device) for s in readers.read(head)} == {("de:8", "CM-700d")}
    head = envi_with(tmp_path, wavelength=MICROMETERS, sensor_type="Unknown")
    assert {(s.instrument, s.device) for s in readers.read(head)} == {("45a:0", "")}


def test_envi_libraries_over_wavenumbers(tmp_path):
    numbers = "{25000, 24390.243902, 23809.52381, 23255.813953, 22727.272727}"
    head = envi_with(tmp_path, wavelength=numbers, wavelength_units="Wavenumber")
    np.testing.assert_allclose(readers.read(head)[0].wavelengths, [400, 410, 420, 430, 440])


def test_envi_library_that_promises_more_than_there_is(tmp_path):
    (tmp_path / "walls.hdr").write_bytes((FIXTURES / "envi_library" / "walls.hdr").read_bytes())
    (tmp_path / "walls.sli").write_bytes(b"skip" + bytes(36))
    with pytest.raises(InputError, match=r"promises 2 spectra of 5 bands, 44 bytes, .* has 40"):
        readers.read(tmp_path / "walls.hdr")
    text = (tmp_path / "walls.hdr").read_text()
    (tmp_path / "walls.hdr").write_text(text.replace("0.44}", "}"))
    with pytest.raises(InputError, match="lists 4 wavelengths of 5 bands"):
        readers.read(tmp_path / "walls.hdr")


def test_cary_reads_pairs_of_unequal_length_and_no_log():
    chalk, brick = readers.read(FIXTURES / "delimited" / "cary.csv")
    assert spectrum(chalk) == ("Chalk wall", [778.0, 779.0, 780.0], [0.125, 0.25, 0.5])
    assert spectrum(brick) == ("Brick", [779.0, 780.0], [0.25, 0.125])
    assert chalk.notes == (
        "Columns not read: Base.",
        "The file does not say the geometry; 45°a:0° is assumed.",
    )


def test_lambda():
    (sample,) = readers.read(FIXTURES / "delimited" / "lambda.asc")
    assert spectrum(sample) == ("Chalk", [780.0, 790.0, 800.0], [0.125, 0.25, 0.5])
    assert sample.device == "Lambda 1050"


def test_qtx():
    standard, batch = readers.read(FIXTURES / "qtx" / "two.qtx")
    nm = [400.0, 410.0, 420.0, 430.0]
    assert spectrum(standard) == ("Gray cloth", nm, [0.125, 0.25, 0.375, 0.5])
    assert spectrum(batch) == ("Lot 7", nm, [0.0625, 0.125, 1.1875, 0.25])
    assert (standard.specular, standard.instrument) == ("SCI", "di:8")
    assert (batch.specular, batch.instrument) == ("SCE", "de:8")
    assert standard.aperture == "LAV"


def test_spectra_vista_in_percent_with_detectors_that_overlap(tmp_path):
    path = FIXTURES / "svc" / "tile.sig"
    (sample,) = readers.read(path)
    nm = [400.5, 550.0, 971.5, 990.0, 1020.0]
    assert spectrum(sample) == ("tile", nm, [0.125, 0.25, 0.375, 0.375, 0.5])
    assert sample.device == "1234567 (HR-1024i)"
    assert "order" in sample.altered[0]
    assert sample.altered[1] == "Bands that two detectors share were averaged: 1 of 5."
    data = path.read_bytes()
    said = tmp_path / "said.sig"
    said.write_bytes(data.replace(b"comm= ", b"comm= d/8 SCE"))
    assert readers.read(said)[0].instrument == "de:8", "as the comment says"
    head = data.split(b"data= \n")[0]
    assert "no rows of data" in refusal(tmp_path, head + b"data= \n")
    assert "column 'reflectance'" in refusal(tmp_path, data.replace(b"  12.50", b""))
    assert "times white" in refusal(tmp_path, data.replace(b"25.00\n990", b"2500\n990"))
