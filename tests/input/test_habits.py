# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as programs, spreadsheets and people of other habits write them."""

import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.core.errors import InputError

NM = (400, 450, 500, 550, 600, 650, 700)
VALUES = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7)


def down(head, mark=",", times=1.0, cell="{:.4f}"):
    """A table of one or more equal columns below a header, which may be missing."""
    columns = 1 if head is None else head.count(mark)
    rows = [
        mark.join([str(w), *[cell.format(v * times)] * columns])
        for w, v in zip(NM, VALUES, strict=True)
    ]
    return "\n".join([*([] if head is None else [head]), *rows]) + "\n"


def across(head, *rows, times=1.0):
    """A table with a sample a row, each with what stands before its values."""
    values = ",".join(f"{v * times:.4f}" for v in VALUES)
    lines = [f"{head},{','.join(map(str, NM))}", *(f"{row},{values}" for row in rows)]
    return "\n".join(lines) + "\n"


def read(tmp_path, text, name="tile.csv"):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return readers.read(path)


def refusal(tmp_path, text, name="tile.csv"):
    with pytest.raises(InputError) as caught:
        read(tmp_path, text, name)
    return str(caught.value)


def is_ramp(sample):
    return sample.wavelengths.tolist() == list(NM) and sample.values == pytest.approx(VALUES)


@pytest.mark.parametrize(
    "top",
    [
        "% Wavelength Reflectance\n% d/8 SCE\n",
        "%wavelength reflectance\n%% d/8 SCE\n",
        "! d/8, SCE\n",
        "// geometry: d/8 SCE\n\n",
        "; geometry: d/8 SCE\n; by hand\n",
    ],
)
def test_comments_with_the_marks_of_other_programs(tmp_path, top):
    [sample] = read(tmp_path, top + down(None, " "))
    assert is_ramp(sample), "a percent sign that begins a comment is no scale"
    assert sample.instrument == "de:8"


def test_names_of_columns_may_begin_with_such_a_mark(tmp_path):
    [first, second] = read(tmp_path, down(";brick;slate", ";"))
    assert [first.name, second.name] == ["brick", "slate"]
    [sample] = read(tmp_path, "%R400,%R500\n10,20\n")
    assert sample.values.tolist() == [0.1, 0.2]


@pytest.mark.parametrize(
    "beside",
    [
        "±",
        "R ±",
        "U(R)",
        "u (k=2)",
        "R_std",
        "R SD",
        "sigma",
        "Uncertainty (k=2)",
        "std of R",
        "σ(R)",
        "标准偏差",
    ],
)
def test_how_sure_a_spectrum_is_is_no_sample(tmp_path, beside):
    [sample] = read(tmp_path, down(f"wavelength,R,{beside}"))
    assert is_ramp(sample)
    assert any("Columns not read" in note and beside in note for note in sample.notes)


def test_statistics_beside_a_mean_are_no_samples_and_names_like_them_are(tmp_path):
    [sample] = read(tmp_path, down("wavelength,mean reflectance,std. dev.,n,min,max"))
    assert is_ramp(sample)
    names = ["brick", "n", "max", "U", "Sedona SD"]
    found = read(tmp_path, down(f"wavelength,{','.join(names)}"))
    assert [sample.name for sample in found] == names
    assert [s.name for s in read(tmp_path, down("wavelength,error,sigma"))] == ["error", "sigma"]


@pytest.mark.parametrize(
    ("column", "what"),
    [
        ("Trasmittanza", "transmittance"),
        ("透射率", "transmittance"),
        ("Пропускание (%)", "transmittance"),
        ("吸收率", "absorbance"),
        ("reflectance as log(1/R)", "absorbance"),
        ("remission function", "Kubelka-Munk"),
        ("first derivative of reflectance", "derivative"),
        ("dR/R", "derivative"),
        ("continuum removed reflectance", "continuum"),
        ("1-R", "one less"),
        ("Single beam", "counts"),
        ("PL intensity", "emission"),
        ("Intensity", "nothing says of what"),
    ],
)
def test_what_is_no_reflectance_in_more_words(tmp_path, column, what):
    assert what in refusal(tmp_path, down(f"nm,{column}"))


def test_letters_beside_r_are_other_quantities(tmp_path):
    for head in ("nm,R,T", "nm,%R,%T,%A", "nm,R (%),T (%)"):
        [sample] = read(tmp_path, down(head, times=100.0 if "%" in head else 1.0))
        assert is_ramp(sample)
        assert any("Columns not read: " in note for note in sample.notes)
    assert len(read(tmp_path, down("nm,R,T,B"))) == 3


def test_a_hyphen_before_a_word_is_no_logarithm(tmp_path):
    [sample] = read(tmp_path, down("nm,brick-logo"))
    assert sample.name == "brick-logo"


@pytest.mark.parametrize(
    "text",
    [
        "Photometric mode: Reflectance (%)\n" + down("nm,black", times=100),
        "Messart;Reflexion [%]\n" + down("nm;black", ";", times=100),
        across("Probe,Reflexion [%]", "black,", times=100),
        across("Wavelength (nm)", "Reflectance (%)", times=100),
        across("nm", "%R", times=100),
        across("nm", "R_pct", times=100),
    ],
)
def test_percent_in_a_mode_over_the_bands_or_in_the_name_of_a_row(tmp_path, text):
    [sample] = read(tmp_path, text)
    assert is_ramp(sample)


def test_a_row_that_is_called_by_a_standard_of_some_percent_is_no_percent(tmp_path):
    samples = read(tmp_path, across("name", "50% reflectance standard", "99 % R", "brick"))
    assert all(map(is_ramp, samples))


@pytest.mark.parametrize(
    ("above", "instrument"),
    [
        ("Geometría: esfera integradora, d/8\nComponente especular: excluido\n", "de:8"),
        ("# Medición: componente especular incluida\n", "di:8"),
        ("# componente speculare esclusa, sfera integratrice\n", "de:8"),
        ("Componente speculare;inclusa\n", "di:8"),
        ("Equipamento: CM-700d, componente especular excluída\n", "de:8"),
        ("# d/8, зеркальная составляющая исключена\n", "de:8"),
        ("Прибор: CM-700d\nРежим: SCE\n", "de:8"),
        ("仪器: CM-700d\n镜面反射: 不包含\n", "de:8"),
        ("# d/8 包含镜面光\n", "di:8"),
        ("# 积分球, 不含镜面反射\n", "de:8"),
        ("Messgeometrie: d/8\nGlanz: aus\n", "de:8"),
        ("# GretagMacbeth Color-Eye 7000A\n", "di:8"),
        ("Instrument: Datacolor SF600\n", "di:8"),
        ("# Datacolor Spectro 1050\n", "di:8"),
        ("# BYK spectro-guide sphere\n", "di:8"),
        ("Instrument: X-Rite 964\n", "0:45a"),
    ],
)
def test_geometry_in_more_languages_and_of_more_devices(tmp_path, above, instrument):
    [sample] = read(tmp_path, above + down("nm;x", ";"))
    assert sample.instrument == instrument
    assert sample.device or not any("device" in note for note in sample.notes)


@pytest.mark.parametrize(
    "head",
    [
        "Nombre,Instrumento,Geometría,Componente especular",
        "Nome,Strumento,Geometria,Speculare",
        "Образец,Прибор,Геометрия,Specular",
        "样品名称,仪器,光学结构,镜面反射",
    ],
)
def test_columns_in_more_languages(tmp_path, head):
    [sample] = read(tmp_path, across(head, "Tile,CM-700d,d/8,SCE"))
    assert (sample.name, sample.device, sample.instrument) == ("Tile", "CM-700d", "de:8")


@pytest.mark.parametrize("device", ["X-Rite MA-T6", "BYK-mac i", "byk mac i", "CM-M6"])
def test_a_multi_angle_device_counts_in_a_comment_as_by_its_key(tmp_path, device):
    for above in (f"# measured with {device}\n", f"Instrument: {device}\n"):
        [sample] = read(tmp_path, above + down("nm,x"))
        assert any("several angles" in note for note in sample.notes), above
        [sample] = read(tmp_path, above + down("nm,x 15°,x 45°"))
        assert [s.instrument for s in sample.readings] == ["45as45", "45as15"], above


@pytest.mark.parametrize(
    "axis",
    [
        "Wellenlänge (nm)",
        "longueur d'onde (nm)",
        "longitud de onda",
        "lunghezza d'onda [nm]",
        "comprimento de onda",
        "длина волны, нм",
        "波長(nm)",
        "波长",
        "Wellenzahl (cm-1)",
    ],
)
def test_wavelengths_need_not_stand_first_in_any_language(tmp_path, axis):
    rows = [f"{1e7 / nm if 'cm-1' in axis else nm};{v}" for nm, v in zip(NM, VALUES, strict=True)]
    down_rows = "\n".join(f"{i};{row}" for i, row in enumerate(rows))
    [sample] = read(tmp_path, f"No;{axis};tile\n{down_rows}\n")
    assert sample.wavelengths == pytest.approx(NM)
    assert sample.values == pytest.approx(VALUES)
    long = "\n".join(f"tile;{row}" for row in rows)
    [sample] = read(tmp_path, f"Probe;{axis};Reflexion\n{long}\n")
    assert (sample.name, sample.wavelengths.tolist()) == ("tile", pytest.approx(list(NM)))


@pytest.mark.parametrize(
    ("head", "before", "behind"),
    [
        ("material,wavelength,R_pct", "{}", ""),
        (",species,lambda_nm,refl", "{i},{}", ""),
        ("wavelength,value,variable", "", "{}"),
    ],
)
def test_names_of_long_tables_by_the_only_column_of_words(tmp_path, head, before, behind):
    times = 100 if "pct" in head else 1
    rows = []
    for name in ("oak", "elm"):
        for i, (nm, value) in enumerate(zip(NM, VALUES, strict=True)):
            cells = [before.format(name, i=i), f"{nm},{value * times}", behind.format(name)]
            rows.append(",".join(filter(None, cells)))
    samples = read(tmp_path, "\n".join([head, *rows]))
    assert [sample.name for sample in samples] == ["oak", "elm"]
    assert all(map(is_ramp, samples))


def test_a_long_table_with_a_mode(tmp_path):
    rows = [f"{mode},{nm},{v}" for mode in ("SCI", "SCE") for nm, v in zip(NM, VALUES, strict=True)]
    [sample] = read(tmp_path, "mode,wl,refl\n" + "\n".join(rows))
    assert [s.instrument for s in sample.readings] == ["de:8", "di:8"]


def names_and_instruments(samples):
    return [(sample.name, [s.instrument for s in sample.readings]) for sample in samples]


@pytest.mark.parametrize(
    "top",
    [
        ",Tile A,,Tile B,\nnm,SCI,SCE,SCI,SCE",
        "Sample,Tile A,,Tile B,\nnm,SCI,SCE,SCI,SCE",
        ",Tile A,Tile A,Tile B,Tile B\n,SCI,SCE,SCI,SCE\nwavelength,,,,",
        "Sample,Tile A,Tile A,Tile B,Tile B\nGlanz,ein,aus,ein,aus\nWellenlänge,,,,",
        "Specular,SCI,SCE,SCI,SCE\nnm,Tile A,Tile A,Tile B,Tile B",
    ],
)
def test_rows_above_the_names_are_about_their_columns(tmp_path, top):
    rows = down(None).replace("\n", "#").strip("#").split("#")
    values = [row.split(",") for row in rows]
    text = "\n".join([top, *(f"{nm},{v},{v},{v},{v}" for nm, v in values)])
    found = names_and_instruments(read(tmp_path, f"Instrument,CM-700d,,,\n{text}"))
    assert found == [("Tile A", ["de:8", "di:8"]), ("Tile B", ["de:8", "di:8"])]


def test_one_cell_beside_a_key_is_about_the_whole_table(tmp_path):
    samples = read(tmp_path, "Specular,SCE,,\n" + down("nm,a tile,b tile,c tile"))
    assert names_and_instruments(samples) == [(f"{c} tile", ["de:8"]) for c in "abc"]


@pytest.mark.parametrize(
    ("name", "instrument"),
    [
        ("brick_SCE.csv", "de:8"),
        ("brick SCI.csv", "di:8"),
        ("brick (d8 SCE).csv", "de:8"),
        ("tile_CM-700d.csv", "di:8"),
        ("paint_45as15.csv", "45as15"),
        ("tile specular excluded.csv", "de:8"),
    ],
)
def test_a_geometry_in_the_name_of_the_file_counts_where_nothing_else_says_one(
    tmp_path, name, instrument
):
    samples = read(tmp_path, down("nm,a tile,b tile"), name)
    assert [sample.instrument for sample in samples] == [instrument] * 2
    for sample in samples:
        assert "file's name" in sample.notes[0]
        assert "is assumed" not in " ".join(sample.notes)
    [sample] = read(tmp_path, down("nm,reflectance"), name)
    assert sample.instrument == instrument
    [sample] = read(tmp_path, "Geometry: 0:45\n" + down("nm,tile"), name)
    assert sample.instrument == "0:45a"


@pytest.mark.parametrize(
    "name", ["sci-fi poster.csv", "D8.csv", "top spin.csv", "color 2024-45-10.csv"]
)
def test_names_of_files_that_say_no_geometry(tmp_path, name):
    [sample] = read(tmp_path, down("nm,tile"), name)
    assert sample.instrument == "45a:0"
    assert any("is assumed" in note for note in sample.notes)


@pytest.mark.parametrize("label", ["SCE", "Spec. Excl.", "Specular Excluded (%)", "R SPEX"])
def test_a_column_named_by_its_specular_component_alone(tmp_path, label):
    [sample] = read(tmp_path, down(f"nm,{label}", times=100 if "%" in label else 1))
    assert (sample.instrument, sample.specular) == ("de:8", "SCE")


@pytest.mark.parametrize(
    "below",
    [
        "\nInstrument,CM-700d\nGeometry,d/8\nSpecular,SCE\n",
        "Instrument: CM-700d\nMode: SCE\n",
        ",,\nMeasured on Tuesday,,\nSpecular component,excluded,\n",
        "\n\n##### Extended Information\n[Comments]\nAccessory: integrating sphere, SCE\n",
    ],
)
@pytest.mark.parametrize("table", [down("nm,a tile"), across("name", "a tile")])
def test_what_stands_below_a_table_is_read_as_what_stands_above(tmp_path, table, below):
    [sample] = read(tmp_path, table + below)
    assert is_ramp(sample)
    assert (sample.name, sample.instrument) == ("a tile", "de:8")


def test_statistics_below_a_table_are_no_part_of_it_and_what_is_damaged_still_is(tmp_path):
    [sample] = read(tmp_path, down("nm,a tile") + "\nmin,0.1\nmax,0.7\n")
    assert is_ramp(sample)
    assert "'average' is not a number" in refusal(tmp_path, down("nm,a tile") + "average,0.4\n")
    assert "line 3" in refusal(tmp_path, across("name", "a tile") + "b tile,0.1\n")
    assert len(read(tmp_path, across("name", "a tile") + "\n" + across("name", "b tile"))) == 2


def test_names_of_columns_that_are_repeated_are_no_row(tmp_path):
    a, b = across("name", "a tile"), across("name", "b tile")
    assert [sample.name for sample in read(tmp_path, a + b)] == ["a tile", "b tile"]


def test_what_comments_say_of_mode_light_and_name(tmp_path):
    above = (
        "# Sample: Red brick\n# device: CM-700d\n# mode: SCE\n# illuminant: D50\n# observer: 10\n"
    )
    [sample] = read(tmp_path, above + down("nm,reflectance"))
    told = (sample.name, sample.instrument, sample.illuminant, sample.observer)
    assert told == ("Red brick", "de:8", "D50", 10)
    [sample] = read(tmp_path, "# measurement mode: M1\n" + down("nm,a tile"))
    assert (sample.name, sample.condition) == ("a tile", "M1")


def test_units_behind_numbers(tmp_path):
    rows = [(f"{nm} nm", f"{100 * v:.0f} %") for nm, v in zip(NM, VALUES, strict=True)]
    for head in ("Wavelength,R", "band,R", "Wavelength (nm),R (%)"):
        [sample] = read(tmp_path, "\n".join([head, *map(",".join, rows)]))
        assert is_ramp(sample)
    [sample] = read(tmp_path, "\n".join(["nm;R", *(f"{a};{b}".replace(" ", "") for a, b in rows)]))
    assert is_ramp(sample)
    values = ",".join(value for _, value in rows)
    [sample] = read(tmp_path, f"name,{','.join(map(str, NM))}\ntile,{values}\n")
    assert is_ramp(sample)


def test_percent_signs_behind_some_numbers_only_or_against_a_comment_are_refused(tmp_path):
    rows = down("nm,R").replace("0.3000", "30%")
    assert "others have none" in refusal(tmp_path, rows)
    text = down("nm,R", times=100, cell="{:.0f}%")
    assert "fraction" in refusal(tmp_path, "# units: fraction\n" + text)


@pytest.mark.parametrize("mark", [",", " "])
def test_row_names_that_r_writes_without_a_name_above(tmp_path, mark):
    rows = down("wavelength" + mark + "reflectance", mark).strip().split("\n")
    numbered = [rows[0], *(f'"{i}"{mark}{row}' for i, row in enumerate(rows[1:], start=1))]
    text = "\n".join(numbered)
    [sample] = read(tmp_path, text if mark == "," else text.replace('"', ""))
    assert is_ramp(sample)


@pytest.mark.parametrize("filled", ["-1.23e+34", "-1.23E34", "3.4e38"])
def test_what_stands_for_no_value_in_remote_sensing(tmp_path, filled):
    [sample] = read(tmp_path, down("nm,R").replace("0.3000", filled))
    assert sample.wavelengths.tolist() == [nm for nm in NM if nm != 500]
    assert "500 nm" in sample.altered[0]


def test_a_merged_name_is_that_of_all_its_rows(tmp_path):
    text = across("Name,Angle", "Car,15", ",45", ",110", "Door,15", ",45", ",110")
    found = read(tmp_path, text)
    assert [sample.name for sample in found] == ["Car", "Door"]
    assert {s.instrument for s in found[0].readings} == {"45as15", "45as45", "45as110"}
    [tile] = read(tmp_path, across("Name,Mode", "Tile,SCI", ",SCE"))
    assert [tile.name, *(s.instrument for s in tile.readings)] == ["Tile", "de:8", "di:8"]


@pytest.mark.parametrize("mark", [",", ";", "\t"])
def test_comments_and_lines_below_with_cells_of_a_spreadsheet(tmp_path, mark):
    cells = f"Geometry{mark}d/8{mark}{mark}\nSCI/SCE{mark}SCE{mark}\n"
    table = down(mark.join(["nm", "a tile"]), mark)
    for text in ("# " + cells.replace("\nSCI", "\n# SCI") + table, table + mark * 3 + "\n" + cells):
        [sample] = read(tmp_path, text)
        assert (sample.instrument, sample.geometry, sample.specular) == ("de:8", "d/8", "SCE")


@pytest.mark.parametrize("value", ["A", "Abs", "T"])
def test_an_ordinate_by_its_letter(tmp_path, value):
    assert "line 1" in refusal(tmp_path, f"Ordinate mode: {value}\n" + down("nm,x"))


def test_wavelengths_once_more_in_another_unit_are_no_sample(tmp_path):
    rows = [f"{1e7 / nm:.3f},{nm},{v}" for nm, v in zip(NM, VALUES, strict=True)]
    [sample] = read(tmp_path, "\n".join(["wavenumber (cm-1),wavelength (nm),R", *rows]))
    assert sample.wavelengths == pytest.approx(NM, rel=1e-4)
    assert any("Columns not read: wavelength (nm)" in note for note in sample.notes)
    pairs = [f"{nm},{v},{nm + 5},{v}" for nm, v in zip(NM, VALUES, strict=True)]
    sentence = refusal(tmp_path, "\n".join(["Wavelength,brick,Wavelength,slate", *pairs]))
    assert "wavelengths once more" in sentence
    assert "white" not in sentence
