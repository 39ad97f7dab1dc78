# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of one surface become one sample, and nothing that a file states is lost by that."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rough_spectra.addon.samples import readers, sets
from rough_spectra.addon.samples.readers.parts import joining, name_marks
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.core.instruments import REGISTRY

NM = (400, 450, 500, 550, 600, 650, 700)
HEAD = ",".join(f"{nm} nm" for nm in NM)
ANGLES = (-15, 15, 25, 45, 75, 110)


def row(level):
    return ",".join(f"{level + 0.01 * i:.2f}" for i in range(len(NM)))


def values(level):
    return [round(level + 0.01 * i, 2) for i in range(len(NM))]


def read(tmp_path, text):
    path = tmp_path / "tiles.csv"
    path.write_text(text, encoding="utf-8")
    return readers.read(path)


def table(*rows, head="name"):
    """A table of rows such as ``("Tile", 0.3)``: cells before the values, and their level."""
    lines = [f"{head},{HEAD}", *(f"{','.join(cells)},{row(level)}" for *cells, level in rows)]
    return "\n".join(lines) + "\n"


def told(sample):
    return [(s.instrument, s.specular, s.values.tolist()) for s in sample.readings]


SPHERE = [("de:8", "SCE", values(0.3)), ("di:8", "SCI", values(0.34))]


@pytest.mark.parametrize(
    "text",
    [
        table(("Tile(SCI)", 0.34), ("Tile(SCE)", 0.3)),
        table(("Tile SCE", 0.3), ("Tile SCI", 0.34)),
        table(("Tile_SPIN", 0.34), ("Tile_SPEX", 0.3)),
        table(("Tile", "SCI", 0.34), ("Tile", "SCE", 0.3), head="name,specular"),
        table(("Tile", "d/8 SCI", 0.34), ("Tile", "d/8 SCE", 0.3), head="name,geometry"),
        f"name,{HEAD.replace(' nm', ' nm(SCI)')},{HEAD.replace(' nm', ' nm(SCE)')}\n"
        f"Tile,{row(0.34)},{row(0.3)}\n",
        f"name,{','.join(f'{nm} SPIN,{nm} SPEX' for nm in NM)}\n"
        f"Tile,{','.join(f'{a},{b}' for a, b in zip(values(0.34), values(0.3), strict=True))}\n",
        "wavelength,Tile SCI,Tile SCE\n"
        + "\n".join(f"{nm},{0.34 + 0.01 * i:.2f},{0.3 + 0.01 * i:.2f}" for i, nm in enumerate(NM)),
    ],
    ids=[
        *("brackets", "suffix", "spin", "column", "geometry", "bands", "interleaved bands", "down")
    ],
)
def test_sci_and_sce_are_one_sample(tmp_path, text):
    [sample] = read(tmp_path, text)
    assert sample.name == "Tile"
    assert told(sample) == SPHERE
    assert any("2 readings of one surface" in note and "de:8°" in note for note in sample.notes)


def test_bands_in_blocks_may_come_in_any_order(tmp_path):
    """As Minolta's software writes them; each block falls or rises by itself."""
    head = ",".join([f"{nm} nm(SCE)" for nm in NM] + [f"{nm} nm(SCI)" for nm in reversed(NM)])
    cells = [*values(0.3), *reversed(values(0.34))]
    samples = read(tmp_path, f"name,{head}\nTile,{','.join(map(str, cells))}\n")
    assert [told(sample) for sample in samples] == [SPHERE]


@pytest.mark.parametrize(
    "text",
    [
        table(*((f"Car {angle}°", 0.3 + i / 100) for i, angle in enumerate(ANGLES))),
        table(*((f"Car 45as{angle}", 0.3 + i / 100) for i, angle in enumerate(ANGLES))),
        table(*((f"Car (as{angle})", 0.3 + i / 100) for i, angle in enumerate(ANGLES))),
        table(
            *(("Car", str(angle), 0.3 + i / 100) for i, angle in enumerate(ANGLES)),
            head="name,angle",
        ),
        table(
            *(("Car", f"{angle}°", 0.3 + i / 100) for i, angle in enumerate(ANGLES)),
            head="name,aspecular angle",
        ),
        table(
            *(("Car", f"45as{angle}", 0.3 + i / 100) for i, angle in enumerate(ANGLES)),
            head="name,geometry",
        ),
    ],
    ids=["degrees", "45as", "as in brackets", "angle", "aspecular", "geometry"],
)
def test_the_angles_of_a_device_are_one_sample(tmp_path, text):
    [sample] = read(tmp_path, text)
    assert sample.name == "Car"
    assert sample.instrument == "45as45", "which is 45°/0°"
    assert {s.instrument: s.values[0] for s in sample.readings} == pytest.approx(
        {f"45as{angle}": 0.3 + i / 100 for i, angle in enumerate(ANGLES)}
    )
    assert all(map(sets.is_exact, sample.readings))


def test_angles_alone_are_the_names_of_columns(tmp_path):
    lines = [f"{nm},{','.join(str(0.3 + i / 10) for i in range(3))}" for nm in NM]
    [sample] = read(tmp_path, "wavelength,45as15,45as45,45as110\n" + "\n".join(lines))
    assert sample.name == "tiles"
    assert [s.instrument for s in sample.readings] == ["45as45", "45as15", "45as110"]


def test_a_device_tells_what_its_few_angles_are(tmp_path):
    rows = ("Car 15°", "BYK-mac i", 0.3), ("Car 45°", "BYK-mac i", 0.4)
    [sample] = read(tmp_path, table(*rows, head="name,device"))
    assert [s.instrument for s in sample.readings] == ["45as45", "45as15"]
    assert any("mirror direction" in note for note in sample.notes)


def test_45_0_makes_the_color_beside_a_sphere(tmp_path):
    rows = ("T", "d/8 SCI", 0.34), ("T", "45/0", 0.28), ("T", "d/8 SCE", 0.3)
    [sample] = read(tmp_path, table(*rows, head="name,geometry"))
    assert [s.instrument for s in sample.readings] == ["45a:0", "di:8", "de:8"]


def test_comments_say_how_all_were_measured(tmp_path):
    comments = "# geometry: d/8\n# specular: SCI\n# aperture: 8 mm\n# gloss 60: 8.5\n"
    [sample] = read(tmp_path, comments + table(("Tile", 0.3)))
    assert (sample.instrument, sample.specular, sample.geometry) == ("di:8", "SCI", "d/8")
    assert (sample.aperture, sample.gloss) == ("8 mm", ((60.0, 8.5),))
    # What is said of one sample counts more.
    rows = ("Tile", "SCI", 0.34), ("Tile", "SCE", 0.3)
    [sample] = read(tmp_path, "# geometry: 45/0\n" + table(*rows, head="name,specular"))
    assert told(sample) == SPHERE


def test_a_comment_may_name_the_device_as_instrument(tmp_path):
    rows = [(f"Car {angle}°", 0.3) for angle in (15, 45)]
    [sample] = read(tmp_path, "# instrument: BYK-mac i\n" + table(*rows))
    assert [s.instrument for s in sample.readings] == ["45as45", "45as15"]
    assert sample.device == "BYK-mac i"
    [sample] = read(tmp_path, "# instrument: de:8\n" + table(("Tile", 0.3)))
    assert (sample.instrument, sample.device) == ("de:8", "")


def test_smooth_belongs_to_the_rough_one(tmp_path):
    rows = ("T", "smooth", 0.4), ("T", "rough", 0.3)
    [sample] = read(tmp_path, table(*rows, head="name,surface"))
    assert [s.surface for s in sample.readings] == ["rough", "smooth"]
    three = read(tmp_path, table(*rows, ("T", "P80", 0.2), head="name,surface"))
    assert [sets.count(s) for s in three] == [1, 1, 1], "two roughnesses are two surfaces"


@pytest.mark.parametrize(
    ("head", "cells"),
    [
        ("Gloss 20°,Gloss 60°,Gloss 85°", "1.5,23.5,60"),
        ("20 GU,60° gloss [GU],GU85", "1.5,23.5 GU,60"),
        ("gloss_20,gloss (60 deg),85gloss", "1.5,23.5,60.0"),
    ],
)
def test_gloss_units_stand_beside_the_spectrum(tmp_path, head, cells):
    [sample] = read(tmp_path, table(("T", cells, 0.3), head=f"name,{head}"))
    assert sample.gloss == ((20.0, 1.5), (60.0, 23.5), (85.0, 60.0))
    assert sample.notes == ("The file does not say the geometry; 45°a:0° is assumed.",)


def test_gloss_without_an_angle_is_told(tmp_path):
    [sample] = read(tmp_path, table(("T", "23.5", 0.3), head="name,Gloss"))
    assert sample.gloss == ((60.0, 23.5),)
    assert any("60° is taken" in note for note in sample.notes)
    [sample] = read(tmp_path, table(("T", "included", 0.3), head="name,Gloss"))
    assert (sample.gloss, sample.specular) == ((), "SCI")


@pytest.mark.parametrize("cell", ["-3", "high", "1e9", "99999"])
def test_gloss_that_is_none_is_named_and_the_spectrum_kept(tmp_path, cell):
    [sample] = read(tmp_path, table(("T", cell, 0.3), head="name,Gloss 60"))
    assert sample.gloss == ()
    assert any(repr(cell) in note and "left out" in note for note in sample.notes)


@pytest.mark.parametrize(
    "text",
    [
        table(("T", 0.3), ("T", 0.4)),
        table(("T(SCI)", 0.3), ("T(SCI)", 0.4)),
        table(("T(SCI)", 0.3), ("T(SCE)", 0.2), ("T(SCE)", 0.25)),
        table(("T SCI", 0.3), ("U SCE", 0.2)),
        table(("Wall 15°", 0.3), ("Wall 45°", 0.4)),  # may be how far it was turned
        table(("Wall 10°", 0.3), ("Wall 20°", 0.4), ("Wall 30°", 0.5)),
        table(("Same as 3", 0.3), ("Same as 5", 0.4)),
        table(("Gray", 0.3), ("Gray (SCI)", 0.4)),
        table(("T", "foo", 0.3), ("T", "", 0.4), head="name,geometry"),
        table(("T(SCI)", "20", 0.3), ("T(SCE)", "30", 0.4), head="name,gloss 60"),
    ],
)
def test_what_is_not_clearly_a_set_stays_apart(tmp_path, text):
    samples = read(tmp_path, text)
    assert len(samples) == len(text.splitlines()) - 1
    assert all(not sample.others for sample in samples)


def test_a_name_in_brackets_tells_a_single_reading(tmp_path):
    [sample] = read(tmp_path, table(("Tile (SCI)", 0.34)))
    assert (sample.name, sample.instrument, sample.specular) == ("Tile (SCI)", "di:8", "SCI")
    [sample] = read(tmp_path, table(("Tile SCI", 0.34)))
    assert (sample.name, sample.instrument, sample.specular) == ("Tile SCI", "di:8", "SCI")
    [sample] = read(tmp_path, table(("Tile sci", 0.34)))
    assert (sample.name, sample.instrument, sample.specular) == ("Tile sci", "45a:0", "")


@pytest.mark.parametrize(
    ("name", "instrument"),
    [
        *((f"{name} SCI", "di:8") for name in ("RAL 9010", "WHITE TILE", "Tile")),
        *(("SCE_RAL 9010", "de:8"), ("Tile SCE 2", "de:8"), ("RAL 9010 SPIN", "di:8")),
        *(("SCI-FI POSTER SCE", "de:8"), ("Top SPIN", "di:8"), ("TOP SPIN (SPIN)", "di:8")),
        *((name, "45a:0") for name in ("SCI-FI POSTER", "Poster (SCI-FI)", "SCI FI POSTER")),
        *((name, "45a:0") for name in ("BLUE SCI\u2010FI", "Sci-Fi blue", "SCIENCE", "SCENE 2")),
        *((name, "45a:0") for name in ("TOP SPIN", "SPIN COATED PTFE", "SPIN-COATED", "RAL 9010")),
    ],
)
def test_a_word_in_capitals_is_a_mark_where_it_can_be_one_and_is_told(tmp_path, name, instrument):
    [sample] = read(tmp_path, table((name, 0.34)))
    assert (sample.name, sample.instrument) == (name, instrument)
    told = "it is not, state the geometry" if instrument != "45a:0" else "45°a:0° is assumed"
    assert any(told in note for note in sample.notes), "never without a word"
    [sample] = read(tmp_path, table((name, "45/0", 0.34), head="name,geometry"))
    assert (sample.instrument, sample.notes) == ("45a:0", ()), "the remedy that the note names"


def test_of_two_readings_any_such_word_is_a_mark(tmp_path):
    [sample] = read(tmp_path, table(("TOP SPIN", 0.34), ("TOP SPEX", 0.3)))
    assert (sample.name, told(sample)) == ("TOP", SPHERE)


def test_a_stated_geometry_is_not_overruled_by_a_name(tmp_path):
    rows = ("T (SCI)", "45/0", 0.3), ("T (SCE)", "45/0", 0.4)
    samples = read(tmp_path, table(*rows, head="name,geometry"))
    assert [(s.instrument, s.specular) for s in samples] == [("45a:0", ""), ("45a:0", "")]


def test_no_geometry_is_lost_that_no_instrument_has(tmp_path):
    """As of a MA-T12: six of its angles are of light at 15°."""
    rows = [("Car", f"{light}as{a}", 0.3) for light, a in ((45, 15), (45, 45), (15, 15), (15, 45))]
    [sample] = read(tmp_path, table(*rows, head="name,geometry"))
    assert [s.geometry for s in sample.readings] == ["45as45", "45as15", "15as15", "15as45"]
    assert [sets.is_exact(s) for s in sample.readings] == [True, True, False, False]
    assert sum("not among the instruments" in text for text in sets.sentences(sample)) == 2


CGATS = """CGATS.17
MEASUREMENT_GEOMETRY "d/8 {0}"
NUMBER_OF_FIELDS 4
BEGIN_DATA_FORMAT
SAMPLE_NAME NM400 NM500 NM700
END_DATA_FORMAT
NUMBER_OF_SETS 1
BEGIN_DATA
Tile {1} {1} {1}
END_DATA
"""


def test_two_tables_of_a_cgats_file(tmp_path):
    path = tmp_path / "tile.txt"
    path.write_text(CGATS.format("SCI", 0.34) + CGATS.format("SCE", 0.3))
    [sample] = readers.read(path)
    assert [(s.instrument, s.values[0]) for s in sample.readings] == [("de:8", 0.3), ("di:8", 0.34)]


def test_columns_of_a_cgats_table(tmp_path):
    path = tmp_path / "tile.txt"
    head, _, tail = CGATS.format("?", 0).partition('MEASUREMENT_GEOMETRY "d/8 ?"')
    tail = tail.replace("FIELDS 4", "FIELDS 6").replace("NAME NM400", "NAME {} {} NM400")
    tail = tail.replace("SETS 1", "SETS 2").replace("Tile 0 0 0", "{}\n{}")
    table = head + tail
    sphere = "SPECULAR", "GLOSS_60", "Tile SCI 8.5 .3 .3 .3", "Tile SCE - .2 .2 .2"
    path.write_text(table.format(*sphere))
    [sample] = readers.read(path)
    assert [(s.instrument, s.values[0]) for s in sample.readings] == [("de:8", 0.2), ("di:8", 0.3)]
    assert sample.gloss == ((60.0, 8.5),)
    assert not any("assumed" in note for s in sample.readings for note in s.notes)
    angles = "GEOMETRY", "SURFACE", "Car 45as15 - .3 .3 .3", "Car 45as110 - .2 .2 .2"
    path.write_text(table.format(*angles))
    [sample] = readers.read(path)
    assert [s.instrument for s in sample.readings] == ["45as110", "45as15"]


def specification(name, geometry):
    return (
        f'<cc:ColorSpecification Id="{name}"><cc:MeasurementSpec><cc:MeasurementType>'
        "Spectrum_Reflectance</cc:MeasurementType><cc:GeometryChoice>"
        f"{geometry}</cc:GeometryChoice>"
        '<cc:WavelengthRange StartWL="400" Increment="50"/></cc:MeasurementSpec>'
        "</cc:ColorSpecification>"
    )


def cxf(tmp_path, spectra, specifications):
    path = tmp_path / "measured.cxf"
    found = "".join(
        f'<cc:ReflectanceSpectrum Name="{name}" ColorSpecification="{of}">'
        f"{row(level).replace(',', ' ')}</cc:ReflectanceSpectrum>"
        for name, of, level in spectra
    )
    path.write_text(
        '<cc:CxF xmlns:cc="http://colorexchangeformat.com/CxF3-core"><cc:Resources>'
        f'<cc:ObjectCollection><cc:Object Name="Car" Id="c1"><cc:ColorValues>{found}'
        "</cc:ColorValues></cc:Object></cc:ObjectCollection><cc:ColorSpecificationCollection>"
        f"{specifications}</cc:ColorSpecificationCollection></cc:Resources></cc:CxF>"
    )
    return readers.read(path)


def test_the_specifications_of_a_cxf_object(tmp_path):
    sphere = "<cc:SphereGeometry>{}</cc:SphereGeometry>"
    specifications = specification("in", sphere.format("Specular_Included"))
    specifications += specification("out", sphere.format("Specular_Excluded"))
    [sample] = cxf(tmp_path, [("", "in", 0.34), ("", "out", 0.3)], specifications)
    assert sample.name == "Car"
    assert told(sample) == SPHERE


def test_the_angles_of_a_cxf_object(tmp_path):
    angles = "".join(
        f'<cc:Angle Notation="r{a}"><cc:IlluminationAngle>45</cc:IlluminationAngle>'
        f"<cc:Aspecular>{a}</cc:Aspecular><cc:Azimuth>0</cc:Azimuth></cc:Angle>"
        for a in ANGLES
    )
    specifications = specification("m", f"<cc:MultiAngle>{angles}</cc:MultiAngle>")
    spectra = [(f"r{a}", "m", 0.3 + i / 100) for i, a in enumerate(ANGLES)]
    [sample] = cxf(tmp_path, spectra, specifications)
    assert (sample.name, sample.instrument) == ("Car", "45as45")
    assert {s.instrument for s in sample.readings} == {f"45as{a}" for a in ANGLES}


QTX = "[{0}_DATA 0]\n{1}_NAME=Tile\n{1}_REFLLOW=400\n{1}_REFLINTERVAL=50\n{1}_VIEWING={2}\n"


def test_standard_and_batch_of_a_qtx_file(tmp_path):
    path = tmp_path / "tile.qtx"
    percent = ", ".join(str(100 * value) for value in values(0.3))
    path.write_text(
        QTX.format("STANDARD", "STD", "SCI")
        + f"STD_R= {percent}\n"
        + QTX.format("BATCH", "BAT", "SCE")
        + f"BAT_R= {percent}\n"
    )
    [sample] = readers.read(path)
    assert [s.specular for s in sample.readings] == ["SCE", "SCI"]


NAMES = st.sampled_from(["T", "T SCI", "T(SCE)", "T 15°", "T 45as45", "T as-15", "SCI", "15°", ""])
READINGS = st.builds(
    lambda name, instrument, geometry, specular, surface, position, condition, level: Sample(
        name,
        [400.0, 700.0],
        [level, level],
        "reading",
        instrument=instrument,
        geometry=geometry,
        specular=specular,
        surface=surface,
        position=position,
        condition=condition,
    ),
    NAMES | st.text(max_size=8),
    st.sampled_from(sorted(REGISTRY)),
    st.sampled_from(["", "45/0", "d/8", "45as15", "angle 15", "angle x"]) | st.text(max_size=8),
    st.sampled_from(["", "SCI", "SCE"]),
    st.sampled_from(["", "smooth", "rough"]),
    st.sampled_from(["", "line 1", "line 2"]),
    st.sampled_from(["", "M0"]),
    st.floats(0.0, 1.0),
)


@settings(deadline=None, max_examples=60)
@given(st.lists(READINGS, max_size=8))
def test_no_reading_is_lost_whatever_is_joined(samples):
    found = joining.joined(samples)
    spectra = [reading.values.tobytes() for sample in found for reading in sample.readings]
    assert sorted(spectra) == sorted(sample.values.tobytes() for sample in samples)
    assert all(sample.name or not any(r.name for r in sample.readings) for sample in found)


@given(st.text(max_size=60) | st.from_regex(r"\A[a-z (]{0,9}(SCI|45as15|15°)[)\]]?\Z"))
def test_a_mark_is_at_the_end_of_its_name(name):
    mark = name_marks.of_name(name)
    assert name.startswith(mark.base)
    of_band = name_marks.of_band(name)[1]
    known = name_marks.aspecular_of(of_band) is not None or name_marks.angle_of(of_band) is not None
    assert of_band in ("", "SCI", "SCE") or known


def test_wavelengths_may_differ_within_a_set():
    sce = Sample("T (SCE)", np.arange(400.0, 701.0, 20.0), np.full(16, 0.3), "reading")
    sci = Sample("T (SCI)", np.arange(360.0, 741.0, 10.0), np.full(39, 0.34), "reading")
    [sample] = joining.joined([sci, sce])
    assert [s.wavelengths.size for s in sample.readings] == [16, 39]
