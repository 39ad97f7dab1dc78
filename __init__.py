# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rough Spectra: measured rough materials that read the same when measured again."""


def register() -> None:
    """Add the extension's classes to Blender."""
    from .addon.interface import registration

    registration.register()


def unregister() -> None:
    """Take the extension's classes out of Blender."""
    from .addon.interface import registration

    registration.unregister()
