# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines, areas and letters cover the pixels that geometry says they cover."""

import itertools

import numpy as np
import pytest
from rough_spectra.addon.preview.drawing import (
    glyphs,
    lines,
    raster,
    text,
)

RED = (1.0, 0.0, 0.0)
LEVEL = 0.501 / 255
"""What one rounding to bytes may cost."""


def alpha(draw, height=40, width=60):
    """Share of each pixel that is covered, to half a level."""
    canvas = raster.blank(height, width)
    draw(canvas)
    return canvas[..., 3] / 255


def test_a_rectangle_covers_its_area_and_nothing_beside_it():
    box = (3.25, 4.5, 20.75, 9.125)
    covered = alpha(lambda c: raster.rectangle(c, box, RED))
    wanted = np.zeros((40, 60))
    wanted[4:10, 3:21] = np.outer([0.5, 1, 1, 1, 1, 0.125], [0.75, *[1] * 16, 0.75])
    assert np.abs(covered - wanted).max() <= LEVEL
    assert covered.sum() == pytest.approx((20.75 - 3.25) * (9.125 - 4.5), rel=2e-3)
    assert covered[5:9, 4:20].min() == 1
    outside = covered.copy()
    outside[4:10, 3:21] = 0
    assert not outside.any()


@pytest.mark.parametrize(
    "corners",
    [
        [(3.3, 2.1), (30.7, 5.9), (12.2, 33.4)],
        [(3.3, 2.1), (12.2, 33.4), (30.7, 5.9)],
        [(5, 5), (45.5, 5), (45.5, 20.25), (5, 20.25)],
        [(10, 3), (10, 30), (30, 30)],
    ],
)
def test_a_polygon_covers_its_area(corners):
    x, y = np.array(corners).T
    shoelace = abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2
    closed = np.array(corners, float)
    covered = raster.area(closed, np.roll(closed, -1, axis=0), (40, 60))
    assert covered.sum() == pytest.approx(shoelace, rel=1e-6)
    drawn = alpha(lambda c: raster.polygon(c, [corners], RED))
    assert np.abs(drawn - covered).max() <= LEVEL


def test_pixels_of_a_polygon_agree_with_counting_points():
    corners = np.array([(3.3, 2.1), (30.7, 5.9), (12.2, 33.4)])
    covered = alpha(lambda c: raster.polygon(c, [corners], RED))
    fine = 16
    at = (np.arange(40 * fine) + 0.5) / fine
    x, y = np.meshgrid(at[: 40 * fine], at[: 40 * fine])
    sides = []
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        sides.append((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > 0)
    inside = np.all(sides, axis=0)
    counted = inside.reshape(40, fine, 40, fine).mean(axis=(1, 3))
    # Points on a grid of 16 x 16 miss an edge by at most two rows of them.
    assert np.abs(covered[:, :40] - counted).max() < 2 / fine


def test_a_polygon_has_holes():
    outer = [(5, 5), (35, 5), (35, 35), (5, 35)]
    inner = [(10, 10), (10, 30), (30, 30), (30, 10)]
    covered = alpha(lambda c: raster.polygon(c, [outer, inner], RED))
    assert covered.sum() == pytest.approx(30 * 30 - 20 * 20)
    assert covered[20, 20] == 0


@pytest.mark.parametrize("tip", [(20.0, 11), (20.3, 11), (33.98, 7), (1.2, 14)])
def test_a_pointer_is_the_polygon_with_its_corners(tip):
    (x, bottom), reach = tip, 4.25
    corners = [(x - reach, 2), (x + reach, 2), (x, bottom)]
    wanted = raster.blank(40, 60)
    raster.polygon(wanted, [corners], RED)
    found = raster.blank(40, 60)
    raster.pointer(found, tip, 2, reach, RED)
    assert np.abs(found.astype(int) - wanted).max() <= 1
    assert found.any()


def test_rows_of_a_canvas_are_a_canvas():
    whole, apart = raster.blank(40, 60), raster.blank(20, 60)
    for canvas in (whole[10:30], apart):
        lines.polyline(canvas, [(3, 25), (50, -5)], RED, 3)
        raster.rectangle(canvas, (5, -5, 15, 15), RED)
        raster.rectangle(canvas, (25.5, 4.5, 35, 30), RED, 0.5)
        text.draw(canvas, "σ", 40, 12, 20, RED)
    np.testing.assert_array_equal(whole[10:30], apart)
    assert not whole[:10].any()
    assert not whole[30:].any()


@pytest.mark.parametrize("width", [1.0, 1.6, 3.0])
def test_pixels_of_a_line_have_their_distance_from_it(width):
    """Down to half a pixel beyond its edge; the nearest piece counts, looked for among all here."""
    corners = [(4.2, 30.1), (11.7, 5.3), (30, 5.3), (30.4, 36), (38, 29), (55, 33)]
    # A point twice, and one that rounding left beside itself.
    line = np.array([corners[0], *corners, (55 + 1e-13, 33)])
    covered = alpha(lambda c: lines.polyline(c, line, RED, width))
    middle = np.stack(np.meshgrid(np.arange(60) + 0.5, np.arange(40) + 0.5), axis=-1)
    away = np.full((40, 60), np.inf)
    for start, end in itertools.pairwise(line):
        along = end - start
        share = np.clip((middle - start) @ along / max(along @ along, 1e-12), 0, 1)
        nearest = start + share[..., np.newaxis] * along
        away = np.minimum(away, np.linalg.norm(middle - nearest, axis=-1))
    assert np.abs(covered - np.clip(width / 2 + 0.5 - away, 0, 1)).max() <= LEVEL


@pytest.mark.parametrize("width", [1.0, 1.6, 3.0])
@pytest.mark.parametrize("end", [(50.0, 10.5), (50.0, 30.2), (10.5, 35.0), (33.0, 33.0)])
def test_a_line_covers_its_length_times_width(width, end):
    start = (10.5, 10.5)
    covered = alpha(lambda c: lines.polyline(c, [start, end], RED, width))
    expected = np.hypot(*np.subtract(end, start)) * width + np.pi * width**2 / 4
    # As `raster` says; the thinnest lines are off the most on diagonals.
    assert covered.sum() == pytest.approx(expected, rel=0.04 if width > 1 else 0.13)
    rows, columns = np.nonzero(covered)
    reach = width / 2 + 1
    assert columns.min() >= 10.5 - reach - 1
    assert columns.max() <= end[0] + reach
    assert rows.max() <= end[1] + reach


def test_a_line_is_centered_on_its_points_and_has_soft_edges():
    covered = alpha(lambda c: lines.polyline(c, [(5, 12.3), (55, 20.3)], RED, 1.6))
    columns = np.arange(10, 50)
    rows = (covered[:, columns] * (np.arange(40)[:, np.newaxis] + 0.5)).sum(axis=0)
    middle = rows / covered[:, columns].sum(axis=0)
    assert np.abs(middle - (12.3 + (columns + 0.5 - 5) * 8 / 50)).max() < 0.1
    between = (covered > 0.05) & (covered < 0.95)
    assert between[:, columns].any(axis=0).all()


def test_dashes_cover_their_share_and_leave_gaps():
    line = np.stack((np.linspace(5.0, 245.0, 41), np.full(41, 12.0)), axis=1)
    covered = alpha(lambda c: lines.polyline(c, line, RED, 2, dash=(6, 4)), 24, 250)
    # Round ends take π/4 of the square at either end of a stroke.
    stroke = (6 - 2) * 2 + np.pi
    assert covered.sum() == pytest.approx(24 * stroke, rel=0.02)
    assert (covered.max(axis=0)[5:245] == 0).sum() >= 24 * 3


def test_lines_drawn_at_once_are_as_one_after_the_other():
    """On canvases of several sizes, over each other, of one point, in dots, and nowhere."""
    wave = np.stack((np.linspace(-4, 70, 30), 18 + 15 * np.sin(np.arange(30) / 3)), axis=1)
    shapes = (
        (0, wave, RED, 3.0),
        (1, wave[::-1], RED, 0.7, (5.0, 3.0)),
        (0, wave + 2, (0.0, 0.5, 1.0), 1.6, (2.0, 6.0)),
        (0, wave - 99, RED),
        (1, wave[9:10], (0.0, 1.0, 0.0), 9.0, (), (5, 3, 20, 16)),
        (0, wave, RED, 3.0),
    )
    alone = [raster.blank(*size) for size in ((40, 60), (20, 33))]
    at_once = [canvas.copy() for canvas in alone]
    for number, *rest in shapes:
        lines.polyline(alone[number], *rest)
    lines._kept.clear()
    lines.draw([lines.Line(at_once[number], *rest) for number, *rest in shapes])
    for one, other in zip(alone, at_once, strict=True):
        assert one.any()
        np.testing.assert_array_equal(one, other)
    before = at_once[1].copy()
    lines.draw([lines.Line(at_once[1], wave - 99, RED), lines.Line(at_once[1], wave - 88, RED)])
    np.testing.assert_array_equal(at_once[1], before)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("dash", [(), (5.0, 3.0)])
def test_what_is_no_number_leaves_a_gap_and_other_lines_whole(dash):
    wave = np.stack((np.linspace(2, 58, 30), 18 + 15 * np.sin(np.arange(30) / 3)), axis=1)
    for value, axis in itertools.product((np.nan, np.inf, -np.inf), (0, 1)):
        torn = wave.copy()
        torn[12, axis] = value
        found, other = raster.blank(40, 60), raster.blank(40, 60)
        lines._kept.clear()
        lines.draw([lines.Line(found, torn, RED, 2.0, dash), lines.Line(other, wave, RED)])
        expected = raster.blank(40, 60)
        lines.polyline(expected, wave, RED)
        np.testing.assert_array_equal(other, expected)
        # Along a line with a gap nobody can tell where dashes are: it is drawn solid.
        expected = raster.blank(40, 60)
        for part in (wave[:12], wave[13:]):
            lines.polyline(expected, part, RED, 2.0)
        np.testing.assert_array_equal(found, expected)


def test_nothing_is_drawn_outside_the_canvas_or_the_box():
    canvas = raster.blank(20, 30)
    lines.polyline(canvas, [(-50, -20), (80, 40)], RED, 3)
    raster.rectangle(canvas, (-5, 15, 200, 400), RED)
    raster.polygon(canvas, [[(-10, -10), (12, -10), (-10, 12)]], RED)
    raster.pointer(canvas, (28.5, 25), -3, 9.5, RED)
    for box in ((-9, -9, -2, -2), (40, 3, 50, 8), (3, 25, 8, 30), (9, 9, 9, 12), (9.5, 9, 8.5, 12)):
        before = canvas.copy()
        raster.rectangle(canvas, box, (0, 1, 0))
        np.testing.assert_array_equal(canvas, before)
    boxed = alpha(lambda c: lines.polyline(c, [(0, 0), (60, 40)], RED, 3, within=(20, 10, 40, 30)))
    assert boxed[10:30, 20:40].any()
    boxed[10:30, 20:40] = 0
    assert not boxed.any()


def test_colors_are_laid_over_each_other_as_premultiplied():
    canvas = raster.blank(4, 4)
    raster.rectangle(canvas, (0, 0, 4, 4), (1, 0, 0), 0.5)
    np.testing.assert_allclose(canvas[0, 0] / 255, (0.5, 0, 0, 0.5), atol=LEVEL)
    raster.rectangle(canvas, (0, 0, 4, 4), (0, 1, 0), 0.5)
    np.testing.assert_allclose(canvas[0, 0] / 255, (0.25, 0.5, 0, 0.75), atol=2 * LEVEL)


@pytest.mark.parametrize("size", [9.0, 10.4, 21.0, 40.0])
def test_every_letter_is_drawn_inside_its_place(size):
    for character in glyphs.CHARACTERS:
        if character == " ":
            continue
        canvas = raster.blank(90, 90)
        text.draw(canvas, character, 20, 50, size, RED)
        rows, columns = np.nonzero(canvas[..., 3] > 0.02 * 255)
        assert rows.size, character
        assert columns.min() >= 20 - 0.15 * size - 1, character
        assert columns.max() <= 20 + text.width(character, size) + 0.15 * size + 1, character
        assert rows.min() >= 50 - 1.05 * size, character
        assert rows.max() <= 50 + 0.3 * size + 1, character


def test_letters_have_their_proportions():
    """Known of the font: capitals are 0.727 em high, digits equally wide, I is a bar."""
    canvas = raster.blank(200, 400)
    text.draw(canvas, "H", 50, 150, 100, RED)
    rows, _ = np.nonzero(canvas[..., 3] > 0.5 * 255)
    assert rows.max() - rows.min() + 1 == pytest.approx(72.7, abs=1)
    assert len({text.width(digit, 10) for digit in "0123456789−"}) == 1
    o = raster.blank(200, 400)
    text.draw(o, "O", 50, 150, 100, RED)
    assert o[114, 50 + round(text.width("O", 100) / 2), 3] == 0


def test_text_is_aligned_and_unknown_letters_show():
    spans = []
    for align in (0, 0.5, 1):
        canvas = raster.blank(30, 200)
        text.draw(canvas, "400 nm", 100, 20, 12, RED, align)
        columns = np.nonzero(canvas[..., 3].max(axis=0) > 0.1 * 255)[0]
        spans.append((columns.min() + columns.max() + 1) / 2 - 100)
    half = text.width("400 nm", 12) / 2
    np.testing.assert_allclose(spans, (half, 0, -half), atol=1.5)
    assert text.width("\u4e00", 12) == text.width("?", 12)


def test_a_dashed_level_covers_its_strokes():
    box = (4.0, 10.25, 54.0, 11.75)
    covered = alpha(lambda c: raster.dashes(c, box, (2.5, 2.5), RED))
    assert covered.sum() == pytest.approx(10 * 2.5 * 1.5, rel=2e-3)
    np.testing.assert_allclose(covered[11, 4:9], (0.75, 0.75, 0.375, 0, 0), atol=LEVEL)
    assert covered[10, 7:9].max() == 0
    covered[10:12, 4:54] = 0
    assert not covered.any()
