# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples and settings given to materials."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from math import degrees, radians
from typing import Any

import bpy

from ...core.errors import DomainError
from ...core.instruments import DEFAULT
from ...core.limits import TOLERANCE
from ..blender import colors
from ..instrument import adjustment
from ..instrument.adjustment import Adjusted
from ..matching.request import AUTO, Request
from ..matching.solution import Solution
from ..material import derive, storage
from ..material.properties import SHADER_ITEMS
from ..samples import stated_white
from ..samples.sample import Kind, Sample
from ..samples.stated_sigma import Names, StatedSigma
from .checks import checked

_SIGMA = Names("sigma")


def request(
    sample: Sample,
    sigma: float | None = None,
    *,
    kind: Kind | None = None,
    model: str = AUTO,
    illuminant: str = "D65",
    observer: int = 2,
    tolerance: float = TOLERANCE,
    rdq: float | None = None,
    sdq: float | None = None,
    white: str | None = None,
    white_factor: float | str | None = None,
    read_at: str = DEFAULT,
) -> Request:
    """Say what to make of a sample; what is left out is as on the command line.

    Parameters
    ----------
    sample
        What `read` or `find` gave, or a `Sample` of your own.
    sigma
        Roughness σ, **radians**, 0 to π/3. None takes what the sample says, or else 0.
    kind
        "reading" for the reflectance factor that an instrument printed of the rough surface,
        "albedo" for the reflectance of one facet. None takes what the sample says.
    model
        "auto", which is `core.models.TARGET`, or one of `core.models.NAMES`.
    illuminant
        Light under which the color is right: "D65", "A", "D50", "D55", "D75", "E", "F2", "F7",
        "F11" or "LED-B3".
    observer
        Of reports, 2 or 10 (degrees).
    tolerance
        Largest ΔE00 from the reference that "auto" accepts for a simpler model, 0.05 to 20.
    rdq, sdq
        Instead of σ, the rms slope of a profile or of an area as a profilometer prints it, rise
        over run: σ = atan(Rdq) = atan(Sdq/√2). It is kept with the material as the source of σ.
    white, white_factor
        What the values are relative to: "perfect" for the perfect diffuser, or the certificate of
        the instrument's white plaque, "45:0" or "8:d"; and the plaque's true reflectance factor at
        the instrument's geometry over the certificate's value, or "ptfe" for sintered PTFE. None
        takes what the sample says. The values stay as measured.
    read_at
        Virtual instrument that the material is to read right at, and is measured with: one of
        `core.instruments.REGISTRY`, such as "45a:0" or "di:8". The sample says itself which real
        instrument it was measured with.

    Raises
    ------
    DomainError
        A setting is none of these; or σ, Rdq and Sdq contradict each other.
    InputError
        The kind is neither, or the white's factor does not follow from what is stated.

    Examples
    --------
    >>> request(find("brick"), rdq=0.35).sample.sigma_source
    'Rdq 0.35 (19.3°)'
    >>> round(request(find("brick"), white="8:d", white_factor="ptfe").sample.scale, 4)
    1.0259
    >>> wanted = request(find("green"), sigma=radians(20), illuminant="D50")
    >>> wanted.model, wanted.illuminant, round(wanted.sigma, 3)
    ('auto', 'D50', 0.349)
    >>> request(find("green"), sigma=20)
    Traceback (most recent call last):
    rough_spectra.core.errors.DomainError: σ is 20 radians; give 0 to π/3, as math.radians(30) is.
    """
    if rdq is not None or sdq is not None:
        stated = StatedSigma(None if sigma is None else degrees(sigma), rdq, sdq)
        _, fault = stated.fault(_SIGMA)
        if fault:
            raise DomainError(f"Sample {sample.name!r}: {fault}.")
        source = stated.source("")
        sample = replace(sample, sigma_degrees=stated.settled, sigma_source=source)
    if sigma is None:
        sigma = radians(sample.sigma_degrees or 0.0)
    if kind is not None:
        sample = sample.taken_as(kind)
    sample = stated_white.given(sample, white, white_factor)
    return Request(
        sample,
        sigma,
        model,
        illuminant=illuminant,
        observer=observer,
        tolerance=tolerance,
        read_at=read_at,
    )


def assign(
    pairs: Iterable[tuple[bpy.types.Material, Sample | Request]],
    shader: str | Sequence[str] = "auto",
    gloss: str = "keep",
) -> list[Solution]:
    """Give materials measured spectra, all of them or none, and set their shader nodes.

    Parameters
    ----------
    pairs
        Each a material, and what it is to become. A sample alone stands for `request(sample)`.
    shader
        "auto" sets the Diffuse or Principled BSDF that is in use, or a new Diffuse BSDF;
        "diffuse" and "principled" ask for that node. One for all, or a list with one a pair.
    gloss
        "keep" leaves a Principled BSDF the gloss that it has, and solves the color below it;
        "none" removes it. A node that is made has none. "read" sets its level and roughness to what
        a sample's set says of gloss (see `estimate_gloss`), in a Principled BSDF; where it says
        nothing, it is as "keep".

    Returns
    -------
    What was matched, in the order of `pairs`: among others `color`, shape (3,); `roughness`;
    `delta_e_instrument` and `delta_e_mean`, the ΔE00 that remain at the virtual instrument and over
    all angles;
    and `warnings`, sentences that should be read.

    Raises
    ------
    MaterialError
        A material cannot be written, or is named twice; nothing was changed.
    DomainError
        A spectrum or a setting cannot be used; nothing was changed.

    Examples
    --------
    >>> wall, door = (bpy.data.materials.new(name) for name in ("Wall", "Door"))
    >>> pairs = [(wall, find("neutral 6.5")), (door, request(find("green"), 0.35))]
    >>> solutions = assign(pairs, gloss="none")
    >>> [[round(value, 2) for value in solution.color.tolist()] for solution in solutions]
    [[0.36, 0.36, 0.36], [0.06, 0.3, 0.06]]
    >>> [round(solution.roughness, 2) for solution in solutions]
    [0.0, 0.28]
    >>> [solution.delta_e_instrument < 0.001 for solution in solutions]
    [True, True]
    """
    wanted = [
        (checked(material), request(what) if isinstance(what, Sample) else what)
        for material, what in pairs
    ]
    if gloss not in ("keep", "none", "read"):
        raise DomainError(f"gloss is {gloss!r}; make it 'keep', 'none' or 'read'.")
    shaders = [shader] * len(wanted) if isinstance(shader, str) else list(shader)
    if len(shaders) != len(wanted):
        raise DomainError(
            f"{len(shaders)} shaders stand beside {len(wanted)} pairs; give one each."
        )
    nodes = [_node(each) for each in shaders]
    return derive.assign(wanted, nodes, gloss != "none", from_readings=gloss == "read")


def match_by_measuring(
    material: bpy.types.Material,
    sample: Sample | Request | None = None,
    color: str = "",
    progress: Callable[[int, int], None] | None = None,
) -> Adjusted:
    """Set one color of a material so that what Cycles shows is the sample's reading.

    For what no formula tells: mixes, groups, sheen, layers, bump. Several colors are tried at once
    in a second Blender, up to five times, and this call waits for it. Nothing but that color is
    changed, and it is kept: it does not follow σ.

    Parameters
    ----------
    sample
        What it is to read; None for what the material stores.
    color
        Node and name of a socket, as in "Diffuse BSDF: Color"; a group's input; or an RGB node.
        Empty takes the one that is most likely meant.
    progress
        Called with measurements done and how many there are at most; may raise to stop.

    Returns
    -------
    `color` and `reading`, shape (3,); `delta_e` between reading and sample; `is_met`, whether
    that is at most 0.1; `measurements`; and a `sentence` for a person, which tells what can be had
    where the sample cannot.

    Raises
    ------
    MaterialError
        The material cannot be written, has no such color, or does not change with it; nothing was
        changed.
    OutputError
        The second Blender failed; nothing was changed.
    CancelledError
        On an interrupt from the keyboard; nothing was changed.

    Examples
    --------
    >>> velvet = bpy.data.materials.new("Velvet")
    >>> _ = assign([(velvet, find("green"))], "principled")
    >>> velvet.node_tree.nodes["Principled BSDF"].inputs["Sheen Weight"].default_value = 0.3
    >>> found = match_by_measuring(velvet)
    >>> found.is_met, state(velvet).kind
    (True, 'kept')
    """
    checked(material)
    asked = storage.load(material) if sample is None else sample
    wanted = request(asked) if isinstance(asked, Sample) else asked
    return adjustment.adjust(material, wanted, colors.find(material, color), progress)


def _node(shader: str) -> Any:
    """Give what the material's own setting calls a shader."""
    known = [identifier for identifier, *_ in SHADER_ITEMS]
    if shader.upper() not in known:
        choices = ", ".join(known).lower()
        raise DomainError(f"The shader {shader!r} is not known; choose one of {choices}.")
    return shader.upper()
