# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How things are started: the extension without Blender's executable, and a desktop Blender."""
