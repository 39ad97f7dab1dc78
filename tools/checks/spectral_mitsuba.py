# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mitsuba's part of check_spectral.py: `python -m tools.checks.spectral_mitsuba ROOM.npz`.

Leaves rendered.npz beside the room: two pictures of other random numbers, `xyz` with the top row
first, and the `seconds` of one, those of all processor cores together.

Mitsuba draws the four wavelengths of a path evenly for an eye, which meets a narrow line once in a
hundred paths. As the room has one lamp, the lamp sends the same at all wavelengths here, and the
sensor has the lamp's spectrum as its response: the integral is the same, and wavelengths are drawn
by the lamp. --plain has it the other way around.
"""

from __future__ import annotations

import importlib
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

VARIANT = "scalar_spectral"
LUMINANCE = 106.7502593994140625
"""Of a spectrum of 1 per nanometer, as Mitsuba has it; its Y is relative to that (spectrum.h)."""
WIDTH, HEIGHT = 64, 48
DEPTH = 8
"""Lamp itself, six bounces of Cycles, and the last that only meets a lamp."""
EYE, AHEAD, LENS = (0.0, -1.9, 1.5), (0.0, 1.0, 1.3), 90.0


def main(path: Path, plain: bool) -> None:
    """Render it twice."""
    mitsuba: Any = importlib.import_module("mitsuba")
    mitsuba.set_variant(VARIANT)
    room = np.load(path)

    def spectrum(nm: Any, values: Any) -> dict[str, Any]:
        told = ",".join(repr(float(value)) for value in values)
        ends = {"wavelength_min": float(nm[0]), "wavelength_max": float(nm[-1])}
        return {"type": "regular", "values": told, **ends}

    scene: dict[str, Any] = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": DEPTH, "rr_depth": 1000},
        "sensor": {
            "type": "perspective",
            "fov": LENS,
            "fov_axis": "x",
            "to_world": mitsuba.ScalarTransform4f().look_at(EYE, AHEAD, (0, 0, 1)),
            "film": {
                "type": "hdrfilm",
                "width": WIDTH,
                "height": HEIGHT,
                "pixel_format": "xyz",
                "rfilter": {"type": "box"},
            },
        },
    }
    sent = spectrum(room["sent"], room["lamp"])
    even = {"type": "uniform", "value": LUMINANCE}
    if plain:
        sent = spectrum(room["sent"], LUMINANCE * room["lamp"])
    else:
        scene["sensor"]["srf"] = sent
    for number, (corners, material) in enumerate(
        zip(room["corners"], room["materials"], strict=True)
    ):
        shines = material == len(room["albedos"])
        black = {"type": "rgb", "value": 0.0}
        color = black if shines else spectrum(room["nm"], room["albedos"][material])
        face: dict[str, Any] = {
            "type": "rectangle",
            "to_world": placed(mitsuba, corners),
            "bsdf": {"type": "diffuse", "reflectance": color},
        }
        if shines:
            face["emitter"] = {"type": "area", "radiance": sent if plain else even}
        scene[f"face-{number}"] = face
    loaded = mitsuba.load_dict(scene)
    began = time.process_time()
    pictures = [
        np.array(mitsuba.render(loaded, spp=int(room["samples"]), seed=seed)) for seed in (1, 2)
    ]
    seconds = (time.process_time() - began) / len(pictures)
    xyz = np.array(pictures, np.float64)[..., :3]
    np.savez(path.with_name("rendered.npz"), xyz=xyz, seconds=seconds)


def placed(mitsuba: Any, corners: Any) -> Any:
    """Turn the rectangle from -1 to 1 into one of these corners; its normal follows their order."""
    across, along = (corners[1] - corners[0]) / 2, (corners[3] - corners[0]) / 2
    normal = np.cross(across, along)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack((across, along, normal / np.linalg.norm(normal)))
    matrix[:3, 3] = corners.mean(axis=0)
    return mitsuba.ScalarTransform4f(matrix.tolist())


if __name__ == "__main__":
    main(Path(sys.argv[1]), "--plain" in sys.argv)
