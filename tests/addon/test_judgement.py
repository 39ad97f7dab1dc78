# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files whose own color contradicts their spectrum are named; the others are not."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
from rough_spectra.addon import judgement, readers, target, working_space

NIX = sorted((Path(__file__).parents[1] / "fixtures" / "nix").glob("*.csv"))


@pytest.mark.parametrize("path", NIX, ids=lambda path: path.stem)
def test_device_lab_agrees_under_the_files_own_light(path):
    (sample,) = readers.read(path)
    # 0.02: the files print nine digits; what is left is the interpolation of the weights.
    assert judgement.own_color_difference(sample) <= 0.02
    assert judgement.contradiction(sample) == ""


def test_brick_only_seems_to_disagree_when_its_light_is_ignored():
    (brick,) = readers.read(next(path for path in NIX if path.stem == "brick"))
    assert (brick.illuminant, brick.observer) == ("D50", 2)
    misread = replace(brick, illuminant="D65", observer=10)
    assert round(judgement.own_color_difference(misread), 1) == 1.7


def test_contradiction_reaches_the_user_with_the_solution():
    (sample,) = readers.read(NIX[0])
    lightness, a, b = sample.lab
    wrong = replace(sample, lab=(lightness, a + 5, b))
    (solution,) = target.solve([target.Request(wrong, math.radians(10))], working_space.current())
    assert any("differs from its own spectrum" in warning for warning in solution.warnings)
    (solution,) = target.solve([target.Request(sample, math.radians(10))], working_space.current())
    assert not any("own spectrum" in warning for warning in solution.warnings)


def test_without_a_stated_light_nothing_is_claimed():
    (sample,) = readers.read(NIX[0])
    assert judgement.own_color_difference(replace(sample, illuminant="")) is None
    assert judgement.own_color_difference(replace(sample, lab=None)) is None
