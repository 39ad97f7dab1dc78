# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the ColorChecker presets from colour-science's data.

Needs colour-science, which the presets themselves do not. Equal data give equal bytes:

    python3 -m tools.tables.make_presets [FOLDER]
"""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
from pathlib import Path
from typing import Any

from tools.run.run_command_line import ROOT

COLLECTION = "ColorChecker N Ohta"
FOLDER = ROOT / "presets" / "colorchecker"
SOURCE = (
    "Ohta, N. (1997), The basis of color reproduction engineering, with Munsell Color Science, "
    "Macbeth Colorchecker, http://www.rit-mcsl.org/UsefulData/MacbethColorChecker.xls, as "
    "distributed by colour-science: colour.SDS_COLOURCHECKERS['{collection}']['{patch}']"
)
SIGMA_SOURCE = (
    "Not measured: the spectrum is taken for the albedo of one facet, and 0 leaves it as it is. "
    "Choose any sigma."
)


def preset(
    number: int, patch: str, wavelengths: list[float], values: list[float]
) -> dict[str, Any]:
    """Return the fields of one preset.

    Parameters
    ----------
    number
        Place on the chart, from 1.
    patch
        colour-science's name of it, such as ``"neutral 8 (.23 D)"``.
    wavelengths, values
        nm and fractions, shape ``(bands,)``.
    """
    slug = re.sub(r"[^a-z0-9]+", "-", patch.partition("(")[0].lower()).strip("-")
    return {
        "format": "rough-spectra-preset",
        "schema": 1,
        "id": f"colorchecker/{number:02}-{slug}",
        "name": f"ColorChecker {number:02} {patch[0].upper()}{patch[1:]}",
        "source": SOURCE.format(collection=COLLECTION, patch=patch),
        "license": "BSD-3-Clause",
        "kind": "albedo",
        "instrument": "45a:0",
        "sigma_degrees": 0,
        "sigma_source": SIGMA_SOURCE,
        "wavelengths": [int(nm) if nm == int(nm) else nm for nm in wavelengths],
        "values": values,
    }


def presets() -> list[dict[str, Any]]:
    """Return the fields of all presets, in the chart's order."""
    import colour

    patches = colour.SDS_COLOURCHECKERS[COLLECTION]
    return [
        preset(number, patch, spectrum.wavelengths.tolist(), spectrum.values.tolist())
        for number, (patch, spectrum) in enumerate(patches.items(), start=1)
    ]


def text_of(fields: dict[str, Any]) -> str:
    """Return the file's text: one field a line, which keeps differences readable."""
    lines = (
        f"  {json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}"
        for key, value in fields.items()
    )
    return "{\n" + ",\n".join(lines) + "\n}\n"


def write_presets(made: list[dict[str, Any]], folder: Path) -> list[Path]:
    """Write presets into a folder, each whole or not at all, and return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for fields in made:
        path = folder / f"{fields['id'].rpartition('/')[2]}.json"
        part = path.with_suffix(".part")
        part.write_bytes(text_of(fields).encode())
        os.replace(part, path)
        written.append(path)
    return written


def main(arguments: list[str]) -> int:
    """Write the presets and say where."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER)
    folder = parser.parse_args(arguments).folder
    print(f"{len(write_presets(presets(), folder))} presets in {folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
