# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""ASD's binary files: counts over the white reference, and every other kind refused."""

import struct
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.addon.samples.readers.formats import asd
from rough_spectra.addon.samples.readers.parts.document import Document
from rough_spectra.core.errors import InputError

TILE = Path(__file__).resolve().parents[1] / "fixtures" / "asd" / "tile.asd"
FORMATS = {0: "f", 1: "i", 2: "d"}


def make(version=b"as7", kind=1, form=2, counts=(10, 20, 60), white=(80, 80, 80), taken=-1):
    """Write a file by the published layout, independently of the reader."""
    header = bytearray(484)
    header[0:3] = version
    header[181], header[186], header[199] = 1, kind, form
    struct.pack_into("<ff", header, 191, 400.0, 150.0)
    struct.pack_into("<H", header, 204, len(counts))
    data = bytes(header) + struct.pack(f"<{len(counts)}{FORMATS[form]}", *counts)
    if white:
        data += struct.pack("<hddH", taken, 0.0, 0.0, 3) + b"abc"
        data += struct.pack(f"<{len(white)}{FORMATS[form]}", *white)
    return data


def read(data):
    document = Document(Path("tile.asd"), data)
    assert asd.sniff(document)
    (sample,) = asd.read(document)
    return sample


def refusal(data):
    with pytest.raises(InputError) as caught:
        asd.read(Document(Path("tile.asd"), data))
    sentence = str(caught.value)
    assert sentence.startswith("tile.asd")
    assert sentence.endswith(".")
    return sentence


def test_the_file_of_the_fixtures():
    (sample,) = readers.read(TILE)
    assert sample.wavelengths.tolist() == [400, 450, 500, 550, 600, 650, 700]
    expected = np.array([10, 20, 30, 40, 50, 60, 70]) / ([80] * 4 + [100] * 3)
    assert sample.values.tolist() == expected.tolist()
    assert (sample.name, sample.device) == ("tile", "ASD FieldSpec FR 1234")
    assert "divided by those of the white reference" in sample.altered[0]
    assert any("test tile" in note for note in sample.notes)


def test_the_comment_tells_the_geometry():
    data = bytearray(make())
    data[3:13] = b"d/8, SPEX\0"
    assert (read(bytes(data)).instrument, read(bytes(data)).specular) == ("de:8", "SCE")
    assert not any("assumed" in note for note in read(bytes(data)).notes)


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("kind", [0, 1])
@pytest.mark.parametrize("version", [b"as2", b"as6", b"as7", b"as8"])
def test_counts_become_reflectance_by_the_white_reference(version, kind, form):
    sample = read(make(version, kind, form))
    assert sample.wavelengths.tolist() == [400, 550, 700]
    assert sample.values.tolist() == [0.125, 0.25, 0.75]
    assert len(sample.altered) == 1


@pytest.mark.parametrize("data", [
    make(b"ASD", counts=(0.125, 0.25, 0.75), white=()),
    make(b"as7", counts=(0.125, 0.25, 0.75), taken=0),
])  # fmt: skip
def test_reflectance_without_a_white_reference_is_as_stored(data):
    sample = read(data)
    assert sample.values.tolist() == [0.125, 0.25, 0.75]
    assert sample.altered == ()


@pytest.mark.parametrize("data", [make(b"ASD", 0, white=()), make(kind=0, taken=0)])
def test_raw_counts_without_a_white_reference_are_refused(data):
    assert "raw detector counts, not reflectance" in refusal(data)


@pytest.mark.parametrize(
    ("kind", "word"),
    [(2, "radiance"), (4, "irradiance"), (6, "transmittance"), (8, "absorbance"), (99, "kind 99")],
)
def test_other_kinds_are_refused_by_name(kind, word):
    assert word in refusal(make(kind=kind))


def test_a_channel_without_white_is_named():
    sentence = refusal(make(white=(80, 0, 80)))
    assert "550 nm, channel 2" in sentence
    assert "infinite" in sentence


def test_saturation_and_a_missing_dark_are_said():
    data = bytearray(make())
    data[422], data[181] = 5, 0
    notes = " ".join(read(bytes(data)).notes)
    assert "Saturated when measured: VNIR, SWIR2." in notes
    assert "dark signal" in notes


def test_truncated_at_each_byte():
    whole = make()
    for size in range(10, len(whole)):
        assert "the file ends in the" in refusal(whole[:size])


def test_every_header_byte_may_be_wrong():
    """Whatever stands in the header: a sample or one sentence."""
    whole = make()
    for at in range(3, 484):
        for value in (0, 1, 127, 128, 255):
            data = whole[:at] + bytes([value]) + whole[at + 1 :]
            try:
                read(data)
            except InputError as error:
                assert str(error).endswith(".")  # noqa: PT017


def test_text_that_begins_the_same_is_no_such_file():
    assert not asd.sniff(Document(Path("a.txt"), b"ASD export\nwavelength;R\n400;0.5\n"))
