# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The one error of the developer commands."""


class SetupError(Exception):
    """A command cannot go on; the message says what is wrong and what to do about it."""
