# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever geometry a table states, in whichever place, reaches each of its samples."""

from pathlib import Path

import pytest
from rough_spectra.addon.samples import readers, sets
from rough_spectra.core.errors import InputError

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "delimited"
NM = (400, 450, 500, 550, 600, 650, 700)
BANDS = ",".join(f"{nm} nm" for nm in NM)
SPHERES = {"di:8": 0.3, "de:8": 0.32}


def values(level):
    return ",".join(f"{level + 0.01 * i:.2f}" for i in range(len(NM)))


def table(head, *rows, above=""):
    """Rows whose level is 0.30, 0.32 and so on."""
    lines = [f"{row},{values(0.3 + 0.02 * i)}" for i, row in enumerate(rows)]
    return above + "\n".join([f"{head},{BANDS}", *lines]) + "\n"


def down(head):
    columns = head.count(",")
    rows = (",".join([str(nm), *(f"{0.3 + 0.02 * i:.2f}" for i in range(columns))]) for nm in NM)
    return "\n".join([head, *rows]) + "\n"


def read(tmp_path, text):
    path = tmp_path / "tiles.csv"
    path.write_text(text, encoding="utf-8")
    return readers.read(path)


def levels(samples):
    return {s.instrument: float(s.values[0]) for sample in samples for s in sample.readings}


def test_several_devices_in_rows():
    [tile] = readers.read(FOLDER / "instruments-in-rows.csv")
    told = {s.instrument: (s.device, s.specular, float(s.values[0])) for s in tile.readings}
    assert told == {
        "45a:0": ("Ring Q", "", 0.058),
        "di:8": ("Sphere Q", "SCI", 0.1),
        "de:8": ("Sphere Q", "SCE", 0.06),
        "45as15": ("BYK-mac i", "", 0.15),
        "45as110": ("BYK-mac i", "", 0.064),
    }
    assert tile.gloss == ((60.0, 9.5),)


@pytest.mark.parametrize("file", ["one-number-a-row.csv", "bands-sci-sce.csv"])
def test_sphere_files_of_other_layouts(file):
    [tile] = readers.read(FOLDER / file)
    assert (tile.name, levels([tile])) == ("Tile", {"di:8": 0.1, "de:8": 0.06})
    assert [s.wavelengths.tolist() for s in tile.readings] == [[400, 460, 520, 580, 640, 700]] * 2


@pytest.mark.parametrize(
    "text",
    [
        table("name,mode", "T,SCI", "T,SCE"),
        table("name,Specular (component)", "T,SCI", "T,SCE"),
        table("name,specular included", "T,yes", "T,no"),
        table("name,SCE", "T,false", "T,true"),
        table("name,Geometry (CIE)", "T,di:8°", "T,de:8°"),
        table("name,measurement mode", "T,d/8 SCI", "T,d/8 SCE"),
        table("name,instrument", "T,di:8", "T,de:8"),
        table("name,instrument", "T,di:8", "T,de:8", above="# instrument: di:8, de:8\n"),
        table("name,instrument", "T,di:8", "T,de:8", above="# instrument: 45a:0\n"),
        table("name", "T (d/8 SCI)", "T (d/8 SCE)"),
        table("name", "T di:8", "T de:8"),
        down("wavelength,di:8,de:8"),
    ],
)
def test_spheres(tmp_path, text):
    [sample] = read(tmp_path, text)
    assert levels([sample]) == SPHERES
    assert all(s.specular == {"di:8": "SCI", "de:8": "SCE"}[s.instrument] for s in sample.readings)
    assert sample.device == ""


@pytest.mark.parametrize(
    "text",
    [
        table("name,geometry", "Car,15", "Car,45", "Car,110"),
        table("name,view angle (deg)", "Car,45as15", "Car,45as45", "Car,45as110"),
        f"name,{','.join(f'{nm} nm (45as{a})' for a in (15, 45, 110) for nm in NM)}\n"
        f"Car,{values(0.3)},{values(0.32)},{values(0.34)}\n",
        f"name,{','.join(f'{nm}nm {a}°' for a in (15, 45, 110) for nm in NM)}\n"
        f"Car,{values(0.3)},{values(0.32)},{values(0.34)}\n",
        "angle,wavelength,value\n"
        + "".join(
            f"{a},{nm},{0.3 + 0.02 * i:.2f}\n" for i, a in enumerate((15, 45, 110)) for nm in NM
        ),
    ],
    ids=["numbers", "view angle", "bands 45as", "bands degrees", "one number a row"],
)
def test_angles(tmp_path, text):
    [sample] = read(tmp_path, text)
    assert levels([sample]) == pytest.approx({"45as15": 0.3, "45as45": 0.32, "45as110": 0.34})
    assert all(map(sets.is_exact, sample.readings))


def test_both_angles_of_a_goniometer(tmp_path):
    [sample] = read(tmp_path, table("name,light angle,detector angle", "T,45,0", "T,45,30"))
    assert sample.instrument == "45x:0"
    [other] = sample.others
    assert not sets.is_exact(other)
    assert "45:30" in sets.label(other), "and not 45°a:0°, as which it is computed"
    assert "45:30" in sample.notes[0]
    assert any("not among the instruments" in note for note in sets.sentences(sample))
    [half] = read(tmp_path, table("name,light angle", "T,30"))
    assert any("light at 30" in note and "assumed" in note for note in half.notes)


@pytest.mark.parametrize(
    "above",
    [
        "# measured with an integrating sphere, d/8, specular included\n",
        "measured with a sphere (d:8, SCI)\n",
        "# device: CM-700d\n# SCI\n",
        "# instrument: Konica Minolta CM-700d\n# specular: SCI\n",
    ],
)
def test_free_text_and_devices_count(tmp_path, above):
    [sample] = read(tmp_path, table("name", "T", above=above))
    assert (sample.instrument, sample.specular, sample.notes) == ("di:8", "SCI", ())


@pytest.mark.parametrize(
    ("above", "instrument"),
    [
        *(("# Tiles, SCI\n", "di:8"), ("Wall: by hand, SCE\n", "de:8")),
        *(("# SCI-FI posters\n", "45a:0"), ("Wall: SPIN-COATED\n", "45a:0")),
    ],
)
def test_a_sphere_that_follows_from_a_word_is_told(tmp_path, above, instrument):
    [sample] = read(tmp_path, table("name", "T", above=above))
    assert sample.instrument == instrument
    [note] = sample.notes
    if instrument == "45a:0":
        assert "assumed" in note
    else:
        words = above.strip("# \n")
        assert f"{sample.specular}, follows from {words!r}" in note
    [sample] = read(tmp_path, table("name,specular", "T,SCE", above=above))
    assert (sample.instrument, sample.notes) == ("de:8", ()), "the row's own, and not the word's"


@pytest.mark.parametrize("above", ["# made on 24/8 at 0:45\n", "# ratio 1/2, speci men, 3d/8x\n"])
def test_dates_and_ratios_are_no_geometry(tmp_path, above):
    samples = read(tmp_path, table("name", "T 1/2", "U (3/8)", "V 45", above=above))
    assert [(s.name, s.instrument, s.geometry) for s in samples] == [
        (name, "45a:0", "") for name in ("T 1/2", "U (3/8)", "V 45")
    ]


def test_what_a_device_leaves_open_is_told(tmp_path):
    rows = ("T,CM-700d", "U,BYK-mac i", "V,X-Rite eXact")
    sphere, angles, ring = read(tmp_path, table("name,device", *rows))
    assert sphere.instrument == "di:8"
    assert any("whether specular light is included" in note for note in sphere.notes)
    assert angles.instrument == "45a:0"
    assert any("several angles" in note and "assumed" in note for note in angles.notes)
    assert ring.instrument == "45a:0"
    assert any("geometry 45/0 is that of the device" in note for note in ring.notes)
    [both] = read(tmp_path, table("name,specular component", "T,SCI+SCE"))
    assert (both.instrument, both.specular) == ("di:8", "")
    assert any("whether specular light is included" in note for note in both.notes)


def test_a_row_counts_more_than_a_comment(tmp_path):
    above = "# device: eXact\n# geometry: 45/0\n"
    first, second = read(
        tmp_path, table("name,device,geometry", "T,Q,d/8 SCI", "U,,-", above=above)
    )
    assert (first.device, first.instrument) == ("Q", "di:8")
    assert (second.device, second.instrument, second.geometry) == ("eXact", "45a:0", "45/0")


def test_one_number_a_row_keeps_faults_at_their_line(tmp_path):
    head = "name,geometry,wavelength,reflectance\n"
    with pytest.raises(readers.InputError, match="line 3"):
        read(tmp_path, head + "T,d/8,400,0.1\nT,d/8,400,0.2\n")
    with pytest.raises(readers.InputError, match="line 3, column 'reflectance'"):
        read(tmp_path, head + "T,d/8,400,0.1\nT,d/8,410,high\n")
    plain = read(tmp_path, "wavelength,sample,reflectance\n400,1,0.5\n500,1,0.6\n")
    assert [s.values.tolist() for s in plain] == [[0.5, 0.6]], "raw counts beside the reflectance"


@pytest.mark.parametrize(
    ("words", "instrument"),
    [
        *(("d:8i", "di:8"), ("d:8e", "de:8"), ("D/8° (SCI)", "di:8"), ("diffuse/8 SPEX", "de:8")),
        *(
            ("SPIN", "di:8"),
            ("SPEX", "de:8"),
            ("RSIN", "di:8"),
            ("RSEX", "de:8"),
            ("SCI方式", "di:8"),
        ),
        *(("mit Glanz", "di:8"), ("ohne Glanz", "de:8"), ("Glanz eingeschlossen", "di:8")),
        *(("Glanzfalle", "de:8"), ("spéculaire inclus", "di:8"), ("正反射光除去", "de:8")),
        *(("spec. excl.", "de:8"), ("specular not included", "de:8"), ("Ulbricht", "di:8")),
        *(
            ("as110", "45as110"),
            ("aspecular 25", "45as25"),
            ("r45as25", "45as25"),
            ("45c:0", "45a:0"),
        ),
    ],
)
@pytest.mark.parametrize(
    "layout", ["# geometry: {}", "Geometry,{}", "# measured {}", "brick ({})", "Mode,{}"]
)
def test_makers_words_in_their_spellings_and_languages(tmp_path, words, instrument, layout):
    said = layout.format(words)
    if layout.startswith("brick"):
        text = down(f"wavelength,{said}")
    else:
        text = f"{said}\n" + down("wavelength,brick")
    [sample] = read(tmp_path, text)
    assert sample.instrument == instrument


def test_what_is_not_stated_is_named(tmp_path):
    [sample] = read(tmp_path, down("wavelength,brick"))
    assert sample.notes == ("The file does not say the geometry; 45°a:0° is assumed.",)
    [sample] = read(tmp_path, down("# instrument: 45a:0\nwavelength,brick"))
    assert sample.notes == ()
    [sample] = read(tmp_path, down("# kind: albedo\nwavelength,brick"))
    assert sample.notes == ()


@pytest.mark.parametrize(
    "head",
    ["Probe,Messgeometrie", "échantillon,géométrie", "試料名,光学系", "name,Glanz", "name,正反射"],
)
def test_columns_in_other_languages(tmp_path, head):
    rows = ("Wand,d/8 SCE", "Putz,d/8 SCI")
    if head.startswith("name"):
        rows = tuple(row.replace("d/8 ", "") for row in rows)
    wall, plaster = read(tmp_path, table(head, *rows))
    assert (wall.name, wall.instrument) == ("Wand", "de:8")
    assert (plaster.name, plaster.instrument) == ("Putz", "di:8")


@pytest.mark.parametrize(
    ("above", "device", "instrument"),
    [
        ("# Konica Minolta CM-26d\n", "CM-26d", "di:8"),
        ("# measured by X-Rite i1Pro 2\n", "i1Pro", "45a:0"),
        ("# Spectrophotometer: Ci7800, SPEX\n", "Ci7800, SPEX", "de:8"),
        ("# Instrument: HunterLab LabScan XE\n", "HunterLab LabScan XE", "0:45a"),
        ("# the exact color of 5 walls\n", "", "45a:0"),
    ],
)
def test_a_device_counts_wherever_it_is_named(tmp_path, above, device, instrument):
    [sample] = read(tmp_path, above + down("wavelength,brick"))
    assert (sample.device, sample.instrument) == (device, instrument)


def test_columns_of_angles_alone_and_of_makers_marks(tmp_path):
    [car] = read(tmp_path, down("wavelength,-15,15,25,45,75,110"))
    assert {s.instrument for s in car.readings} == {f"45as{a}" for a in (-15, 15, 25, 45, 75, 110)}
    assert len(read(tmp_path, down("wavelength,15,25,45"))) == 3, "may be samples 15, 25 and 45"
    [car] = read(tmp_path, down("wavelength,car r45as15,car r45as110"))
    assert levels([car]) == {"45as15": 0.3, "45as110": 0.32}
    [tile] = read(tmp_path, down("wavelength,Tile RSIN,Tile RSEX"))
    assert (tile.name, levels([tile])) == ("Tile", SPHERES)


def test_a_name_tells_the_condition(tmp_path):
    assert [s.condition for s in read(tmp_path, down("wavelength,T M0,T (M1)"))] == ["M0", "M1"]


CGATS = """CGATS.17
{}
NUMBER_OF_FIELDS 9
BEGIN_DATA_FORMAT
SAMPLE_ID SAMPLE_NAME {}
END_DATA_FORMAT
NUMBER_OF_SETS 1
BEGIN_DATA
1 brick {}
END_DATA
"""


@pytest.mark.parametrize(
    ("keys", "instrument"),
    [
        *(('SPECULAR "excluded"', "de:8"), ("# geometry: d/8 SCE", "de:8")),
        *(('INSTRUMENTATION "CM-26d SCE"', "de:8"), ('INSTRUMENTATION "CM-26d"', "di:8")),
        *(('DESCRIPTOR "brick, 45as25"', "45as25"), ('INSTRUMENT_GEOMETRY "45as15"', "45as15")),
        ('MEASUREMENT_GEOMETRY "0/45"\nDESCRIPTOR "unlike SCE"', "0:45a"),
    ],
)
def test_keywords_and_remarks_of_cgats(tmp_path, keys, instrument):
    names = " ".join(f"SPECTRAL_NM{nm}" for nm in NM)
    text = CGATS.format(keys, names, values(0.3).replace(",", " "))
    [sample] = read(tmp_path, text)
    assert sample.instrument == instrument
    assert not any("does not say the geometry" in note for note in sample.notes)
    [sample] = read(tmp_path, text.replace(keys, 'MEASUREMENT_MODE "M1"\nUNITS "percent"'))
    assert (sample.condition, sample.values[0]) == ("M1", 0.003)
    with pytest.raises(InputError, match="absorbance"):
        read(tmp_path, text.replace(keys, 'MEAS_TYPE "Absorbance"'))


@pytest.mark.parametrize(
    ("labels", "instrument"),
    [
        ("##SPECTROMETER/DATA SYSTEM=CM-700d, SCE", "de:8"),
        ("##INSTRUMENTAL PARAMETERS=d/8 SPIN", "di:8"),
        ("$$ measured with d/8 SCE", "de:8"),
        ("##$GEOMETRY=0/45", "0:45a"),
        ("##COMMENTS=specular excluded, d/8", "de:8"),
        ("##SAMPLING PROCEDURE=45as110\n##COMMENTS=not SCE", "45as110"),
    ],
)
def test_labels_and_remarks_of_jcamp(tmp_path, labels, instrument):
    points = "\n".join(f"{nm}, 0.3" for nm in NM)
    head = f"##TITLE=brick\n##JCAMP-DX=4.24\n{labels}\n##XUNITS=NANOMETERS\n##YUNITS=REFLECTANCE"
    [sample] = read(tmp_path, f"{head}\n##XYPOINTS=(XY..XY)\n{points}\n##END=\n")
    assert sample.instrument == instrument
    assert not any("does not say the geometry" in note for note in sample.notes)


def test_the_device_of_any_format_counts_and_nothing_counts_as_45_0_in_silence(tmp_path):
    lines = "STD_NAME=brick\nSTD_REFLPOINTS=7\nSTD_REFLLOW=400\nSTD_REFLINTERVAL=50\n"
    text = f"[STANDARD_DATA 0]\n{lines}STD_R={values(30)}\nSTD_INSTRUMENT=CM-700d\n"
    [sample] = read(tmp_path, text)
    assert (sample.instrument, sample.device) == ("di:8", "CM-700d")
    [sample] = read(tmp_path, text.replace("CM-700d", "CM-700d SCE"))
    assert sample.instrument == "de:8"
    [sample] = read(tmp_path, text.replace("CM-700d", "Q 1"))
    assert sample.notes == ("The file does not say the geometry; 45°a:0° is assumed.",)
    [sample] = read(tmp_path, "Brick,,\nWavelength (nm),%R,\n400,30,\n500,30,\n")
    assert sample.notes == ("The file does not say the geometry; 45°a:0° is assumed.",)


def test_a_range_or_a_factor_tells_the_scale_and_per_mille_is_refused(tmp_path):
    for label in ("R (0-100)", "R x100"):
        [sample] = read(tmp_path, down(f"wavelength,{label}"))
        assert sample.values[0] == 0.003
    with pytest.raises(InputError, match="per mille"):
        read(tmp_path, down("wavelength,R (‰)"))
