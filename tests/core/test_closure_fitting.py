# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The closed form through a few grays, against surfaces that it was not made from."""

import numpy as np
import pytest

from core import vcavity
from core.closure.fitting import fit
from core.errors import DomainError

GRAYS = np.array([0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.96])
BETWEEN = np.array([0.05, 0.15, 0.3, 0.58, 0.73, 0.86, 0.93])


@pytest.mark.parametrize("degrees", [15, 30, 45])
def test_nine_grays_tell_the_albedos_between(degrees):
    """The V-cavity's solver sums bounce after bounce, and knows no closed form."""
    sigma = np.radians(degrees)
    found = fit(GRAYS, vcavity.reading_from_albedo(GRAYS, sigma))
    expected = vcavity.reading_from_albedo(BETWEEN, sigma)
    off = np.abs(found.reading(BETWEEN) / expected - 1).max()
    assert off < 2 * found.residual + 1e-6
    assert found.residual < 6e-4


def test_the_residual_is_that_of_the_worst_gray():
    read = 0.9 * GRAYS
    read[4] *= 1.02
    found = fit(GRAYS, read)
    off = np.abs(found.reading(GRAYS) / read - 1)
    assert found.residual == pytest.approx(off.max(), abs=1e-12)
    assert 0.005 < found.residual < 0.02


@pytest.mark.parametrize(
    ("albedo", "read", "words"),
    [
        ([0.1, 0.5, 0.9], [0.1, 0.5, 0.9], "give 4 or more"),
        ([0.1, 0.5, 0.9, 0.95], [0.1, 0.5, 0.9], "one of each"),
        ([0.0, 0.5, 0.9, 0.95], [0.0, 0.5, 0.9, 0.95], "leave it out"),
        ([0.1, 0.5, 0.9, 0.95], [0.1, 0.5, np.nan, 0.95], "leave it out"),
    ],
)
def test_too_few_or_no_numbers_are_refused(albedo, read, words):
    with pytest.raises(DomainError, match=words):
        fit(albedo, read)
