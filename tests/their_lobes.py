# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Diffuse lobes of renderers, written down anew from their code, with vectors as they have them.

MaterialX: libraries/pbrlib/genglsl/lib/mx_microfacet_diffuse.glsl of 1.39. Mitsuba 3:
src/bsdfs/principled.cpp. LuxCore: src/slg/materials/roughmatte.cpp. tools/checks/check_exports.py
holds them to the renderers themselves.

Each takes a color (channels,), a roughness and angles (3, directions), and gives reflectance
factors (directions, channels).
"""

import numpy as np


def vectors(light, view, azimuth):
    """Unit vectors to light and view, shape (3, n); the normal is z."""
    zero = np.zeros_like(light)
    to_light = np.array([np.sin(light) * np.cos(azimuth), np.sin(light) * np.sin(azimuth), zero])
    to_light[2] = np.cos(light)
    return to_light, np.array([np.sin(view), zero, np.cos(view)])


def materialx(color, roughness, angles):
    to_light, to_view = vectors(*angles)
    n_l, n_v, l_v = to_light[2], to_view[2], (to_light * to_view).sum(axis=0)
    one, two = 0.5 - 2 / (3 * np.pi), 2 / 3 - 28 / (15 * np.pi)
    s = l_v - n_l * n_v
    stinv = np.where(s > 0, s / np.maximum(n_l, n_v), s)
    a = 1 / (1 + one * roughness)

    def albedo(cos):
        sin = np.sqrt(1 - cos * cos)
        g = sin * (np.arccos(cos) - sin * cos) + 2 * (sin / cos * (1 - sin**3) - sin) / 3
        return a + roughness * a * g / np.pi

    mean = a * (1 + two * roughness)
    c = color[:, np.newaxis]
    again = c * c * mean / (1 - c * (1 - mean))
    lost = (1 - albedo(n_v)) * (1 - albedo(n_l)) / (1 - mean) if roughness else 0
    return (c * a * (1 + roughness * stinv) + again * lost).T


def mitsuba(color, roughness, angles):
    to_light, to_view = vectors(*angles)
    half = to_light + to_view
    half /= np.linalg.norm(half, axis=0)
    cos_d = (half * to_light).sum(axis=0)
    at_light, at_view = (1 - to_light[2]) ** 5, (1 - to_view[2]) ** 5
    plain = (1 - 0.5 * at_light) * (1 - 0.5 * at_view)
    rr = 2 * roughness * cos_d**2
    retro = rr * (at_view + at_light + at_view * at_light * (rr - 1))
    return (color[:, np.newaxis] * (plain + retro)).T


def luxcore(color, sigma, angles):
    to_light, to_view = vectors(*angles)
    a = 1 - sigma**2 / (2 * (sigma**2 + 0.33))
    b = 0.45 * sigma**2 / (sigma**2 + 0.09)
    sin_i, sin_o = (np.hypot(*each[:2]) for each in (to_light, to_view))
    cosine = (to_light[:2] * to_view[:2]).sum(axis=0) / (sin_i * sin_o)
    steeper = to_light[2] < to_view[2]
    sin_alpha = np.where(steeper, sin_i, sin_o)
    tan_beta = np.where(steeper, sin_o / to_view[2], sin_i / to_light[2])
    return (color[:, np.newaxis] * (a + b * np.maximum(0, cosine) * sin_alpha * tan_beta)).T


def lambert(color, _roughness, angles):
    return np.tile(color, (np.size(angles[0]), 1))
