# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral images: the mean of a region, against OpenImageIO, and what broken ones bring."""

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.readings.writers import images
from rough_spectra.addon.samples import readers
from rough_spectra.addon.samples.readers.formats import spectral_exr
from rough_spectra.addon.samples.readers.parts.document import Document
from rough_spectra.addon.support.openimageio import openimageio
from rough_spectra.core.errors import InputError

from tests.input.refused import refusal

PIXELS = Path(__file__).resolve().parents[1] / "fixtures" / "spectral_exr" / "pixels.spectral.exr"
DATA = PIXELS.read_bytes()
NAMES = ["R", "G", "B", *(f"T.{nm},000000nm" for nm in (400, 475, 550, 625, 1000))]
VALUES = np.arange(96).reshape(3, 4, 8) % 61 / 64  # as the fixture was written


def write(path, pixels, names=NAMES, compression="zip", half=True, **attributes):
    """Write an image with OpenImageIO, not with the code under test."""
    oiio = openimageio()
    height, width, count = pixels.shape
    spec = oiio.ImageSpec(width, height, count, oiio.HALF if half else oiio.FLOAT)
    spec.channelnames = names
    spec.attribute("compression", compression)
    for key, value in attributes.items():
        setattr(spec, key, value)
    out = oiio.ImageOutput.create("openexr")
    assert out.open(str(path), spec)
    assert out.write_image(np.ascontiguousarray(pixels, np.float32))
    assert out.close()
    return path


def test_the_whole_image_and_regions_of_it():
    (sample,) = readers.read(PIXELS)
    assert sample.wavelengths.tolist() == [400, 475, 550, 625, 1000]
    np.testing.assert_allclose(sample.values, VALUES[..., 3:].mean((0, 1)), rtol=1e-15)
    assert (sample.name, sample.altered) == ("pixels", ("Mean of 12 pixels.",))
    assert any("one color" in note for note in sample.notes)
    (sample,) = readers.read(PIXELS, (1, 2, 2, 1))
    assert sample.values.tolist() == VALUES[2, 1:3, 3:].mean(0).tolist()
    assert sample.position == "pixels 1, 2 to 2, 2"
    (sample,) = readers.read(PIXELS, (3, 0, 1, 1))
    assert sample.values.tolist() == VALUES[0, 3, 3:].tolist()
    assert sample.altered == ("Mean of 1 pixels.",)


@pytest.mark.parametrize("half", [True, False])
@pytest.mark.parametrize("compression", ["none", "zip", "zips"])
def test_openimageio_sees_the_same_pixels(tmp_path, compression, half):
    random = np.random.default_rng(5).random((37, 21, 8))
    path = write(tmp_path / "a.exr", random, compression=compression, half=half)
    buffer = openimageio().ImageBuf(str(path))  # which sorts the channels by their names
    order = [buffer.spec().channelnames.index(name) for name in NAMES[3:]]
    pixels = buffer.get_pixels()[..., order].astype(float)
    found = readers.read(path)[0].values
    np.testing.assert_allclose(found, pixels.mean((0, 1)), rtol=1e-14)
    found = readers.read(path, (4, 11, 9, 20))[0].values
    np.testing.assert_allclose(found, pixels[11:31, 4:13].mean((0, 1)), rtol=1e-14)


@pytest.mark.parametrize("compression", ["none", "zip", "zips"])
def test_large_chunks_and_long_lines_are_the_same_in_pieces(tmp_path, compression):
    """A chunk of 16 lines has 1.5 MB here, a line 96 kB; both exceed what is unpacked at a time."""
    pixels = np.random.default_rng(6).integers(0, 64, (21, 3001, 8)) / 64  # packs to a fifth
    path = write(tmp_path / "a.exr", pixels, compression=compression, half=False)
    for x, y, width, height in ((0, 0, 3001, 21), (5, 3, 2000, 1), (0, 14, 3001, 5)):
        (sample,) = readers.read(path, (x, y, width, height))
        expected = pixels[y : y + height, x : x + width, 3:].mean((0, 1))
        np.testing.assert_allclose(sample.values, expected, rtol=1e-14)


def test_a_data_window_that_begins_elsewhere_changes_nothing(tmp_path):
    path = write(tmp_path / "a.exr", VALUES, x=-7, y=40)
    assert (
        readers.read(path, (1, 2, 2, 1))[0].values.tolist() == VALUES[2, 1:3, 3:].mean(0).tolist()
    )


def test_what_this_extension_writes_comes_back_in_half_precision(tmp_path):
    swatches = np.linspace(0.1, 0.9, 7)[None]
    names = ("R", "G", "B", *(f"T.{nm},000000nm" for nm in (400, 500, 600, 700)))
    path = tmp_path / "predicted.spectral.exr"
    images.write(images.Picture(swatches, names, "one swatch", True), path, path)
    (sample,) = readers.read(path)
    np.testing.assert_allclose(sample.values, swatches[0, 3:], rtol=2**-11)
    assert not any("one color" in note for note in sample.notes)


def test_units_and_layers_of_channel_names(tmp_path):
    names = ["R", "G", "B", "a.T.0,4um", "a.T.5E-7m", "a.T.600nm", "a.T.428,274940THz", "a.Z"]
    (sample,) = readers.read(write(tmp_path / "a.exr", VALUES, names))
    np.testing.assert_allclose(sample.wavelengths, [400, 500, 600, 700], atol=1e-6)
    assert sample.values.tolist() == VALUES[..., 3:7].mean((0, 1)).tolist()


@pytest.mark.parametrize(
    ("names", "parts"),
    [
        ([name.replace("T.", "S0.") for name in NAMES], ["radiance", "S0"]),
        ([*NAMES[:7], "T.380,000000nm.420,000000nm"], ["bispectral"]),
        ([f"c{i}" for i in range(8)], ["no channels such as 'T.400,000000nm'", "c0"]),
        ([*NAMES[:6], "left.T.600nm", "right.T.600nm"], ["3 layers"]),
        ([*NAMES[:7], "T.400nm"], ["400 nm stands twice", "'T.400nm'"]),
    ],
)
def test_other_channels_are_refused_by_name(tmp_path, names, parts):
    sentence = refusal(write(tmp_path / "a.exr", VALUES, names))
    for part in parts:
        assert part in sentence


def test_emitted_light_beside_reflectance_is_told_of(tmp_path):
    names = [*NAMES[:6], "S0.400,000000nm", "S1.400,000000nm"]
    (sample,) = readers.read(write(tmp_path / "a.exr", VALUES, names))
    assert sample.wavelengths.size == 3
    assert any("emitted light" in note for note in sample.notes)


@pytest.mark.parametrize("compression", ["rle", "piz", "pxr24", "b44", "dwaa"])
def test_other_packings_are_refused_by_name(tmp_path, compression):
    sentence = refusal(write(tmp_path / "a.exr", VALUES, compression=compression))
    assert f"packed with {compression.upper()}; save the image with ZIP" in sentence


def test_tiles_are_refused_by_name(tmp_path):
    path = write(tmp_path / "a.exr", VALUES, tile_width=16, tile_height=16)
    assert "tiled" in refusal(path)


@pytest.mark.parametrize("region", [(0, 0, 5, 1), (-1, 0, 1, 1), (0, 3, 1, 1), (0, 0, 0, 1)])
def test_a_region_has_to_be_in_the_image(region):
    assert "not within the image of 4 x 3 pixels" in refusal(PIXELS, region)


def test_other_files_have_no_regions():
    path = PIXELS.parents[1] / "nix" / "brick.csv"
    assert "has no regions" in refusal(path, (0, 0, 1, 1))


def test_a_pixel_that_is_no_number_is_named_by_its_channel(tmp_path):
    pixels = VALUES.copy()
    pixels[1, 1, 4] = np.nan
    assert "channel 'T.475,000000nm'" in refusal(write(tmp_path / "a.exr", pixels))


def image(data):
    return spectral_exr.read(Document(Path("a.exr"), data))


def test_truncated_at_each_byte():
    for size in range(4, len(DATA)):
        with pytest.raises(InputError) as caught:
            image(DATA[:size])
        assert str(caught.value).endswith(".")


def test_every_byte_may_be_wrong():
    """Whatever stands there: a sample or one sentence."""
    for at in range(4, len(DATA)):
        for value in (0, 1, 127, 255):
            try:
                image(DATA[:at] + bytes([value]) + DATA[at + 1 :])
            except InputError as error:
                assert str(error).endswith(".")  # noqa: PT017


def with_window(width, height):
    box = DATA.index(b"dataWindow\0box2i\0") + 21
    return DATA[:box] + struct.pack("<4i", 0, 0, width - 1, height - 1) + DATA[box + 16 :]


@pytest.mark.parametrize(
    "size",
    [(2**31 - 1, 1), (2**16, 2**16), (0, 3), (-5, 3), (60_000, 3), (4, 60_000), (2**20, 2**20)],
)
def test_sizes_that_the_file_cannot_hold_are_refused(size):
    with pytest.raises(InputError, match=r"pixels|table of lines|broken|missing"):
        image(with_window(*size))


def test_a_chunk_that_unpacks_to_more_is_refused():
    """A bomb: the lines are said to be small, and unpack to 16 MB."""
    start = _first_chunk()
    packed = zlib.compress(bytes(2**24))
    data = DATA[:start] + struct.pack("<2i", 0, len(packed)) + packed
    with pytest.raises(InputError, match="line 1 of the image: its pixels are broken"):
        image(data)


def packed_image(height, size, packed, length=None):
    """An image 1 pixel wide whose chunks of 16 lines all are `packed`, or claim to be longer."""
    head = DATA[: DATA.index(b"dataWindow")] + b"dataWindow\0box2i\0" + struct.pack("<i", 16)
    head += struct.pack("<4i", 0, 0, size - 1, height - 1) + b"\0"
    chunks = -(-height // 16)
    at = len(head) + 8 * chunks
    end = at + chunks * (8 + len(packed))
    table, body = b"", b""
    for chunk in range(chunks):
        claimed = len(packed) if length is None else min(length, end - at - 8)
        table += struct.pack("<Q", at)
        body += struct.pack("<2i", 16 * chunk, claimed) + packed
        at += 8 + len(packed)
    return head + table + body


def test_chunks_that_overlap_are_refused_before_each_unpacks_the_rest_of_the_file():
    line = zlib.compress(bytes(8 * 2 * 16))
    (sample,) = image(packed_image(1600, 1, line))
    assert sample.altered == ("Mean of 1600 pixels.",)
    with pytest.raises(InputError, match="line 17 of the image: its pixels are broken"):
        image(packed_image(1600, 1, line, 2**30))


@pytest.mark.parametrize("size", [2**19 - 16, 2**19 + 16])
def test_a_large_chunk_that_unpacks_to_another_size_is_refused(size):
    right = zlib.compress(bytes([0]) + bytes([0x80]) * (2**19 - 1))
    assert image(packed_image(16, 2**19 // 16 // 16, right))[0].values.tolist() == [0] * 5
    with pytest.raises(InputError, match="line 1 of the image: its pixels are broken"):
        image(packed_image(16, 2**19 // 16 // 16, zlib.compress(bytes(size))))


def _first_chunk():
    """Where the only chunk of the fixture begins, which is where its table of lines says."""
    (start,) = (at for at in range(len(DATA)) if DATA[at : at + 8] == struct.pack("<Q", at + 8))
    return start + 8
