# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The core's formula of a Principled BSDF's gloss, against Cycles."""

import numpy as np
from rough_spectra.addon.instrument.measure import RING_45_0, Geometry, measure
from rough_spectra.core import cycles
from rough_spectra.core.cycles import gloss_lobe
from rough_spectra.core.gloss import Gloss

STEEPEST = np.radians(80)
KINDS = 40
"""Random sets of gloss, color and diffuse roughness."""


def single(values):
    """Round to what a socket can hold."""
    return np.asarray(values, np.float32).astype(np.float64)


def random_gloss(rng):
    """One in two has a coat, one in two a tint, one in five an index below 1."""
    pick = rng.uniform(0, 1, 16).astype(np.float32).tolist()
    white = (1.0, 1.0, 1.0)
    return Gloss(
        level=pick[0],
        roughness=float(np.float32(0.1 + 0.8 * pick[1])),
        ior=float(np.float32(1.05 + pick[2] if pick[3] > 0.2 else 0.6 + 0.3 * pick[2])),
        tint=tuple(pick[4:7]) if pick[7] > 0.5 else white,
        coat=pick[8] if pick[9] > 0.5 else 0.0,
        coat_roughness=float(np.float32(0.1 + 0.8 * pick[10])),
        coat_ior=float(np.float32(1.05 + pick[11])),
        coat_tint=tuple(pick[12:15]) if pick[7] > 0.5 else white,
        multiscatter=pick[15] > 0.2,
    )


def principled(make_material, gloss, color, roughness):
    material = make_material(
        node="ShaderNodeBsdfPrincipled",
        Base_Color=(*color, 1),
        Diffuse_Roughness=roughness,
        Specular_IOR_Level=gloss.level,
        Roughness=gloss.roughness,
        IOR=gloss.ior,
        Specular_Tint=(*gloss.tint, 1),
        Coat_Weight=gloss.coat,
        Coat_Roughness=gloss.coat_roughness,
        Coat_IOR=gloss.coat_ior,
        Coat_Tint=(*gloss.coat_tint, 1),
    )
    node = material.node_tree.nodes["Principled BSDF"]
    node.distribution = "MULTI_GGX" if gloss.multiscatter else "GGX"
    return material


def test_formula_agrees_with_renders(make_material):
    """Random gloss, color and diffuse roughness in random directions and at the instrument."""
    rng = np.random.default_rng(14)
    kinds = [random_gloss(rng) for _ in range(KINDS)]
    colors, roughness = single(rng.uniform(0, 1, (KINDS, 3))), single(rng.uniform(0, 1, KINDS))
    sine = np.sqrt(rng.uniform(0, np.sin(STEEPEST) ** 2, (2, 24)))
    light, view, around = (*np.arcsin(sine), rng.uniform(0, 2 * np.pi, 24))
    geometries = [
        Geometry(((float(i), float(phi)),), float(r))
        for i, r, phi in zip(light, view, around, strict=True)
    ]
    materials = [
        principled(make_material, *each) for each in zip(kinds, colors, roughness, strict=True)
    ]
    seen = measure(materials, [*geometries, RING_45_0], samples=8)[:, :, 0]
    angles = (np.append(light, np.pi / 4), np.append(view, 0), np.append(around, 0))
    diffuse = cycles.reflectance(colors[:, None], roughness[:, None], *angles)
    expected = np.stack(
        [
            gloss_lobe.layer(gloss, *angles).over(below)
            for gloss, below in zip(kinds, diffuse, strict=True)
        ],
        axis=1,
    )
    # Cycles adds up in single precision, and lights the very tip of a narrow lobe through sines
    # of small angles.
    apart = np.abs(seen - expected) / (1 + expected)
    assert apart.max() < 5e-5
    assert apart[-1].max() < 2e-5
