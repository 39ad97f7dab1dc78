# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Principled BSDF without its gloss, which leaves the same lobe as that of the Diffuse BSDF."""

from __future__ import annotations

from ..target_shader import TargetShader

SHADER = TargetShader(
    name="PRINCIPLED",
    title="Principled BSDF",
    description="Set a Principled BSDF with its specular level at 0",
    number=2,
)
