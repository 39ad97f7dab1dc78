# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read and write what a material stores.

The truth is the spectrum; color and roughness in the shader node are derived from it. The stamp
says from what; `stamp` tells whether that still holds.
"""

from __future__ import annotations

import json
from typing import Any

from ..core.errors import InputError, MaterialError
from .properties import SCHEMA
from .sample import Sample
from .stamp import inputs_digest, sigma
from .target import Request, Solution

_DETAILS = (
    *("license", "position", "device", "condition", "illuminant", "observer", "lab", "xyz"),
    *("quantity", "geometry", "aperture", "specular"),
)
_SENTENCES = ("notes", "altered")


def store(material: Any, request: Request, shader: str) -> None:
    """Write the spectrum and all settings of a request into the material."""
    sample, group = request.sample, material.rough_spectra
    group.schema = SCHEMA
    group.sample_name = sample.name
    group.source = sample.source
    group.kind = sample.kind
    group.instrument = sample.instrument
    # repr of a float keeps every bit of it.
    group.spectrum = json.dumps(
        {"wavelengths": sample.wavelengths.tolist(), "values": sample.values.tolist()}
    )
    group.details = json.dumps(
        {key: getattr(sample, key) for key in _DETAILS}
        | {key: list(getattr(sample, key)) for key in _SENTENCES}
    )
    group.sigma = request.sigma
    group.sigma_source = sample.sigma_source
    group.illuminant = request.illuminant
    group.observer = str(request.observer)
    group.model = request.model
    group.shader = shader


def load(material: Any) -> Request:
    """Read back what `store` wrote.

    Raises
    ------
    MaterialError
        If the material has no spectrum, or one stored by a newer version.
    """
    group = material.rough_spectra
    if not group.spectrum:
        msg = f"Material {material.name!r} has no measured spectrum; assign one first."
        raise MaterialError(msg)
    if group.schema > SCHEMA:
        msg = (
            f"Material {material.name!r} was stored by a newer Rough Spectra (schema "
            f"{group.schema}); update the extension to work with it."
        )
        raise MaterialError(msg)
    try:
        spectrum, details = json.loads(group.spectrum), json.loads(group.details or "{}")
        lists = ("lab", "xyz", *_SENTENCES)
        pairs = {key: tuple(details[key]) for key in lists if details.get(key)}
        plain = {key: details[key] for key in _DETAILS if key in details and key not in pairs}
        sample = Sample(
            name=group.sample_name,
            wavelengths=spectrum["wavelengths"],
            values=spectrum["values"],
            kind=group.kind,
            instrument=group.instrument,
            sigma_source=group.sigma_source,
            source=group.source,
            **(plain | pairs),
        )
    except (InputError, ValueError, KeyError, TypeError) as error:
        msg = (
            f"Material {material.name!r}: its stored spectrum cannot be read ({error}); assign "
            "the sample again."
        )
        raise MaterialError(msg) from error
    return Request(
        sample=sample,
        sigma=sigma(group),
        model=group.model,
        illuminant=group.illuminant,
        observer=int(group.observer),
    )


def set_stamp(material: Any, solution: Solution, working_space: str, node: str) -> None:
    """Note what was derived and from what."""
    group = material.rough_spectra
    stamp = {
        "inputs": inputs_digest(group),
        "working_space": working_space,
        "node": node,
        "color": solution.color.tolist(),
        "roughness": solution.roughness,
        "model": solution.model,
        "model_reason": solution.model_reason,
        "shader_reason": solution.shader_reason,
        "delta_e_instrument": solution.delta_e_instrument,
        "delta_e_mean": solution.delta_e_mean,
        "delta_e_95": solution.delta_e_95,
        "warnings": list(solution.warnings),
    }
    group.stamp = json.dumps(stamp)
