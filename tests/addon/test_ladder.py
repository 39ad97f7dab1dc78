# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The models in CIEDE2000, on scenes that tools/checks/check_ladder.py draws.

The tool takes 1,000 of another seed; docs/ladder.md states what it finds.
"""

import numpy as np
import pytest

from tools.checks import check_ladder


@pytest.fixture(scope="module")
def errors(extension):
    return check_ladder.errors(check_ladder.random_scenes(60, seed=4))


def test_every_model_errs_as_the_manual_says(errors):
    median = {model: float(np.median(found)) for model, found in errors.items()}
    assert median["surface"] < 1e-12
    # V-grooves are nearer than no roughness at all, and none of them is near.
    assert 3 < median["lambert"] < 9
    for model in ("two-bounce", "closure", "reference"):
        assert 0.3 < median[model] < 0.6 * median["lambert"]
