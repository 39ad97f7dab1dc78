# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which white a reading is relative to, on plaques whose true values are made up or NIST's."""

import math

import pytest

from core import instruments, white_scale
from core.errors import DomainError

RING = ("45a:0", "0:45a", "45x:0", "45a:0-iso", "0:45a-iso", "45x:0-iso", "45as45")
SPHERES = ("di:8", "de:8")


@pytest.mark.parametrize("instrument", instruments.REGISTRY)
def test_every_instrument_has_its_geometry(instrument):
    expected = "45:0" if instrument in RING else "8:d" if instrument in SPHERES else ""
    assert white_scale.geometry_of(instrument) == expected
    assert white_scale.factor("perfect", instrument) == 1
    assert white_scale.factor("perfect", instrument, plaque="ptfe") == 1


@pytest.mark.parametrize("certificate", ["45:0", "8:d"])
@pytest.mark.parametrize("instrument", [*RING, *SPHERES])
def test_a_sample_reads_what_it_is(certificate, instrument):
    """What an instrument does, step by step, with a plaque of sintered PTFE."""
    plaque = {"45:0": 1.0156, "8:d": 0.99}
    truth, counts_per_factor = 0.42, 31_000.0
    counts = {"white": plaque[white_scale.geometry_of(instrument)] * counts_per_factor}
    counts["sample"] = truth * counts_per_factor
    printed = counts["sample"] / counts["white"] * plaque[certificate]
    factor = white_scale.factor(certificate, instrument, plaque="ptfe")
    assert printed * factor == pytest.approx(truth, rel=1e-12)


def test_what_it_matters():
    """Of the order that the measured surfaces say: 1.5 to 2.6 %."""
    off = white_scale.factor("8:d", "45a:0", plaque="ptfe") - 1
    assert 0.015 < off < 0.027
    assert white_scale.factor("45:0", "di:8", plaque="ptfe") == pytest.approx(1 / (1 + off))


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("8:d", "45a:0"), "the white's certificate is of 8:d and the reading of 45a:0"),
        (("8:d", "45as15", None, "ptfe"), "the factor of ptfe at 45as15 is not known"),
        (("8:d", "45a:0", 1.02, "ptfe"), "leave one of them out"),
        (("8:d", "45a:0", 102.0), "the white's factor is 102; it is the plaque's true value"),
        (("8:d", "45a:0", 0.0), "the white's factor is 0"),
        (("8:d", "45a:0", math.nan), "the white's factor is nan"),
        (("perfect", "45a:0", 1.02), "the perfect diffuser has no factor"),
        (("paper", "45a:0"), "the white is 'paper'; make it one of perfect, 45:0, 8:d"),
        (("8:d", "45a:0", None, "chalk"), "the plaque is 'chalk'; make it 'ptfe'"),
    ],
)
def test_what_does_not_follow_is_refused(given, words):
    with pytest.raises(DomainError) as caught:
        white_scale.factor(*given)
    assert words in str(caught.value)
    assert words in white_scale.fault(*given)


def test_a_stated_factor_counts_at_every_geometry():
    assert white_scale.factor("8:d", "45as15", 1.1) == 1.1
    assert white_scale.factor("8:d", "di:8", 0.995) == 0.995


def test_words_of_files():
    assert {white_scale.parse(t) for t in ("perfect", "Perfect reflecting diffuser")} == {"perfect"}
    assert {white_scale.parse(t) for t in ("45/0", "45°:0°", "0/45", " 45a:0 ")} == {"45:0"}
    assert {white_scale.parse(t) for t in ("8/d", "d:8", "8°/d", "8/h", "di:8")} == {"8:d"}
    assert {white_scale.parse(t) for t in ("", "white", "4:0", "45", "60:0")} == {None}


def test_numbers_stay_what_a_blend_stores():
    assert {white.name: white.number for white in white_scale.REGISTRY.values()} == {
        "perfect": 0,
        "45:0": 1,
        "8:d": 2,
    }
