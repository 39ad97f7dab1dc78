# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hold spectral pictures of a room to Mitsuba's spectral path tracer.

    .venv/bpy-5.2/bin/python -m tools.checks.check_spectral --mitsuba .venv/chart/bin/python --write

A closed room of ColorChecker patches, all Lambertian, with two boxes in it and a light in the
ceiling, with the spectra of several lamps: illuminants of the CIE, sodium at high pressure (HP1 of
CIE 15, from colour-science), and at low pressure, where all light is a line. Mitsuba is told of
each at 1 nm or finer. Both programs render it twice with other random numbers, so that their noise
is known: half of what two pictures of one program differ by is that of their mean. A pixel is a
block of the rendered ones. --write puts its rows into docs/spectral-table.md, and leaves the
others there.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import ROOT, load_extension

WIDTH, HEIGHT, BLOCK = 64, 48, 4
BOUNCES = 6
"""As Cycles counts them; light that met one surface more is seen where that meets a lamp."""
LIGHTS = ("D65", "A", "F11", "LED-B3", "HP1", "sodium line")
_LINE, _WIDE = 589.3, 2.0
"""Nanometers: middle of sodium's two lines, and as wide as a spectrometer shows them at half."""
PATCHES = ("red", "green", "white 9.5", "neutral 8", "blue", "yellow", "orange", "cyan", "magenta")
TABLE = ROOT / "docs" / "spectral-table.md"
EYE, AHEAD, LENS = (0.0, -1.9, 1.5), (0.0, 1.0, 1.3), 90.0
"""Of the camera: where it is, where it looks to, and its angle across, degrees."""


def quads() -> list[tuple[list[tuple[float, float, float]], int]]:
    """Corners and material of every face; the last material shines. Normals point inward."""
    low, high, top, lamp = -2.0, 2.0, 3.0, 0.6
    found = []

    def add(material: int, *corners: tuple[float, float, float]) -> None:
        found.append(([*corners], material))

    add(2, (low, low, 0), (high, low, 0), (high, high, 0), (low, high, 0))
    add(0, (low, low, 0), (low, high, 0), (low, high, top), (low, low, top))
    add(1, (high, low, 0), (high, low, top), (high, high, top), (high, high, 0))
    add(4, (low, high, 0), (high, high, 0), (high, high, top), (low, high, top))
    add(5, (low, low, 0), (low, low, top), (high, low, top), (high, low, 0))
    edges = (low, -lamp, lamp, high)
    for i in range(3):
        for j in range(3):
            xs, ys = edges[i : i + 2], edges[j : j + 2]
            material = len(PATCHES) if i == j == 1 else 3
            add(material, (xs[0], ys[0], top), (xs[0], ys[1], top), (xs[1], ys[1], top),
                (xs[1], ys[0], top))  # fmt: skip
    for x, y, height, materials in ((-0.8, 0.6, 1.6, (6, 7)), (0.8, 0.0, 0.8, (8, 2))):
        box(add, x, y, height, *materials)
    return found


def box(add: Any, x: float, y: float, height: float, sides: int, lid: int) -> None:
    """Add a box of a square base."""
    corners = [(x - 0.5, y - 0.5), (x + 0.5, y - 0.5), (x + 0.5, y + 0.5), (x - 0.5, y + 0.5)]
    for one, other in zip(corners, corners[1:] + corners[:1], strict=True):
        add(sides, (*one, 0), (*other, 0), (*other, height), (*one, height))
    add(lid, *((*corner, height) for corner in corners))


def build() -> Any:
    """Make the room in Blender."""
    from mathutils import Vector
    from rough_spectra.addon import api

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    materials = [bpy.data.materials.new(name) for name in PATCHES]
    for material in materials:
        if material.node_tree is None:
            material.use_nodes = True
    pairs = [(m, api.request(api.find(m.name), 0.0)) for m in materials]
    api.assign(pairs, shader="diffuse", gloss="none")
    lamp = bpy.data.materials.new("Lamp")
    if lamp.node_tree is None:
        lamp.use_nodes = True
    tree = lamp.node_tree
    tree.nodes.clear()
    glow, output = (tree.nodes.new(f"ShaderNode{k}") for k in ("Emission", "OutputMaterial"))
    glow.inputs["Color"].default_value = (1, 1, 1, 1)
    glow.inputs["Strength"].default_value = 5
    tree.links.new(glow.outputs[0], output.inputs["Surface"])
    for corners, number in quads():
        mesh = bpy.data.meshes.new("Face")
        mesh.from_pydata(corners, [], [range(4)])
        mesh.materials.append([*materials, lamp][number])
        scene.collection.objects.link(bpy.data.objects.new("Face", mesh))
    camera = bpy.data.cameras.new("Camera")
    camera.sensor_fit, camera.angle = "HORIZONTAL", np.radians(LENS)
    camera.clip_start = 0.01
    scene.camera = bpy.data.objects.new("Camera", camera)
    scene.collection.objects.link(scene.camera)
    scene.camera.location = EYE
    ahead = Vector(AHEAD) - Vector(EYE)
    scene.camera.rotation_euler = ahead.to_track_quat("-Z", "Y").to_euler()
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    cycles = scene.cycles
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.min_light_bounces = BOUNCES
    cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    return scene


def spectrum_of(light: str) -> tuple[Any, Any]:
    """Wavelengths and power of a lamp, with a luminance Y of 1 by sums over its nanometers."""
    from rough_spectra.addon.colorimetry import cie_tables
    from rough_spectra.addon.support.colour_science import colour

    nm = cie_tables.GRID
    if light in cie_tables.ILLUMINANTS:
        power = cie_tables.illuminant(light)
    elif light == "sodium line":
        nm = np.arange(_LINE - 3 * _WIDE, _LINE + 3 * _WIDE, 0.05)
        power = np.exp(-4 * np.log(2) * ((nm - _LINE) / _WIDE) ** 2)
    else:
        table = colour().SDS_ILLUMINANTS[light]
        power = np.interp(nm, table.wavelengths, table.values)
    bright = np.interp(nm, cie_tables.GRID, cie_tables.observer(2)[:, 1])
    return nm, power / (power @ bright * (nm[1] - nm[0]))


def white_of(light: str) -> Any:
    """XYZ of a lamp."""
    from rough_spectra.addon.colorimetry import cie_tables

    nm, power = spectrum_of(light)
    seen = [np.interp(nm, cie_tables.GRID, each) for each in cie_tables.observer(2).T]
    return np.array(seen) @ power * (nm[1] - nm[0])


def by_cycles(
    scene: Any, light: str, samples: int, bands: int, direct: bool, folder: Path
) -> tuple[list[Any], Any]:
    """Two pictures of other seeds, and the first's RGB picture: blocks of XYZ, top down."""
    from rough_spectra.addon import api
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.colorimetry import cie_tables

    named = light
    if light not in cie_tables.ILLUMINANTS:
        named = str(folder / f"{light}.csv")
        rows = np.column_stack(spectrum_of(light))
        np.savetxt(named, rows, fmt="%.7g", delimiter=",", header="wavelength,power", comments="")
    # The RGB picture has at least the lamp's color, or the nearest that its space has.
    from_xyz = working_space.current().from_xyz
    rgb = np.maximum(from_xyz @ white_of(light), 0)
    rgb /= np.linalg.solve(from_xyz, rgb)[1]  # as bright as the lamp, which has a luminance of 1
    color = bpy.data.materials["Lamp"].node_tree.nodes["Emission"].inputs["Color"]
    color.default_value = (*rgb, 1)
    found, plain = [], None
    for seed in (1, 2):
        scene.cycles.seed = seed
        picture = api.spectral_picture(
            scene,
            bands=bands,
            direct=direct,
            samples=samples,
            lights={"Lamp": named},
            compare=seed == 1,
        )
        found.append(blocks(picture.xyz[::-1]))
        if picture.comparison is not None:
            to_xyz = np.linalg.inv(working_space.current().from_xyz)
            plain = blocks(picture.comparison.plain[::-1, :, :3] @ to_xyz.T)
    return found, plain


def by_mitsuba(python: str, light: str, samples: int, *words: str) -> tuple[list[Any], float]:
    """Two pictures of other seeds, as blocks of XYZ, top down, and the seconds of one."""
    from rough_spectra.addon import api
    from rough_spectra.addon.colorimetry import cie_tables
    from rough_spectra.core.numerics import wavelength_grid

    nm = cie_tables.GRID
    sent, lamp = spectrum_of(light)
    albedos = [
        wavelength_grid.resample(s.reflectance, s.wavelengths, nm, ends="hold")
        for s in map(api.find, PATCHES)
    ]
    corners, numbers = zip(*quads(), strict=True)
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder) / "room.npz"
        np.savez(
            work,
            corners=np.array(corners, float),
            materials=np.array(numbers),
            albedos=np.array(albedos),
            lamp=5 * lamp,
            sent=sent,
            nm=nm,
            samples=samples,
        )
        command = [python, "-m", "tools.checks.spectral_mitsuba", str(work), *words]
        subprocess.run(command, check=True, cwd=ROOT)
        rendered = np.load(work.with_name("rendered.npz"))
        return [blocks(each) for each in rendered["xyz"]], float(rendered["seconds"])


def blocks(pixels: Any) -> Any:
    """Mean over blocks of pixels."""
    rows, columns = HEIGHT // BLOCK, WIDTH // BLOCK
    return pixels.reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3))


def write(rows: dict[str, str]) -> None:
    """Put rows into the table, and keep the others in it."""
    _, _, *there = TABLE.read_text(encoding="utf-8").splitlines()
    kept = {line.split("|")[1].strip(): line for line in there}
    lines = [
        "| light | mean X, Y, Z off | ΔE00 between the two | of it noise | beyond it | RGB off |",
        "|---|---|---|---|---|---|",
        *((kept | rows)[light] for light in LIGHTS if light in kept | rows),
    ]
    TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main() -> None:
    """Print the table, and write it if asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mitsuba", default=str(ROOT / ".venv" / "chart" / "bin" / "python"))
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--more", type=int, default=4, help="times as many samples in Mitsuba")
    parser.add_argument("--bands", type=int, default=12)
    parser.add_argument("--light", action="append", choices=LIGHTS)
    parser.add_argument("--direct", action="store_true")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    extension = load_extension()
    extension.register()
    from rough_spectra.core.color import color_difference

    def apart(one: Any, other: Any) -> Any:
        labs = (color_difference.xyz_to_lab(each, white) for each in (one, other))
        return color_difference.delta_e(*labs)[seen]

    rows = {}
    scene = build()
    for light in options.light or LIGHTS:
        white = white_of(light)
        with tempfile.TemporaryDirectory() as folder:
            cycles, plain = by_cycles(
                scene, light, options.samples, options.bands, options.direct, Path(folder)
            )
        mitsuba, _ = by_mitsuba(options.mitsuba, light, options.samples * options.more)
        seen = mitsuba[0][..., 1] < 2.0  # without the lamp itself and its edge
        ours, theirs = (np.mean(each, axis=0) for each in (cycles, mitsuba))
        off = ours[seen].mean(axis=0) / theirs[seen].mean(axis=0) - 1
        # The mean of two pictures has half the noise that they differ by.
        noises = [apart(*each).mean() / 2 for each in (cycles, mitsuba)]
        found, noise = apart(ours, theirs).mean(), np.hypot(*noises)
        beyond = np.sqrt(max(found**2 - noise**2, 0))
        rows[light] = (
            f"| {light} | {', '.join(f'{100 * each:+.2f} %' for each in off)} | {found:.2f} | "
            f"{noises[0]:.2f} and {noises[1]:.2f} | {beyond:.2f} | "
            f"{apart(plain, theirs).mean():.2f} |"
        )
        print(rows[light], flush=True)
        if options.write:
            write(rows)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.unregister()


if __name__ == "__main__":
    main()
