# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Material ▸ Rough Spectra, and the same in the sidebar of the shader editor."""

from __future__ import annotations

from typing import Any

import bpy

from ....core.numerics.memoized import memoized
from ..operators import common
from . import menus

_ENGINES = {"CYCLES", "BLENDER_EEVEE", "BLENDER_EEVEE_NEXT", "BLENDER_WORKBENCH"}


class _Tab:
    """Place of a panel in the Material tab of the Properties editor."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    COMPAT_ENGINES = _ENGINES

    @classmethod
    def is_here(cls, context: Any) -> bool:
        """Show wherever a material can be."""
        if common.active_material(context) is not None:
            return True
        thing = common.active_object(context)
        return hasattr(getattr(thing, "data", None), "materials")


class _Sidebar:
    """Place of a panel in the sidebar of the shader editor."""

    bl_space_type = "NODE_EDITOR"
    bl_region_type = "UI"
    bl_category = "Rough Spectra"

    @classmethod
    def is_here(cls, context: Any) -> bool:
        """Show where the nodes are those of a material."""
        return common.is_material_tree(context)


@memoized(maxsize=1)
def _drawing() -> Any:
    """Import what draws: most sessions of Blender never show these panels."""
    from . import drawing

    return drawing


class _Main:
    """Measured spectrum of the material"""

    bl_label = "Rough Spectra"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show wherever a material can be."""
        return bool(cls.is_here(context))  # type: ignore[attr-defined]

    def draw(self, context: Any) -> None:
        """Draw the sample and the settings."""
        _drawing().draw_sample(self.layout, context)  # type: ignore[attr-defined]


class _Part:
    """A part that needs a material with a spectrum."""

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show where the material stores a spectrum."""
        return _drawing().current(context).shown is not None


class _Difference(_Part):
    """Target and Blender side by side, and what the difference means"""

    bl_label = "Difference"

    def draw(self, context: Any) -> None:
        """Draw swatches, numbers and words."""
        _drawing().draw_difference(self.layout, context)  # type: ignore[attr-defined]


class _Plots(_Part):
    """Range of σ, spectrum, and reflectance over the view angle"""

    bl_label = "Plots"

    def draw(self, context: Any) -> None:
        """Draw the plots."""
        _drawing().draw_plots(self.layout, context)  # type: ignore[attr-defined]


class _Measurement:
    """Measure the material with a virtual spectrophotometer"""

    bl_label = "Measurement"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Show where there is a material."""
        return bool(_drawing().current(context).has_material)

    def draw(self, context: Any) -> None:
        """Draw the buttons and the last measurement."""
        _drawing().draw_measurement(self.layout, context)  # type: ignore[attr-defined]


class _Scene(_Part):
    """What the scene shows of the material"""

    bl_label = "Scene"

    def draw(self, context: Any) -> None:
        """Draw the lights found."""
        _drawing().draw_scene(self.layout, context)  # type: ignore[attr-defined]


class _Source(_Part):
    """Where the spectrum comes from"""

    bl_label = "Source"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Any) -> None:
        """Draw file, instrument and notes."""
        _drawing().draw_source(self.layout, context)  # type: ignore[attr-defined]


class ROUGHSPECTRA_PT_material(_Main, _Tab, bpy.types.Panel):
    """Measured spectrum of the material"""


class ROUGHSPECTRA_PT_difference(_Difference, _Tab, bpy.types.Panel):
    """Target and Blender side by side, and what the difference means"""

    bl_parent_id = "ROUGHSPECTRA_PT_material"


class ROUGHSPECTRA_PT_plots(_Plots, _Tab, bpy.types.Panel):
    """Range of σ, spectrum, and reflectance over the view angle"""

    bl_parent_id = "ROUGHSPECTRA_PT_material"


class ROUGHSPECTRA_PT_measurement(_Measurement, _Tab, bpy.types.Panel):
    """Measure the material with a virtual spectrophotometer"""

    bl_parent_id = "ROUGHSPECTRA_PT_material"


class ROUGHSPECTRA_PT_scene(_Scene, _Tab, bpy.types.Panel):
    """What the scene shows of the material"""

    bl_parent_id = "ROUGHSPECTRA_PT_material"


class ROUGHSPECTRA_PT_source(_Source, _Tab, bpy.types.Panel):
    """Where the spectrum comes from"""

    bl_parent_id = "ROUGHSPECTRA_PT_material"


class ROUGHSPECTRA_PT_nodes(_Main, _Sidebar, bpy.types.Panel):
    """Measured spectrum of the material"""


class ROUGHSPECTRA_PT_nodes_difference(_Difference, _Sidebar, bpy.types.Panel):
    """Target and Blender side by side, and what the difference means"""

    bl_parent_id = "ROUGHSPECTRA_PT_nodes"


class ROUGHSPECTRA_PT_nodes_plots(_Plots, _Sidebar, bpy.types.Panel):
    """Range of σ, spectrum, and reflectance over the view angle"""

    bl_parent_id = "ROUGHSPECTRA_PT_nodes"


class ROUGHSPECTRA_PT_nodes_measurement(_Measurement, _Sidebar, bpy.types.Panel):
    """Measure the material with a virtual spectrophotometer"""

    bl_parent_id = "ROUGHSPECTRA_PT_nodes"


classes = (
    *(ROUGHSPECTRA_PT_material, ROUGHSPECTRA_PT_difference, ROUGHSPECTRA_PT_plots),
    *(ROUGHSPECTRA_PT_measurement, ROUGHSPECTRA_PT_scene, ROUGHSPECTRA_PT_source),
    *(ROUGHSPECTRA_PT_nodes, ROUGHSPECTRA_PT_nodes_difference, ROUGHSPECTRA_PT_nodes_plots),
    ROUGHSPECTRA_PT_nodes_measurement,
)
register_menus = menus.register
unregister_menus = menus.unregister
