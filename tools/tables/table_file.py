# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The module that holds one table of `core.closure.table`, as text."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence

import numpy as np

from core.closure import packing
from core.numerics.arrays import Array

LARGEST = np.iinfo(np.int16).max

_HEAD = '''# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of the model "{name}" for `core.closure.table`.

Made by {maker}.
"""

from __future__ import annotations

'''


def render(
    name: str,
    maker: str,
    nodes: Mapping[str, Sequence[float]],
    meeting: float,
    rows: Array,
) -> str:
    """Write nodes, the albedo between, and the anchors: each column as fine as 16 bits allow.

    Parameters
    ----------
    name, maker
        The model, and the tool that made it.
    nodes
        SIGMA, POLAR, RATIO and AZIMUTH.
    meeting
        As in `core.closure.table.Table`.
    rows
        What `core.closure.table.packable` gives.
    """
    steps = tuple(float(f"{step:.3g}") for step in 1.01 * np.abs(rows).max(axis=0) / LARGEST)
    packed = packing.pack(rows, np.array(steps))
    lines = [_HEAD.format(name=name, maker=maker)]
    lines += [
        f"{axis} = ({', '.join(f'{at:g}' for at in at_all)})\n" for axis, at_all in nodes.items()
    ]
    lines.append(f"MEETING = {meeting:.2f}\n")
    listed = textwrap.fill(", ".join(f"{step:g}" for step in steps), 94)
    lines.append(f"STEPS = (\n{textwrap.indent(listed, '    ')}\n)\n")
    quoted = "\n".join(f'    "{row}"' for row in textwrap.wrap(packed, 94, break_on_hyphens=False))
    lines.append(f"PACKED = (\n{quoted}\n)\n")
    return "".join(lines)
