# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Principled BSDF: the same lobe as that of the Diffuse BSDF, below the gloss that it has."""

from __future__ import annotations

from ..target_shader import TargetShader

SHADER = TargetShader(
    name="PRINCIPLED",
    title="Principled BSDF",
    description="Set a Principled BSDF below the gloss that it has; one that is made has none",
    number=2,
)
