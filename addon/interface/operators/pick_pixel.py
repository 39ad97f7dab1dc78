# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read pixels of a spectral picture where the user clicks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import IntVectorProperty

from ....core.errors import RoughSpectraError
from . import common

if TYPE_CHECKING:
    from ...picture.pixel import Pixel

_NAVIGATION = {
    *("MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "TRACKPADPAN", "TRACKPADZOOM"),
    *("NDOF_MOTION", "TIMER", "WINDOW_DEACTIVATE", "HOME"),
    *("LEFT_CTRL", "RIGHT_CTRL", "LEFT_SHIFT", "RIGHT_SHIFT", "LEFT_ALT", "RIGHT_ALT"),
}
"""What goes to Blender while pixels are read: moving the picture, and what changes nothing."""


class ROUGHSPECTRA_OT_pick_pixel(bpy.types.Operator):
    """Click on the spectral picture, to read spectrum, color and RGB's error; ESC stops"""

    bl_idname = "rough_spectra.pick_pixel"
    bl_label = "Pick Spectrum"
    bl_options = {"REGISTER"}
    menu_place = 4, 2

    place: IntVectorProperty(
        name="Pixel",
        description="Column and row from the bottom left",
        size=2,
        default=(-1, -1),
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a picture whose spectra are in memory."""
        from ...picture import images

        if images.last() is None:
            cls.poll_message_set(
                "Render a spectral picture first; its spectra are not kept in the file"
            )
            return False
        return True

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user click in an Image Editor, unless the caller has chosen a pixel."""
        if min(self.place) >= 0:
            return self.execute(context)
        if not _editors(context):
            common.report_error(self, rpt_("Open an Image Editor with the picture, to click in."))
            return {"CANCELLED"}
        self._workspace = context.workspace.name
        context.window.cursor_modal_set("EYEDROPPER")
        context.window_manager.modal_handler_add(self)
        self._tell(rpt_("Click on the spectral picture"))
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Tell what is under the mouse, and keep what is clicked."""
        if event.type in _NAVIGATION:
            return {"PASS_THROUGH"}
        if event.type in {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"}:
            found = self._under(context, event)
            self._tell(rpt_("Click on the spectral picture") if found is None else line(found))
            return {"PASS_THROUGH"}
        if event.value != "PRESS":
            return {"RUNNING_MODAL"}
        if event.type in {"ESC", "RIGHTMOUSE"}:
            self.cancel(context)
            return {"FINISHED"}
        if event.type != "LEFTMOUSE":
            return {"RUNNING_MODAL"}
        found = self._under(context, event)
        if found is None:
            return {"PASS_THROUGH"}  # a click on something else in the window
        _keep(context, found)
        return {"RUNNING_MODAL"}

    def execute(self, context: Any) -> set[str]:
        """Read the pixel that the caller chose."""
        from ...picture import images, pixel

        last = images.last()
        assert last is not None
        try:
            found = pixel.read(last.picture, *self.place)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        _keep(context, found)
        self.report({"INFO"}, line(found))
        return {"FINISHED"}

    def cancel(self, context: Any) -> None:
        """Blender is closing, or another file was opened; or it ends."""
        if context.window is not None:
            context.window.cursor_modal_restore()
        if self._workspace in bpy.data.workspaces:
            bpy.data.workspaces[self._workspace].status_text_set(None)

    def _tell(self, what: str) -> None:
        if self._workspace in bpy.data.workspaces:
            leave = rpt_("ESC: leave")
            bpy.data.workspaces[self._workspace].status_text_set(f"{what}   |   {leave}")

    def _under(self, context: Any, event: Any) -> Pixel | None:
        """Read the pixel under the mouse, where an editor shows the picture there."""
        from ...picture import images, pixel

        for area in _editors(context):
            here = [region for region in area.regions if _is_in(region, event)]
            if not here or any(region.type != "WINDOW" for region in here):
                continue  # a sidebar may lie over the picture
            picture = images.of(area.spaces.active.image)
            if picture is None:
                continue
            rows, columns = picture.xyz.shape[:2]
            region = here[0]
            at = event.mouse_x - region.x, event.mouse_y - region.y
            across, up = region.view2d.region_to_view(*at)
            place = math.floor(across * columns), math.floor(up * rows)
            if 0 <= place[0] < columns and 0 <= place[1] < rows:
                return pixel.read(picture, *place)
        return None


def line(found: Pixel) -> str:
    """Say what a pixel is, in one line."""
    lightness, a, b = found.lab
    sentence = rpt_("Pixel {column}, {row}: L* {L:.1f}, a* {a:.1f}, b* {b:.1f}").format(
        column=found.column, row=found.row, L=lightness, a=a, b=b
    )
    if found.delta_e is not None:
        sentence += rpt_("; RGB is off by ΔE00 {delta_e:.2f}").format(delta_e=found.delta_e)
    return str(sentence)


def _keep(context: Any, found: Pixel) -> None:
    from ...picture import images
    from ...preview import pixel_plot

    images.pick(found)
    pixel_plot.make(found.wavelengths, found.radiance)
    if context.window is None:
        return
    for area in context.window.screen.areas:
        if area.type == "IMAGE_EDITOR":
            area.tag_redraw()


def _editors(context: Any) -> list[Any]:
    if context.window is None:
        return []
    return [area for area in context.window.screen.areas if area.type == "IMAGE_EDITOR"]


def _is_in(region: Any, event: Any) -> bool:
    inside_x = 0 <= event.mouse_x - region.x < region.width
    return region.width > 1 and inside_x and 0 <= event.mouse_y - region.y < region.height


classes = (ROUGHSPECTRA_OT_pick_pixel,)
