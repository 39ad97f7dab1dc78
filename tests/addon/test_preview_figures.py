# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures show what they are given, where it belongs, in colors that everybody can tell apart."""

from dataclasses import replace

import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry import perceptibility
from rough_spectra.addon.matching import solve, surface_spectra
from rough_spectra.addon.material import derive
from rough_spectra.addon.preview import figures
from rough_spectra.addon.preview.data import collect
from rough_spectra.addon.preview.drawing import (
    lines,
    looks,
    raster,
    text,
)
from rough_spectra.addon.preview.figures import compose, data, plot
from rough_spectra.addon.preview.figures.sigma_range import MOST, _limit_said
from rough_spectra.core import feasible, reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.gloss import Gloss

DARK = looks.look((0.239, 0.239, 0.239), (0.902, 0.902, 0.902))
LIGHT = looks.look((0.8, 0.8, 0.8), (0.102, 0.102, 0.102))
LOOKS = pytest.mark.parametrize("look", [DARK, LIGHT], ids=["dark", "light"])
SIZE = (280, 130)


@pytest.fixture(scope="session")
def green(colorchecker):
    return next(sample for sample in colorchecker if sample.name == "green")


def scaled(look, scale):
    return replace(look, scale=float(scale))


def drawn(figure, size, *numbers):
    """Shares of a figure on a canvas that was used before: it has to fill all of it."""
    canvas = raster.blank(size[1], size[0])
    canvas[:] = (1, 2, 3, 255)
    lines.draw(figure(canvas, *numbers) or ())
    return canvas / np.float32(255)


def row_of(canvas, color, column, within):
    """Middle of what is drawn in a color in one column, pixels; NaN where nothing is."""
    seen = canvas[within[1] : within[3], column]
    own = seen[:, :3] / np.maximum(seen[:, 3:], 1e-6)
    share = np.where(np.abs(own - color).max(axis=1) < 0.02, seen[:, 3], 0)
    rows = np.arange(within[1], within[3]) + 0.5
    return (rows * share).sum() / share.sum() if share.sum() > 0.5 else np.nan


@LOOKS
@pytest.mark.parametrize("scale", [1, 2])
def test_the_reading_runs_through_its_values(look, scale):
    look, size = scaled(look, scale), (SIZE[0] * scale, SIZE[1] * scale)
    nm = np.arange(380.0, 731, 10)
    curve = 0.3 + 0.25 * np.sin(nm / 60)
    canvas = drawn(figures.spectrum, size, nm, np.full(nm.size, 0.05), curve, [], look)
    axes = figures.spectrum_axes(size, look, curve.max())
    columns = np.arange(axes.left + 3, axes.right - 3)
    wanted = axes.place(
        np.interp(columns + 0.5, (axes.left, axes.right), axes.x),
        np.interp(
            np.interp(columns + 0.5, (axes.left, axes.right), axes.x),
            nm,
            curve,
        ),
    )[:, 1]
    found = [row_of(canvas, look.target, column, axes.box) for column in columns]
    # Where a grid line or the albedo shines through the color is mixed, and the column is left out.
    seen = np.isfinite(found)
    assert seen.mean() > 0.8
    assert np.nanmax(np.abs(found - wanted)) < 1


@LOOKS
def test_both_curves_over_angle_run_through_their_values(look):
    wanted = 0.5 + 0.3 * np.cos(np.radians(data.VIEW_ANGLES))
    blender = 0.25 + 0.1 * np.cos(np.radians(data.VIEW_ANGLES + 20))
    canvas = drawn(figures.angles, SIZE, data.VIEW_ANGLES, wanted, blender, 0.1, look)
    axes = figures.angles_axes(SIZE, look, wanted.max())
    columns = np.arange(axes.left + 3, axes.right - 3)
    degrees = np.interp(columns + 0.5, (axes.left, axes.right), axes.x)
    for values, color, share in ((wanted, look.target, 0.8), (blender, look.blender, 0.3)):
        rows = axes.place(degrees, np.interp(degrees, data.VIEW_ANGLES, values))[:, 1]
        found = [row_of(canvas, color, column, axes.box) for column in columns]
        assert np.isfinite(found).mean() > share
        assert np.nanmax(np.abs(found - rows)) < 1


def test_the_polar_plot_has_its_curve_at_the_right_distance():
    level = np.full(data.VIEW_ANGLES.size, 0.5)
    canvas = drawn(figures.angles_polar, (200, 120), data.VIEW_ANGLES, level, level * 0, DARK)
    for degrees in (-60, 0, 45):
        [[x, y]] = figures.polar_place((200, 120), DARK, [degrees], [0.5 / plot.ceiling(0.5)])
        pixel = canvas[int(y), int(x)]
        assert pixel[3] > 0.8
        np.testing.assert_allclose(pixel[:3] / pixel[3], DARK.target, atol=0.1)


@LOOKS
def test_bars_stand_at_their_values(look):
    bars = [(400.0, 490.0, 0.2), (490.0, 570.0, 0.5), (570.0, 690.0, 0.35)]
    nothing = np.zeros(36)
    nm = np.linspace(380, 730, 36)
    canvas = drawn(figures.spectrum, SIZE, nm, nothing, nothing, bars, look)
    axes = figures.spectrum_axes(SIZE, look, 0.5)
    for start, end, value in bars:
        [[x, y]] = axes.place([(start + end) / 2], [value])
        assert row_of(canvas, look.blender, int(x), axes.box) == pytest.approx(y, abs=0.5)
        [[left, _]] = axes.place([start], [value])
        assert canvas[int(y), int(left) + 2, 3] > 0.9


@LOOKS
@pytest.mark.parametrize("scale", [1, 2])
def test_the_albedos_that_a_reading_leaves_open_are_shaded_and_nothing_else(look, scale):
    look, size = scaled(look, scale), (SIZE[0] * scale, SIZE[1] * scale)
    nm = np.arange(380.0, 731, 10)
    low, nothing = 0.2 + 0.1 * np.sin(nm / 60), np.zeros(nm.size)
    high = low + 0.25
    bare = drawn(figures.spectrum, size, nm, nothing, np.full(nm.size, 0.55), [], look)
    shown = drawn(
        figures.spectrum, size, nm, nothing, np.full(nm.size, 0.55), [], look, (low, high)
    )
    axes = figures.spectrum_axes(size, look, 0.55)
    changed = np.abs(shown - bare).max(axis=2)
    columns = np.arange(axes.left + 3, axes.right - 3)
    at = np.interp(columns + 0.5, (axes.left, axes.right), axes.x)
    for column, wavelength in zip(columns, at, strict=True):
        top, bottom = (axes.down(float(np.interp(wavelength, nm, side))) for side in (high, low))
        rows = np.arange(axes.top, axes.bottom) + 0.5
        inside = (rows > top + 2) & (rows < bottom - 2)
        outside = (rows < top - 2) | (rows > bottom + 2)
        # A grid line has nearly the color of what is laid over it.
        seen = changed[axes.top : axes.bottom, column]
        assert (seen[inside] > 0.05).mean() > 0.9
        assert seen[outside].max() == 0


def test_open_albedos_are_those_of_the_measured_reading_whatever_sigma(green):
    space = working_space.current()
    request = solve.Request(replace(green, kind="reading"), np.radians(20), "closure")
    first, later = (
        data.of_request(replace(request, sigma=np.radians(degrees)), np.full(3, 0.2), 0.3, space)
        for degrees in (20, 50)
    )
    low, high = first.open_albedos
    expected = feasible.albedo_range(green.reflectance, "closure")
    np.testing.assert_array_equal(low, expected.lowest)
    np.testing.assert_array_equal(high, expected.highest)
    # The same arrays: while σ is dragged they are searched and shaded once.
    assert later.open_albedos is first.open_albedos
    for shown in (first, later):
        assert (shown.albedo >= low - 1e-4).all()
        assert (shown.albedo <= high + 1e-4).all()
    known = solve.Request(replace(green, kind="albedo"), np.radians(20), "closure")
    assert data.of_request(known, np.full(3, 0.2), 0.3, space).open_albedos is None


def test_swatches_have_exactly_their_colors():
    one, other = (0.25, 0.5, 0.75), (0.24, 0.5, 0.75)
    canvas = drawn(figures.swatch_pair, (80, 80), one, other, DARK)
    middle = np.rint(canvas[20] * 255)
    # To the nearest of the 256 levels that a screen has.
    np.testing.assert_array_equal(middle[:40], [(64, 128, 191, 255)] * 40)
    np.testing.assert_array_equal(middle[40:], [(61, 128, 191, 255)] * 40)
    marked = drawn(figures.swatch_pair, (80, 80), one, other, DARK, (False, True))
    changed = np.nonzero((marked != canvas).any(axis=-1))
    assert changed[0].max() < 10
    assert changed[1].min() > 69


@LOOKS
def test_a_figure_is_the_same_after_others_were_drawn(look, green):
    """What is kept from one picture to the next is never drawn on."""
    space, color = working_space.current(), np.array((0.1, 0.3, 0.1))
    low, high = (
        data.of_request(solve.Request(green, sigma, model="closure"), color, sigma / 2, space)
        for sigma in (0.3, 0.9)
    )
    for figure in ("swatches", "sheet", "polar"):
        first = compose.picture(figure, low, 200, look)
        other = compose.picture(figure, high, 200, look)
        assert figure == "swatches" or (first != other).any()
        np.testing.assert_array_equal(compose.picture(figure, low, 200, look), first)


def test_an_axis_stays_while_what_it_shows_changes_a_little():
    """Also where a polished gloss mirrors the light, hundreds of times as bright as white."""
    for low, high in ((0.21, 0.39), (3.1, 3.9), (4.1, 5.9), (210.0, 299.0), (1001.0, 1999.0)):
        [top] = {plot.ceiling(peak) for peak in np.linspace(low, high, 50)}
        assert high <= top <= 2 * low
    for peak in np.logspace(-1, 9, 200):
        assert plot.ceiling(peak) >= peak


def test_many_balls_are_as_one():
    colors, gloss = np.array([(0.1, 0.2, 0.3), (0.9, 0.5, 0.0)]), Gloss(roughness=0.2)
    for side in (16, 120):
        many = figures.balls(side, colors, 0.4, np.eye(3), gloss)
        for color, canvas in zip(colors, many, strict=True):
            one = figures.ball(side, color, 0.4, np.eye(3), gloss)
            np.testing.assert_array_equal(canvas, one)
        assert (many[..., 3] == many[0, ..., 3]).all()


@LOOKS
def test_the_range_of_sigma_ends_where_it_should(look):
    canvas = drawn(figures.sigma_range, (380, 30), 10, 30.0, look)
    row = canvas[11]
    is_bar = np.abs(row[:, :3] - look.target).max(axis=1) < 0.02
    left, right = 4, 376
    assert np.nonzero(is_bar)[0].max() == pytest.approx(left + (right - left) / 2, abs=1.5)
    mark = left + (right - left) * 10 / 60
    top = canvas[0, :, 3]
    assert (np.arange(380) + 0.5) @ top / top.sum() == pytest.approx(mark, abs=0.5)
    everywhere = drawn(figures.sigma_range, (380, 30), 10, None, look)[11]
    assert (everywhere[left:right, 3] == 1).all()


@LOOKS
@pytest.mark.parametrize("sigma", [0, 31, 60])
@pytest.mark.parametrize("width", [60, 120, 280])
def test_letters_stay_inside_the_picture(look, sigma, width):
    """No ink on the outermost columns next to text: nothing is cut."""
    canvas = drawn(figures.sigma_range, (width, 30), sigma, 58.0, look)
    assert not canvas[19:, 0, 3].any()
    assert not canvas[19:, -1, 3].any()
    nm = np.linspace(380, 730, 36)
    spectrum = drawn(figures.spectrum, (width, 90), nm, nm / 1000, nm / 1200, [], look)
    legend = spectrum[: plot.legend_height(look)]
    assert not legend[:, -1, 3].any()


@LOOKS
def test_letters_are_readable(look):
    """WCAG 2.1 asks for a contrast of 4.5 for text."""
    for color in (look.text, look.faint, look.target, look.blender):
        assert looks.contrast(color, look.background) >= 4.5
    assert looks.contrast((0, 0, 0), (1, 1, 1)) == pytest.approx(21)
    assert looks.contrast((119 / 255,) * 3, (1, 1, 1)) == pytest.approx(4.48, abs=0.01)


# Machado, Oliveira and Fernandes (2009), table 1, severity 1.0, for linear RGB.
DEFICIENCIES = {
    "protanopia": (
        (0.152286, 1.052583, -0.204868),
        (0.114503, 0.786281, 0.099216),
        (-0.003882, -0.048116, 1.051998),
    ),
    "deuteranopia": (
        (0.367322, 0.860646, -0.227968),
        (0.280085, 0.672501, 0.047413),
        (-0.011820, 0.042940, 0.968881),
    ),
    "tritanopia": (
        (1.255528, -0.076749, -0.178779),
        (-0.078411, 0.930809, 0.147602),
        (0.004733, 0.691367, 0.303900),
    ),
}


@LOOKS
@pytest.mark.parametrize("deficiency", [None, *DEFICIENCIES])
def test_color_blind_readers_tell_the_curves_apart(look, deficiency):
    matrix = np.eye(3) if deficiency is None else np.array(DEFICIENCIES[deficiency])
    encoded = np.array((look.target, look.blender, look.text, look.faint))
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    seen = np.clip(linear @ matrix.T, 0, 1)
    from_rgb = np.array(
        ((0.4124, 0.3576, 0.1805), (0.2126, 0.7152, 0.0722), (0.0193, 0.1192, 0.9505))
    )
    lab = color_difference.xyz_to_lab(seen @ from_rgb.T, from_rgb.sum(axis=1))
    apart = color_difference.delta_e(lab[:, np.newaxis], lab)
    # Differences that are seen at a glance; and the curves differ in dash and thickness, too.
    assert apart[0, 1] > 25
    assert min(apart[0, 2], apart[1, 2]) > 15
    assert min(apart[0, 3], apart[1, 3]) > 10


def test_data_of_a_material_is_what_the_solver_matched(make_material, green):
    sample = replace(green, kind="reading")
    material = make_material()
    request = solve.Request(sample, np.radians(28))
    [solution] = derive.assign([(material, request)])
    space = working_space.current()
    found = collect(material, space)
    settled = replace(request, model=solution.model)
    np.testing.assert_allclose(found.reading, solve.target_reading(settled))
    np.testing.assert_allclose(
        reading.from_albedo(found.albedo, np.radians(28), solution.model), found.reading, rtol=1e-6
    )
    np.testing.assert_allclose(found.target.color, found.blender.color, atol=1e-4)
    assert [bar[2] for bar in found.bars] == pytest.approx(solution.target[::-1], abs=1e-5)
    middle = data.VIEW_ANGLES == 0
    # Light from 45°, view along the normal: the instrument's own geometry.
    # The closure for any direction and the one for the instrument are two fits.
    assert found.target_curve[middle] == pytest.approx(found.lambert, rel=2e-3)
    assert found.blender_curve[middle] == pytest.approx(found.lambert, rel=1e-4)
    assert found.sigma == pytest.approx(28, abs=1e-4)


def test_a_hand_edited_node_shows_as_it_is(make_material, green):
    material = make_material()
    derive.assign([(material, solve.Request(green, 0.4))])
    node = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
    node.inputs["Roughness"].default_value = 0
    found = collect(material, working_space.current())
    # Half of the light of a linear space, encoded by sRGB's curve.
    np.testing.assert_allclose(found.blender.color, 1.055 * 0.5 ** (1 / 2.4) - 0.055, atol=1e-4)
    assert found.target.color != found.blender.color


@pytest.mark.parametrize("model", ["lambert", "first-order", "two-bounce", "closure", "reference"])
@pytest.mark.parametrize("kind", ["reading", "albedo"])
def test_every_model_gives_curves(green, model, kind):
    request = solve.Request(replace(green, kind=kind), 0.5, model=model)
    color = np.array((0.2, 0.4, 0.2))
    found = data.of_request(request, color, 0.3, working_space.current())
    assert np.isfinite(found.target_curve).all()
    assert found.target_curve.min() >= 0
    assert (found.albedo >= found.reading - 1e-9).all()


def test_sigma_max_is_the_published_bound(green):
    """The positive root of the quadratic in the physics page, for the two-bounce model."""
    for peak, degrees in ((0.8, 48.9), (0.9, 28.0), (0.95, 19.5)):
        bright = replace(
            green, kind="reading", values=np.full(green.wavelengths.size, peak), instrument="45a:0"
        )
        request = solve.Request(bright, 0.1, model="two-bounce")
        assert surface_spectra.sigma_max(request) == pytest.approx(degrees, abs=0.06)
    assert surface_spectra.sigma_max(solve.Request(replace(green, kind="albedo"), 0.1)) is None


def test_bars_cover_the_visible_range_in_order(green):
    for illuminant in ("D65", "A"):
        bars = data.rgb_bars(np.array((0.1, 0.2, 0.3)), working_space.current(), illuminant)
        (b0, b1, b), (g0, g1, g), (r0, r1, r) = bars
        assert b0 < b1 < g0 < g1 < r0 < r1
        assert (b, g, r) == (0.3, 0.2, 0.1)


def test_a_color_beyond_the_screen_is_marked():
    space = working_space.current()
    assert not data.patch(np.array((1.0, 1.0, 1.0)), space).outside
    np.testing.assert_allclose(data.patch(np.ones(3), space).color, 1, atol=1e-3)
    assert data.patch(np.array((-0.05, 0.5, 0.2)), space).outside
    assert data.patch(np.array((0.5, 1.2, 0.2)), space).outside


@LOOKS
@pytest.mark.parametrize("side", [40, 140, 200, 420])
def test_every_figure_is_drawn_at_every_size(look, side, green):
    found = data.of_request(
        solve.Request(green, 0.5, model="closure"),
        np.array((0.1, 0.3, 0.1)),
        0.3,
        working_space.current(),
    )
    for figure in ("swatches", "sheet", "spectrum", "angles", "polar"):
        canvas = compose.picture(figure, found, side, look)
        assert canvas.shape == (side, side, 4)
        assert canvas.dtype == np.uint8
        # Premultiplied: no color is brighter than its alpha.
        assert (canvas[..., :3] <= canvas[..., 3:]).all()
        assert canvas[..., 3].max() > 0.9 * 255


def test_the_range_of_sigma_is_told_without_a_letter():
    assert [_limit_said(most) for most in (21.04, MOST)] == [
        "fits up to 21.0°",
        "any roughness fits",
    ]


def test_words_follow_the_thresholds():
    assert [perceptibility.words(x) for x in (0, 0.79, 0.8, 1.9, 2.0, 30, float("nan"))] == [
        "not visible",
        "not visible",
        "visible beside the sample",
        "visible beside the sample",
        "visible",
        "visible",
        "unknown",
    ]


def test_ticks_that_would_touch_are_thinned_evenly():
    canvas = raster.blank(20, 90)
    axes = plot.Axes(0, 0, 89, 5, (-80, 80), (0, 1))
    ticks = [(t, f"{t}°") for t in (-60, -30, 0, 30, 60)]
    plot.name_below(canvas, axes, ticks, 16, DARK)
    inked = canvas[..., 3].max(axis=0) > 0.1 * 255
    assert inked[:30].any()
    assert inked[60:].any()
    for value in (-30, 30):
        [[x, _]] = axes.place([value], [0])
        width = text.width("30°", DARK.font) / 4
        assert not inked[int(x - width) + 2 : int(x)].all()


def test_the_shinier_the_smaller_and_brighter_is_the_highlight_up_to_a_mirror():
    """A mirror shows a light without width in no pixel: the ball was as dull at Gloss 1 as at 0."""
    color, dull = np.full(3, 0.1), None
    brightest, areas = [], []
    for roughness in (1.0, 0.7, 0.5, 0.3, 0.15, 0.0):
        ball = figures.ball(96, color, 0.2, np.eye(3), Gloss(roughness=roughness))[..., 1].astype(
            int
        )
        dull = figures.ball(96, color, 0.2, np.eye(3))[..., 1].astype(int)
        brightest.append(ball.max())
        areas.append(int((ball > (dull.max() + ball.max()) / 2).sum()))
    assert brightest[-1] == 255
    assert brightest == sorted(brightest)
    assert areas[1:] == sorted(areas[1:], reverse=True)
    assert 4 <= areas[-1] < areas[2] / 4
    for coat in (0.0, 0.03):  # the coat's mirror shows, too
        gloss = Gloss(level=0.0, coat=1.0, coat_roughness=coat)
        assert figures.ball(96, color, 0.2, np.eye(3), gloss)[..., 1].max() == 255
