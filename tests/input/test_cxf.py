# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""CxF3: each value equals the file's, specifications are honored, hostile XML ends soon."""

import re
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.samples import readers

from tests import pace
from tests.input.refused import refusal

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "cxf"
TWO = (FOLDER / "two.cxf").read_text(encoding="utf-8")
HEAD = '<c:CxF xmlns:c="http://colorexchangeformat.com/CxF3-core"><c:Resources><c:ObjectCollection>'
TAIL = "</c:ObjectCollection></c:Resources></c:CxF>"
OBJECT = (
    '<c:Object Name="a"><c:ColorValues><c:ReflectanceSpectrum StartWL="400" Increment="10">{}'
    "</c:ReflectanceSpectrum></c:ColorValues></c:Object>"
)


def write(folder, text, encoding="utf-8"):
    path = folder / "measured.cxf"
    path.write_bytes(text.encode(encoding))
    return path


@pytest.mark.parametrize("name", ["two.cxf", "mixed.cxf"])
def test_every_value_equals_the_file(name):
    """Against a plain search in the text, which knows nothing of XML."""
    text = (FOLDER / name).read_bytes().decode("latin-1")
    expected = re.findall(r"<(?:cc:)?ReflectanceSpectrum[^>]*>([^<]+)<", text)
    samples = [sample for sample in readers.read(FOLDER / name) if sample.name != "Flake"]
    assert len(samples) == len(expected) == 2
    for sample, values in zip(samples, expected, strict=True):
        assert sample.values.tolist() == [float(word) for word in values.split()]


def test_what_the_specification_says():
    rust, slate = readers.read(FOLDER / "two.cxf")
    assert (rust.name, slate.name) == ("Rust", "Slate")
    for sample in (rust, slate):
        assert sample.wavelengths.tolist() == list(range(400, 701, 10))
        assert (sample.instrument, sample.specular) == ("di:8", "SCI")
        assert (sample.device, sample.aperture, sample.condition) == ("X-Rite Ci64", "MAV", "M1")
        assert (sample.illuminant, sample.observer) == ("D65", 10)
        assert any("XRGA" in note for note in sample.notes)
    assert rust.lab == (40.5, 21.25, 18.75)
    assert rust.xyz == (0.145, 0.115, 0.045)
    assert (slate.lab, slate.xyz, slate.position) == (None, None, "object 2")


def test_conditions_angles_points_and_what_is_left_out():
    first, second, flake = readers.read(FOLDER / "mixed.cxf")
    assert (first.name, first.condition, first.instrument) == ("Grün (M0)", "M0", "45x:0")
    assert (second.name, second.condition, second.instrument) == ("Grün (M2)", "M2", "0:45a")
    assert first.wavelengths.tolist() == list(range(380, 721, 20))
    assert (first.lab, second.lab) == ((60.0, -20.5, 30.0), None)
    assert (first.illuminant, first.observer) == ("D50", 2)
    assert (flake.name, flake.instrument) == ("Flake", "45as110")
    assert flake.wavelengths.tolist() == [400, 500.5, 700]
    assert flake.values.tolist() == [0.25, 0.30, 1.75]
    (left,) = first.notes
    for part in ("1 with emission", "1 with transmittance", "1 with color"):
        assert part in left


GEOMETRY = "<cc:SphereGeometry>Specular_Included</cc:SphereGeometry>"


@pytest.mark.parametrize(
    ("single", "note"),
    [
        ("", "that of the device"),
        (
            "<cc:SingleAngleConfiguration>Annular</cc:SingleAngleConfiguration>",
            "that of the device",
        ),
        (
            "<cc:IlluminationAngle>30</cc:IlluminationAngle>",
            "'light at 30°, view at an angle that is …' is not known",
        ),
    ],
)
def test_angles_that_are_not_there(tmp_path, single, note):
    text = TWO.replace(GEOMETRY, f"<cc:SingleAngle>{single}</cc:SingleAngle>")
    for sample in readers.read(write(tmp_path, text)):
        assert sample.instrument == ("45a:0" if "30" in single else "di:8"), "its device's"
        assert any(note in said for said in sample.notes)
        assert not any("°a:°" in said for said in (sample.geometry, *sample.notes))
    angle = single.replace("Single", "Multi")
    text = TWO.replace(GEOMETRY, f"<cc:MultiAngle><cc:Angle>{angle}</cc:Angle></cc:MultiAngle>")
    for sample in readers.read(write(tmp_path, text)):
        assert sample.instrument == ("45a:0" if "30" in single else "di:8"), "its device's"
        assert any("assumed" in said or "device" in said for said in sample.notes)


@pytest.mark.parametrize(
    ("remark", "instrument", "note"),
    [
        ("<cc:Description>Tiles, d/8 SCE</cc:Description>", "de:8", ""),
        ("<cc:Comment>Tiles, SCE</cc:Comment>", "de:8", "SCE, follows from 'Tiles, SCE'"),
        ('<cc:Tag Name="Geometry" Value="45/0"/>', "45a:0", ""),
        ("<cc:Description>SCI-FI posters</cc:Description>", "di:8", "that of the device"),
    ],
)
def test_the_description_of_the_file_says_what_no_specification_does(
    tmp_path, remark, instrument, note
):
    said = f"<cc:FileInformation>{remark}"
    text = TWO.replace("<cc:FileInformation>", said)
    assert readers.read(write(tmp_path, text))[0].instrument == "di:8", "the specification's"
    [sample, _] = readers.read(write(tmp_path, text.replace(GEOMETRY, "")))
    assert sample.instrument == instrument
    assert note in " ".join(sample.notes)
    assert "assumed" not in " ".join(sample.notes)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "latin-1"])
@pytest.mark.parametrize("prefix", ["cc:", "", "x-rite:"])
def test_prefix_and_encoding_change_nothing(tmp_path, prefix, encoding):
    text = TWO.replace("UTF-8", encoding).replace("<cc:", f"<{prefix}")
    declaration = f"xmlns:{prefix}".rstrip(":")
    text = text.replace("</cc:", f"</{prefix}").replace("xmlns:cc", declaration)
    rust, _ = readers.read(write(tmp_path, text.replace("Slate", "Öl"), encoding))
    assert rust.values.tolist() == readers.read(FOLDER / "two.cxf")[0].values.tolist()


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("CxF3-core", "v2", ["older CxF", "CxF3"]),
        ("ReflectanceSpectrum", "EmissiveSpectrum", ["emission", "not reflectance"]),
        ("ReflectanceSpectrum", "TransmittanceSpectrum", ["transmittance", "not reflectance"]),
        ("Spectrum_Reflectance", "Spectrum_Transmittance", ["transmittance"]),
        ("Spectrum_Reflectance", "Spectrum_Emissive", ["emission"]),
        ("ReflectanceSpectrum", "PrivateSpectrum", ["no spectral data"]),
        ('Increment="10"', "", ["object 1", "no Increment", "'S1'"]),
        ('"S1">0', '"S9">0', ["object 1", "no Increment", "'S9'"]),
        ("0.077416", "7,7416", ["object 1", "'7,7416'", "not a number"]),
        ("0.077416", "7.7416", ["object 1", "400 nm", "times white"]),
        ("0.077416", "NaN", ["object 1", "400 nm", "NaN"]),
        ('Increment="10"', 'Increment="0"', ["object 1", "400 nm stands twice"]),
        ("</cc:Resources>", "", ["XML is broken", "line 33"]),
        ("UTF-8", "UTF-99", ["encoding", "UTF-8"]),
        (
            "<cc:CxF",
            '<!DOCTYPE x [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><cc:CxF',
            ["document type or entities"],
        ),
        (
            "<cc:CxF",
            '<!DOCTYPE x SYSTEM "file:///etc/passwd"><cc:CxF',
            ["document type or entities"],
        ),
    ],
)
def test_each_fault_is_named(tmp_path, old, new, parts):
    assert old in TWO
    sentence = refusal(write(tmp_path, TWO.replace(old, new)))
    for part in parts:
        assert part in sentence


@pytest.mark.parametrize(
    "inside",
    [
        "<a>" * 300_000,
        "<x/>" * 250_000,
        "<c:Object/>" * 80_000,
        "<c:Object>" + "<x/>" * 250_000 + "</c:Object>",
        "<c:Object><c:ColorCIELab>" + "<c:L>1</c:L>" * 80_000 + "</c:ColorCIELab></c:Object>",
        "<x " + " ".join(f'a{i}="1"' for i in range(90_000)) + "/>",
        "<x " + " ".join(f'xmlns:a{i}="1"' for i in range(50_000)) + "/>",
        OBJECT.format("9" * 2**20),
        OBJECT.format("1 " * 2**19),
        "&amp;" * 200_000,
    ],
    ids=lambda inside: inside[:12],
)
def test_a_megabyte_of_hostile_xml_ends_soon(tmp_path, inside):
    path = write(tmp_path, HEAD + inside + TAIL)
    # Below 50 paces; anything quadratic takes thousands.
    with pace.at_most(200):
        refusal(path)


def test_memory_stays_in_proportion(tmp_path):
    rng = np.random.default_rng(3)
    objects = [
        OBJECT.format(" ".join(f"{value:.6f}" for value in row)) for row in rng.random((2000, 31))
    ]
    path = write(tmp_path, HEAD + "".join(objects) + TAIL)
    tracemalloc.start()
    try:
        assert len(readers.read(path)) == 2000
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 20 * path.stat().st_size
