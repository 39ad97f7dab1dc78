# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`compare`: two samples as measured and as albedos, held to colour-science's own numbers."""

import csv
import math
from dataclasses import replace

import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.support.colour_science import colour
from rough_spectra.core import reading
from rough_spectra.core.errors import DomainError

BANDS = np.arange(400.0, 701, 10)
PAINT = 0.1 + 0.5 / (1 + np.exp(-(BANDS - 580) / 15))
OTHER = 0.1 + 0.45 / (1 + np.exp(-(BANDS - 575) / 15))


@pytest.fixture
def readings(tmp_path):
    """One paint on a smooth and on a rough ground, and another paint, as an instrument reads."""
    path = tmp_path / "paints.csv"
    columns = {
        "smooth": reading.from_albedo(PAINT, math.radians(5), "surface"),
        "rough": reading.from_albedo(PAINT, math.radians(40), "surface"),
        "=other # one": OTHER,
    }
    lines = [",".join(["nm", *columns])]
    lines += [
        ",".join(map(repr, (float(nm), *map(float, row))))
        for nm, *row in zip(BANDS, *columns.values(), strict=True)
    ]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def table(text):
    head, *rows = (line.split("\t") for line in text.strip().splitlines())
    return {row[0]: dict(zip(head[1:], row[1:], strict=True)) for row in rows}


def lab(values, observer=2, illuminant="D65"):
    return tristimulus.spectrum_to_lab(values, BANDS, illuminant, observer)


def test_one_paint_of_two_roughnesses_is_one_color_as_albedos(main, readings, tmp_path):
    words = (f"{readings}#smooth", f"{readings}#rough", "--sigma", "5", "40")
    result = main("compare", *words, "--output", tmp_path / "apart.csv")
    assert result.status == 0
    rows = table(result.out)
    assert [*rows] == [
        "samples as measured",
        "their albedos",
        "first: albedo to reading",
        "second: albedo to reading",
    ]
    assert {float(number) for number in rows["their albedos"].values() if number} == {0}
    smooth, rough = (reading.from_albedo(PAINT, math.radians(s), "surface") for s in (5, 40))
    one, other = lab(smooth), lab(rough)
    measured = {key: float(value) for key, value in rows["samples as measured"].items() if value}
    expected = {
        "delta_e_00": float(colour().delta_E(one, other, method="CIE 2000")),
        "delta_L*": other[0] - one[0],
        "delta_a*": other[1] - one[1],
        "delta_b*": other[2] - one[2],
        "delta_a*b*": math.hypot(*(other - one)[1:]),
    }
    # Two digits are printed.
    assert {key: measured[key] for key in expected} == pytest.approx(expected, abs=0.0051)
    weights = tristimulus.weights(BANDS)
    leveled = rough * (smooth @ weights[:, 1]) / (rough @ weights[:, 1])
    shift = math.hypot(*(lab(leveled) - one)[1:])
    assert measured["shift"] == pytest.approx(shift, abs=0.0051)
    assert shift > 0.5
    with (tmp_path / "apart.csv").open(encoding="utf-8", newline="") as file:
        written = [*csv.DictReader(line for line in file if not line.startswith("#"))]
    assert [row["between"] for row in written] == [*rows]
    for row in written:
        for key, number in rows[row["between"]].items():
            told = float(row[key]) if row[key] else None
            assert told == (pytest.approx(float(number), abs=0.0051) if number else None)
        assert (row["first_sample"], row["second_sample"]) == ("smooth", "rough")
    assert [float(written[0][f"{axis}_second"]) for axis in ("L*", "a*", "b*")] == pytest.approx(
        other.tolist(), abs=1e-6
    )


def test_names_files_and_signs_in_them(main, readings, tmp_path):
    odd = readings.rename(tmp_path / "a#b.csv")
    result = main("compare", f"{odd}#=other # one", "14 green", "--output", tmp_path / "x.csv")
    assert result.status == 0, result.err
    *_, last = (tmp_path / "x.csv").read_text(encoding="utf-8").splitlines()
    assert last.endswith(",'=other # one,ColorChecker 14 Green")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("{file}", "green"), "has 3 samples; name one as FILE#NAME, of: smooth, rough"),
        (("{file}#none", "green"), "has no sample 'none'"),
        (("none.csv", "green"), "'none.csv' is no file, and no sample either"),
        (
            ("green", "red", "--sigma", "10", "95"),
            "Sample 'red': σ is 95°, and materials are matched up to 60°",
        ),
    ],
)
def test_what_cannot_be_compared_is_refused_and_nothing_is_written(
    words, said, main, readings, tmp_path
):
    target = tmp_path / "x.csv"
    result = main("compare", *(w.format(file=readings) for w in words), "--output", target)
    assert result.status == 2
    assert said in result.err
    assert not target.exists()


def test_samples_on_different_wavelengths_and_instruments_compare():
    fine = np.arange(380.0, 731, 5)
    smooth = api.Sample("smooth", BANDS, PAINT, "albedo")
    values = np.interp(fine, BANDS, reading.from_albedo(PAINT, 0.6, "surface", "di:8"))
    rough = api.Sample("rough", fine, values, "reading", instrument="di:8")
    found = api.compare(smooth, api.request(rough, 0.6))
    # Interpolation and what lies beyond 400 to 700 nm.
    assert found.albedos.delta_e_00 < 0.3
    assert found.measured.delta_e_00 > 3
    assert found.roughness[0].delta_e_00 == 0
    assert found.interreflection[0] == 0
    assert 0.03 < found.interreflection[1] < 0.3


def test_a_gray_is_the_same_gray_on_every_grid():
    fine = np.arange(380.0, 731, 5)
    pair = [api.Sample("gray", nm, np.full(nm.size, 0.4), "albedo") for nm in (BANDS, fine)]
    found = api.compare(*pair)
    assert found.albedos.delta_e_00 == pytest.approx(0, abs=1e-9)


def test_roughness_alone_is_what_the_page_on_the_2007_report_has():
    green = replace(api.find("green"), kind="albedo")
    for observer, ab, equal in ((2, 4.37, 1.60), (10, 3.96, 1.42)):
        smooth, rough = (
            api.request(green, math.radians(s), model="two-bounce", observer=observer)
            for s in (0, 45)
        )
        found = api.compare(smooth, rough)
        assert round(found.measured.delta_ab, 2) == ab
        assert round(found.measured.shift, 2) == equal
        assert found.roughness[1].delta_ab == pytest.approx(found.measured.delta_ab)


def test_settings_must_be_the_same():
    green = api.find("green")
    for setting in ({"illuminant": "A"}, {"observer": 10}, {"model": "two-bounce"}):
        with pytest.raises(DomainError, match=f"The {next(iter(setting))} is .* compare them"):
            api.compare(green, api.request(green, **setting))


def test_what_is_beyond_the_model_is_said():
    white = api.Sample("white", BANDS, np.full(BANDS.size, 0.95), "reading")
    found = api.compare(white, api.request(white, 1.0, model="surface"))
    assert not found.warnings
    pair = (api.request(white, sigma, model="two-bounce") for sigma in (0.1, 1.0))
    assert any(sentence.startswith("white: ") for sentence in api.compare(*pair).warnings)
