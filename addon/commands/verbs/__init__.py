# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verbs of the command line. A verb is one module of this package, found by itself.

NAME = "assign"                                          what the user types
SUMMARY, DESCRIPTION                                     a line for the list, and its own help
def add_arguments(parser: ArgumentParser) -> None        declares options, but --blend, --debug
def run(options: Namespace) -> int                       the exit status
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
