# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ask a second Blender to measure materials, without touching anything in this one.

A render in this Blender would add datablocks, replace the last Render Result and block the
window. The materials are written to a file of their own, and `worker` measures them there.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.arrays import Array
from ...core.errors import CancelledError, OutputError

SAMPLES = 16
"""Rays a pixel unless told otherwise: with 16 pixels a sample, 256 places on a texture."""

_POLL_SECONDS = 0.05
_PATIENCE_SECONDS = 5.0
"""How long a Blender that was asked to end may take before it is killed."""


@dataclass(frozen=True)
class Geometry:
    """Lights and view of one measurement.

    Parameters
    ----------
    lights
        Polar angle and azimuth of each light, radians; they share the irradiance equally.
    view
        Polar angle of the view, radians below π/2; its azimuth is 0.
    """

    lights: tuple[tuple[float, float], ...]
    view: float


RING_45_0 = Geometry(tuple((math.pi / 4, 2 * math.pi * k / 8) for k in range(8)), 0.0)
"""45°a:0°: eight lights around the sample at 45°, view along the normal."""


class Measurement:
    """A measurement under way in a second Blender.

    Parameters
    ----------
    materials
        `bpy.types.Material`, linked ones too; each is measured as it is now.
    geometries
        Where to measure.
    samples
        Rays a pixel. One is exact for an even material; textures and bumps need more.

    Raises
    ------
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    def __init__(
        self,
        materials: Sequence[Any],
        geometries: Sequence[Geometry],
        samples: int = SAMPLES,
    ) -> None:
        self._folder: Path | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self.total = 0
        self.done = 0
        try:
            self._folder = Path(tempfile.mkdtemp(prefix="rough-spectra-"))
            self._start(self._folder, materials, geometries, samples)
        except (OSError, RuntimeError) as error:
            self.close()
            # Blender says "Error: Success" when the disk is full.
            reason = getattr(error, "strerror", None) or "is the disk full?"
            msg = (
                f"Temporary files cannot be written in {tempfile.gettempdir()} ({reason}); free "
                "the disk, or let TMPDIR name another one."
            )
            raise OutputError(msg) from error
        except BaseException:
            self.close()
            raise

    def poll(self) -> bool:
        """Update `done` and `total`; returns whether the measurement has ended."""
        assert self._process is not None
        assert self._folder is not None
        ended = self._process.poll() is not None
        try:
            done, total = (self._folder / "progress").read_text(encoding="ascii").split()
            self.done, self.total = int(done), int(total)
        except FileNotFoundError:
            pass  # the other Blender is still starting
        return ended

    def wait(self, progress: Callable[[int, int], None] | None = None) -> None:
        """Wait for the end.

        Raises
        ------
        CancelledError
            On an interrupt from the keyboard.
        """
        try:
            while not self.poll():
                if progress is not None:
                    progress(self.done, self.total)
                time.sleep(_POLL_SECONDS)
        except KeyboardInterrupt as error:
            msg = "Measuring was interrupted; nothing was written."
            raise CancelledError(msg) from error

    def result(self) -> Array:
        """Give what was measured, once `poll` says that it has ended.

        Returns
        -------
        Shape (geometries, materials, 2, 3): mean and standard deviation over the sample's area of
        the reflectance factor in scene-linear RGB.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        assert self._process is not None
        assert self._folder is not None
        path = self._folder / "result.npy"
        if self._process.returncode != 0 or not path.exists():
            log = (self._folder / "log").read_text(encoding="utf-8", errors="replace")
            lines = [line for line in log.splitlines() if line.strip()] or ["it said nothing"]
            msg = (
                f"The Blender that measures stopped with status {self._process.returncode} "
                f"({lines[-1].strip()}); nothing was written. Try again, or measure fewer "
                "materials at once."
            )
            raise OutputError(msg)
        return np.asarray(np.load(path))

    def close(self) -> None:
        """Stop the second Blender if it still runs, and remove its files."""
        if self._process is not None and self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(_PATIENCE_SECONDS)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)

    def _start(
        self,
        folder: Path,
        materials: Sequence[Any],
        geometries: Sequence[Geometry],
        samples: int,
    ) -> None:
        blend = folder / "materials.blend"
        # Blender leaves linked data out unless local data use it: the worker links it anew.
        local = {material for material in materials if material.library is None}
        bpy.data.libraries.write(
            str(blend), local, fake_user=True, path_remap="ABSOLUTE", compress=False
        )
        job = {
            "blend": blend.name,
            "asked_by": os.getpid(),
            "samples": samples,
            "materials": [[m.name, _library_path(m)] for m in materials],
            "geometries": [{"lights": g.lights, "view": g.view} for g in geometries],
        }
        job_path = folder / "job.json"
        job_path.write_text(json.dumps(job), encoding="utf-8")
        with (folder / "log").open("wb") as log:
            self._process = subprocess.Popen(
                [*_blender(), str(job_path)],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
            )


def measure(
    materials: Sequence[Any],
    geometries: Sequence[Geometry] = (RING_45_0,),
    progress: Callable[[int, int], None] | None = None,
    samples: int = SAMPLES,
) -> Array:
    """Measure materials and wait for the result.

    Parameters
    ----------
    materials, geometries, samples
        As in `Measurement`.
    progress
        Called with renders done and renders in all; may raise to stop.

    Returns
    -------
    Shape (geometries, materials, 2, 3), as in `Measurement.result`.

    Raises
    ------
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    if not materials:
        return np.empty((len(geometries), 0, 2, 3))
    measurement = Measurement(materials, geometries, samples)
    try:
        measurement.wait(progress)
        return measurement.result()
    finally:
        measurement.close()


def _blender() -> list[str]:
    """Command that runs the worker, in Blender's executable or in Python with the bpy module."""
    worker = str(Path(__file__).with_name("worker.py"))
    if bpy.app.binary_path:
        options = ["--background", "--factory-startup", "--python-exit-code", "1"]
        return [bpy.app.binary_path, *options, "--python", worker, "--"]
    return [sys.executable, "-P", worker]


def _library_path(material: Any) -> str | None:
    if material.library is None:
        return None
    return bpy.path.abspath(material.library.filepath)
