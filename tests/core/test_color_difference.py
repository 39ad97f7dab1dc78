# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""L*a*b* and ΔE00 against published data; tests/addon compares them with colour-science too."""

import numpy as np
import pytest

from core.color.color_difference import (
    LAB_FROM_ROOTS,
    adaptation,
    delta_e,
    roots,
    roots_to_lab,
    xyz_to_lab,
)

# G. Sharma, W. Wu and E. N. Dalal, "The CIEDE2000 color-difference formula: implementation notes,
# supplementary test data, and mathematical observations" (2005), table 1.
SHARMA = """
50.0000 2.6772 -79.7751 50.0000 0.0000 -82.7485 2.0425
50.0000 3.1571 -77.2803 50.0000 0.0000 -82.7485 2.8615
50.0000 2.8361 -74.0200 50.0000 0.0000 -82.7485 3.4412
50.0000 -1.3802 -84.2814 50.0000 0.0000 -82.7485 1.0000
50.0000 -1.1848 -84.8006 50.0000 0.0000 -82.7485 1.0000
50.0000 -0.9009 -85.5211 50.0000 0.0000 -82.7485 1.0000
50.0000 0.0000 0.0000 50.0000 -1.0000 2.0000 2.3669
50.0000 -1.0000 2.0000 50.0000 0.0000 0.0000 2.3669
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0009 7.1792
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0010 7.1792
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0011 7.2195
50.0000 2.4900 -0.0010 50.0000 -2.4900 0.0012 7.2195
50.0000 -0.0010 2.4900 50.0000 0.0009 -2.4900 4.8045
50.0000 -0.0010 2.4900 50.0000 0.0010 -2.4900 4.8045
50.0000 -0.0010 2.4900 50.0000 0.0011 -2.4900 4.7461
50.0000 2.5000 0.0000 50.0000 0.0000 -2.5000 4.3065
50.0000 2.5000 0.0000 73.0000 25.0000 -18.0000 27.1492
50.0000 2.5000 0.0000 61.0000 -5.0000 29.0000 22.8977
50.0000 2.5000 0.0000 56.0000 -27.0000 -3.0000 31.9030
50.0000 2.5000 0.0000 58.0000 24.0000 15.0000 19.4535
50.0000 2.5000 0.0000 50.0000 3.1736 0.5854 1.0000
50.0000 2.5000 0.0000 50.0000 3.2972 0.0000 1.0000
50.0000 2.5000 0.0000 50.0000 1.8634 0.5757 1.0000
50.0000 2.5000 0.0000 50.0000 3.2592 0.3350 1.0000
60.2574 -34.0099 36.2677 60.4626 -34.1751 39.4387 1.2644
63.0109 -31.0961 -5.8663 62.8187 -29.7946 -4.0864 1.2630
61.2901 3.7196 -5.3901 61.4292 2.2480 -4.9620 1.8731
35.0831 -44.1164 3.7933 35.0232 -40.0716 1.5901 1.8645
22.7233 20.0904 -46.6940 23.0331 14.9730 -42.5619 2.0373
36.4612 47.8580 18.3852 36.2715 50.5065 21.2231 1.4146
90.8027 -2.0831 1.4410 91.1528 -1.6435 0.0447 1.4441
90.9257 -0.5406 -0.9208 88.6381 -0.8985 -0.7239 1.5381
6.7747 -0.2908 -2.4247 5.8714 -0.0985 -2.2286 0.6377
2.0776 0.0795 -1.1350 0.9033 -0.0636 -0.5514 0.9082
"""


def test_delta_e_is_ciede2000_to_the_digits_published():
    table = np.array([[float(x) for x in line.split()] for line in SHARMA.split("\n") if line])
    assert table.shape == (34, 7)
    found = delta_e(table[:, :3], table[:, 3:6])
    np.testing.assert_array_equal(np.round(found, 4), table[:, 6])
    np.testing.assert_allclose(delta_e(table[:, 3:6], table[:, :3]), found, rtol=1e-9, atol=0)
    assert delta_e(table[:, :3].reshape(2, 17, 3), table[0, 3:6]).shape == (2, 17)


def test_opposite_hues_are_half_a_turn_apart_and_not_more():
    """The formula then takes the hue halfway between the two angles: rounding must not turn it."""
    rng = np.random.default_rng(5)
    chroma = np.column_stack((rng.uniform(0.1, 60, 20000), rng.choice((1e-3, 1, 60), 20000)))
    one = np.column_stack((np.full(20000, 50.0), chroma * rng.choice((-1, 1), chroma.shape)))
    other = one * (1, -1, -1)
    # Less than half a turn without any doubt: the larger of the two angles, below, a hair smaller.
    below = np.where(one[:, 2:] < 0, one, other)
    above = -below * (-1, 1, 1)
    hair = below + 1e-7 * np.column_stack((np.zeros(20000), below[:, 2], -below[:, 1]))
    expected = delta_e(above, hair)
    np.testing.assert_allclose(delta_e(one, other), expected, rtol=1e-5)
    np.testing.assert_allclose(delta_e(other, one), expected, rtol=1e-5)


@pytest.mark.parametrize("shape", [(9001,), (3, 5000), (100, 1, 99)])
def test_many_pairs_differ_as_each_alone_does(shape):
    """Blocks end within rows here, and one of the two is spread over the other."""
    rng = np.random.default_rng(7)
    lab = rng.uniform((0, -60, -60), (100, 60, 60), (*shape, 3))
    other = rng.uniform((0, -60, -60), (100, 60, 60), (shape[-1], 3))
    lab[0, ..., 1:], other[0, 1:] = 0, 0
    found = delta_e(lab, other)
    expected = [delta_e(row, other) for row in lab.reshape(-1, shape[-1], 3)]
    # 1e-12: which path a block takes depends on its neighbors.
    np.testing.assert_allclose(found.reshape(-1, shape[-1]), expected, rtol=0, atol=1e-12)
    np.testing.assert_allclose(delta_e(other, lab), found, rtol=0, atol=1e-12)
    few = np.array([delta_e(lab.reshape(-1, 3)[i], other[i % shape[-1]]) for i in range(50)])
    np.testing.assert_allclose(found.ravel()[:50], few, rtol=0, atol=1e-12)


def test_what_is_compared_is_left_as_it_was():
    for count in (10, 9001):
        lab = np.random.default_rng(8).uniform(-50, 50, (2, count, 3))
        before = lab.copy()
        delta_e(lab[0], lab[1])
        np.testing.assert_array_equal(lab, before)


def test_nothing_to_compare_and_no_numbers():
    assert delta_e(np.empty((0, 3)), np.zeros(3)).shape == (0,)
    broken = delta_e([[50, np.nan, 1], [50, 1, 2]], [50, 1, 1])
    assert np.isnan(broken).tolist() == [True, False]


def test_roots_lead_to_lab_and_have_its_slopes():
    relative = np.array((1e-4, 0.003, 0.008, 0.01, 0.2, 0.9, 1.3))
    bent, slope = roots(relative)
    gray = np.repeat(relative[:, np.newaxis], 3, axis=1) * (0.9, 1, 1.1)
    lab = LAB_FROM_ROOTS @ roots(gray)[0][..., np.newaxis]
    assert lab[..., 0] - (16, 0, 0) == pytest.approx(xyz_to_lab(gray, np.ones(3)))
    step = 1e-7
    rise = roots(relative + step)[0] - roots(relative - step)[0]
    assert slope == pytest.approx(rise / (2 * step), rel=1e-5)
    assert bent[-3:] == pytest.approx(np.cbrt(relative[-3:]))


def test_grays_are_exactly_gray():
    relative = np.linspace(0, 1.2, 50)[:, np.newaxis] * np.ones(3)
    np.testing.assert_array_equal(roots_to_lab(roots(relative)[0])[:, 1:], 0)


def test_adaptation_takes_one_white_to_the_other():
    one, other = np.array([1.0985, 1, 0.3558]), np.array([0.9505, 1, 1.0888])
    np.testing.assert_allclose(one @ adaptation(one, other).T, other, rtol=1e-14)
    np.testing.assert_allclose(adaptation(one, one), np.eye(3), atol=1e-15)
