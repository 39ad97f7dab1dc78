# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""CGATS in its dialects: each value equals the file's, and everything else is refused by name."""

import csv
import re
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.samples import readers

from tests import pace
from tests.input.refused import refusal

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "cgats"
TI3 = (FOLDER / "argyll.ti3").read_text(encoding="utf-8")
I1 = (FOLDER / "i1profiler-two-conditions.txt").read_text(encoding="utf-8")


def write(folder, text, encoding="utf-8"):
    path = folder / "measured.txt"
    path.write_bytes(text.encode(encoding))
    return path


def tables(path, mark):
    """Split a file at its keywords, unlike the reader: fields and records of all tables."""
    text = path.read_bytes().decode("latin-1" if path.stem == "spectrolino" else "utf-8")
    text = re.sub("\r\n?", "\n", text)
    for part in text.split("BEGIN_DATA_FORMAT")[1:]:
        names, rest = part.split("END_DATA_FORMAT")
        body = rest.split("BEGIN_DATA\n")[1].split("END_DATA")[0]
        rows = csv.reader(body.splitlines(), delimiter=mark, skipinitialspace=True)
        yield names.split(), [[cell for cell in row if cell] for row in rows]


@pytest.mark.parametrize(
    ("name", "mark", "prefix", "scale"),
    [
        ("argyll.ti3", " ", "SPEC_", 100),
        ("barbieri.txt", "\t", "SPECTRAL_", 1),
        ("i1profiler-two-conditions.txt", "\t", "SPECTRAL_NM", 1),
        ("spectrolino.txt", "\t", "nm", 1),
    ],
)
def test_every_value_equals_the_file(name, mark, prefix, scale):
    expected = [
        {field: cell.replace(",", ".") for field, cell in zip(fields, row, strict=True)}
        for fields, rows in tables(FOLDER / name, mark)
        for row in rows
        if any(field.startswith(prefix) for field in fields)
    ]
    samples = readers.read(FOLDER / name)
    assert len(samples) == len(expected) > 2
    for sample, row in zip(samples, expected, strict=True):
        bands = [field for field in row if field.startswith(prefix)]
        assert sample.wavelengths.tolist() == [float(field[len(prefix) :]) for field in bands]
        assert sample.values.tolist() == [float(row[field]) / scale for field in bands]
        if "LAB_L" in row:
            assert sample.lab == tuple(float(row[field]) for field in ("LAB_L", "LAB_A", "LAB_B"))
        if "XYZ_X" in row:
            assert sample.xyz == tuple(float(row[f"XYZ_{axis}"]) / 100 for axis in "XYZ")
        assert (sample.kind, sample.instrument) == ("reading", "45a:0")


def test_argyll_says_its_device_and_the_calibration_table_is_left_out():
    samples = readers.read(FOLDER / "argyll.ti3")
    assert [sample.name for sample in samples] == ["A1", "A2", "A3"]
    assert samples[0].device == "GretagMacbeth i1 Pro"
    assert samples[0].position == "line 27"
    assert any("line 42" in note for note in samples[0].notes)
    assert any("GretagMacbeth" in note for note in samples[0].notes)


def test_argyll_bands_between_whole_nanometers():
    (sample,) = readers.read(FOLDER / "reflective.sp")
    assert sample.name == "reflective"
    np.testing.assert_allclose(sample.wavelengths, 380 + np.arange(106) * (350 / 105), atol=1e-6)
    words = (FOLDER / "reflective.sp").read_text().split("BEGIN_DATA\n")[1].split()[:-1]
    assert sample.values.tolist() == [float(word) for word in words]  # SPECTRAL_NORM is 1


def test_conditions_of_one_file_make_names_that_differ():
    samples = readers.read(FOLDER / "i1profiler-two-conditions.txt")
    assert [sample.name for sample in samples] == ["A1 (M0)", "A2 (M0)", "A1 (M1)", "A2 (M1)"]
    assert [sample.condition for sample in samples] == ["M0", "M0", "M1", "M1"]
    assert {(sample.illuminant, sample.observer) for sample in samples} == {("D50", 2)}


def test_barbieri_words():
    sample = readers.read(FOLDER / "barbieri.txt")[0]
    assert (sample.condition, sample.aperture, sample.geometry) == ("M1", "8", "45/0")
    assert (sample.illuminant, sample.observer, sample.notes) == ("D50", 10, ())


def test_quotes_umlauts_commas_and_returns_of_an_old_macintosh():
    samples = readers.read(FOLDER / "spectrolino.txt")
    assert [sample.name for sample in samples] == ['Grün, "matt"', "Gelb", "Rot"]
    assert samples[0].position == "line 15"
    assert (samples[0].illuminant, samples[0].observer) == ("D65", 10)


def test_wavelength_beside_each_percent_and_records_over_several_lines():
    samples = readers.read(FOLDER / "wrapped.txt")
    body = (FOLDER / "wrapped.txt").read_text().split("BEGIN_DATA\n")[1].split("END_DATA")[0]
    records = re.findall(r'\d+ "(.*?)" (.*?)(?=\n\d|\Z)', body.strip(), re.DOTALL)
    assert len(records) == 2
    for sample, (name, rest) in zip(samples, records, strict=True):
        cells = list(map(float, rest.split()))
        assert sample.name == name
        assert sample.lab == tuple(cells[:3])
        assert sample.wavelengths.tolist() == cells[3::2]
        assert sample.values.tolist() == [value / 100 for value in cells[4::2]]
        assert (sample.instrument, sample.specular) == ("de:8", "SCE")
        assert (sample.illuminant, sample.observer) == ("D65", 10)
        assert sample.notes == ("NUMBER_OF_SETS says '3', the table has 2.",)


def small(fields, rows, keys=""):
    body = "\n".join(rows)
    head = f"CGATS.17\n{keys}BEGIN_DATA_FORMAT\n{fields}\nEND_DATA_FORMAT\n"
    return f"{head}BEGIN_DATA\n{body}\nEND_DATA\n"


@pytest.mark.parametrize(
    ("label", "scale"),
    [
        ("SPEC_{}", 100),
        ("SPECTRAL_PCT_{}", 100),
        ("SPECTRAL_DEC_{}", 1),
        ("SPECTRAL_NM{}", 1),
        ("SPECTRAL_NM_{}", 1),
        ("SPECTRAL_{}", 1),
        ("nm{}", 1),
        ("NM_{}", 1),
        ("R_{}", 1),
        ("{}nm", 1),
        ("REFL_PCT_{}", 100),
        ("PCT_{}", 100),
        ("WL_{}", 1),
        ("LAMBDA_{}", 1),
    ],
)
def test_the_scale_follows_from_the_family_and_never_from_the_values(tmp_path, label, scale):
    fields = " ".join(["SAMPLE_ID", *(label.format(nm) for nm in (400, 500, 600))])
    (sample,) = readers.read(write(tmp_path, small(fields, ["1 0.5 0.25 1.5"])))
    assert sample.wavelengths.tolist() == [400, 500, 600]
    assert sample.values.tolist() == [0.5 / scale, 0.25 / scale, 1.5 / scale]
    keys = 'SPECTRAL_NORM "2.0"\n'
    (sample,) = readers.read(write(tmp_path, small(fields, ["1 0.5 0.25 1.5"], keys)))
    assert sample.values.tolist() == [0.25, 0.125, 0.75]


def test_columns_may_stand_in_any_order_and_a_condition_in_each(tmp_path):
    fields = "SAMPLE_ID\tM2_nm500\tM2_nm400\tM0_nm400\tM0_nm500"
    first, second = readers.read(write(tmp_path, small(fields, ["7\t.2\t.1\t.3\t.4"])))
    assert (first.name, first.condition, first.values.tolist()) == ("7 (M2)", "M2", [0.1, 0.2])
    assert (second.name, second.condition, second.values.tolist()) == ("7 (M0)", "M0", [0.3, 0.4])


@pytest.mark.parametrize("label", ["{}_400 {}_500", "NM400_{} NM500_{}", "R_400:{} R_500:{}"])
def test_bands_may_say_whether_specular_light_is_included(tmp_path, label):
    fields = f"SAMPLE_NAME {label.format('SCI', 'SCI')} {label.format('SPEX', 'SPEX')}"
    (sample,) = readers.read(write(tmp_path, small(fields, ["tile .1 .2 .3 .4"])))
    told = {s.instrument: (s.specular, s.values.tolist()) for s in sample.readings}
    assert told == {"di:8": ("SCI", [0.1, 0.2]), "de:8": ("SCE", [0.3, 0.4])}
    assert sample.name == "tile"


@pytest.mark.parametrize("label", ["M_CONDITION", "MEASUREMENT_CONDITION"])
def test_a_column_of_conditions(tmp_path, label):
    (sample,) = readers.read(write(tmp_path, small(f"ID {label} nm400 nm500", ["7 M1 .1 .2"])))
    assert sample.condition == "M1"


def test_names_with_spaces_and_empty_cells_between_tabs(tmp_path):
    fields = "SAMPLE_ID\tSAMPLE_NAME\tLAB_L\tLAB_A\tLAB_B\tnm400\tnm500"
    rows = ["1\tdark brick\t\t\t\t0.25\t0.5", "2 light 50 1 2 0.5 0.75 # spaces after all"]
    first, second = readers.read(write(tmp_path, small(fields, rows)))
    assert (first.name, first.lab, first.values.tolist()) == ("dark brick", None, [0.25, 0.5])
    assert (second.name, second.lab, second.values.tolist()) == ("light", (50, 1, 2), [0.5, 0.75])


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ('"OUTPUT"', '"DISPLAY"', ["line 7", "DEVICE_CLASS", "emission"]),
        ("CTI3   \n\nDESCRIPTOR", "CCSS   \n\nDESCRIPTOR", ["CCSS", "emission"]),
        ('"OUTPUT"\n', '"OUTPUT"\nMEAS_TYPE "AMBIENT"\n', ["line 8", "emission"]),
        ('"OUTPUT"\n', '"OUTPUT"\nMEAS_TYPE "TRANSMISSIVE"\n', ["line 8", "transmittance"]),
        (
            '"OUTPUT"\n',
            '"OUTPUT"\nMEASUREMENT_SOURCE "MeasurementOptics=Transmission"\n',
            ["line 8", "MEASUREMENT_SOURCE", "transmittance"],
        ),
        ("CTI3", "SPECT", ["SPECT", 'MEAS_TYPE "REFLECTIVE"']),
        ("CTI3", "CMF", ["signature CMF", "color matching functions"]),
        ("SPEC_380", "SPEC_390", ["line 27", "390 nm stands twice", "'SPEC_390'"]),
        ("SPEC_", "DENSITY_", ["no spectral data", "export the spectra"]),
        ('SPECTRAL_END_NM "730.000000"', 'SPECTRAL_NORM "0"', ["SPECTRAL_NORM", "'0'"]),
        ("6.259035", "nothing", ["line 27", "'SPEC_380'", "'nothing'", "not a number"]),
        ("6.259035", "-", ["line 27", "'SPEC_380'", "missing"]),
        ("6.259035", "625.9035", ["line 27", "'SPEC_380'", "times white"]),
        ("6.259035", "", ["line 27", "ends before column 'SPEC_730'", "43 of 44"]),
        ("6.259035", "6.259035 1", ["line 27", "45 cells", "44 columns"]),
        ("40.100000", "40.1.0", ["line 27", "'XYZ_X'", "'40.1.0'"]),
        ("\nEND_DATA\n", "\n", ["line 26", "BEGIN_DATA has no END_DATA"]),
        ("END_DATA_FORMAT", "", ["line 21", "no END_DATA_FORMAT"]),
        ("BEGIN_DATA_FORMAT", "REMARK", ["line 26", "there is no BEGIN_DATA_FORMAT"]),
    ],
)
def test_each_fault_is_named_with_its_place(tmp_path, old, new, parts):
    text = TI3[: TI3.index("CAL    ")]
    assert old in text
    count = -1 if old in ("SPEC_", "END_DATA_FORMAT") else 1
    if old == "SPEC_":
        text = text.replace("SPECTRAL_", "X_")
    sentence = refusal(write(tmp_path, text.replace(old, new, count)))
    for part in parts:
        assert part in sentence


def test_two_families_are_not_chosen_between(tmp_path):
    fields = "SAMPLE_ID SPEC_400 SPEC_500 SPECTRAL_NM400 SPECTRAL_NM500"
    sentence = refusal(write(tmp_path, small(fields, ["1 10 20 .1 .2"])))
    assert "SPEC, SPECTRAL_NM" in sentence


def test_a_table_of_light_beside_one_of_surfaces_is_left_out(tmp_path):
    light = I1.replace("Filter=no", "MeasurementOptics=Emission", 1)
    samples = readers.read(write(tmp_path, light))
    assert [sample.name for sample in samples] == ["A1", "A2"]
    assert samples[0].condition == "M1"
    assert any("1 with other quantities" in note for note in samples[0].notes)


def test_what_is_written_is_read_back(tmp_path):
    from rough_spectra.addon.readings import document
    from rough_spectra.addon.readings.writers import cgats

    rng = np.random.default_rng(5)
    nm = tuple(float(band) for band in range(380, 731, 10))
    names = ('Brick "old"', "Plaster, white")
    parts = [
        document.Predicted(
            kind="albedo",
            model_reason="",
            sigma_degrees=30.0,
            preview=(0.5, 0.4, 0.3),
            values=tuple(np.round(rng.random(36), 6)),
            wavelengths=nm,
            xyz=(30.5, 28.25, 12.125),
            lab=(60.0625, 10.5, -3.25),
            illuminant="D65",
            observer=10,
            model="closure",
        )
        for _ in names
    ]
    entries = tuple(
        document.Reading(name, "", name, "", part, None, None, "", ())
        for name, part in zip(names, parts, strict=True)
    )
    path = tmp_path / "readings.txt"
    written = cgats.predicted(document.Readings("Linear Rec.709", "5.2", entries))
    path.write_bytes(b"".join(written))
    samples = readers.read(path)
    assert [sample.name for sample in samples] == list(names)
    for sample, part in zip(samples, parts, strict=True):
        assert sample.values.tolist() == list(part.values)
        assert sample.wavelengths.tolist() == list(nm)
        assert sample.xyz == (0.305, 0.2825, 0.12125)
        assert sample.lab == part.lab
        assert (sample.illuminant, sample.observer) == ("D65", 10)
        assert (sample.instrument, sample.notes) == ("45a:0", ())


def test_thousands_of_samples_take_little_time_and_memory(tmp_path):
    rng = np.random.default_rng(1)
    bands = "\t".join(f"SPECTRAL_NM{nm}" for nm in range(380, 740, 10))
    rows = [
        f"{i}\tP{i}\t" + "\t".join(f"{value:.4f}" for value in row)
        for i, row in enumerate(rng.random((4_000, 36)))
    ]
    path = write(tmp_path, small(f"SAMPLE_ID\tSAMPLE_NAME\t{bands}", rows))
    # About 10 paces; anything quadratic takes thousands.
    with pace.at_most(200):
        assert len(readers.read(path)) == 4_000
    tracemalloc.start()
    try:
        readers.read(path)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 20 * path.stat().st_size


@pytest.mark.parametrize("mark", ["1\t", "1 ", '"', '"a" ', "#", " #", "BEGIN_DATA\n", "\n", "1\n"])
def test_a_megabyte_of_one_thing_takes_no_longer_than_its_length(tmp_path, mark):
    text = small("SAMPLE_ID\tnm400\tnm500", [mark * (2**20 // len(mark))])
    with pace.at_most(200):
        refusal(write(tmp_path, text))
