# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""JCAMP-DX: all forms of ordinates, blocks, units, and what its checkpoints find."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rough_spectra.addon.samples import readers
from rough_spectra.addon.samples.readers.formats import jcamp
from rough_spectra.addon.samples.readers.parts.document import Document
from rough_spectra.core.errors import InputError

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "jcamp"
ORDINATES = [10, 11, 12, 12, 12, 12, 9, -3, 0, 40, 64]


@pytest.mark.parametrize("form", ["affn", "pac", "sqz", "difdup"])
def test_four_forms_of_the_same_ordinates(form):
    (sample,) = readers.read(FOLDER / f"{form}.jdx")
    assert sample.wavelengths.tolist() == list(range(400, 441, 4))
    assert sample.values.tolist() == [ordinate / 64 for ordinate in ORDINATES]


def test_blocks_wavenumbers_pairs_and_missing_ordinates():
    wall, pairs = readers.read(FOLDER / "blocks.jdx")
    assert wall.name == "wall, seen over wavenumbers"
    np.testing.assert_allclose(wall.wavelengths, [400, 1e7 / 15000, 1000])
    assert wall.values.tolist() == [0.5, 0.25, 0.125]
    assert wall.altered == ("1 band without a value was left out: 500 nm.",)
    assert wall.device == "Invented 3000"
    assert any("through a filter" in note for note in wall.notes)
    assert any("Wavenumbers" in note for note in wall.notes)
    assert (pairs.name, pairs.wavelengths.tolist()) == ("pairs", [570.0, 580.0, 590.0])
    assert pairs.values.tolist() == [0.5, 0.25, 0.125]


def letter(number, positive, negative):
    digits = str(abs(number))
    table = negative if number < 0 else positive
    return table[int(digits[0]) - (number < 0)] + digits[1:]


def encode(ordinates, per_line):
    """Write DIF and DUP by the table of the paper, with a checkpoint at each line."""
    rows, last = [], len(ordinates) - 1
    for start in range(0, last, per_line):
        end = min(start + per_line, last)
        text = letter(ordinates[start], "@ABCDEFGHI", "abcdefghi")
        steps = [ordinates[i + 1] - ordinates[i] for i in range(start, end)]
        while steps:
            count = next((i for i, step in enumerate(steps) if step != steps[0]), len(steps))
            text += letter(steps[0], "%JKLMNOPQR", "jklmnopqr")
            if count > 1:
                text += "?STUVWXYZs"[int(str(count)[0])] + str(count)[1:]
            steps = steps[count:]
        rows.append(f"{400 + start}{text}")
    rows.append(f"{400 + last}{letter(ordinates[-1], '@ABCDEFGHI', 'abcdefghi')}")
    return "\n".join(rows)


HEAD = "##TITLE=x\n##JCAMP-DX=5\n##XUNITS={x}\n##YUNITS={y}\n##YFACTOR=0.0001\n"
HEAD += "##FIRSTX=400\n##LASTX={last}\n##NPOINTS={n}\n##XYDATA=(X++(Y..Y))\n"


def document(rows, n, x="NANOMETERS", y="REFLECTANCE"):
    text = HEAD.format(x=x, y=y, n=n, last=400 + n - 1) + rows + "\n##END=\n"
    return Document(Path("x.jdx"), text.encode())


@given(st.lists(st.integers(0, 20000), min_size=2, max_size=60), st.integers(1, 12))
def test_differences_and_repetitions_come_back_as_they_were(ordinates, per_line):
    (sample,) = jcamp.read(document(encode(ordinates, per_line), len(ordinates)))
    np.testing.assert_array_equal(sample.values, np.array(ordinates) * 0.0001)


@pytest.mark.parametrize(
    ("rows", "parts"),
    [
        ("400A0J\n401A2", ["line 11", "checkpoint 12", "11"]),
        ("400A0\n409A1", ["line 11", "begins at 409", "401"]),
        ("400A0A1A2", ["NPOINTS", "2", "but 3"]),
        ("400J1 A0", ["line 10", "difference"]),
        ("400S3 A0", ["line 10", "repeats nothing"]),
        ("400A0s9999999999", ["line 10", "more points"]),
        ("400A0 x1", ["line 10", "'x1'"]),
        ("A0A1", ["line 10", "abscissa"]),
        ("400 1 " + "9" * 400 + "!", ["line 10"]),
    ],
)
def test_damage_is_named_with_its_line(rows, parts):
    with pytest.raises(InputError) as caught:
        jcamp.read(document(rows, 2))
    for part in parts:
        assert part in str(caught.value)


@pytest.mark.parametrize(("units", "scale"), [("%R", 100), ("R", 1), ("R (%)", 100)])
def test_reflectance_by_its_letter(units, scale):
    (sample,) = jcamp.read(document("400 1 2", 2, "NANOMETERS", units))
    assert sample.values.tolist() == pytest.approx([1e-4 / scale, 2e-4 / scale])


@pytest.mark.parametrize(
    ("x", "y", "parts"),
    [
        ("NANOMETERS", "TRANSMITTANCE", ["line 4", "transmittance"]),
        ("NANOMETERS", "ABSORBANCE", ["line 4", "absorbance"]),
        ("NANOMETERS", "KUBELKA-MUNK", ["line 4", "Kubelka-Munk"]),
        ("NANOMETERS", "1ST DERIVATIVE OF REFLECTANCE", ["line 4", "derivative"]),
        ("NANOMETERS", "ARBITRARY UNITS", ["line 4", "'ARBITRARY UNITS'"]),
        ("MHZ", "REFLECTANCE", ["line 3", "'MHZ'", "NANOMETERS"]),
    ],
)
def test_other_units_are_refused_by_their_name(x, y, parts):
    with pytest.raises(InputError) as caught:
        jcamp.read(document("400 1 2", 2, x, y))
    for part in parts:
        assert part in str(caught.value)


def test_what_is_no_light_is_refused_by_its_data_type(tmp_path):
    path = tmp_path / "ethanol.jdx"
    head = "##TITLE= ethanol\n##JCAMP-DX= 5.0\n##DATA TYPE= NMR SPECTRUM\n"
    path.write_text(head + "##NTUPLES= NMR SPECTRUM\n##END=\n")
    with pytest.raises(InputError, match="line 3, ##DATA TYPE=: the values are 'NMR SPECTRUM', "):
        readers.read(path)


def test_a_file_without_a_version_is_still_judged_by_its_units(tmp_path):
    path = tmp_path / "small.dx"
    path.write_text("##TITLE= small\n##XYDATA=(X++(Y..Y))\n  400 0.5 0.25\n##END=\n")
    with pytest.raises(InputError, match="##YUNITS= is missing"):
        readers.read(path)
