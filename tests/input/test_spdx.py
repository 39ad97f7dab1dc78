# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""IES TM-27 files: reflectance is read, light is refused, and XML does no harm."""

from pathlib import Path

import pytest
from rough_spectra.addon.samples import readers

from tests.input.refused import refusal

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "spdx"
TILE = (FOLDER / "tile.spdx").read_text()
DATA = '    <SpectralData wavelength="403.1">0.25</SpectralData>\n'


def write(tmp_path, text):
    path = tmp_path / "file.spdx"
    path.write_text(text)
    return path


def test_reflectance_is_read_with_all_that_stands_around_it():
    (sample,) = readers.read(FOLDER / "tile.spdx")
    assert sample.wavelengths.tolist() == [400, 403.1, 700]
    assert sample.values.tolist() == [0.125, 0.25, 0.5]
    assert (sample.name, sample.device) == ("Gray tile", "Invented spectrometer")
    assert (sample.geometry, sample.instrument, sample.specular) == ("de:8", "de:8", "SCE")
    assert sample.notes == ("The bandwidth is 2.0 nm, and was corrected for.",)


def test_colour_science_reads_the_same_numbers():
    colour = pytest.importorskip("colour")
    spectrum = colour.SpectralDistribution_IESTM2714(str(FOLDER / "tile.spdx")).read()
    (sample,) = readers.read(FOLDER / "tile.spdx")
    assert spectrum.wavelengths.tolist() == sample.wavelengths.tolist()
    assert spectrum.values.tolist() == sample.values.tolist()


def test_prefixed_names_and_two_distributions(tmp_path):
    inner = TILE[TILE.index("  <SpectralDistribution>") : TILE.index("</IESTM2714>")]
    text = TILE.replace("</IESTM2714>", inner.replace("0.125", "0.375") + "</IESTM2714>")
    first, second = readers.read(write(tmp_path, text))
    assert (first.name, second.name) == ("Gray tile 1", "Gray tile 2")
    assert (first.values[0], second.values[0]) == (0.125, 0.375)
    text = TILE.replace("<", "<t:").replace("<t:/", "</t:").replace("<t:?", "<?")
    (sample,) = readers.read(write(tmp_path, text.replace("xmlns=", "xmlns:t=")))
    assert sample.values.tolist() == [0.125, 0.25, 0.5]


@pytest.mark.parametrize(
    ("quantity", "word"),
    [
        ("relative", "emission"),
        ("flux", "emission"),
        ("irradiance", "irradiance"),
        ("radiance", "radiance"),
        ("transmittance", "transmittance"),
        ("T-Factor", "transmittance"),
        ("absorptance", "absorptance"),
        ("other", "other"),
    ],
)
def test_other_quantities_are_refused_by_name(tmp_path, quantity, word):
    path = write(tmp_path, TILE.replace("reflectance", quantity))
    sentence = refusal(path)
    assert f"SpectralQuantity '{quantity}'" in sentence
    assert word in sentence
    assert "not reflectance" in sentence


def test_bands_in_any_order_are_sorted(tmp_path):
    end = "  </SpectralDistribution>"
    text = TILE.replace(DATA, "").replace(end, DATA + end)
    (sample,) = readers.read(write(tmp_path, text))
    assert sample.values.tolist() == [0.125, 0.25, 0.5]
    assert "order" in sample.altered[0]


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (TILE.replace("0.25<", "high<"), ["SpectralData 2", "'high' is not a number"]),
        (TILE.replace("403.1", "nan"), ["SpectralData 2", "'nan' is not a number"]),
        (TILE.replace("403.1", "400"), ["400 nm stands twice", "SpectralData 1"]),
        (TILE.replace("reflectance", ""), ["SpectralQuantity is missing"]),
        (TILE[:-9], ["the XML is broken"]),
        (TILE.replace("utf-8", "x-unknown"), ["encoding"]),
        (TILE.replace("<Header>", "<Header>" + "<a>" * 40), ["more than 20 levels"]),
        (TILE.replace("<Header>", "<Header>" + "<a/>" * 2000), ["more than 1000 elements"]),
        (TILE.replace("<Header>", "<Header>" + "<a b='" + "c" * 70_000 + "'/>"), ["64 kB"]),
        (
            TILE.replace("<IESTM2714", '<!DOCTYPE x [<!ENTITY a "b">]><IESTM2714', 1),
            ["document type or entities"],
        ),
    ],
)
def test_each_fault_is_named(tmp_path, text, parts):
    sentence = refusal(write(tmp_path, text))
    for part in parts:
        assert part in sentence
