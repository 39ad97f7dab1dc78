# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: buttons, dialogs and file browsers. An operator is one file here, found by itself.

    classes = (ROUGHSPECTRA_OT_keep,)           registered in this order
    def register_menu(), unregister_menu()      only where it is in a menu of Blender's besides

An operator that users call by itself has a `menu_place`, its group in the menu Rough Spectra and
its place among them: Blender's search finds what is in a menu. Files without `classes` are help
for the operators.
"""

from __future__ import annotations

from types import ModuleType

from ...support import discovery


def modules() -> list[ModuleType]:
    """Import all files with operators, and give them in the order of their names."""
    found = discovery.modules(__name__, __path__)
    return [module for module in found if hasattr(module, "classes")]
