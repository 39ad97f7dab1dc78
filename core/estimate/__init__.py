# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The roughness σ from readings: what they say of it, and what they leave open.

readings       what was read, with what repeatability, and which bands can be used
likelihood     how well a σ explains the readings, with the albedo that suits it best
search         the best σ, and the interval that noise leaves open
estimation     both with what the models leave open, or why σ can't be told
"""

from .estimation import CONFIDENCE, LARGEST, MODEL, MODEL_ERROR, SPREAD, Estimate, of_draws, sigma
from .readings import ABSOLUTE, RELATIVE, Reading, repeatability

__all__ = [
    "ABSOLUTE",
    "CONFIDENCE",
    "LARGEST",
    "MODEL",
    "MODEL_ERROR",
    "RELATIVE",
    "SPREAD",
    "Estimate",
    "Reading",
    "of_draws",
    "repeatability",
    "sigma",
]
