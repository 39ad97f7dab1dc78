# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What samples emit: from any kind of measurement to numbers, tables and a picture."""

import csv
import math
import zlib
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.matching import emission
from rough_spectra.addon.preview.figures import emission as figure
from rough_spectra.addon.samples import filter_response, readers
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support import png
from rough_spectra.core import emissivity
from rough_spectra.core.errors import DomainError, InputError
from rough_spectra.core.instruments import curves
from rough_spectra.core.vcavity import bounce_series

SAND = Path(__file__).parents[1] / "fixtures" / "ecostress" / "emissivity.spectrum.txt"
NM = np.linspace(7000.0, 15000.0, 17)
ALBEDO = 0.3 + 0.25 * np.sin(NM / 900)
SIGMA = math.radians(30)


def infrared(values=ALBEDO, kind="albedo", **fields):
    return Sample("Sand", NM, values, kind, **fields)


def test_an_albedo_is_what_facets_do_not_emit():
    found = emission.compute(infrared(), SIGMA, angles=[0.0, 1.0])
    np.testing.assert_array_equal(found.facets, 1 - ALBEDO)
    expected = emissivity.directional(ALBEDO, np.array([0.0, 1.0]), SIGMA)
    np.testing.assert_array_equal(found.directional, expected)
    np.testing.assert_array_equal(found.hemispherical, emissivity.hemispherical(ALBEDO, SIGMA))
    [band] = found.bands
    assert (band.name, band.first, band.last) == ("8000-14000 nm", 8000, 14000)
    of_band = emissivity.band_emissivity(expected, NM, 300.0, (8000, 14000))
    np.testing.assert_array_equal(band.directional, of_band)


@pytest.mark.parametrize("instrument", ["45a:0", "di:8"])
def test_a_reading_is_brought_back_to_its_facets(instrument):
    read = bounce_series.evaluate(curves.series(instrument).rows(SIGMA), ALBEDO)
    found = emission.compute(infrared(read, "reading", instrument=instrument), SIGMA)
    np.testing.assert_allclose(found.facets, 1 - ALBEDO, atol=1e-9)


@pytest.mark.parametrize("model", list(emissivity.MODELS))
def test_an_emissivity_is_that_of_the_rough_surface_near_the_normal(model):
    tilt = math.radians(8)
    seen = emissivity.directional(ALBEDO, tilt, SIGMA, model=model)
    sample = infrared(seen, "emissivity", instrument="di:8")
    found = emission.compute(sample, SIGMA, angles=[tilt], model=model)
    np.testing.assert_allclose(found.directional[0], seen, atol=1e-9)
    np.testing.assert_allclose(found.facets, 1 - ALBEDO, atol=1e-9)


def test_a_file_of_the_library_says_all_that_was_noise():
    [sand] = readers.read(SAND)
    found = emission.compute(sand, 0.0)
    assert found.directional[0] == pytest.approx([0.85, 0.75, 0.95, 1.0, 0.965])
    assert any("above 1 in one band, 1.002" in sentence for sentence in found.warnings)
    assert not any("no color" in sentence for sentence in found.warnings)


def test_more_than_white_is_told_and_not_hidden():
    found = emission.compute(infrared(np.full(NM.size, 1.2), "reading"), SIGMA, bands=())
    assert (found.directional < 0).all()
    assert any("more than white facets" in sentence for sentence in found.warnings)


@pytest.mark.parametrize(
    ("options", "fault"),
    [
        ({"model": "two-bounce"}, "loses the light of all bounces after the second"),
        ({"model": "first-order"}, "leaves out the light between facets"),
        ({"bands": [("window", (3000.0, 5000.0))]}, "Sand.*covers 7000 to 15000 nm"),
        ({"temperature": 0.0, "bands": None}, "0 K"),
        ({"background": -1.0, "bands": None}, "background"),
        ({"angles": [2.0]}, "theta holds 2 rad"),
    ],
)
def test_faults_are_named(options, fault):
    with pytest.raises(DomainError, match=fault):
        emission.compute(infrared(), SIGMA, **options)


def test_a_roughness_that_is_none_is_refused():
    with pytest.raises(DomainError, match=r"σ is 30 radians \(1718.87°\)"):
        emission.compute(infrared(), 30)


def test_tables_hold_the_numbers_and_read_back_as_emissivity(tmp_path):
    sand, felt = infrared(source="sand.csv"), Sample("=Felt", NM[1:] + 1, ALBEDO[1:], "albedo")
    both = [api.emissivity(each, SIGMA, angles=[0, 1], background=250) for each in (sand, felt)]
    spectra, bands, *pictures = api.write_emissivity(both, tmp_path / "out" / "two")
    assert [path.name for path in pictures] == ["two.1.png", "two.2.png"]
    again = {sample.name: sample for sample in readers.read(spectra)}
    assert len(again) == 8
    assert {sample.kind for sample in again.values()} == {"emissivity"}
    steep = again["Sand σ 30°, 57.2958°"]
    np.testing.assert_allclose(steep.values, both[0].directional[1], atol=5e-7)
    assert steep.wavelengths.tolist() == NM.tolist()
    whole = again["=Felt σ 30°, hemisphere"]
    np.testing.assert_allclose(whole.values, both[1].hemispherical, atol=5e-7)
    lines = [line for line in bands.read_text("utf-8").splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    assert [row["direction_deg"] for row in rows] == ["0", "57.2958", "hemisphere"] * 2
    assert float(rows[0]["emissivity"]) == pytest.approx(both[0].bands[0].directional[0], abs=1e-6)
    assert float(rows[1]["apparent_K"]) == pytest.approx(both[0].bands[0].apparent[1], abs=1e-3)
    assert rows[2]["apparent_K"] == ""
    assert (rows[0]["temperature_K"], rows[0]["background_K"]) == ("300", "250")
    with pytest.raises(DomainError, match="no emissivity to write"):
        api.write_emissivity([], tmp_path / "none")


def pixels_of(data):
    """Decode the pictures that we write: one part, differences to the row above."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    columns, rows = (int.from_bytes(data[at : at + 4], "big") for at in (16, 20))
    length = int.from_bytes(data[33:37], "big")
    lines = np.frombuffer(zlib.decompress(data[41 : 41 + length]), np.uint8)
    lines = lines.reshape(rows, 1 + 3 * columns)
    assert (lines[:, 0] == 2).all()
    return np.cumsum(lines[:, 1:], axis=0, dtype=np.uint8).reshape(rows, columns, 3)


def test_pictures_survive_their_file():
    given = np.random.default_rng(1).integers(0, 256, (5, 7, 3), np.uint8)
    np.testing.assert_array_equal(pixels_of(png.encode(given)), given)


def test_the_picture_shows_curves_where_the_numbers_are():
    found = emission.compute(infrared(np.full(NM.size, 0.4)), 0.0, angles=[0.0])
    rough = emission.compute(infrared(np.full(NM.size, 0.4)), math.radians(50), angles=[0.0])

    def height_of_blue(pixels):
        """Row of the blue curve in the middle of the picture."""
        column = pixels[40:, pixels.shape[1] // 2].astype(int)
        return 40 + int(np.argmax(column[:, 2] - column[:, 0]))

    smooth, raised = (height_of_blue(figure.picture(each)) for each in (found, rough))
    assert raised < smooth - 10


@pytest.mark.parametrize(
    "text",
    [
        "wavelength (um),response\n7.5,0\n10,1\n14,0.2\n",
        "7500;0\n10000;1\n14000;0,2\n",
        "# wavelength_unit: um\n14 0.2\n10 1\n7.5 0\n",
    ],
)
def test_a_response_is_a_table_of_two_columns(tmp_path, text):
    path = tmp_path / "camera.txt"
    path.write_text(text)
    found = filter_response.read(path)
    assert found.wavelengths.tolist() == [7500, 10000, 14000]
    assert found.response.tolist() == [0, 1, 0.2]
    [band] = api.emissivity(infrared(), SIGMA, bands=[found]).bands
    assert (band.name, band.first, band.last) == ("filter", 7500, 14000)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("7.5,0\n10,1\n", "look like micrometers"),
        ("7500,0\n10000,0\n", "somewhere above 0"),
        ("7500,1\n10000,x\n", "line 2"),
        ("7500,1,2\n10000,1,2\n", "columns"),
        ("7500,1\n", "at least two"),
        ("nm,r\n", "."),
        (";\n;;\n", "no rows of numbers"),
    ],
)
def test_what_is_no_response_is_refused(tmp_path, text, fault):
    path = tmp_path / "camera.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=fault):
        filter_response.read(path)
