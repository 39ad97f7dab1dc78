# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Diffuse BSDF: the diffuse lobe and nothing else."""

from __future__ import annotations

from ..target_shader import TargetShader

SHADER = TargetShader(
    name="DIFFUSE",
    title="Diffuse BSDF",
    description="Set a Diffuse BSDF, making one if another shader is in use",
    number=1,
    is_default=True,
)
