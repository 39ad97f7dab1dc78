# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that knows Blender, colour-science, OpenImageIO or files."""
