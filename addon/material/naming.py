# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of materials: those that we or Blender gave follow the sample, those of the user stay."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from ..blender import untouched

_CUT = 59
"""Bytes of a name from which on Blender may have cut it, to make room for a number behind it."""


def given_by_us(materials: Sequence[Any]) -> list[Any]:
    """Give those whose name is their sample's, or Blender's own while nobody touched them.

    To be asked before another sample is assigned. One that is marked as an asset keeps its name:
    others find it by that.
    """
    new = untouched.among(materials)
    return [
        material
        for material in materials
        if material.asset_data is None and (material in new or _is_samples(material))
    ]


def rename(materials: Iterable[Any], sample: str) -> None:
    """Call materials as their sample; a name that is taken gets a number from Blender."""
    for material in materials:
        if not _is_called(material.name, sample):
            material.name = sample


def _is_samples(material: Any) -> bool:
    sample = material.rough_spectra.sample_name
    return bool(sample) and _is_called(material.name, sample)


def _is_called(name: str, sample: str) -> bool:
    """Whether a name is a sample's, as Blender writes it."""
    base = untouched.without_number(name)
    cut = base.encode()
    return sample in {name, base} or (len(cut) >= _CUT and sample.encode().startswith(cut))
