# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain tables: layouts, delimiters, units, and what is refused."""

from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.core.errors import InputError

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "delimited"
UNSAID = "The file does not say the geometry; 45°a:0° is assumed."


def read(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "chalk.csv"
    path.write_bytes(text.encode(encoding))
    return readers.read(path)


def refusal(tmp_path, text):
    with pytest.raises(InputError) as caught:
        read(tmp_path, text)
    sentence = str(caught.value)
    assert "chalk.csv" in sentence
    assert sentence.endswith(".")
    assert "\n" not in sentence
    return sentence


def summary(samples):
    return [(s.name, s.wavelengths.tolist(), s.values.tolist()) for s in samples]


def test_samples_in_rows_percent_by_column_name():
    samples = readers.read(FOLDER / "across-percent-tabs.txt")
    nm = [400, 410, 420, 430]
    assert summary(samples) == [
        ("Chalk", nm, [0.7125, 0.745, 0.77, 0.78125]),
        ("Brick dust", nm, [0.0625, 0.065, 0.0775, 0.09]),
    ]
    assert [sample.position for sample in samples] == ["line 2", "line 3"]
    assert samples[0].notes == (UNSAID, "Columns not read: Batch.")


def test_comments_state_what_a_table_cannot():
    gray, plaster = readers.read(FOLDER / "bake-style.csv")
    assert summary([gray, plaster]) == [
        ("50% gray", [400, 410, 420], [0.5, 0.5, 0.5]),
        ("plaster", [400, 410, 420], [0.875, 0.8828125, 0.890625]),
    ]
    assert (gray.kind, gray.instrument, gray.license) == ("albedo", "45a:0", "CC0-1.0")
    assert gray.source.endswith("bake-style.csv")
    assert plaster.position == "column 'plaster'"


def test_decimal_commas():
    nm = [400, 410, 420]
    assert summary(readers.read(FOLDER / "decimal-comma.csv")) == [
        ("Tür", nm, [0.0625, 0.0703125, 0.078125]),
        ("Wand, außen", nm, [0.5, 0.515625, 0.53125]),
    ]


def test_two_columns_without_a_header():
    (clay,) = readers.read(FOLDER / "spaces.txt")
    assert summary([clay]) == [("spaces", [400, 410, 420, 430], [0.125, 0.1406, 0.1563, 0.1719])]


def test_micrometers_and_percent_where_the_header_says_so():
    (sample,) = readers.read(FOLDER / "micrometers.tsv")
    # 2.01 * 1000 is 2009.9999999999998 in floating point.
    nm = [570, 580, 590, 2010]
    assert summary([sample]) == [("micrometers", nm, [0.11486, 0.1175, 0.12, 0.125])]


BANDS = [400.0, 410.0, 420.0]
VALUES = [0.125, 0.25, 0.5]


@pytest.mark.parametrize("delimiter", [",", ";", "\t", " ", ", "])
@pytest.mark.parametrize("header", ["wavelength{}reflectance\n", "nm{}R\n", "x{}y\n", ""])
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_down_in_every_dress(tmp_path, delimiter, header, newline):
    rows = "".join(f"{b:g}{delimiter}{v}\n" for b, v in zip(BANDS, VALUES, strict=True))
    text = (header.format(delimiter) + rows).replace("\n", newline)
    (sample,) = read(tmp_path, text)
    assert (sample.wavelengths.tolist(), sample.values.tolist()) == (BANDS, VALUES)
    assert sample.name.startswith("chalk")


@pytest.mark.parametrize("label", ["{}", "{}nm", "R{} nm", "nm{}", "{}.0", "R_{}"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("corner", ["name", "wavelength", "", "Sample ID"])
def test_across_in_every_dress(tmp_path, label, delimiter, corner):
    header = delimiter.join([corner, *(label.format(int(band)) for band in BANDS)])
    rows = [delimiter.join([name, "0.125", "0.25", "0.5"]) for name in ("a", "b_1")]
    samples = read(tmp_path, "\n".join([header, *rows]))
    assert summary(samples) == [("a", BANDS, VALUES), ("b_1", BANDS, VALUES)]


def test_a_header_of_numbers_with_and_without_names_below(tmp_path):
    assert summary(read(tmp_path, "400,410,420\n0.125,0.25,0.5\n")) == [("chalk", BANDS, VALUES)]
    assert summary(read(tmp_path, "400 410 420\nred 0.125 0.25 0.5\n")) == [("red", BANDS, VALUES)]


def test_numbered_samples_down_and_across_are_told_apart(tmp_path):
    down = read(tmp_path, "wavelength,1,2\n400,0.125,0\n410,0.25,0\n420,0.5,0\n")
    assert summary(down)[0] == ("1", BANDS, VALUES)
    across = read(tmp_path, "wavelength,400,410,420\n1,0.125,0.25,0.5\n2,0,0,0\n")
    assert summary(across)[0] == ("1", BANDS, VALUES)
    sentence = refusal(tmp_path, "wavelength,400,410,420\n400,0.1,0.2,0.5\n410,0,0,0\n")
    assert "first row or in the first column" in sentence


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_encodings(tmp_path, encoding):
    text = "wavelength;Tür\n400;0,125\n410;0,25\n420;0,5\n"
    assert summary(read(tmp_path, text, encoding)) == [("Tür", BANDS, VALUES)]


def test_a_byte_order_mark_is_no_part_of_the_first_number(tmp_path):
    assert summary(read(tmp_path, "400,0.125\n410,0.25\n420,0.5\n", "utf-8-sig")) == [
        ("chalk", BANDS, VALUES)
    ]


@pytest.mark.parametrize(
    ("top", "scale"),
    [
        ("wavelength,reflectance\n", 1),
        ("wavelength,R [%]\n", 100),
        ("wavelength,% reflectance\n", 100),
        ("wavelength,Reflectance (percent)\n", 100),
        ("wavelength,gray 50%\n", 1),
        ("wavelength,50 % gray\n", 1),
        ("# units: percent\nwavelength,R\n", 100),
        ("# units: fraction\nwavelength,R\n", 1),
        ("# Units: Fraction (100 percent = 1); others differ\nwavelength,R\n", 1),
        ("# units: %\nwavelength,R\n", 100),
        ("# reflectance in percent\nwavelength,R\n", 100),
        ("# name: 20 percent gray\nwavelength,R\n", 1),
        ("# humidity: 40 %\nwavelength,R\n", 1),
        ("# error bars: percent\nwavelength,R\n", 1),
        ("# title: reflectance in % against time\nwavelength,R\n", 1),
    ],
)
def test_scale_follows_words_and_never_size(tmp_path, top, scale):
    # All below 1: whoever looks at the size takes these for fractions.
    (sample,) = read(tmp_path, top + "400,0.5\n410,0.25\n")
    assert sample.values.tolist() == [0.5 / scale, 0.25 / scale]


def test_large_values_are_refused_rather_than_scaled(tmp_path):
    sentence = refusal(tmp_path, "wavelength,R\n400,50\n410,25\n")
    for part in ("column 'R'", "line 2", "times white", "percent", "column name"):
        assert part in sentence


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("wavelength,R\n400,nan\n410,0.5\n", ["column 'R'", "line 2", "no value"]),
        ("wavelength,R\n400,0.5\n410,1e999\n", ["line 3", "infinite"]),
        ("wavelength,R\n400,0.5\n410,-0.5\n", ["line 3", "410 nm", "below 0"]),
        ("wavelength,R\n400,0.5\n420,0.5\n\n410,0.5\n", ["line 5", "line 3", "410 nm", "sort"]),
        ("wavelength,R\n400,0.5\n400,0.5\n", ["line 2", "line 3", "twice"]),
        ("wavelength,R\n400,0.5\n", ["only one band"]),
        ("wavelength,R\n", ["no band"]),
        ("name,400\na,0.5\n", ["line 2", "only one band"]),
        ("name,400 nm,420 nm,410 nm\na,0,0,0\n", ["'410 nm'", "'420 nm'", "sort"]),
        ("name,400 nm,400 nm\na,0,0\n", ["twice"]),
        ("name,400 nm,410 nm\na,0.5,\n", ["line 2", "'410 nm'", "no value"]),
        ("name,400 nm,410 nm\na,0.5\n", ["line 2", "before column '410 nm'"]),
        ("name,400 nm,410 nm\n", ["holds no sample"]),
        ("wavelength,R\n0.4,0.5\n0.5,0.5\n", ["0.4 to 0.5", "micrometers"]),
        ("wavelength,R\n400,half\n410,0.5\n", ["line 2", "column 'R'", "'half'", "not a number"]),
        ("wavelength,R\n400,1_0\n410,0.5\n", ["line 2", "'1_0'", "not a number"]),
        ("wavelength,R,S\n400,.5,.5\n410,.5\n", ["line 3", "before column 'S'", "2 of 3"]),
        ("wavelength,R\n400,0.5\n410,0.5,0.5\n", ["line 3", "3 columns", "2"]),
        ("wavelength,R\n400,0,5\n410,0,6\n", ["line 2", "decimal commas", "semicolons"]),
        ("400,0,5\n410,0,6\n", ["line 1", "decimal commas", "semicolons"]),
        ("wavelength|R\n400|0.5\n410|0.5\n", ["line 1", "expected commas", "found vertical bars"]),
        ("wavelength | R\n400 | 0.5\n410 | 0.5\n", ["line 1", "found vertical bars"]),
        ("wavelength,R\n400;0.5\n410;0.5\n", ["line 2", "semicolons", "header by commas"]),
        ("wavelength;R\n400,0.5\n410,0.5\n", ["line 2", "commas", "header by semicolons"]),
        ("wavelength,R\n400;0,5\n410;0,5\n", ["line 2", "'400;0'", "semicolons", "header"]),
        ("sep=;\nwavelength,R\n400,0.5\n", ["line 2", "expected semicolons", "found commas"]),
        ("Name;a;b\nFirst;5;x\nlast;6;y\n", ["line 1", "no wavelengths found", "'#'"]),
        ("# units: furlongs\n400,0.5\n410,0.5\n", ["line 1", "'furlongs'", "fraction"]),
        ("# kind: color\n400,0.5\n410,0.5\n", ["line 1", "'color'", "reading", "albedo"]),
        ("# units: fraction\nnm,R %\n400,0.5\n410,0.5\n", ["column 'R %'", "percent", "agree"]),
        ("# wavelength_unit: um\nwavelength nm,R\n.4,0.5\n.5,.5\n", ["unit", "agree"]),
        ("sep=;1\n;;\n", ["rows are empty"]),
        ('wavelength,R\n400,"0.5\n410,0.5\n', ["line 2", "not a number"]),
    ],
)
def test_each_fault_is_named_with_its_place(tmp_path, text, parts):
    sentence = refusal(tmp_path, text)
    for part in parts:
        assert part in sentence


def test_an_unclosed_quotation_mark_in_a_long_file(tmp_path):
    rows = "".join(f"{400 + i},0.5\n" for i in range(30000))
    assert "quotation mark" in refusal(tmp_path, 'wavelength,R\n399,0.5\n"' + rows)


def test_trailing_delimiters_are_no_columns(tmp_path):
    assert summary(read(tmp_path, "wavelength,R,\n400,0.5,\n410,0.25,\n"))[0][2] == [0.5, 0.25]


def test_a_spreadsheet_with_lines_above_and_falling_wavelengths():
    (sample,) = readers.read(FOLDER / "spreadsheet.csv")
    assert summary([sample]) == [("Chalk wall", [750, 770, 780], [0.125, 0.25, 0.5])]
    assert (sample.device, sample.geometry, sample.aperture) == ("CM-700d", "d/8", "8 mm")
    assert (sample.specular, sample.instrument) == ("SCE", "de:8")
    assert (sample.illuminant, sample.observer) == ("D65", 10)
    assert sample.altered == ("1 band without a value was left out: 760 nm.",)
    assert sample.notes == ("Columns not read: std.",)


def test_columns_beside_the_bands_say_what_they_say():
    wall, tile = readers.read(FOLDER / "color-columns.txt")
    assert summary([wall, tile]) == [
        ("Wall", [360, 380], [0.125, 0.25]),
        ("Tile", [360, 370, 380], [0.5, 0.625, 0.75]),
    ]
    assert (wall.lab, wall.illuminant, wall.observer) == ((50.5, 1.0, -2.5), "D65", 10)
    assert (wall.specular, wall.instrument, wall.condition) == ("SCI", "di:8", "M1")
    assert (tile.lab, tile.specular, tile.condition) == (None, "SCE", "M0")
    assert wall.notes == ("Columns not read: Group.",)


def test_units_below_the_names_and_raw_columns_beside():
    (sample,) = readers.read(FOLDER / "units-below.txt")
    assert summary([sample]) == [("units-below", [400, 410], [0.125, 0.25])]
    assert sample.notes == (UNSAID, "Columns not read: Dark, Reference, Sample.")


def test_rows_of_keys_above_the_numbers():
    red, blue = readers.read(FOLDER / "key-rows.csv")
    assert summary([red, blue]) == [
        ("red", [400, 410], [0.125, 0.5]),
        ("blue", [400, 410], [0.25, 0.75]),
    ]
    assert (red.illuminant, red.observer) == ("D65", 10)
    assert (blue.illuminant, blue.observer) == ("A", 2)


@pytest.mark.parametrize(
    ("label", "scale"),
    [
        *[("X{}", 1), ("SPECTRAL_{}", 1), ("SPEC_{}", 100), ("%R{}", 100)],
        *[("R[{}]", 1), ("{}[nm]", 1), ("{} nm (%)", 100), ("R_{}.0", 1)],
    ],
)
def test_more_names_of_bands(tmp_path, label, scale):
    header = ",".join(["name", *(label.format(int(band)) for band in BANDS)])
    (sample,) = read(tmp_path, f"{header}\na,0.125,0.25,0.5\n")
    assert summary([sample]) == [("a", BANDS, [value / scale for value in VALUES])]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('wavelength,R\n"400","0,5"\n"410","0,25"\n', [0.5, 0.25]),
        ("Name: x\nFirst: y\n400 0.5\n410 0.25\n", [0.5, 0.25]),
        ("Date, 2020, 1300\nOperator: me\nnm R\n400 .5\n410 .25\n", [0.5, 0.25]),
        ("Title,,\n,,\nwavelength,,a\n400,,.5\n410,,.25\n", [0.5, 0.25]),
        ("Reflectance (%),\nWavelength,a\n400,50\n410,25\n", [0.5, 0.25]),
        ("wavelength,absorbance,reflectance\n400,1,.5\n410,1,.25\n", [0.5, 0.25]),
        ("Index,Wavelength [µm],R [%],std\n0,.4,50,1\n1,.41,25,1\n", [0.5, 0.25]),
    ],
)
def test_what_stands_around_a_table_does_not_hide_it(tmp_path, text, expected):
    (sample,) = read(tmp_path, text)
    assert sample.wavelengths.tolist() == [400, 410]
    assert sample.values.tolist() == expected


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_two_byte_text_without_a_mark(tmp_path, encoding):
    text = "wavelength;Tür\n400;0,125\n410;0,25\n420;0,5\n"
    assert summary(read(tmp_path, text, encoding)) == [("Tür", BANDS, VALUES)]


@pytest.mark.parametrize(
    ("top", "quantity"),
    [
        ("Wavelength,%T", "transmittance"),
        ("Wavelength,Absorbance", "absorbance"),
        ("Wavelength,log(1/R)", "absorbance"),
        ("Wavelength,Radiance (W/sr/m2/nm)", "radiance"),
        ("Wavelength,Irradiance", "irradiance"),
        ("Wavelength,Counts", "counts"),
        ("Wavelength,Emission", "emission"),
        ("Units=Radiance\n\nWavelength,x", "line 1: the values are radiance"),
    ],
)
def test_other_quantities_are_refused_by_name(tmp_path, top, quantity):
    assert quantity in refusal(tmp_path, f"{top}\n400,0.5\n410,0.5\n")


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("wavelength,D65\n400,0.8\n410,0.9\n", "emission"),
        ("nm,x_bar,y_bar,z_bar\n400,0.1,0.2,0.3\n410,0.1,0.2,0.3\n", "color matching functions"),
        ("nm,R,G,B\n400,0.1,0.2,0.3\n410,0.1,0.2,0.3\n", "sensitivities of a camera"),
        ("nm;n;k\n400;0.1;3.2\n410;0.1;3.3\n", "refractive indices"),
        ("nm,Sensitivity\n400,0.1\n410,0.2\n", "sensitivities"),
        ("nm,Rad. (Ref.)\n400,0.1\n410,0.2\n", "radiance"),
        ("# Optical constants for Al\n400 0.1\n410 0.2\n", "refractive indices"),
        ("Y units: W/m^2/sr/nm\nnm,Sample\n400,0.1\n410,0.2\n", "radiance"),
    ],
)
def test_what_only_looks_like_reflectance_is_refused_by_its_names(tmp_path, text, what):
    assert what in refusal(tmp_path, text)


def test_samples_may_be_called_like_a_color_or_an_illuminant_among_others(tmp_path):
    for names in ("red,green,blue", "D50,D51,D52", "A,B,C", "R,G,white"):
        text = f"nm,{names}\n400,0.1,0.2,0.3\n410,0.1,0.2,0.3\n"
        assert [s.name for s in read(tmp_path, text)] == names.split(",")


def test_the_file_name_counts_where_nothing_else_says_what_the_values_are(tmp_path):
    path = tmp_path / "window_transmission.csv"
    path.write_text("400,0.5\n410,0.5\n420,0.5\n")
    with pytest.raises(InputError, match=r"by it they are transmittance.*call their column"):
        readers.read(path)
    lamp = tmp_path / "CIE-D65.csv"
    lamp.write_text("400,82.75\n410,91.49\n420,93.43\n")
    with pytest.raises(InputError, match="by it they are emission"):
        readers.read(lamp)
    path.write_text("nm,reflectance\n400,0.5\n410,0.5\n")
    assert readers.read(path)[0].values.tolist() == [0.5, 0.5]
    plastic = tmp_path / "ABS.csv"
    plastic.write_text("nm,value\n400,0.5\n410,0.5\n")
    assert readers.read(plastic)[0].name == "ABS"


@pytest.mark.parametrize("observer", ["2 Degree", "10 Degree"])
def test_functions_of_the_eye_are_known_by_their_shape(tmp_path, observer):
    # colour-science's tables, in any scale and without a single name.
    colour = pytest.importorskip("colour")
    names = [name for name in colour.MSDS_CMFS if observer in name and "Observer" in name]
    for name in names:
        table = colour.MSDS_CMFS[name]
        rows = [",".join(f"{0.5 * value:.6f}" for value in row) for row in table.values]
        text = "\n".join(f"{nm:g}.0,{row}" for nm, row in zip(table.wavelengths, rows, strict=True))
        assert "color matching functions" in refusal(tmp_path, text)
    assert len(names) > 1


def test_what_a_camera_sees_comes_to_nothing_and_samples_of_its_colors_do_not(tmp_path):
    nm = np.arange(400, 710, 10.0)
    lobes = np.exp(-0.5 * ((nm[:, None] - [610, 540, 460]) / 30.0) ** 2)
    for floor in (0.0, 0.02):
        rows = [f"{w},{','.join(map(str, row + floor))}" for w, row in zip(nm, lobes, strict=True)]
        text = "\n".join(["wavelength,red,green,blue", *rows])
        if floor:
            assert [s.name for s in read(tmp_path, text)] == ["red", "green", "blue"]
        else:
            assert "sensitivities of a camera" in refusal(tmp_path, text)


def test_three_vivid_surfaces_are_not_taken_for_the_eye(tmp_path):
    nm = np.arange(400, 710, 10.0)
    bumps = 0.04 + np.exp(-0.5 * ((nm[:, None] - [450, 540, 610]) / 40.0) ** 2)
    rows = [f"{w},{','.join(map(str, row))}" for w, row in zip(nm, bumps, strict=True)]
    assert len(read(tmp_path, "\n".join(rows))) == 3


def test_a_column_of_reflectance_is_read_beside_those_of_radiance(tmp_path):
    text = (
        "Units: W/m^2/sr/nm\nData:\nWvl\tRad. (Ref.)\tRad. (Target)\tReflect. %\n"
        " 400.0\t 5.08E-003\t 1.10E-003\t    25.0\n 410.0\t 5.2E-003\t 1.1E-003\t    50.0\n"
    )
    (sample,) = read(tmp_path, text)
    assert sample.values.tolist() == [0.25, 0.5]
    assert sample.notes == (UNSAID, "Columns not read: Rad. (Ref.), Rad. (Target).")


def test_numbers_in_rows_of_data_are_no_bands(tmp_path):
    text = "site,sample,mass,length\nA,a1,39,13.3\nB,b2,130.5,212\nB,b3,140,248\n"
    assert "no wavelengths found at 'site'" in refusal(tmp_path, text)


def test_a_first_column_with_the_illuminant_is_what_colors_were_computed_for(tmp_path):
    (sample,) = read(tmp_path, "Illuminant;Name;400 nm;410 nm;420 nm\nD65;chalk;0.5;0.5;0.5\n")
    assert (sample.name, sample.illuminant) == ("chalk", "D65")


@pytest.mark.parametrize(
    "text",
    [
        "wavelength (um),Emissivity\n8,0.9\n9,0.8\n",
        "wavelength (um),Emissivity (%)\n8,90\n9,80\n",
        "# kind: emissivity\n# wavelength_unit: um\n8,0.9\n9,0.8\n",
        "# kind: emissivity\nname,8000 nm,9000 nm\nsand,0.9,0.8\n",
        "Y units: Emissivity\nwavelength (um),sand\n8,0.9\n9,0.8\n",
        "Emissivity,8000 nm,9000 nm\nsand,0.9,0.8\n",
    ],
)
def test_emissivity_is_read_as_what_it_is(tmp_path, text):
    (sample,) = read(tmp_path, text)
    assert (sample.kind, sample.quantity) == ("emissivity", "emissivity")
    assert sample.wavelengths.tolist() == [8000, 9000]
    assert sample.values.tolist() == [0.9, 0.8]
    assert sample.instrument == "di:8"
    assert any("near the normal" in note for note in sample.notes)


def test_reflectance_and_emissivity_may_stand_side_by_side(tmp_path):
    text = "nm,Reflectance sand,Emissivity sand\n8000,0.1,0.9\n9000,0.2,0.8\n"
    one, other = read(tmp_path, text)
    assert [one.kind, other.kind] == ["reading", "emissivity"]
    assert other.values.tolist() == [0.9, 0.8]


@pytest.mark.parametrize("kind", ["albedo", "emissivity"])
def test_a_comment_and_a_column_that_disagree_on_emissivity_are_refused(tmp_path, kind):
    column = {"albedo": "Emissivity", "emissivity": "Reflectance"}[kind]
    sentence = refusal(tmp_path, f"# kind: {kind}\nnm,{column}\n8000,0.9\n9000,0.8\n")
    assert f"the kind is {kind}" in sentence
    assert column in sentence
