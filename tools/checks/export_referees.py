# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let renderers read what was exported for them: `python -m tools.checks.export_referees FOLDER`.

Started by `check_exports` in the environment of the chart, which has Mitsuba, LuxCore and
MaterialX. Each reads its own file as a user's scene would and is asked in all directions; what it
says is left in the folder: reflectance factors (materials, directions, channels).

    mitsuba     the file included in a scene; BSDF.eval, at FINE nanometers
    luxcore     the file's properties in a scene; rendered, in RGB
    materialx   validated with MaterialX's libraries; then the lines of its own GLSL, run by numpy
"""

from __future__ import annotations

import importlib
import json
import math
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from core.numerics.arrays import Array
from tools.chart import chart_luxcore, chart_mitsuba

FINE = np.arange(380.0, 781.0, 5.0)
"""Nanometers that a spectral renderer is asked at."""
_LANES = 4
_GLSL = "libraries/pbrlib/genglsl/lib/mx_microfacet_diffuse.glsl"
_FUNCTIONS = (
    "mx_oren_nayar_fujii_diffuse_dir_albedo",
    "mx_oren_nayar_fujii_diffuse_avg_albedo",
    "mx_oren_nayar_compensated_diffuse",
)


def mitsuba(path: Path, names: list[str], angles: Array) -> Array:
    """Ask the BSDFs of a file that a scene includes, shape (names, directions, `FINE`)."""
    renderer, _ = chart_mitsuba.load("scalar_spectral")
    shapes = "".join(f'<shape type="rectangle"><ref id="{name}"/></shape>' for name in names)
    scene = renderer.load_string(
        f'<scene version="3.0.0"><include filename="{path}"/>{shapes}</scene>', parallel=False
    )
    padded = np.pad(FINE, (0, -FINE.size % _LANES), mode="edge").reshape(-1, _LANES)
    groups = [renderer.Spectrum([float(x) for x in group]) for group in padded]
    context, at = renderer.BSDFContext(), renderer.SurfaceInteraction3f()
    found = np.empty((len(names), angles.shape[1], padded.size))
    # Mitsuba keeps the shapes in an order of its own.
    by_name = {shape.bsdf().id(): shape.bsdf() for shape in scene.shapes()}
    for name, of_shape in zip(names, found, strict=True):
        bsdf = by_name[name]
        for (light, view, azimuth), row in zip(angles.T.tolist(), of_shape, strict=True):
            at.wi = renderer.Vector3f(math.sin(view), 0, math.cos(view))
            sine, cosine = math.sin(light), math.cos(light)
            out = renderer.Vector3f(sine * math.cos(azimuth), sine * math.sin(azimuth), cosine)
            values = []
            for group in groups:
                at.wavelengths = group
                values.append(np.array(bsdf.eval(context, at, out)).ravel())
            row[:] = np.concatenate(values) * np.pi / cosine
    return found[..., : FINE.size]


def luxcore(path: Path, names: list[str], angles: Array) -> tuple[Array, Array]:
    """Render the file's materials, shape (names, directions, 3), and their textures of spectra."""
    renderer = importlib.import_module("pyluxcore")
    renderer.Init()
    renderer.SetLogHandler(lambda _message: None)
    scene, columns, rows = chart_luxcore.build(
        renderer, np.full((len(names), 3), 0.5), np.zeros(len(names))
    )
    scene.Parse(renderer.Properties(str(path)))
    objects = {f"scene.objects.o{i}.shape": f"q{i}" for i in range(len(names))}
    materials = {f"scene.objects.o{i}.material": name for i, name in enumerate(names)}
    scene.Parse(chart_luxcore.properties(renderer, objects | materials))
    found = np.stack(
        [chart_luxcore.read(renderer, scene, columns, rows, one) for one in angles.T], axis=1
    )
    textures = {
        f"scene.materials.m{i}.{key}": value
        for i, name in enumerate(names)
        for key, value in (("type", "matte"), ("kd", f"{name}_spectrum"))
    }
    own = {f"scene.objects.o{i}.material": f"m{i}" for i in range(len(names))}
    scene.Parse(chart_luxcore.properties(renderer, textures | objects | own))
    at_ring = chart_luxcore.read(renderer, scene, columns, rows, angles[:, -1])
    return found[: len(names)], at_ring[: len(names)]


def materialx(path: Path, angles: Array) -> tuple[str, Array]:
    """Validate the document, and ask its surfaces; gives what is wrong, and (names, n, 3)."""
    package = importlib.import_module("MaterialX")
    document, library = package.createDocument(), package.createDocument()
    package.readFromXmlFile(document, str(path))
    where = package.getDefaultDataSearchPath()
    package.loadLibraries(package.getDefaultDataLibraryFolders(), where, library)
    document.importLibrary(library)
    _, wrong = document.validate()
    lobe = own_lobe(Path(str(package.__file__)).parent / _GLSL)
    light, view, azimuth = angles
    between = np.cos(light) * np.cos(view) + np.sin(light) * np.sin(view) * np.cos(azimuth)
    found = []
    for material in document.getMaterialNodes():
        if not package.getShaderNodes(material):
            continue
        inputs = {
            each.getName(): each.getValue()
            for each in package.getShaderNodes(material)[0].getInputs()
        }
        color = np.array([inputs["base_color"][i] for i in range(3)])
        # MaterialX holds the product of light and view at least at 0.
        dots = np.cos(view), np.cos(light), np.maximum(between, 1e-6)
        found.append(
            np.stack(
                [lobe(*dots, inputs["base_diffuse_roughness"], channel) for channel in color],
                axis=-1,
            )
        )
    return wrong, np.stack(found)


def own_lobe(path: Path) -> Callable[..., Array]:
    """Make the functions of MaterialX's GLSL callable: line by line, with numpy's functions."""
    text = re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8"))
    lines = [
        f"{name} = {value}"
        for name, value in re.findall(r"^const float (\w+) = ([^;]+);", text, re.M)
    ]
    for name in _FUNCTIONS:
        head = re.search(rf"\w+ {name}\(([^)]*)\)\s*\{{(.*?)\n\}}", text, re.DOTALL)
        if head is None:
            raise RuntimeError(f"{path} has no {name}; see what MaterialX calls it now.")
        arguments = [word.split()[-1] for word in head[1].split(",")]
        lines.append(f"def {name}({', '.join(arguments)}):")
        for statement in head[2].split(";"):
            code = " ".join(statement.split())
            code = re.sub(r"^(?:float|vec3) ", "", code)
            code = re.sub(r"\((.+?)\) \? (.+) : (.+)", r"where(\1, \2, \3)", code)
            if code:
                lines.append(f"    {code}")
    known: dict[str, Any] = {
        "M_PI": math.pi,
        "M_PI_INV": 1 / math.pi,
        "M_FLOAT_EPS": 1e-8,
        "where": np.where,
        "max": np.maximum,
        "sqrt": np.sqrt,
        "mx_acos": np.arccos,
        "clamp": np.clip,
        "vec3": lambda x: x,
        "mx_square": lambda x: x * x,
    }
    exec("\n".join(lines), known)
    lobe: Callable[..., Array] = known[_FUNCTIONS[-1]]
    return lobe


def main(folder: Path) -> None:
    """Read `work.json` and leave `seen.npz` and `seen.json`."""
    work = json.loads((folder / "work.json").read_text(encoding="utf-8"))
    names, angles = work["names"], np.array(work["angles"])
    wrong, of_materialx = materialx(folder / "chart.mtlx", angles)
    of_mitsuba = mitsuba(folder / "chart.mitsuba.xml", names, angles)
    with chart_luxcore.silence():
        of_luxcore, textures = luxcore(folder / "chart.luxcore.scn", names, angles)
    np.savez(
        folder / "seen.npz",
        materialx=of_materialx,
        mitsuba=of_mitsuba,
        luxcore=of_luxcore,
        luxcore_textures=textures,
    )
    versions = {
        name: str(getattr(importlib.import_module(name), attribute))
        for name, attribute in (("mitsuba", "__version__"), ("MaterialX", "__version__"))
    }
    versions["pyluxcore"] = importlib.import_module("pyluxcore").Version()
    (folder / "seen.json").write_text(json.dumps({"wrong": wrong, "versions": versions}))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
    sys.stdout.flush()
    # All is written; LuxCore's own clearing up at the end of Python crashes.
    os._exit(0)
