# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make `core/cycles/gloss_data.py` from the tables of Cycles' own source.

Cycles scales its GGX lobe, and darkens what lies below, by tables that its developers computed
(`src/app/cycles_precompute.cpp`) and that are compiled into it. A lobe that is to agree with its
renders needs these very numbers. `intern/cycles/scene/shader.tables` of Blender's source holds
them, the same ones in 4.5 and 5.2:

    .venv/bpy-5.2/bin/python -m tools.tables.make_gloss_table shader.tables
"""

from __future__ import annotations

import re
import sys
import textwrap
from pathlib import Path

import numpy as np

from core.closure import packing

ROOT = Path(__file__).resolve().parents[2]
STEP = 1 / 32767
"""Of values from 0 to 1, as fine as 16 bits allow."""

TABLES = {
    "kept": ("ggx_E", 32, 2),
    "mean kept": ("ggx_Eavg", 32, 1),
    "share": ("ggx_gen_schlick_ior_s", 16, 3),
}
"""Our name of each: Cycles' name, entries along each axis, and axes."""

HEAD = '''# SPDX-FileCopyrightText: 2011-2022 Blender Foundation
# SPDX-License-Identifier: Apache-2.0
"""Tables of Cycles for `core.cycles.gloss_facets`, by tools/tables/make_gloss_table.py.

Of what a GGX lobe of facets that absorb nothing returns: "kept", over the cosine of the view and
the roughness; "mean kept", its mean over the hemisphere. "share" is where the lobe's reflection
lies between that at the normal and the whole, over the index of refraction, the cosine of the view
and the roughness. Roughness runs fastest, and all axes from 0 to 1.
"""

STEP = 1 / 32767
TABLES = {
'''


def read(source: str, name: str) -> np.ndarray:
    """Read one table of Cycles' source."""
    found = re.search(rf"table_{name}\[\d+\] = {{(.*?)}};", source, re.DOTALL)
    if found is None:
        sys.exit(f"There is no table_{name} in this file; give Cycles' scene/shader.tables.")
    return np.array([float(number) for number in re.findall(r"\d+\.\d+", found[1])])


def main(path: Path) -> None:
    """Write the module."""
    source, text = path.read_text(encoding="utf-8"), HEAD
    for ours, (name, size, axes) in TABLES.items():
        values = read(source, name)
        if values.size != size**axes or not 0 <= values.min() <= values.max() <= 1:
            sys.exit(f"table_{name} is not what it was; look at how Cycles reads it now.")
        packed = packing.pack(values[:, np.newaxis], np.array([STEP]))
        quoted = "\n".join(
            f'        "{row}"' for row in textwrap.wrap(packed, 90, break_on_hyphens=False)
        )
        text += f'    "{ours}": (\n        {size},\n{quoted},\n    ),\n'
    (ROOT / "core/cycles/gloss_data.py").write_text(text + "}\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
