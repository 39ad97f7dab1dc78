# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verbs of the command line. A verb is one module of this package, found by itself.

NAME = "assign"                                          what the user types
SUMMARY, DESCRIPTION                                     a line for the list, and its own help
def add_arguments(parser: ArgumentParser) -> None        declares options, but for those of all
def run(options: Namespace) -> int                       the exit status

All have --blend, --debug, --quiet, --json and --version.
Results go to files or through `shown_text.out`, what has to be known through `tell`, what went well
through `inform`; `result.add` adds facts for --json.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from ...support.discovery import modules

if TYPE_CHECKING:
    import argparse


class Verb(Protocol):
    """What a module of this package offers."""

    NAME: str
    SUMMARY: str
    DESCRIPTION: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the options."""

    def run(self, options: argparse.Namespace) -> int:
        """Do it and give the exit status."""


def verbs() -> list[Verb]:
    """Import all verbs, and give them in the order of their names."""
    return sorted(modules(__name__, __path__), key=lambda verb: verb.NAME)
