# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether red, green and blue are enough for a scene, and if not, the least that is.

A small spectral picture is rendered beside small ordinary ones: as the scene is, as it would be in
a wide working space, and with its measured materials matched to its lights. All follow the same
paths of light, and blocks of pixels are compared, so that a few samples tell. What is left of noise
spreads ΔE00 and would raise its percentiles: two halves of the samples tell how much it does.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ...core.bands import IN_A_PASS
from ...core.errors import DomainError, MaterialError
from ...core.limits import TOLERANCE
from ...core.numerics.arrays import Array
from ..blender.background_job import waited
from ..colorimetry import illuminant_spectra, rgb_spectra, standard_spaces
from ..colorimetry.rgb_space import WorkingSpace
from ..scene import analysis
from ..support import durations
from . import passes, places
from .colors import Measured
from .passes import Pass
from .picture import SEEN, Comparison, compare
from .render import Rendering, Wanted

SIZE = 240, 135
"""Pixels of the small pictures, at most."""
SAMPLES = 8
"""Of each of their pixels, in two halves."""
WIDE = "Linear Rec.2020"
"""Working space that is tried."""

_IN_A_BLOCK = 80
"""Samples that a block of pixels has at least, where that takes no more than `_WIDEST`."""
_WIDEST = 4
"""Pixels of a block's side at most."""
_FINER = 4.0
"""By how much less than the tolerance the small spectral picture is off, as far as bands go."""
_BANDS = 12
"""Bands of it at most."""
_SURE = 0.85
"""Part of the tolerance within which what is recommended has to be: that much small pictures and
predictions may be off."""
_DARK = 1e-3
"""Part of the light in a channel below which no color is matched to it."""


@dataclass(frozen=True)
class Rung:
    """A way to render the scene.

    Parameters
    ----------
    kind
        "rgb", "space", "lights", "space and lights" or "passes".
    renders
        How many it takes.
    mean, usual, largest
        ΔE00 from the colors of the whole spectrum: mean, 95th percentile and maximum.
    seconds
        What it takes, by the small pictures' renders.
    """

    kind: str
    renders: int
    mean: float
    usual: float
    largest: float
    seconds: float

    @property
    def words(self) -> str:
        """What it is."""
        if self.kind == "passes":
            return f"{self.renders} passes of three bands" if self.renders > 1 else "one pass"
        return {
            "rgb": "RGB as it is",
            "space": f"working space {WIDE}",
            "lights": "materials matched to the lights",
            "space and lights": f"both, {WIDE} and matched",
        }[self.kind]


@dataclass(frozen=True, eq=False)
class Verdict:
    """What was found.

    Parameters
    ----------
    rungs
        From RGB as it is to as many passes as are needed.
    tolerance
        ΔE00 within which 95 % of the picture are to be.
    chosen
        RGB if it is within it, else the first rung that surely is, or None.
    comparison
        Of the small pictures, blocks of pixels.
    untranslated
        By name, what stayed red, green and blue also in the spectral picture.
    touched
        Share of the picture that shows materials of these, 0 to 1.
    seconds
        Of the small renders, together.
    """

    rungs: tuple[Rung, ...]
    tolerance: float
    chosen: Rung | None
    comparison: Comparison
    untranslated: Mapping[str, tuple[str, ...]]
    touched: float
    seconds: float

    @property
    def enough(self) -> bool:
        """Whether RGB is, as it is."""
        return self.chosen is self.rungs[0]

    @property
    def sentence(self) -> str:
        """The verdict in one sentence."""
        rgb = self.rungs[0]
        found = f"95 % of the picture within ΔE00 {rgb.usual:.2f}"
        off = f"{found}, the tolerance is {self.tolerance:g}"
        if self.enough:
            return f"RGB is enough: {off}."
        if self.chosen is None:
            return f"RGB is not enough ({off}), and nothing is; nearest come {_do(self.advised)}."
        return f"RGB is not enough ({off}); {_do(self.chosen)}."

    @property
    def advised(self) -> Rung:
        """What is to be done: what was chosen, else what comes nearest."""
        return self.chosen or min(self.rungs, key=lambda rung: rung.usual)


class Judging(Rendering):
    """A verdict under way.

    Parameters
    ----------
    scene
        A `bpy.types.Scene`, as it is now.
    tolerance, lights
        As of `render.Wanted`.
    samples, percentage
        Of the small renders; `SAMPLES`, and what comes to `SIZE`, where they are None.

    Raises
    ------
    RoughSpectraError
        As `Rendering`.
    """

    doing = "renders small pictures"
    interrupted = "The verdict was interrupted."
    smaller = "give a smaller percentage"

    def __init__(
        self,
        scene: Any,
        tolerance: float = TOLERANCE,
        samples: int | None = None,
        percentage: int | None = None,
        lights: Mapping[str, str] | None = None,
    ) -> None:
        if not tolerance > 0:
            msg = f"The tolerance is ΔE00 {tolerance:g}; give a number above 0."
            raise DomainError(msg)
        self._tolerance = tolerance
        self._scene_name = scene.name
        asked = samples or min(SAMPLES, scene.cycles.samples)
        self._halves = asked > 1
        each = asked // 2 if self._halves else asked
        self._samples = each * (1 + self._halves)
        self._kinds: list[str] = []
        self._report: analysis.SceneReport | None = None
        render = scene.render
        self._percentage = percentage or _fitting(render)
        small = (self._percentage / render.resolution_percentage) ** 2
        self._larger = scene.cycles.samples / self._samples / small
        wanted = Wanted(
            tolerance / _FINER,
            samples=each,
            percentage=self._percentage,
            lights=lights or {},
            most=_BANDS,
            steady=True,
            halves=self._halves,
            spectra=False,
        )
        super().__init__(scene, wanted)

    def verdict(self) -> Verdict:
        """Judge, once `poll` says that the renders are done.

        Raises
        ------
        OutputError
            If the second Blender failed.
        MaterialError
            If the picture is black.
        """
        picture = self.result()
        if not picture.xyz.any():
            msg = (
                f"Scene {self._scene_name!r} is black: no light reaches the camera, and there is "
                "nothing to compare; light what it sees."
            )
            raise MaterialError(msg)
        side = min(_WIDEST, math.ceil(math.sqrt(_IN_A_BLOCK / self._samples)))
        pictures = self._pictures("", side)
        halves = [self._pictures(f"-half-{n}", side) for n in (0, 1)] if self._halves else []
        shown, white = _blocks(picture.rgb, side), self._lamps.white
        # The first render of all makes the scene ready; the others only render.
        each_takes = float(np.median(picture.seconds[1:])) * self._larger
        once = max(picture.seconds[0] - float(np.median(picture.seconds[1:])), 0)
        rungs, comparisons = [], []
        whole, *alike = pictures
        for number, (kind, xyz) in enumerate(zip(("rgb", *self._kinds), alike, strict=True), 1):
            found = compare(shown, shown, whole, xyz, white)
            comparisons.append(found)
            parts = [compare(shown, shown, of[0], of[number], white) for of in halves]
            usual = _without_noise(found, parts, shown[..., 3] >= SEEN)
            rungs.append(Rung(kind, 1, found.mean, usual, found.largest, once + each_takes))
        rungs += self._of_passes(once, each_takes)
        sure = [rung for rung in rungs if rung.usual <= _SURE * self._tolerance]
        chosen = rungs[0] if rungs[0].usual <= self._tolerance else next(iter(sure), None)
        return Verdict(
            tuple(rungs),
            self._tolerance,
            chosen,
            comparisons[0],
            picture.untranslated,
            picture.touched or 0.0,
            sum(picture.seconds),
        )

    def _pictures(self, ending: str, side: int) -> list[Array]:
        """XYZ of blocks: the spectral picture, the ordinary one, and the others."""
        files = [f"pass-{n}{ending}.npy" for n in range(len(self._passes) + len(self._others))]
        pixels = [np.load(self.output(f))[..., :3] for f in (*files, f"plain{ending}.npy")]
        each_to_xyz = [each.to_xyz for each in (*self._passes, *self._others)]
        each_to_xyz.append(np.linalg.inv(self._space.from_xyz).T)
        *parts, plain = (
            _blocks(each.astype(np.float64) @ to_xyz, side)
            for each, to_xyz in zip(pixels, each_to_xyz, strict=True)
        )
        count = len(self._passes)
        return [np.sum(parts[:count], axis=0), plain, *parts[count:]]

    def _of_passes(self, once: float, each_takes: float) -> list[Rung]:
        """Predict pictures of bands, from one pass to as many as the tolerance needs."""
        found: list[Rung] = []
        while len(found) * IN_A_PASS < _BANDS:
            count = len(found) + 1
            bands = passes.choose(
                self._found, self._lamps, self._space, 0.0, most=count * IN_A_PASS
            )
            error = bands.error
            seconds = once + count * each_takes
            found.append(Rung("passes", count, error.mean, error.usual, error.largest, seconds))
            if error.usual <= _SURE * self._tolerance:
                break
        return found

    def _beside(self, depsgraph: Any, scene: Any) -> list[Pass]:
        self._others: list[Pass] = []
        wide = _wide(self._space)
        if self._found.measured:
            self._report = analysis.analyze(depsgraph, scene)
        spaces = {"": self._space} | ({} if wide is None else {"space": wide})
        for kind, space in spaces.items():
            for lights in ("", "lights") if self._found.measured else ("",):
                if kind or lights:
                    self._kinds.append(" and ".join(filter(None, (kind, lights))))
                    self._others.append(_of_colors(space, self._space, self._lamps.spectra))
        return self._others

    def _edits(self, renders: list[Pass]) -> list[dict[str, Any]]:
        told = super()._edits(renders)
        by_rgb = rgb_spectra.reflectances(self._space)
        for number, (kind, each) in enumerate(zip(self._kinds, self._others, strict=True)):
            if "lights" not in kind:
                continue
            at = len(self._passes) + number
            from_xyz = np.linalg.inv(each.to_xyz.T)
            # Surfaces with a spectrum come first, in their order.
            for edit, measured in zip(told, self._found.measured, strict=False):
                taken = _under(self._light_on(measured), from_xyz, each.taken)
                matched = passes.matched(measured, by_rgb, taken)
                edit["colors"][at] = matched.tolist()
        return told

    def _light_on(self, measured: Measured) -> Array:
        """Give the spectrum of the light that falls on a material, by its lights' shares."""
        assert self._report is not None
        view = self._report.views.get(places.owner(measured.place.of))
        if view is None:
            return np.asarray(self._lamps.spectra.sum(axis=0))
        return np.sum([light.share * np.array(light.spd) for light in view.lights], axis=0)


def judge(scene: Any, progress: Callable[[int, int], None] | None = None, **wanted: Any) -> Verdict:
    """Ask for a verdict and wait for it; arguments as of `Judging`."""
    with waited(Judging(scene, **wanted), progress) as job:
        return job.verdict()


def _do(rung: Rung) -> str:
    """Say what to do for a rung, how good it is, and what it takes."""
    what = {
        "space": f"switch the working space to {WIDE}, for nothing",
        "lights": "match the materials to the lights (Analyze Scene)",
        "space and lights": f"switch the working space to {WIDE} and match to the lights",
        "passes": f"a spectral picture of {rung.words}",
        "rgb": "RGB as it is",
    }[rung.kind]
    return f"{what}: ΔE00 {rung.usual:.2f}, about {durations.words(rung.seconds)} a picture"


def _fitting(render: Any) -> int:
    """Give the percentage at which the picture has no more pixels than `SIZE`."""
    whole = render.resolution_x * render.resolution_y
    if render.use_border:  # of which alone there are pixels
        across = render.border_max_x - render.border_min_x
        whole *= max(across * (render.border_max_y - render.border_min_y), 1 / whole)
    fits = math.floor(100 * math.sqrt(SIZE[0] * SIZE[1] / whole))
    return max(1, min(fits, render.resolution_percentage))


def _wide(space: WorkingSpace) -> WorkingSpace | None:
    """Give the wide space, unless the file has it or this Blender cannot switch."""
    one_alone = not hasattr(bpy.data, "colorspace") or bool(space.warning)
    return None if one_alone or space.name == WIDE else standard_spaces.SPACES[WIDE]


def _of_colors(space: WorkingSpace, current: WorkingSpace, spectra: Array) -> Pass:
    """Render in red, green and blue of a space."""
    across = np.linalg.inv(current.from_xyz).T @ space.from_xyz.T
    sent = np.maximum(illuminant_spectra.to_xyz(spectra) @ space.from_xyz.T, 0)
    return Pass(
        space.rgb_weights(illuminant_spectra.GRID, "D65"),
        sent,
        np.linalg.inv(space.from_xyz).T,
        from_rgb=across / across.sum(axis=0),
    )


def _under(light: Array, from_xyz: Array, usual: Array) -> Array:
    """From a reflectance to its red, green and blue under a light, of those of white there."""
    seen = light[:, np.newaxis] * illuminant_spectra.observer() @ from_xyz.T
    white = seen.sum(axis=0)
    lit = white > _DARK * white.max()
    return np.where(lit, seen / np.where(lit, white, 1), usual)


def _without_noise(found: Comparison, halves: list[Comparison], there: Array) -> float:
    """95th percentile of ΔE00 where something is, as it is without noise.

    Half of the variance between two halves is that of a half, and half of that is of both together;
    what remains of all variance is the picture's, and the percentile's distance from the mean goes
    with its root.
    """
    if not halves or not there.any():
        return found.usual
    whole = float(found.delta_e[there].var())
    apart = (halves[0].delta_e - halves[1].delta_e)[there]
    noise = float(np.mean(apart**2)) / 4
    kept = math.sqrt(max(1 - noise / whole, 0)) if whole > 0 else 1.0
    return found.mean + (found.usual - found.mean) * kept


def _blocks(pixels: Array, side: int) -> Array:
    """Mean over blocks of pixels; what does not fill one is left out."""
    rows, columns = (max(each // side, 1) for each in pixels.shape[:2])
    high, wide = pixels.shape[0] // rows, pixels.shape[1] // columns
    high, wide = min(high, side), min(wide, side)
    cut = pixels[: rows * high, : columns * wide]
    return np.asarray(cut.reshape(rows, high, columns, wide, -1).mean(axis=(1, 3)))
