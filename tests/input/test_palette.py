# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Palettes as people have them, and what none is."""

import numpy as np
import pytest
from rough_spectra.addon.samples import palette
from rough_spectra.core.errors import DomainError, InputError


def read(tmp_path, text):
    path = tmp_path / "own.csv"
    path.write_text(text, encoding="utf-8")
    return palette.read(path)


@pytest.mark.parametrize(
    "text",
    [
        "name,L,a,b\nHouse red,43,21,20\nDoor,30,-5.5,4\n",
        "House red,43,21,20\nDoor,30,-5.5,4\n",
        "\nHouse red,43,21,20\nDoor,30,-5.5,4\n",
        "Name;L*;a*;b*\nHouse red;43,0;21;20\nDoor;30;-5,5;4\n",
        "L*\ta*\tb*\tColor\n43\t21\t20\tHouse red\n30\t-5.5\t4\tDoor\n",
        "number,name,CIE L*,CIE a*,CIE b*\n1,House red,43,21,20\n2,Door,30,−5.5,4\n".replace(
            "−", "-"
        ),
    ],
)
def test_names_and_lab(tmp_path, text):
    red, door = read(tmp_path, text)
    assert (red.name, red.lab) == ("House red", (43, 21, 20))
    assert (door.name, door.lab) == ("Door", (30, -5.5, 4))
    assert (red.illuminant, red.observer, red.sample) == ("D65", 2, None)


def test_what_lab_is_for(tmp_path):
    [red] = read(tmp_path, "# illuminant: d50\n# observer: 10°\nHouse red,43,21,20\n")
    assert (red.illuminant, red.observer) == ("D50", 10)
    with pytest.raises(InputError, match="'B' is not known"):
        read(tmp_path, "# illuminant: B\nHouse red,43,21,20\n")


@pytest.mark.parametrize("text", ["name,hex\nHouse red,#734f3d\n", "House red;734F3D\n"])
def test_codes_of_srgb(tmp_path, text):
    # By the published transform of sRGB, computed by colour-science (XYZ_to_Lab of sRGB_to_XYZ).
    from rough_spectra.addon.support.colour_science import colour

    science = colour()
    rgb = np.array([0x73, 0x4F, 0x3D]) / 255
    expected = science.XYZ_to_Lab(science.sRGB_to_XYZ(rgb))
    [red] = read(tmp_path, "# observer: 10\n" + text)
    assert red.lab == pytest.approx(expected.tolist(), abs=0.02)
    assert red.observer == 2  # sRGB is of D65 and 2°, whatever the file says of L*a*b*


def test_spectra(tmp_path):
    rows = read(tmp_path, "name,400,500,600,700\nGray,0.2,0.2,0.2,0.2\nRed,0.1,0.1,0.5,0.6\n")
    assert [row.name for row in rows] == ["Gray", "Red"]
    gray, red = rows
    # L* of Y = 0.2 by its definition.
    assert gray.lab == pytest.approx((116 * 0.2 ** (1 / 3) - 16, 0, 0), abs=1e-6)
    assert red.sample.values.tolist() == [0.1, 0.1, 0.5, 0.6]


def test_white_is_a_color_and_three_bands_are_a_spectrum(tmp_path):
    assert read(tmp_path, "White,100,0,0\n")[0].lab == (100, 0, 0)
    [gray] = read(tmp_path, "name,400,550,700\nGray,0.2,0.2,0.2\n")
    assert gray.sample.wavelengths.tolist() == [400, 550, 700]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name,L,a,b\nHouse red,43,21,20\nDoor,143,0,0\n", "line 3: '143, 0, 0' is no color"),
        ("House red,43,21,20\nDoor,x,0,0\n", "line 2: 'x, 0, 0' is no color"),
        ("name,L,a,b\n", "no color is in it"),
        ("name,hex\nHouse red,#734f3d\nDoor,#73\n", "line 3"),
        ("name,400,500,600\nDoor,0.2,0.2,0.2\n", "sample 'Door': The bands from 400 to 600 nm"),
        ("House red,43,21,20\n" + "x" * 140_000 + "\n", "line 2: one of its fields is too long"),
        ("House red,43,21,20\nDoor," + "x" * 1000 + ",0,0\n", "line 2: 'xxx"),
        ("# illuminant: " + "x" * 1000 + "\nDoor,43,21,20\n", "is not known"),
    ],
)
def test_what_is_no_color_is_said_with_its_line(tmp_path, text, said):
    with pytest.raises(InputError) as caught:
        read(tmp_path, text)
    assert said in str(caught.value)
    assert "own.csv" in str(caught.value)
    assert len(str(caught.value)) < len(str(tmp_path)) + 200, "a sentence, whatever the file holds"


def test_what_is_neither_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"own\.csv"):
        read(tmp_path, "just some words\n")


def test_rows_are_found_by_name(tmp_path):
    rows = read(tmp_path, "RAL 3000,43,52,32\nRAL 3001,41,49,27\nDoor,30,0,0\n")
    assert palette.find(rows, "ral 3001").lab == (41, 49, 27)
    assert palette.find(rows, "door").name == "Door"
    with pytest.raises(InputError, match="several rows with 'ral'"):
        palette.find(rows, "ral")
    with pytest.raises(InputError, match="no row 'blue'"):
        palette.find(rows, "blue")


def test_typed_colors():
    assert palette.of_text("43, 21,20") == palette.of_text("43 21 20") == (43, 21, 20)
    assert palette.of_text("red") is None
    assert palette.of_text("1,2") is None
    assert palette.of_text("101,0,0") is None
    with pytest.raises(DomainError):
        palette.checked_light("D65", 5)
