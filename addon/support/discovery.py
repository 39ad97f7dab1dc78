# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find what has one file a kind: formats, target shaders, verbs, operators, boxes of the panel."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from pkgutil import iter_modules
from typing import Any


def modules(package: str, path: Iterable[str]) -> list[Any]:
    """Import all modules of a package, in the order of their names.

    Parameters
    ----------
    package, path
        Its `__name__` and `__path__`.
    """
    names = sorted(found.name for found in iter_modules(path))
    return [import_module(f"{package}.{name}") for name in names]
