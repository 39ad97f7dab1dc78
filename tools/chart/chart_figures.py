# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which figures the chart has: a question each, and the few methods that answer it.

Standard library only: tests and tables ask for them too.
"""

from __future__ import annotations

from dataclasses import dataclass

MOST = 9
"""Labels a figure may have, to be read in ten seconds."""


@dataclass(frozen=True)
class Figure:
    """One figure of cost against error.

    Attributes
    ----------
    name
        Of its file: docs/images/chart-NAME.
    panel
        Which errors it shows, one of `chart_work.PANELS`.
    title
        The question.
    truth
        Against what.
    keys
        Of the methods.
    """

    name: str
    panel: str
    title: str
    truth: str
    keys: tuple[str, ...]


LADDER = ("lambert", "lambert-as-read", "first-order", "two-bounce", "closure", "reference")

FIGURES = (
    Figure(
        "traced",
        "traced",
        "Which model is right about random rough surfaces?",
        "error against traced Gaussian height fields, light and view below 80°",
        (*LADDER, "surface"),
    ),
    Figure(
        "angles",
        "angles",
        "Which model is right about V-grooves?",
        "error against the V-cavity solved, light and view below 80°",
        (*LADDER, "surface"),
    ),
    Figure(
        "reading",
        "reading",
        "And for one instrument reading, 45°/0°?",
        "error against the V-cavity solved, at 45°/0°",
        ("lambert", "first-order", "two-bounce", "geometric", "closure", "reference", "surface"),
    ),
    Figure(
        "shortcuts",
        "angles",
        "What do the usual shortcuts give away?",
        "error against the V-cavity solved, light and view below 80°",
        (
            "two-bounce", "two-colors", "rgb-squared", "qualitative", "qualitative-57", "mixed-57",
            "geometric", "band-loop", "sd-to-xyz",
        ),
    ),
    Figure(
        "peers",
        "traced",
        "All start from one reading at 45°/0°: who gets the other angles right?",
        "error against traced Gaussian height fields, light and view below 80°",
        (
            "lambert-as-read", "two-bounce-matched", "surface-matched", "eon-matched",
            "cycles-matched", "mitsuba-diffuse", "mitsuba-principled", "luxcore-roughmatte",
        ),
    ),
)  # fmt: skip
