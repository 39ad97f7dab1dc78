# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliders for the lamps of `relit`, and its observer: they show what is set there, and set it.

Blender stores nothing of them, in no file: each is a view of a number that Python holds.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bpy.props import EnumProperty, FloatProperty, PointerProperty
from bpy.types import PropertyGroup, WindowManager

from .settings import OBSERVER_ITEMS

MOST = 16
"""Lamps that have a slider."""
_DEGREES = (2, 10)
"""Of `OBSERVER_ITEMS`, by their numbers."""


def _observer(_group: Any) -> int:
    from . import relit  # most sessions of Blender never render one

    last = relit.last()
    return 0 if last is None else _DEGREES.index(last.observer)


def _set_observer(_group: Any, value: int) -> None:
    from . import relit

    last = relit.last()
    if last is not None:
        last.set_observer(_DEGREES[value])
        relit.changed()


class RoughSpectraLamps(PropertyGroup):
    """What lamps are set to in the picture of which they were rendered apart."""

    observer: EnumProperty(
        name="Observer",
        description="Whose eye sees the picture",
        items=OBSERVER_ITEMS,
        get=_observer,
        set=_set_observer,
    )


def name(number: int) -> str:
    """Give the name of a lamp's property."""
    return f"intensity_{number}"


def _intensity(number: int) -> Callable[[Any], float]:
    def get(_group: Any) -> float:
        from . import relit

        last = relit.last()
        if last is None or number >= len(last.intensities):
            return 1.0
        return last.intensities[number]

    return get


def _set_intensity(number: int) -> Callable[[Any, float], None]:
    def put(_group: Any, value: float) -> None:
        from . import relit

        last = relit.last()
        if last is not None and number < len(last.intensities):
            last.set_intensity(number, value)
            relit.changed()

    return put


for _number in range(MOST):
    RoughSpectraLamps.__annotations__[name(_number)] = FloatProperty(
        name="Intensity",
        description="How many times as bright the lamp is in this picture as it was rendered; "
        "the lamp itself stays as it is",
        default=1.0,
        min=0.0,
        soft_max=10.0,
        precision=2,
        step=10,
        get=_intensity(_number),
        set=_set_intensity(_number),
    )

classes = (RoughSpectraLamps,)


def register_pointers() -> None:
    """Give the window manager its `rough_spectra` group."""
    WindowManager.rough_spectra = PointerProperty(type=RoughSpectraLamps)


def unregister_pointers() -> None:
    """Take the group away."""
    del WindowManager.rough_spectra
