# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a reading is of: the shader node as it stood, and how its color was derived. No Blender."""

from __future__ import annotations

from dataclasses import dataclass, field

Triple = tuple[float, float, float]

Colors = dict[str, Triple]
"""Scene-linear RGB by the name of its space, such as "ACEScg"; not clipped to any gamut."""


@dataclass(frozen=True)
class Node:
    """The shader node behind the material's output, as it stood when the reading was taken.

    Parameters
    ----------
    name, shader
        The node's name, and its type in short, such as "diffuse".
    color, roughness
        Values of its sockets: scene-linear RGB of the working space, and the diffuse roughness;
        None where that is no number. Of a texture, what multiplies it.
    colors
        The same color in spaces that pipelines exchange; empty without one.
    textured
        Whether the color is a texture.
    linked
        Names of sockets that other nodes set: their values here do not show.
    in_use
        Names of sockets besides, such as sheen, that change what is shown.
    muted, bumped
        Whether the node is muted, and whether bump or displacement turns its surface.
    gloss
        What lies over the color, by the fields of `core.gloss.Gloss`; None for a matte one.
    """

    name: str
    shader: str
    color: Triple | None
    roughness: float | None
    colors: Colors = field(default_factory=dict)
    textured: bool = False
    linked: tuple[str, ...] = ()
    in_use: tuple[str, ...] = ()
    muted: bool = False
    bumped: bool = False
    gloss: dict[str, float | Triple | bool] | None = None


@dataclass(frozen=True)
class Derivation:
    """How color and roughness of the node came about, as the material notes it.

    Parameters
    ----------
    state
        Whether that still holds: "fresh", "stale", "kept", "error" or "linked".
    reasons
        Why it does not, sentences without their first capital and their full stop.
    version
        Of the extension that derived it; empty in files of early ones.
    working_space
        Name of the space that the color was written in.
    color, roughness
        What was written to the node.
    model, model_reason, shader_reason
        The model of the target and why it was taken; whether it is Lambertian or rough, and why.
    delta_e_instrument, delta_e_mean, delta_e_95
        Predicted ΔE00 at the instrument, and over the hemisphere or the scene's directions.
    delta_e_lights
        Predicted mean ΔE00 by the scene's lights; empty without a scene.
    scene_reason
        What the scene decided; empty without one.
    sigma_max
        Largest σ, degrees, that the reading allows; None where every σ fits.
    settings
        All that the color follows from, by the words of the panel.
    """

    state: str
    reasons: tuple[str, ...]
    version: str
    working_space: str
    color: Triple
    roughness: float
    model: str
    model_reason: str
    shader_reason: str
    delta_e_instrument: float
    delta_e_mean: float
    delta_e_95: float
    delta_e_lights: dict[str, float] = field(default_factory=dict)
    scene_reason: str = ""
    sigma_max: float | None = None
    settings: dict[str, str] = field(default_factory=dict)
