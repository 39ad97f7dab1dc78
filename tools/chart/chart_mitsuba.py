# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mitsuba 3 on the chart's work: `python -m tools.chart.chart_mitsuba BSDF VARIANT FOLDER`.

Mitsuba has no Oren-Nayar. Its `diffuse` is Lambert's law; the diffuse part of its `principled` has
a roughness that darkens or brightens grazing light, for which the value that comes closest is
chosen at each σ. Both get the spectrum with which they read the same as the surface at 45°/0°, at
the 31 bands, and are asked through `BSDF.eval`, four wavelengths at a time, which is what a
spectral variant holds.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tools.chart.chart_timing import in_turns, spread
from tools.chart.chart_work import (
    BANDS,
    PEER_TRUTHS,
    RING,
    TIMED_GEOMETRIES,
    TIMED_PATCH,
    Array,
    Truth,
    Work,
    timed_angles,
    write_json,
)

ROUGHNESSES = np.linspace(0, 1, 11)
LANES = 4
SECONDS = 10.0
FEW = 64
"""Geometries timed where every one of them is a call from Python."""

VECTORIZED = "llvm_ad_spectral"

Evaluate = Callable[[Any, Array], Array]


def load(variant: str) -> tuple[Any, Any]:
    """Mitsuba in a variant, and Dr.Jit, on one thread."""
    mitsuba, drjit = (importlib.import_module(name) for name in ("mitsuba", "drjit"))
    mitsuba.set_variant(variant)
    drjit.set_thread_count(1)
    return mitsuba, drjit


def make_bsdf(mitsuba: Any, kind: str, albedo: Array, roughness: float) -> Any:
    """BSDF whose reflectance is `albedo` at `BANDS`."""
    spectrum = {
        "type": "regular",
        "wavelength_min": float(BANDS[0]),
        "wavelength_max": float(BANDS[-1]),
        "values": ",".join(repr(float(value)) for value in albedo),
    }
    if kind == "diffuse":
        return mitsuba.load_dict({"type": kind, "reflectance": spectrum})
    sockets = {"base_color": spectrum, "roughness": float(roughness), "specular": 0.0}
    return mitsuba.load_dict({"type": kind, **sockets})


def groups() -> Array:
    """Cut the bands into groups of `LANES`, the last one filled up, shape (groups, LANES)."""
    count = -(-BANDS.size // LANES)
    return np.pad(BANDS, (0, count * LANES - BANDS.size), mode="edge").reshape(count, LANES)


def vectorized(mitsuba: Any, drjit: Any) -> Evaluate:
    """All geometries in one kernel."""

    def evaluate(bsdf: Any, angles: Array) -> Array:
        light, view, azimuth = (mitsuba.Float(row.astype(np.float32)) for row in angles)
        sine, cosine = drjit.sin(light), drjit.cos(light)
        at = drjit.zeros(mitsuba.SurfaceInteraction3f, angles.shape[1])
        at.wi = mitsuba.Vector3f(drjit.sin(view), 0, drjit.cos(view))
        out = mitsuba.Vector3f(sine * drjit.cos(azimuth), sine * drjit.sin(azimuth), cosine)
        scale = drjit.pi / cosine
        values = []
        for group in groups():
            at.wavelengths = mitsuba.UnpolarizedSpectrum(*(mitsuba.Float(x) for x in group))
            values.append(bsdf.eval(mitsuba.BSDFContext(), at, out) * scale)
        drjit.eval(*values)
        drjit.sync_thread()
        return np.concatenate([np.array(value) for value in values])[: BANDS.size].T

    return evaluate


def one_by_one(mitsuba: Any) -> Evaluate:
    """One call for each geometry and group of wavelengths."""

    def evaluate(bsdf: Any, angles: Array) -> Array:
        context, at = mitsuba.BSDFContext(), mitsuba.SurfaceInteraction3f()
        spectra = [mitsuba.Spectrum([float(x) for x in group]) for group in groups()]
        found = np.empty((angles.shape[1], len(spectra), LANES))
        for row, (light, view, azimuth) in zip(found, angles.T.tolist(), strict=True):
            sine, cosine = np.sin(light), np.cos(light)
            at.wi = mitsuba.Vector3f(np.sin(view), 0, np.cos(view))
            out = mitsuba.Vector3f(sine * np.cos(azimuth), sine * np.sin(azimuth), cosine)
            for values, wavelengths in zip(row, spectra, strict=True):
                at.wavelengths = wavelengths
                values[:] = bsdf.eval(context, at, out)
            row *= np.pi / cosine
        return found.reshape(len(found), -1)[:, : BANDS.size]

    return evaluate


def answer(
    mitsuba: Any, evaluate: Evaluate, kind: str, albedo: Array, truth: Truth
) -> tuple[Array, list[float]]:
    """Answers at all angles, shape of `truth.factor`, and the roughness chosen at each σ."""
    every = np.concatenate((truth.angles, np.array(RING)[:, np.newaxis]), axis=1)

    def ask(colors: Array, roughness: float) -> Array:
        bsdfs = [make_bsdf(mitsuba, kind, color, roughness) for color in colors]
        return np.stack([evaluate(bsdf, every) for bsdf in bsdfs], axis=1)

    roughnesses = ROUGHNESSES if kind == "principled" else np.zeros(1)
    tried = {float(roughness): ask(albedo, float(roughness)) for roughness in roughnesses}
    found, chosen = [], []
    for factor, read in zip(truth.factor, truth.reading, strict=True):
        # Both are in proportion to their color.
        apart = {
            roughness: np.abs(seen[:-1] * (read / seen[-1]) / factor - 1).mean()
            for roughness, seen in tried.items()
        }
        best = min(apart, key=lambda roughness: float(apart[roughness]))
        seen = ask(np.clip(albedo * read / tried[best][-1], 0, 1), best)
        found.append(seen[:-1])
        chosen.append(best)
    return np.stack(found), chosen


def main(kind: str, variant: str, folder: Path) -> None:
    """Answer, time and write both files."""
    work = Work.load(folder / "work.npz")
    mitsuba, drjit = load(variant)
    fast = variant == VECTORIZED
    evaluate = vectorized(mitsuba, drjit) if fast else one_by_one(mitsuba)
    answers: dict[str, Any] = {}
    chosen: dict[str, list[float]] = {}
    for name in PEER_TRUTHS:
        truth = getattr(work, name)
        answers[name], chosen[name] = answer(mitsuba, evaluate, kind, work.albedo, truth)
    np.savez(folder / f"peer-mitsuba-{kind}.npz", **answers)
    count = TIMED_GEOMETRIES if fast else FEW
    bsdf = make_bsdf(mitsuba, kind, work.albedo[TIMED_PATCH], 0.5)
    some = timed_angles()[:, :count]
    times = in_turns({"eval": lambda: evaluate(bsdf, some)}, SECONDS)["eval"]
    cost = [seconds / count * 1e9 for seconds in spread(times)]
    about = "Lambert's law" if kind == "diffuse" else "Disney's diffuse lobe, specular 0"
    if kind == "principled":
        pairs = zip(np.degrees(work.traced.sigmas), chosen["traced"], strict=True)
        about += "; slider " + ", ".join(f"{r:.1f} at {s:.0f}°" for s, r in pairs)
    how = "one kernel for all" if fast else "one call from Python each"
    write_json(
        folder / f"peer-mitsuba-{kind}.json",
        {
            "key": f"mitsuba-{kind}",
            "label": f"Mitsuba {kind}",
            "group": "peer",
            "about": f"{about}; BSDF.eval, {how}",
            "ends_in": "bands",
            "version": f"Mitsuba {mitsuba.__version__} {variant}",
            "threads": 1,
            "overhead": "" if fast else "a call from Python",
            "cost": {"angles": cost},
        },
    )


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]))
