# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a texture of a spectral image costs beside reading the image and writing the texture alone.

.venv/bpy-5.2/bin/python -m tools.benchmarks.bench_texture [--size 4096] [--bands 31]

Each row runs in a process of its own, whose peak memory is that of the row; bare and whole take
turns, and the least of both counts.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from tools.run.run_command_line import load_extension

BLOCK = 64  # lines that the bare reading and writing holds
SIGMA = np.radians(30)
ROUNDS = 2
KINDS = ("exr half", "exr float", "envi bil", "envi bsq")


def main() -> None:
    """Make the images, measure each, print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=4096)
    parser.add_argument("--bands", type=int, default=31)
    parser.add_argument("--kind", action="append", choices=KINDS)
    parser.add_argument("--holds", action="append", choices=("albedo", "color"))
    parser.add_argument("--work", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.work:
        work(*options.work)
        return
    print("| image | texture | on the clock | of processors | memory |")
    print("|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for kind in options.kind or KINDS:
            path = make(Path(folder), kind, options.size, options.bands)
            size = sum(each.stat().st_size for each in Path(folder).glob("image*")) / 1e9
            for holds in options.holds or ("albedo", "color"):
                rounds = [
                    (ask("bare", path, holds), ask("whole", path, holds)) for _ in range(ROUNDS)
                ]
                bare, whole = (np.min(each, axis=0) for each in zip(*rounds, strict=True))
                times = zip(bare[:2], whole[:2], strict=True)
                told = [f"{kind}, {size:.2f} GB", holds]
                told += [f"{b:.1f} → {w:.1f} s, {w / b:.2f}" for b, w in times]
                print(f"| {' | '.join(told)} | {whole[2]:.2f} GB |", flush=True)
            for each in Path(folder).iterdir():
                each.unlink()


def make(folder: Path, kind: str, size: int, bands: int) -> Path:
    """Write an image with some noise, as a camera's has, in which every pixel differs."""
    load_extension()
    from rough_spectra.addon.support.openimageio import openimageio

    nm = np.linspace(400, 700, bands).round(3)
    random = np.random.default_rng(7)
    lines = (block(random, nm, size, first) for first in range(0, size, BLOCK))
    if kind.startswith("envi"):
        interleave = kind.split()[1]
        path = folder / "image.img"
        numbers = np.memmap(path, "<f4", "w+", shape=shape_of(interleave, size, bands))
        for first, values in zip(range(0, size, BLOCK), lines, strict=True):
            if interleave == "bsq":
                numbers[:, first : first + BLOCK] = values.transpose(2, 0, 1)
            else:
                numbers[first : first + BLOCK] = values.transpose(0, 2, 1)
        numbers.flush()
        listed = ", ".join(f"{each:g}" for each in nm)
        path.with_suffix(".hdr").write_text(
            f"ENVI\nsamples = {size}\nlines = {size}\nbands = {bands}\ndata type = 4\n"
            f"interleave = {interleave}\nwavelength units = nm\nwavelength = {{{listed}}}\n"
        )
        return path
    oiio = openimageio()
    spec = oiio.ImageSpec(size, size, bands, kind.split()[1])
    spec.channelnames = tuple(f"T.{each:.6f}nm".replace(".", ",").replace(",", ".", 1)
                              for each in nm)  # fmt: skip
    spec.attribute("compression", "zip")
    out = oiio.ImageOutput.create("openexr")
    out.open(str(folder / "image.exr"), spec)
    for first, values in zip(range(0, size, BLOCK), lines, strict=True):
        out.write_scanlines(first, first + len(values), 0, values)
    out.close()
    return folder / "image.exr"


def shape_of(interleave: str, size: int, bands: int) -> tuple[int, int, int]:
    """Shape of a cube's numbers."""
    return (bands, size, size) if interleave == "bsq" else (size, bands, size)


def block(random: np.random.Generator, nm: np.ndarray, size: int, first: int) -> np.ndarray:
    """Give lines of readings, shape (lines, size, bands)."""
    count = min(BLOCK, size - first)
    across = np.sin((np.arange(size) + first) / 50)[np.newaxis, :, np.newaxis]
    values = 0.35 + 0.2 * across * np.sin(nm / 60)
    values = values + 0.02 * random.standard_normal((count, size, 1), np.float32)
    values = values + 0.002 * random.standard_normal((count, size, nm.size), np.float32)
    return np.clip(values, 0.01, 0.95).astype(np.float32)


def ask(what: str, path: Path, holds: str) -> list[float]:
    """Do one thing in a process of its own: seconds, of processors too, and gigabytes at most."""
    command = [sys.executable, "-m", "tools.benchmarks.bench_texture", "--work"]
    done = subprocess.run([*command, what, str(path), holds], capture_output=True, check=True)
    found: list[float] = json.loads(done.stdout.splitlines()[-1])
    return found


def work(what: str, path: str, holds: str) -> None:
    """Read and write alone, or make the texture; prints seconds and gigabytes."""
    load_extension()
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.textures import convert
    from rough_spectra.addon.textures.wanted import Wanted

    source, target = Path(path), Path(path).with_name("texture.exr")
    space = working_space.current()
    space.rgb_weights(np.linspace(400, 700, 31), "D65")  # colour-science is imported by then
    start = time.perf_counter(), time.process_time()
    if what == "bare":
        bare(source, target)
    else:
        wanted = Wanted(float(SIGMA), holds=holds)
        convert.Conversion(source, target, wanted, space).finish()
    seconds = [time.perf_counter() - start[0], time.process_time() - start[1]]
    # The system's own figure for a process begins with that of the one that started it.
    status = Path("/proc/self/status").read_text(encoding="ascii")
    [line] = [line for line in status.splitlines() if line.startswith("VmHWM")]
    print(json.dumps([*seconds, int(line.split()[1]) * 1024 / 1e9]))


def bare(source: Path, target: Path) -> None:
    """Read all of the image, and write three of its bands as the texture is written."""
    from rough_spectra.addon.support.openimageio import openimageio
    from rough_spectra.addon.textures import convert

    image = convert.open_image(source)
    oiio = openimageio()
    spec = oiio.ImageSpec(image.width, image.height, 3, oiio.HALF)
    spec.attribute("compression", "zip")
    out = oiio.ImageOutput.create("openexr")
    out.open(str(target), spec)
    for first in range(0, image.height, BLOCK):
        last = min(first + BLOCK, image.height)
        values = image.read(first, last).reshape(last - first, image.width, -1)
        out.write_scanlines(first, last, 0, np.ascontiguousarray(values[:, :, 10:13]))
    out.close()
    image.close()


if __name__ == "__main__":
    main()
