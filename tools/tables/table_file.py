# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The module that holds one table of `core.closure.table`, as text."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence

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
    packed: str,
    step: float,
) -> str:
    """Write nodes, the albedo between, and the packed anchors.

    Parameters
    ----------
    name, maker
        The model, and the tool that made it.
    nodes
        SIGMA, POLAR, RATIO and AZIMUTH.
    meeting, packed, step
        As in `core.closure.table.Table`.
    """
    lines = [_HEAD.format(name=name, maker=maker)]
    lines += [
        f"{axis} = ({', '.join(f'{at:g}' for at in at_all)})\n" for axis, at_all in nodes.items()
    ]
    lines.append(f"MEETING = {meeting:.2f}\nSTEP = {step:g}\n")
    quoted = "\n".join(f'    "{row}"' for row in textwrap.wrap(packed, 94, break_on_hyphens=False))
    lines.append(f"PACKED = (\n{quoted}\n)\n")
    return "".join(lines)
