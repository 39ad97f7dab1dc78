# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a spectral picture costs, and how right it is: a room of ColorChecker patches, rendered.

    .venv/bpy-5.2/bin/python -m tools.benchmarks.bench_picture [--write]

The room of `tools.checks.check_spectral`. Truth is 36 bands in twelve renders with the same random
numbers, so that what is left is spectral, and noise cancels; check_spectral.py holds such pictures
to Mitsuba. Costs are in ordinary renders of the same run, by processor time,
which other programs don't lengthen. Mitsuba's spectral path tracer stands in at the noise of
Cycles: its time is scaled by the square of the two programs' noise, each measured as what two seeds
differ by. --write puts docs/picture-table.md and docs/data/picture.csv in place, which
tools/manual/picture_figures.py draws; --room FILE.npz leaves larger pictures of it for the same.
"""

from __future__ import annotations

import argparse
import csv
import sys
from typing import Any

import bpy
import numpy as np

from tools.checks import check_spectral as room
from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon import api
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics import wavelength_grid

LIGHTS = ("D65", "A", "F11")
COUNTS = (6, 9, 12)
TRUTH = 36
TABLE, DATA = ROOT / "docs" / "picture-table.md", ROOT / "docs" / "data" / "picture.csv"
SHOWN, BANDS, SIZE, SAMPLES = "A", 9, (200, 150), 48
"""The light of the pictures that the manual shows, and how they are rendered."""
FIELDS = ("light", "picture", "renders", "mean", "usual", "largest", "predicted", "cost")


def plain_xyz(picture: Any) -> Any:
    """XYZ of the ordinary picture that came with a spectral one."""
    to_xyz = np.linalg.inv(working_space.current().from_xyz)
    return picture.comparison.plain[..., :3] @ to_xyz.T


def put_light(light: str) -> None:
    """Give the lamp its color."""
    xyz = illuminant_spectra.to_xyz(illuminant_spectra.cie(light))
    color = bpy.data.materials["Lamp"].node_tree.nodes["Emission"].inputs["Color"]
    color.default_value = (*np.maximum(working_space.current().from_xyz @ xyz, 0), 1)


def match_to(light: str) -> None:
    """Give the walls the colors that are right under a lamp of this spectrum, one bounce on.

    Cycles multiplies the lamp's RGB with the wall's, so this is their quotient, channel by channel.
    """
    seen = illuminant_spectra.observer(2) @ working_space.current().from_xyz.T
    power = illuminant_spectra.cie(light)
    for name in room.PATCHES:
        sample = api.find(name)
        albedo = wavelength_grid.resample(
            sample.reflectance, sample.wavelengths, illuminant_spectra.GRID, ends="hold"
        )
        color = np.clip((albedo * power) @ seen / (power @ seen), 0, 1)
        tree = bpy.data.materials[name].node_tree
        [shader] = (node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
        shader.inputs["Color"].default_value = (*color, 1)


class Room:
    """The room under one light: renders it in one way after the other, and keeps the table.

    Parameters
    ----------
    light
        Name of the lamp's spectrum.
    samples
        Of each pixel.
    """

    def __init__(self, light: str, samples: int) -> None:
        self._light, self._samples = light, samples
        self._white = illuminant_spectra.to_xyz(illuminant_spectra.cie(light))
        self._scene = room.build()
        put_light(light)
        self._truth = self.spectral(TRUTH)
        self._seen = room.blocks(self._truth.xyz)[..., 1] < 2.0  # not the lamp itself and its edge
        self.rows: list[dict[str, Any]] = []

    def spectral(self, bands: int, seed: int = 1, **options: Any) -> Any:
        """Render with some bands, and as RGB."""
        self._scene.cycles.seed = seed
        told: dict[str, Any] = {"direct": False, "lights": {"Lamp": self._light}} | options
        return api.spectral_picture(self._scene, bands=bands, samples=self._samples, **told)

    def ordinary(self) -> None:
        """Add what one render of RGB gives: as it is, matched to the light, in a wider space."""
        self._add("RGB", plain_xyz(self._truth), 1, 1.0)
        match_to(self._light)
        self._add("RGB, matched to the light", plain_xyz(self.spectral(3)), 1, 1.0)
        change = bpy.ops.wm.set_working_color_space
        change(working_space="Linear Rec.2020", convert_colors=True)
        match_to(self._light)
        put_light(self._light)
        self._add("RGB, matched, Rec.2020", plain_xyz(self.spectral(3)), 1, 1.0)
        change(working_space="Linear Rec.709", convert_colors=True)
        self._scene = room.build()
        put_light(self._light)

    def bands(self) -> None:
        """Add what more and more bands give."""
        for direct in (False, True):
            for count in COUNTS:
                name = f"{count} bands" + ", direct light apart" * direct
                self._add_spectral(name, self.spectral(count, direct=direct))
        self._add_spectral(f"{TRUTH} bands", self._truth)

    def mitsuba(self, python: str) -> None:
        """Add Mitsuba's spectral path tracer, as long as it takes to the noise of Cycles."""
        pictures, seconds = room.by_mitsuba(python, self._light, self._samples, "--plain")
        theirs = [each[::-1] for each in pictures]
        ours = [room.blocks(self.spectral(COUNTS[-1], seed, compare=False).xyz) for seed in (1, 2)]
        noise, their_noise = (self._apart(*each).mean() / np.sqrt(2) for each in (ours, theirs))
        cost = seconds / self._truth.processor_seconds[0] * (their_noise / noise) ** 2
        off = self._apart(np.mean(ours, axis=0), np.mean(theirs, axis=0))
        self._row("Mitsuba, spectral, as little noise", off, 0, cost)
        print(f"noise of one picture: Cycles {noise:.3f}, Mitsuba {their_noise:.3f}", flush=True)

    def _add_spectral(self, name: str, picture: Any) -> None:
        ordinary, *passes = picture.processor_seconds
        cost = sum(passes) / ordinary
        self._add(name, picture.xyz, len(passes), cost, picture.predicted.mean)

    def _add(self, name: str, xyz: Any, *row: Any) -> None:
        self._row(name, self._apart(room.blocks(xyz), room.blocks(self._truth.xyz)), *row)

    def _row(
        self, name: str, off: Any, renders: int, cost: float, predicted: float | None = None
    ) -> None:
        largest = (off.mean(), np.quantile(off, 0.95), off.max())
        values = (self._light, name, renders, *map(float, largest), predicted, cost)
        self.rows.append(dict(zip(FIELDS, values, strict=True)))
        print(*(v if isinstance(v, str) else v and round(v, 3) for v in values), flush=True)

    def _apart(self, one: Any, other: Any) -> Any:
        labs = (color_difference.xyz_to_lab(each, self._white) for each in (one, other))
        return color_difference.delta_e(*labs)[self._seen]


def show(path: str) -> None:
    """Render what the manual shows: XYZ of RGB and of bands, top down, and the light's white."""
    scene = room.build()
    put_light(SHOWN)
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.cycles.use_denoising = True
    lights = {"Lamp": SHOWN}
    picture = api.spectral_picture(scene, bands=BANDS, samples=SAMPLES, lights=lights, direct=False)
    white = illuminant_spectra.to_xyz(illuminant_spectra.cie(SHOWN))
    ordinary = plain_xyz(picture)[::-1]
    np.savez(path, ordinary=ordinary, spectral=picture.xyz[::-1], white=white)


def table(rows: list[dict[str, Any]]) -> str:
    """Give the manual's table: a picture a row, mean / 95 % / largest ΔE00 under each light."""
    lights = list(dict.fromkeys(row["light"] for row in rows))
    lines = [
        f"| picture | renders | {' | '.join(lights)} | cost |",
        "|---|---|---|" + "---|" * len(lights),
    ]
    for name in dict.fromkeys(row["picture"] for row in rows):
        of = {row["light"]: row for row in rows if row["picture"] == name}
        cells = [
            f"{r['mean']:.2f} / {r['usual']:.2f} / {r['largest']:.1f}"
            for r in (of[light] for light in lights)
        ]
        cost = np.mean([row["cost"] for row in of.values()])
        renders = next(iter(of.values()))["renders"] or "–"
        lines.append(f"| {name} | {renders} | {' | '.join(cells)} | {cost:.1f} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Print the table, and write it if asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mitsuba", default=str(ROOT / ".venv" / "chart" / "bin" / "python"))
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--light", action="append", choices=room.LIGHTS)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--room", metavar="FILE.npz")
    options = parser.parse_args()
    sys.modules["rough_spectra"].register()
    if options.room:
        show(options.room)
        return
    rows: list[dict[str, Any]] = []
    for light in options.light or LIGHTS:
        under = Room(light, options.samples)
        under.ordinary()
        under.bands()
        under.mitsuba(options.mitsuba)
        rows += under.rows
    print(table(rows))
    if options.write:
        TABLE.write_text(table(rows), encoding="utf-8")
        with DATA.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, FIELDS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(
                {k: f"{v:.4f}" if isinstance(v, float) else v for k, v in row.items()}
                for row in rows
            )
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    sys.modules["rough_spectra"].unregister()


if __name__ == "__main__":
    main()
