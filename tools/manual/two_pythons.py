# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the numbers of a page where the extension is, and its figures where matplotlib is.

Needs no more than dev.py does, so a page is made by one command in any Python from 3.9 on.
"""

from __future__ import annotations

from collections.abc import Sequence

import dev


def run(numbers: Sequence[str], figures: Sequence[str]) -> int:
    """Run a module in an environment that has bpy, then one in that of the tools.

    Parameters
    ----------
    numbers, figures
        File of the module, as "tools/manual/name.py", and its arguments.

    Returns
    -------
    int
        Exit status of the first that fails, or 0.
    """
    for prepare, (name, *arguments) in (
        (dev.prepare_blender, numbers),
        (dev.prepare_tools, figures),
    ):
        if status := dev.call(dev.tool(prepare().python, name, *arguments)):
            return status
    return 0
