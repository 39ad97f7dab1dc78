# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A user's own surface from a file: whatever wrote it, the same heights, or one sentence."""

from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.laboratory import height_map, kinds
from rough_spectra.addon.support.openimageio import openimageio
from rough_spectra.core.errors import InputError

HEIGHTS = np.random.default_rng(3).normal(0, 1, (5, 7))
EXPECTED = height_map.mirrored(height_map.level(HEIGHTS))


def written(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def matrix(delimiter=" ", heights=HEIGHTS):
    return "\n".join(delimiter.join(f"{value:.9g}" for value in row) for row in heights)


def points(order=None):
    rows = [
        f"{0.5 * column:.6g} {0.25 * row:.6g} {HEIGHTS[row, column]:.9g}"
        for row in range(5)
        for column in range(7)
    ]
    return "\n".join(rows if order is None else [rows[i] for i in order])


def sdf(values=None):
    words = " ".join(f"{v:.9g}" for v in HEIGHTS.ravel()) if values is None else values
    return (
        "aISO-1.0\nManufacID = Example\nNumPoints = 7\nNumProfiles = 5\nXscale = 0.5\n"
        f"Yscale = 0.25\nZscale = 1\nDataType = 7\n*\n{words}\n*\n"
    )


@pytest.mark.parametrize(
    ("name", "text", "spacing"),
    [
        ("points.xyz", points(), (0.5, 0.25)),
        ("shuffled.xyz", points(np.random.default_rng(0).permutation(35)), (0.5, 0.25)),
        ("named.csv", "x,y,z\n" + points().replace(" ", ","), (0.5, 0.25)),
        ("commented.txt", "# by hand\n" + points().replace(" ", "\t"), (0.5, 0.25)),
        ("matrix.csv", matrix(","), (2.0, 2.0)),
        ("semicolons.csv", matrix(";") + ";", (2.0, 2.0)),
        ("matrix.txt", matrix("\t"), (2.0, 2.0)),
        (
            "grid.asc",
            "ncols 7\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 0.5\nNODATA_value -9999\n"
            + matrix(heights=HEIGHTS[::-1]),
            (0.5, 0.5),
        ),
        ("surface.sdf", sdf(), (0.5, 0.25)),
    ],
)
def test_texts_give_heights_and_spacing(tmp_path, name, text, spacing):
    field = height_map.read(written(tmp_path, name, text), 2.0)
    assert field.spacing == pytest.approx(spacing)
    assert field.heights == pytest.approx(EXPECTED, abs=1e-7)


def write_image(path, values, basetype):
    oiio = openimageio()
    spec = oiio.ImageSpec(values.shape[1], values.shape[0], 1, basetype)
    image = oiio.ImageOutput.create(str(path))
    image.open(str(path), spec)
    image.write_image(np.ascontiguousarray(values[..., np.newaxis]))
    image.close()


def test_float_and_16_bit_images_give_heights(tmp_path):
    oiio = openimageio()
    write_image(tmp_path / "a.exr", HEIGHTS[::-1].astype(np.float32).copy(), oiio.FLOAT)
    field = height_map.read(tmp_path / "a.exr", 0.1)
    assert field.heights == pytest.approx(EXPECTED, abs=1e-5)
    gray = np.round(30000 + 5000 * HEIGHTS[::-1]).astype(np.uint16)
    write_image(tmp_path / "a.png", gray, oiio.UINT16)
    field = height_map.read(tmp_path / "a.png", 0.1)
    assert field.heights * 65535 / 5000 == pytest.approx(EXPECTED, abs=3e-4)


def test_the_plane_goes_and_nothing_else():
    x, y = np.meshgrid(np.arange(7), np.arange(5))
    tilted = HEIGHTS + 3 * x - 2 * y + 5
    assert height_map.level(tilted) == pytest.approx(height_map.level(HEIGHTS))
    wave = np.cos(x - 3.0)  # even about the middle: it has no plane
    assert height_map.level(wave) == pytest.approx(wave - wave.mean())


def test_a_mirrored_surface_has_no_step_at_its_edges():
    field = height_map.mirrored(HEIGHTS)
    assert (field[:, 0] == field[:, -1]).all()
    assert (field[0] == field[-1]).all()


def test_a_map_keeps_its_slope_unless_asked_to(tmp_path):
    path = written(tmp_path, "points.xyz", points())
    rough = kinds.make("map", path=path)
    across = np.diff(height_map.level(HEIGHTS), axis=1) / 0.5
    assert rough.asked is None
    assert rough.mesh.sdq > np.sqrt(np.mean(across**2)) / 2
    stretched = kinds.make("map", 0.4, path=path)
    assert stretched.sigma == pytest.approx(0.4)


@pytest.mark.parametrize(
    ("name", "text", "sentence"),
    [
        ("holes.xyz", "\n".join(points().splitlines()[:-2]), "has 2 heights missing of 35; fill"),
        ("nan.csv", "1,2,3,4\n1,nan,3,4\n1,2,3,4\n1,2,3,4\n", "has 1 heights missing of 16"),
        ("bad.sdf", sdf("BAD " * 35), "has 35 heights missing of 35"),
        ("short.sdf", sdf("1 2 3"), "has 3 heights and not 7 × 5"),
        ("bare.sdf", "aISO-1.0\n*\n1 2\n*\n", "has a header without a readable 'numpoints'"),
        ("binary.sdf", "bISO-1.0\n", "is a binary SDF file; export the ASCII one"),
        ("ragged.csv", "1,2,3,4\n1,2,3\n", "line 2 has 3 numbers and not 4, as the first"),
        ("words.csv", "1,2,3,4\n1,2,three,4\n", "line 2: 'three' is no number"),
        ("empty.txt", "", "has no heights: neither an image nor a table of numbers"),
        ("small.csv", "1,2,3,4\n1,2,3,4\n", "has 4 × 2 heights; a surface needs 4 × 4"),
        (
            "cloud.xyz",
            "\n".join(f"{i * 0.37 % 1} {i * 0.73 % 1} 0" for i in range(40)),
            "has points that lie on no regular grid",
        ),
        (
            "uneven.xyz",
            "\n".join(f"{x} {y} 0" for x in (0, 1, 2, 4, 5) for y in range(5)),
            "has points unevenly spaced along x",
        ),
        ("fake.png", "no image", "cannot be read as an image"),
    ],
)
def test_what_is_no_surface_is_refused_in_a_sentence(tmp_path, name, text, sentence):
    path = written(tmp_path, name, text)
    with pytest.raises(InputError) as caught:
        height_map.read(path, 1.0)
    assert str(path) in str(caught.value)
    assert sentence in str(caught.value)
    assert str(caught.value).endswith(".")


def test_spacing_has_to_be_said(tmp_path):
    with pytest.raises(InputError) as caught:
        height_map.read(written(tmp_path, "matrix.csv", matrix(",")))
    assert "does not say how far apart its heights are" in str(caught.value)


def test_a_missing_file_is_said(tmp_path):
    with pytest.raises(InputError) as caught:
        height_map.read(tmp_path / "none.xyz")
    assert "cannot be read (No such file or directory); check the path" in str(caught.value)


def test_8_bits_are_too_few(tmp_path):
    path = Path(tmp_path / "gray.png")
    write_image(path, np.full((8, 8), 9, np.uint8), openimageio().UINT8)
    with pytest.raises(InputError) as caught:
        height_map.read(path, 1.0)
    assert "has 8 bits a pixel" in str(caught.value)
