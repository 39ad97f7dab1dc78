# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a material made from a set of readings reads all of them again.

Sets of known surfaces are written as tables and CxF files, as instruments' software makes them,
read, and joined. σ follows from angles, gloss from SCI and SCE or from gloss units, and the color
from the reading that comes first. Then each reading of the set is rendered at its virtual
instrument, gloss units by the virtual gloss meter, and compared with what the file states. Writes
docs/sets-table.md; ends with 1 where a bound is missed. Needs an environment with bpy:

    python -m tools.checks.check_sets

Files named behind it are read instead, and nothing is written.
"""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon import api
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.matching import roughness
from rough_spectra.addon.samples import gloss_of_set, presets, sets
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support import atomic_files
from rough_spectra.core import instruments, reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.cycles import gloss_estimate, gloss_reading
from rough_spectra.core.gloss import Gloss
from rough_spectra.core.limits import MATCHED_SIGMA

BOUND, UNITS = 0.3, 1.0
"""ΔE00, and gloss units, within which a reading has to be what its file states."""
PAINTS = {"white": "19-white-9-5", "gray": "21-neutral-6-5", "green": "14-green"}
ROUGHNESS = (0.15, 0.3, 0.6)
SPHERES = ("di:8", "de:8")
ANGLES = tuple(name for name, found in instruments.REGISTRY.items() if found.aspecular is not None)
METERS = (20, 60, 85)
SIGMAS = (5, 10, 20, 30)

TABLE = ROOT / "docs" / "sets-table.md"


@dataclass(frozen=True)
class Kind:
    """Surfaces of one kind, and how they were read.

    Attributes
    ----------
    name
        In the table.
    samples
        The sets, as their file was read.
    has_to
        Whether all readings have to be met.
    """

    name: str
    samples: list[Sample]
    has_to: bool = True


@dataclass(frozen=True)
class Read:
    """One reading of a set, as stated and as rendered; gloss units by angle have no instrument."""

    sample: str
    at: str
    apart: float
    is_units: bool = False


def made(folder: Path) -> list[Kind]:
    """Make the sets, by way of files."""
    bodies = {name: presets.load(f"colorchecker/{preset}") for name, preset in PAINTS.items()}
    nm = bodies["gray"].wavelengths.tolist()
    glossy = [
        (f"{name} {rough:g}", body, Gloss(roughness=rough))
        for name, body in bodies.items()
        for rough in ROUGHNESS
    ]
    rough = [
        (f"{name} {degrees}°", body, math.radians(degrees))
        for name, body in bodies.items()
        for degrees in SIGMAS
    ]
    of_gloss = [
        ("SCI, SCE and gloss units", SPHERES, METERS, _table, True),
        ("SCI and SCE", SPHERES, (), _cxf, True),
        ("45°/0° and gloss units", ("45a:0",), METERS, _table, True),
        ("45°/0°, SCI and SCE", ("45a:0", *SPHERES), (), _cxf, True),
        ("six angles and gloss units", ANGLES, METERS, _table, True),
        ("six angles", ANGLES, (), _cxf, True),
    ]
    kinds = []
    for name, at, meters, write, has_to in of_gloss:
        rows = [
            (label, _glossy(body, gloss, at), _units(body, gloss, meters))
            for label, body, gloss in glossy
        ]
        kinds.append(Kind(f"gloss: {name}", _through(folder, name, nm, rows, write), has_to))
    of_slopes = [
        ("45°/0° and SCE", ("45a:0", "de:8"), _table),
        ("six angles", ANGLES, _cxf),
    ]
    for name, at, write in of_slopes:
        rows = [(label, _rough(body, sigma, at), {}) for label, body, sigma in rough]
        samples = _through(folder, name, nm, rows, write)
        kinds.append(Kind(f"matte, rough: {name}", samples, False))
    return kinds


def _glossy(body: Sample, gloss: Gloss, at: Sequence[str]) -> dict[str, np.ndarray]:
    """Give what instruments read of an even body under a gloss, by Cycles' own formula."""
    layers = {name: gloss_reading.at_instrument(gloss, name) for name in at}
    return {
        name: layer.shine.mean() + layer.passed.mean() * body.values
        for name, layer in layers.items()
    }


def _units(body: Sample, gloss: Gloss, angles: tuple[int, ...]) -> dict[int, float]:
    weights = tristimulus.weights(body.wavelengths)[:, 1]
    return dict(gloss_estimate.readings(gloss, float(body.values @ weights), angles).units)


def _rough(body: Sample, sigma: float, at: Sequence[str]) -> dict[str, np.ndarray]:
    return {name: reading.from_albedo(body.values, sigma, "surface", name) for name in at}


Rows = list[tuple[str, dict[str, np.ndarray], dict[int, float]]]


def _through(
    folder: Path, name: str, wavelengths: Iterable[float], rows: Rows, write: Callable[..., str]
) -> list[Sample]:
    path = folder / f"{name.replace('/', ' ')}.{'csv' if write is _table else 'cxf'}"
    path.write_text(write(list(wavelengths), rows), encoding="utf-8")
    samples = api.read(path)
    assert [sample.name for sample in samples] == [label for label, *_ in rows], path
    return samples


def _table(nm: list[float], rows: Rows) -> str:
    """Write a table with a row a reading."""
    bands = ",".join(f"{at:g} nm" for at in nm)
    lines = [f"name,geometry,{','.join(f'gloss {angle}' for angle in METERS)},{bands}"]
    for label, read, units in rows:
        for geometry, values in read.items():
            cells = [f"{units[a]:.1f}" if a in units else "" for a in METERS]
            numbers = ",".join(f"{value:.4f}" for value in values)
            lines.append(f"{label},{geometry},{','.join(cells)},{numbers}")
    return "\n".join(lines) + "\n"


def _cxf(nm: list[float], rows: Rows) -> str:
    """Write CxF3 with an object a surface; all angles are of one device."""
    start, step = f'StartWL="{nm[0]:g}"', f'Increment="{nm[1] - nm[0]:g}"'
    known = dict.fromkeys(at for _, read, _ in rows for at in read)
    objects = "".join(
        f'<cc:Object Name="{label}" Id="o{i}"><cc:ColorValues>'
        + "".join(
            f'<cc:ReflectanceSpectrum Name="{_notation(at)}" ColorSpecification="{_device(at)}" '
            f"{start}>{' '.join(f'{value:.4f}' for value in values)}</cc:ReflectanceSpectrum>"
            for at, values in read.items()
        )
        + "</cc:ColorValues></cc:Object>"
        for i, (label, read, _) in enumerate(rows)
    )
    geometries: dict[str, str] = {}
    for at in known:
        geometries[_device(at)] = geometries.get(_device(at), "") + _geometry(at)
    specifications = "".join(
        f'<cc:ColorSpecification Id="{device}"><cc:MeasurementSpec><cc:MeasurementType>'
        f"Spectrum_Reflectance</cc:MeasurementType><cc:GeometryChoice>{geometry}"
        f"</cc:GeometryChoice><cc:WavelengthRange {start} {step}/>"
        "</cc:MeasurementSpec></cc:ColorSpecification>"
        for device, geometry in geometries.items()
    ).replace("</cc:MultiAngle><cc:MultiAngle>", "")
    return (
        '<cc:CxF xmlns:cc="http://colorexchangeformat.com/CxF3-core"><cc:Resources>'
        f"<cc:ObjectCollection>{objects}</cc:ObjectCollection><cc:ColorSpecificationCollection>"
        f"{specifications}</cc:ColorSpecificationCollection></cc:Resources></cc:CxF>"
    )


def _device(at: str) -> str:
    return "angles" if at in ANGLES else at.replace(":", "-")


def _notation(at: str) -> str:
    return f"r{at.partition('as')[2]}" if at in ANGLES else ""


def _geometry(at: str) -> str:
    if at in ANGLES:
        return (
            f'<cc:MultiAngle><cc:Angle Notation="{_notation(at)}"><cc:IlluminationAngle>45'
            f"</cc:IlluminationAngle><cc:Aspecular>{at.partition('as')[2]}</cc:Aspecular>"
            "<cc:Azimuth>0</cc:Azimuth></cc:Angle></cc:MultiAngle>"
        )
    if at in SPHERES:
        component = "Specular_Included" if at == "di:8" else "Specular_Excluded"
        return f"<cc:SphereGeometry>{component}</cc:SphereGeometry>"
    return (
        "<cc:SingleAngle><cc:SingleAngleConfiguration>Annular</cc:SingleAngleConfiguration>"
        "<cc:IlluminationAngle>45</cc:IlluminationAngle><cc:MeasurementAngle>0"
        "</cc:MeasurementAngle></cc:SingleAngle>"
    )


def check(samples: Sequence[Sample]) -> list[Read]:
    """Make a material of each set, and render all readings of it; needs the extension."""
    materials = [bpy.data.materials.new(sample.name) for sample in samples]
    requests = [api.request(s, sigma_of(s), read_at=s.instrument) for s in samples]
    glossy = [i for i, sample in enumerate(samples) if gloss_of_set.tells(sample)]
    for gloss in ("read", "none"):
        pairs = [
            (materials[i], requests[i])
            for i in range(len(samples))
            if (i in glossy) == (gloss == "read")
        ]
        api.assign(pairs, gloss=gloss)
    found = []
    for names in dict.fromkeys(_instruments(sample) for sample in samples):
        mine = [i for i, sample in enumerate(samples) if _instruments(sample) == names]
        entries = iter(api.bake([materials[i] for i in mine], read_at=names).entries)
        for i in mine:
            stated = {s.instrument: s for s in samples[i].readings if sets.is_exact(s)}
            for name, entry in zip(names, entries, strict=False):
                if entry.measured is None:
                    raise RuntimeError(entry.fault)
                values = stated[name].values * stated[name].scale
                lab = tristimulus.spectrum_to_lab(values, stated[name].wavelengths)
                apart = color_difference.delta_e(lab, np.array(entry.measured.lab))
                found.append(Read(samples[i].name, name, float(apart)))
    angles = [a for a in METERS if any(a in dict(s.gloss) for s in samples)]
    if angles:
        units = api.gloss(materials, angles)
        found += [
            Read(
                sample.name,
                f"{angle:g}°",
                float(row[angles.index(round(angle))] - value),
                is_units=True,
            )
            for sample, row in zip(samples, units, strict=True)
            for angle, value in sample.gloss
            if angle in angles
        ]
    bpy.data.batch_remove(materials)
    return found


def sigma_of(sample: Sample) -> float:
    """Give σ of a set: as stated, or from its readings if they tell it and have no gloss, or 0."""
    if sample.sigma_degrees is not None:
        return math.radians(sample.sigma_degrees)
    if gloss_of_set.tells(sample) or not roughness.tells(sample):
        return 0.0
    found = roughness.of_samples([([], [sample])])
    return min(float(found.sigma), MATCHED_SIGMA) if found.is_told else 0.0


def _instruments(sample: Sample) -> tuple[str, ...]:
    own = [s for s in sample.readings if sets.is_exact(s)]
    return tuple(dict.fromkeys(s.instrument for s in own if not sets.is_smooth(s)))


def row(kind: Kind, read: list[Read]) -> str:
    """Give the row of a kind."""
    colors = [each for each in read if not each.is_units]
    worst = max(colors, key=lambda each: each.apart)
    met = sum(each.apart <= BOUND for each in colors)
    units = [abs(each.apart) for each in read if each.is_units]
    cells = [
        *(kind.name, str(len(kind.samples)), f"{met} of {len(colors)}", f"{worst.apart:.2f}"),
        *(f"{worst.sample}, `{worst.at}`", f"{max(units):.2f}" if units else ""),
    ]
    return f"| {' | '.join(cells)} |\n"


HEAD = (
    "| sets | materials | readings within ΔE00 0.3 | largest | of | gloss units, off by at most |\n"
    "|---|--:|--:|--:|---|--:|\n"
)


def main(files: Sequence[str]) -> int:
    """Check everything and write it; 1 where a bound is missed."""
    extension: Any = sys.modules["rough_spectra"]
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.register()
    lines, missed = [], 0
    try:
        with tempfile.TemporaryDirectory() as folder:
            kinds = [Kind(path, api.read(path), False) for path in files] or made(Path(folder))
        for kind in kinds:
            read = check(kind.samples)
            lines.append(row(kind, read))
            print(lines[-1], end="", flush=True)
            wrong = [r for r in read if abs(r.apart) > (UNITS if r.is_units else BOUND)]
            for each in wrong:
                print(f"  {each.sample} at {each.at}: {each.apart:.2f}")
            missed += len(wrong) if kind.has_to else 0
    finally:
        # Blender trips over classes that are still registered when it ends.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        extension.unregister()
    if not files:
        with atomic_files.publication() as written:
            written.write(TABLE, (HEAD + "".join(lines)).encode())
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
