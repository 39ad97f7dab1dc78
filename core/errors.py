# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The one exception family of Rough Spectra.

Each message is one sentence for a person: what is wrong, where, and what to do about it.
Operators turn it into a report, the command line into exit status 2.
"""


class RoughSpectraError(Exception):
    """Anything the user can mend; the message names the place and the remedy."""


class DomainError(RoughSpectraError, ValueError):
    """A number lies where the physics is not defined."""


class InputError(RoughSpectraError):
    """A file cannot be used; the message names the file, the place and the remedy."""


class MaterialError(RoughSpectraError):
    """A Blender material cannot be read or written as asked."""


class OutputError(RoughSpectraError):
    """A result cannot be written; whatever stood at its target is as it was."""


class OwnFaultError(RoughSpectraError):
    """Rough Spectra itself failed, where nothing the user did could matter; says what to report."""


class CancelledError(RoughSpectraError):
    """The user stopped a long task; nothing was written."""
