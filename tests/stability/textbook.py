# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The forms one writes down first, each without one remedy of the core.

tools/manual/stability_figures.py draws them; test_remedies_matter.py holds them against the checks
as the core. Each takes what the core's function takes.
"""

import numpy as np

from core import oren_nayar, reading, vcavity
from core.cycles import matching
from core.errors import DomainError
from core.vcavity import slope_law


def root(values, sigma):
    """(-b + √(b² + 4ar)) / 2a, as a textbook prints it."""
    values = np.asarray(values)
    f1, f2 = (
        f[..., np.newaxis] for f in reading.coefficients(np.asarray(sigma, dtype=values.dtype))
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        return (-f1 + np.sqrt(f1 * f1 + 4 * f2 * values)) / (2 * f2)


def root_with_warnings(values, sigma):
    """The stable root, but without a word to numpy that NaN is meant."""
    f1, f2 = reading.coefficients(sigma)
    return 2 * values / (f1 + np.sqrt(f1 * f1 + 4 * f2 * values))


def clipped_root(values, sigma):
    """Albedos forced into 0 to 1."""
    return np.clip(reading.to_albedo(values, sigma), 0, 1)


def root_of_clipped(values, sigma):
    """Noise below zero taken for black."""
    return reading.to_albedo(np.maximum(values, 0), sigma)


def sigma_max(peak):
    """(-b - √(b² - 4ac)) / 2a for σ²."""
    a, b, c = 0.67 - peak, 0.46 * (1 - peak) - 0.0089, 0.0429 * (1 - peak)
    return np.sqrt((-b - np.sqrt(b * b - 4 * a * c)) / (2 * a))


def bounce_ratio(sigma):
    """1 - f2 / (1 - f1), the ratio as energy conservation gives it."""
    f1, f2 = reading.coefficients(sigma)
    with np.errstate(invalid="ignore"):
        return 1 - f2 / (1 - f1)


def closure(albedo, sigma):
    """Sum all bounces with that ratio."""
    rho = np.asarray(albedo)
    sigma = np.asarray(sigma, dtype=rho.dtype)
    f1, f2 = reading.coefficients(sigma)
    return f1 * rho + f2 * rho**2 / (1 - bounce_ratio(sigma) * rho)


def cut_series(albedo, sigma, bounces=16):
    """Sum the reference's bounces up to the 16th and drop the others."""
    rho = np.asarray(albedo)
    angles = np.pi / 4, 0.0, 0.0, sigma
    rows = vcavity.bounce_coefficients(*angles, bounces=bounces, slopes="oren-nayar")
    return np.sum(rows * rho[..., np.newaxis] ** np.arange(1, bounces + 1), axis=-1)


def gaussian_slopes(sigma):
    """Give slopes and their shares of area from the density as it is written, by one fixed rule."""
    points, weights = np.polynomial.legendre.leggauss(200)
    slope = (points + 1) * np.pi / 4
    m = np.tan(sigma)
    share = (
        weights * np.tan(slope) / np.cos(slope) ** 2 * np.exp(-(np.tan(slope) ** 2) / (2 * m**2))
    )
    return slope, share / np.sum(share)


def drawn_slopes(sigma):
    """Give them by the inverse of their running sum."""
    steps = (np.arange(1000) + 0.5) / 1000
    return np.arctan(np.tan(sigma) * np.sqrt(-2 * np.log1p(-steps))), np.full(1000, 1 / 1000)


def extrapolated_slopes(sigma):
    """Give them with what polynomials say of slopes beyond the last one solved."""
    nodes = slope_law.nodes(6)[-6:]
    slope, _ = drawn_slopes(min(float(sigma), np.pi / 2))
    each = [
        np.prod([(slope - other) / (node - other) for other in nodes if other != node], axis=0)
        for node in nodes
    ]
    return nodes, np.mean(each, axis=1)


def _assemble(alpha, beta, cos_phi, backward, sigma):
    s2 = sigma * sigma
    slant = 2 * beta / np.pi
    c2 = 0.45 * s2 / (s2 + 0.09) * (np.sin(alpha) - np.where(backward, slant**3, 0))
    c3 = 0.125 * s2 / (s2 + 0.09) * (4 * alpha * beta / np.pi**2) ** 2
    f1 = 1 - 0.5 * s2 / (s2 + 0.33) + cos_phi * c2 * np.tan(beta)
    f1 = f1 + (1 - np.abs(cos_phi)) * c3 * np.tan((alpha + beta) / 2)
    f2 = 0.17 * s2 / (s2 + 0.13) * (1 - cos_phi * slant**2)
    dtype = np.result_type(alpha, beta)
    return np.asarray(f1, dtype), np.asarray(f2, dtype)


def factors(theta_i, theta_r, delta_phi, sigma):
    """Equations 30 and 31 as printed."""
    cos_phi = np.cos(delta_phi)
    return _assemble(
        np.maximum(theta_i, theta_r), np.minimum(theta_i, theta_r), cos_phi, cos_phi < 0, sigma
    )


def factors_branching_on_angle(theta_i, theta_r, delta_phi, sigma):
    """Take the branch "cos Δφ < 0" as "Δφ > 90°"."""
    return _assemble(
        np.maximum(theta_i, theta_r),
        np.minimum(theta_i, theta_r),
        np.cos(delta_phi),
        np.abs(delta_phi) > np.pi / 2,
        sigma,
    )


def factors_ignoring_nan(theta_i, theta_r, delta_phi, sigma):
    """As with C's fmax and fmin, which drop NaN."""
    cos_phi = np.cos(delta_phi)
    return _assemble(
        np.fmax(theta_i, theta_r), np.fmin(theta_i, theta_r), cos_phi, cos_phi < 0, sigma
    )


def factors_from_vectors(theta_i, theta_r, delta_phi, sigma):
    """cos Δφ as a renderer gets it: from directions projected onto the surface."""
    light, view = (np.asarray(t) for t in (theta_i, theta_r))
    across = np.sin(light) * np.sin(view)
    dot = across * np.cos(delta_phi)
    with np.errstate(invalid="ignore"):
        cos_phi = dot / across
    return _assemble(np.maximum(light, view), np.minimum(light, view), cos_phi, cos_phi < 0, sigma)


def factors_refusing_rounding(theta_i, theta_r, delta_phi, sigma):
    """Take π/2 in float64 as the limit of an angle in float32."""
    for angle in (theta_i, theta_r, sigma):
        if np.any(np.asarray(angle, np.float64) > np.pi / 2):
            msg = f"{angle} lies outside 0 to π/2"
            raise DomainError(msg)
    return oren_nayar.factors(theta_i, theta_r, delta_phi, sigma)


def cycles_reflectance(color, roughness, theta_i, theta_r, delta_phi):
    """Cycles' closure in the order in which its source computes it."""
    color = np.asarray(color)
    dtype = color.dtype.type
    s, light, view = (np.asarray(x, color.dtype) for x in (roughness, theta_i, theta_r))
    a = 1 / (dtype(np.pi) + s * dtype(np.pi / 2 - 2 / 3))
    b = s * a
    t = np.sin(light) * np.sin(view) * np.cos(np.asarray(delta_phi, color.dtype))
    t = np.where(t > 0, t / np.maximum(np.cos(light), np.cos(view)), t)

    def energy(theta):
        sin, cos = np.sin(theta), np.cos(theta)
        g = sin * (theta - dtype(2 / 3) - sin * cos) + dtype(2 / 3) * (sin / cos) * (1 - sin**3)
        return dtype(np.pi) * a + b * g

    mean = dtype(np.pi) * a + b * dtype((2 * np.pi - 5.6) / 3)
    with np.errstate(invalid="ignore", divide="ignore"):
        lost = (1 - energy(light)) * (1 - energy(view)) * mean / (1 - mean)
        shared = color**2 * lost[..., None] / (1 - color * (1 - mean[..., None]))
    return color * (dtype(np.pi) * (a + b * t)[..., None] + shared)


def targets(albedo, geometries, sigma):
    """Leave the published model's negative values among the targets of matching."""
    return oren_nayar.reflectance(np.full(3, albedo), *geometries, sigma)


def resample(values, source, target):
    """Interpolate by a matrix of weights, zeros included."""
    source, target = np.asarray(source, float), np.asarray(target, float)
    weights = np.stack([np.interp(target, source, unit) for unit in np.eye(source.size)])
    with np.errstate(invalid="ignore"):
        return np.asarray(values) @ weights


def coefficients_of_anything(sigma):
    """f1 and f2 without a look at the unit of σ."""
    s2 = np.asarray(sigma) ** 2
    return 1 - 0.5 * s2 / (s2 + 0.33), 0.17 * s2 / (s2 + 0.13)


def color_of_clipped(values, roughness):
    """Socket color of a reading whose noise was taken for black."""
    return matching.color_for_reading(np.maximum(values, 0), roughness)


def factors_with_qualitative_constant(theta_i, theta_r, delta_phi, sigma):
    """C1 with the constant 0.57 of the paper's qualitative model."""
    f1, f2 = oren_nayar.factors(theta_i, theta_r, delta_phi, sigma)
    s2 = np.asarray(sigma) ** 2
    return f1 + 0.5 * s2 / (s2 + 0.33) - 0.5 * s2 / (s2 + 0.57), f2


def clipped_reflectance(albedo, theta_i, theta_r, delta_phi, sigma):
    """Hide from the caller what the model gives."""
    return np.maximum(oren_nayar.reflectance(albedo, theta_i, theta_r, delta_phi, sigma), 0)


def reading_with_warnings(albedo, sigma):
    """f1 ρ + f2 ρ² without a word to numpy that NaN is meant."""
    rho = np.asarray(albedo)
    f1, f2 = reading.coefficients(np.asarray(sigma, rho.dtype))
    return f1 * rho + f2 * rho * rho


def root_without_nan(values, sigma):
    """Take a missing band for black, as nan_to_num does."""
    return np.nan_to_num(reading.to_albedo(np.nan_to_num(values), sigma))
