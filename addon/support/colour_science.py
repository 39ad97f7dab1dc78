# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Import colour-science on first use, and leave no trace of it in the rest of Blender.

The import takes about half a second. Where scipy and matplotlib are missing, as in Blender,
colour-science puts `MagicMock` stand-ins under their names into `sys.modules`, where other add-ons
would take them for the real thing; it also switches numpy's print options and Python's warning
filters. All of that is put back.
"""

from __future__ import annotations

import sys
import warnings
from types import ModuleType

import numpy as np


def colour() -> ModuleType:
    """Give the module colour-science."""
    loaded = sys.modules.get("colour")
    if loaded is not None:
        return loaded
    # It brings asyncio along, which a material's first color needs as little.
    from unittest import mock

    before = set(sys.modules)
    print_options = np.get_printoptions()
    with warnings.catch_warnings():
        # It tells of each optional package that is missing; none of them is used here.
        warnings.simplefilter("ignore")
        import colour as module
    # numpy 1.26 reports legacy=False, but accepts it back only as such.
    np.set_printoptions(**print_options)
    for name in set(sys.modules) - before:
        if isinstance(sys.modules[name], mock.MagicMock):
            del sys.modules[name]
    return module
