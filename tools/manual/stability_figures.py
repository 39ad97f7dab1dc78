# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the figures of stability.md: what the textbook's form does and what the core's does.

    python -m tools.manual.stability_figures

Needs matplotlib and numpy. The textbook's forms are those that tests/stability holds against the
same checks as the core.
"""

import warnings

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from core import (
    cycles,
    oren_nayar,
    reading,
    vcavity,
)
from core.numerics import wavelength_grid
from tests.stability import exact, textbook
from tools.manual import figure_style
from tools.manual.figure_style import BLUE, GRAY, TEAL, VERMILION
from tools.run.run_command_line import ROOT

IMAGES = ROOT / "docs" / "images"
TEXTBOOK, OURS, THIRD = VERMILION, BLUE, TEAL

STYLE = {
    "figure.figsize": (7.0, 3.7),
    "figure.constrained_layout.use": True,
    "axes.titlesize": 12,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.labelsize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "lines.linewidth": 2,
    "legend.frameon": False,
    "svg.hashsalt": "rough-spectra",
    "svg.fonttype": "none",
    "font.size": 10,
}


def save(figure, name):
    figure_style.save(figure, IMAGES / f"stability-{name}", dpi=120)
    plt.close(figure)


def floor(error):
    """Errors below the last digit of float64, shown as that digit."""
    return np.maximum(np.nan_to_num(np.asarray(error, float), nan=1.0), 2e-16)


def root():
    figure, axes = plt.subplots()
    sigma = np.geomspace(1e-10, 1, 220)
    for dtype, dashes, name in ((np.float64, "-", "float64"), (np.float32, ":", "float32")):
        r = np.array([0.5], dtype)
        expected = np.array([exact.albedo(r[0], dtype(s)) for s in sigma])
        for form, color, who in (
            (textbook.root, TEXTBOOK, "textbook"),
            (reading.to_albedo, OURS, "ours"),
        ):
            found = form(r, sigma.astype(dtype))[:, 0]
            axes.loglog(
                np.degrees(sigma),
                floor(np.abs(found / expected - 1)),
                dashes,
                color=color,
                label=f"{who}, {name}",
            )
    axes.set(
        xlabel="roughness σ (degrees)",
        ylabel="relative error of the albedo",
        ylim=(3e-17, 5),
        title="As σ → 0 the textbook root loses every digit",
    )
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, "root")


def grazing():
    figure, axes = plt.subplots()
    right = np.float32(np.pi / 2)
    theta = [right]
    for _ in range(8):
        theta.append(np.nextafter(theta[-1], np.float32(0)))
    theta = np.array(theta[::-1])
    zero, sigma = np.zeros_like(theta), np.full_like(theta, 0.5)
    steps = np.arange(-8, 1)
    for form, color, mark, name, shift in (
        (textbook.factors, TEXTBOOK, "X", "textbook", 0.1),
        (oren_nayar.factors, OURS, "o", "ours", -0.1),
    ):
        value = form(theta, theta, zero, sigma)[0]
        axes.plot(steps + shift, value, mark, color=color, ms=8, label=name, ls="none")
    axes.axhline(0, color="black", lw=1)
    axes.set_yscale("symlog", linthresh=1e5)
    axes.set_yticks([-1e7, -1e6, 0, 1e6, 1e7])
    axes.set_ylim(-4e7, 4e7)
    axes.set(
        xlabel="θi = θr, in float32 steps from its own 90°",
        ylabel="F1 (dimensionless)",
        title="Float32's 90° lies beyond 90°: the tangent turns negative",
    )
    axes.annotate(
        "here tan β = −22 877 332",
        (0.1, -7e6),
        (-4.2, -5e6),
        arrowprops={"arrowstyle": "->", "color": TEXTBOOK},
        color=TEXTBOOK,
    )
    axes.legend(loc="center left")
    save(figure, "grazing")


def grazing_away():
    figure, axes = plt.subplots()
    gap = np.geomspace(3e-7, 0.3, 90)
    for dtype, dashes, name in ((np.float64, "-", "float64"), (np.float32, ":", "float32")):
        theta = (np.pi / 2 - gap).astype(dtype)
        away, sigma = np.full_like(theta, np.pi), np.full_like(theta, 0.7)
        expected = np.array([exact.factors(t, t, away[0], sigma[0])[0] for t in theta])
        for form, color, who in (
            (textbook.factors, TEXTBOOK, "textbook"),
            (oren_nayar.factors, OURS, "ours"),
        ):
            error = np.abs(form(theta, theta, away, sigma)[0] - expected)
            # The worst up to here: the error itself jumps from one number to the next.
            worst = np.maximum.accumulate(error[::-1])[::-1]
            axes.loglog(np.degrees(gap), floor(worst), dashes, color=color, label=f"{who}, {name}")
    axes.axhline(0.0249, color=GRAY, lw=1)
    axes.text(16, 0.04, "|F1| itself at 90°", color=GRAY)
    axes.invert_xaxis()
    axes.set(
        xlabel="90° − θ (degrees), θi = θr, Δφ = 180°",
        ylabel="absolute error of F1",
        ylim=(3e-17, 1),
        title="0 · ∞ away from the light: F1 dissolves in noise",
    )
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, "grazing-away")


def normal():
    figure, axes = plt.subplots()
    theta = np.linspace(0, np.radians(12), 25)
    for azimuth, sign in ((0.0, 1), (np.pi, -1)):
        light, sigma = np.full_like(theta, np.pi / 4), np.full_like(theta, 0.5)
        ours = oren_nayar.factors(light, theta, np.full_like(theta, azimuth), sigma)[0]
        book = textbook.factors_from_vectors(light, theta, np.full_like(theta, azimuth), sigma)[0]
        first = sign == 1
        axes.plot(sign * np.degrees(theta), ours, "-", color=OURS, label="ours" if first else None)
        axes.plot(
            sign * np.degrees(theta),
            book,
            "X",
            color=TEXTBOOK,
            ms=6,
            label="cos Δφ from projected vectors" if first else None,
        )
    axes.axvline(0, color=TEXTBOOK, lw=1, ls=":")
    middle = float(reading.coefficients(0.5)[0])
    axes.plot(0, middle, "o", color=OURS, ms=9)
    axes.annotate(
        "0/0: NaN at the normal,\nno mark here",
        (0, middle),
        (-11, middle + 0.025),
        color=TEXTBOOK,
        arrowprops={"arrowstyle": "->", "color": TEXTBOOK},
    )
    axes.set(
        xlabel="view angle from the normal (degrees), light at 45°, σ = 28.6°",
        ylabel="F1 (dimensionless)",
        title="Along the normal the azimuth is 0/0, and does not matter",
    )
    axes.legend(loc="lower right")
    save(figure, "normal")


def azimuth():
    figure, axes = plt.subplots()
    phi = np.linspace(-np.pi, 3 * np.pi, 721)
    geometry = (np.radians(75.0), np.radians(70.0), phi, np.radians(30.0))
    axes.plot(
        np.degrees(phi),
        textbook.factors_branching_on_angle(*geometry)[0],
        color=TEXTBOOK,
        label="branch at Δφ = 90°",
    )
    axes.plot(
        np.degrees(phi),
        oren_nayar.factors(*geometry)[0],
        color=OURS,
        ls="--",
        label="ours: branch at cos Δφ = 0",
    )
    axes.set_xticks(np.arange(-180, 541, 90))
    axes.set(
        xlabel="azimuth Δφ (degrees), θi = 75°, θr = 70°, σ = 30°",
        ylabel="F1 (dimensionless)",
        title="A branch on Δφ itself goes wrong after a full turn",
    )
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 1), handlelength=1.3)
    save(figure, "azimuth")


def negative():
    figure, axes = plt.subplots()
    theta = np.radians(np.linspace(40, 89, 50))
    albedo, sigma = np.array([0.05]), np.radians(70.0)
    geometry = (theta, theta, np.full_like(theta, np.pi))
    book = oren_nayar.reflectance(albedo, *geometry, sigma)[:, 0]
    some = slice(None, None, 3)
    true = vcavity.reflectance(albedo, *(g[some] for g in geometry), sigma)[:, 0]
    axes.plot(np.degrees(theta), book, color=TEXTBOOK, label="published model")
    axes.plot(np.degrees(theta[some]), true, "o-", ms=4, color=OURS, label="reference (V-cavity)")
    axes.plot(
        np.degrees(theta),
        cycles.reflectance(albedo, 1.0, *geometry)[:, 0],
        color=THIRD,
        ls="--",
        label="Cycles, roughness 1",
    )
    axes.axhline(0, color="black", lw=1)
    axes.fill_between(np.degrees(theta), book, 0, where=book < 0, color=TEXTBOOK, alpha=0.25)
    axes.set(
        xlabel="θi = θr (degrees), Δφ = 180°, ρ = 0.05, σ = 70°",
        ylabel="reflectance factor r",
        title="Opposite the light the published model falls below 0",
    )
    axes.legend(loc="upper right")
    save(figure, "negative")


def energy():
    figure, axes = plt.subplots()
    node, weight = np.polynomial.legendre.leggauss(48)
    cosine, weight = (node + 1) / 2, weight / 2
    view = np.arccos(cosine)[:, np.newaxis]
    around = np.pi * (np.arange(48) + 0.5) / 48

    def share(form, theta, cosine=cosine, weight=weight, view=view, around=around):
        r = form(np.ones(1), theta, view, around)[..., 0].mean(axis=1)
        return float((2 * cosine * weight * r).sum())

    angles = np.linspace(0, 88, 45)
    for sigma, dashes in ((10, "-"), (20, "--"), (30, ":")):
        spread = np.radians(sigma)

        def published(rho, light, view, around, spread=spread):
            return oren_nayar.reflectance(rho, light, view, around, spread)

        axes.plot(
            angles,
            [100 * share(published, np.radians(a)) for a in angles],
            dashes,
            color=TEXTBOOK,
            label=f"published, σ = {sigma}°",
        )
    few, few_weight = np.polynomial.legendre.leggauss(10)
    few, few_weight = (few + 1) / 2, few_weight / 2
    grid10 = (few, few_weight, np.arccos(few)[:, None], np.pi * (np.arange(10) + 0.5) / 10)

    def reference(rho, light, view, around):
        return vcavity.reflectance(rho, light, view, around, np.radians(20.0))

    places = [0, 30, 60, 75, 85]
    axes.plot(
        places,
        [100 * share(reference, np.radians(a), *grid10) for a in places],
        "o",
        color=OURS,
        ms=7,
        label="reference, σ = 20°",
    )

    def lobe(rho, light, view, around):
        return cycles.reflectance(rho, 0.5, light, view, around)

    axes.plot(
        angles,
        [100 * share(lobe, np.radians(a)) for a in angles],
        color=THIRD,
        ls="-.",
        label="Cycles, roughness 0.5",
    )
    axes.axhline(100, color="black", lw=1, zorder=0)
    axes.set(
        xlabel="angle of the light θi (degrees)",
        ylabel="light returned by white facets (%)",
        ylim=(87, 106),
        title="At grazing the published model makes light",
    )
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, "energy")


def white():
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.9))
    sigma = np.geomspace(1e-5, 1, 300).astype(np.float32)
    left.semilogx(
        np.degrees(sigma), textbook.bounce_ratio(sigma), color=TEXTBOOK, label="1 − f2/(1 − f1)"
    )
    left.semilogx(np.degrees(sigma), reading.bounce_ratio(sigma), color=OURS, label="ours")
    left.set(
        xlabel="roughness σ (degrees), float32",
        ylabel="ratio g of the later bounces",
        ylim=(-1, 1),
    )
    left.set_title("0/0 as σ → 0", fontsize=11)
    left.legend(loc="lower right")
    rough = np.linspace(0, 90, 46)
    cut = [textbook.cut_series(np.ones(1), np.radians(s))[0] for s in rough[::5]]
    right.plot(rough[::5], 100 * np.array(cut), "X-", color=TEXTBOOK, label="cut after 16 bounces")
    full = reading.from_albedo(np.ones(1), np.radians(rough), "reference")[:, 0]
    right.plot(rough, 100 * full, color=OURS, label="ours: tail summed")
    right.set(xlabel="roughness σ (degrees)", ylabel="reading of white facets (%)", ylim=(85, 103))
    right.set_title("Light still under way", fontsize=11)
    right.legend(loc="lower left")
    figure.suptitle("At ρ → 1 all bounces count", x=0.01, ha="left", fontweight="bold", fontsize=12)
    save(figure, "white")


def infeasible():
    figure, axes = plt.subplots()
    sigma = np.radians(40.0)
    r = np.linspace(0, 1.1, 200)
    limit = float(reading.white_reading(sigma))
    axes.axvspan(limit, 1.1, color="#f0f0f0")
    axes.axvline(limit, color=GRAY, lw=1)
    axes.text(limit + 0.01, 0.05, "above white facets:\ntold to the user", color=GRAY)
    axes.plot(r, textbook.clipped_root(r, sigma), color=TEXTBOOK, label="clipped to 1")
    axes.plot(r, reading.to_albedo(r, sigma), color=OURS, ls="--", label="ours")
    axes.set(
        xlabel="reading r (reflectance factor), σ = 40°",
        ylabel="albedo ρ",
        title="A reading above f1 + f2: σ is wrong, and clipping hides it",
    )
    axes.legend(loc="upper left")
    save(figure, "infeasible")


def sigma_max():
    figure, axes = plt.subplots()
    below = np.geomspace(1e-13, 0.25, 120)
    peaks = 1 - below
    expected = np.array([exact.largest_sigma(peak) for peak in peaks])
    with np.errstate(invalid="ignore"):
        book = textbook.sigma_max(peaks)
    axes.loglog(below, floor(np.abs(book / expected - 1)), color=TEXTBOOK, label="textbook")
    axes.loglog(
        below, floor(np.abs(reading.sigma_max(peaks) / expected - 1)), color=OURS, label="ours"
    )
    axes.set(
        xlabel="1 − peak reading",
        ylabel="relative error of σmax",
        ylim=(3e-17, 1),
        title="The bound on σ cancels too, when the peak comes close to 1",
    )
    axes.legend(loc="upper right")
    save(figure, "sigma-max")


def noise():
    figure, axes = plt.subplots()
    true, spread, sigma = 0.001, 0.003, np.radians(30.0)
    values = np.random.default_rng(7).normal(true, spread, 40_000)
    edges = np.linspace(-0.014, 0.018, 65)
    for form, color, name in (
        (textbook.clipped_root, TEXTBOOK, "clipped at 0"),
        (reading.to_albedo, OURS, "ours"),
    ):
        rho = form(values, sigma)
        axes.hist(edges[:-1], edges, weights=np.histogram(rho, edges)[0], color=color, alpha=0.35)
        axes.axvline(rho.mean(), color=color, lw=2, label=f"mean, {name}: {rho.mean():.5f}")
    actual = float(reading.to_albedo([true], sigma)[0])
    axes.axvline(actual, color="black", ls=":", lw=2, label=f"true albedo: {actual:.5f}")
    axes.set(
        xlabel="albedo ρ of a black patch, from readings with noise of 0.003",
        ylabel="readings (count)",
        title="Clipping noise at zero makes black brighter",
    )
    axes.legend(loc="upper right")
    axes.set_ylim(0, 5000)
    axes.annotate(
        "all clipped\nreadings: off\nthe scale",
        (0.0004, 4800),
        (-0.009, 3900),
        color=TEXTBOOK,
        arrowprops={"arrowstyle": "->", "color": TEXTBOOK},
    )
    save(figure, "noise")


def rough():
    figure, axes = plt.subplots()
    for model, last, color, dashes, name in (
        ("two-bounce", 90, TEXTBOOK, "-", "published model"),
        ("surface", 65, OURS, "-", "surface"),
        ("reference", 80, THIRD, "--", "reference (V-cavity)"),
    ):
        sigma = np.linspace(0, last, 2 * last + 1)
        value = 100 * reading.white_reading(np.radians(sigma), model)
        axes.plot(sigma, value, dashes, color=color, label=name)
    axes.axvspan(50, 90, color="#f0f0f0", zorder=0)
    axes.text(70, 84, "beyond 50°", color=GRAY, ha="center")
    axes.set(
        xlabel="roughness σ (degrees)",
        ylabel="45°/0° reading of white facets (%)",
        ylim=(68, 103),
        title="Beyond 50° the published model has lost 20 to 28 % of the light",
    )
    axes.legend(loc="lower left")
    save(figure, "rough")


def not_a_number():
    figure, axes = plt.subplots()
    source = np.arange(400.0, 701, 10)
    values = 0.3 + 0.2 * np.sin(source / 45)
    values[12] = np.nan
    target = np.arange(400.0, 701, 5)
    book = textbook.resample(values, source, target)
    ours = wavelength_grid.resample(values, source, target)
    axes.plot(source, values, "o", color=GRAY, ms=7, mfc="none", label="measured, one band missing")
    axes.plot(target, ours, "-", color=OURS, label="ours, to 5 nm")
    lost = np.isnan(book)
    axes.plot(
        target[lost],
        np.full(lost.sum(), 0.04),
        "X",
        color=TEXTBOOK,
        ms=5,
        label="matrix of weights: NaN in every band",
    )
    axes.axvspan(510, 530, color="#f0f0f0", zorder=0)
    axes.set(
        xlabel="wavelength (nm)",
        ylabel="reflectance factor r",
        ylim=(0, 0.72),
        title="One missing band must not take the spectrum with it",
    )
    axes.legend(loc="upper center", ncols=2, fontsize=9)
    save(figure, "nan")


def denormals():
    figure, axes = plt.subplots()
    sigma = 0.5
    first = float(reading.coefficients(sigma)[0])
    for dtype, low, dashes, name in (
        (np.float64, -322.5, "-", "float64"),
        (np.float32, -44.5, ":", "float32"),
    ):
        r = np.array(10.0 ** np.linspace(low, -2, 400)).astype(dtype)
        for form, color, who in (
            (textbook.root, TEXTBOOK, "textbook"),
            (reading.to_albedo, OURS, "ours"),
        ):
            found = form(r, dtype(sigma)).astype(float) * first
            axes.plot(
                np.log10(r.astype(float)),
                found / r,
                dashes,
                color=color,
                label=f"{who}, {name}",
            )
    axes.set_xscale("symlog", linthresh=10)
    axes.set_xticks([-300, -100, -45, -16, -8, -2], ["−300", "−100", "−45", "−16", "−8", "−2"])
    axes.minorticks_off()
    axes.set(
        xlabel="log₁₀ of the reading r",
        ylabel="f1 ρ / r (1 is right)",
        ylim=(-0.1, 2.1),
        title="Small readings become 0 in the textbook root",
    )
    axes.legend(loc="upper left")
    save(figure, "denormals")


def cycles_lobe():
    figure, axes = plt.subplots()
    gap = np.geomspace(1e-6, 0.5, 200).astype(np.float32)
    theta = np.float32(np.pi / 2) - gap
    color = np.array([0.9], np.float32)
    exactly = cycles.reflectance(color.astype(float), 1.0, theta.astype(float), 0.2, 3.0)[:, 0]
    for form, paint, name in (
        (textbook.cycles_reflectance, TEXTBOOK, "in the order of Cycles' source"),
        (cycles.reflectance, OURS, "ours: the cosine canceled"),
    ):
        found = form(color, 1.0, theta, np.float32(0.2), np.float32(3.0))[:, 0]
        worst = np.maximum.accumulate(np.abs(found - exactly)[::-1])[::-1]
        axes.loglog(np.degrees(gap), floor(worst), color=paint, label=name)
    axes.invert_xaxis()
    axes.set(
        xlabel="90° − θi (degrees), float32, roughness 1",
        ylabel="absolute error of r",
        title="Cycles' own energy term is ∞ · 0 at grazing",
    )
    axes.legend(loc="upper left")
    save(figure, "cycles")


FIGURES = (
    root,
    grazing,
    grazing_away,
    normal,
    azimuth,
    negative,
    energy,
    white,
    infeasible,
    sigma_max,
    noise,
    rough,
    not_a_number,
    denormals,
    cycles_lobe,
)


def main():
    IMAGES.mkdir(exist_ok=True)
    mpl.rcParams.update(STYLE)
    # The textbook's forms divide by zero on purpose.
    warnings.simplefilter("ignore", RuntimeWarning)
    for draw in FIGURES:
        draw()


if __name__ == "__main__":
    main()
