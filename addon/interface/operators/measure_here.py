# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure a spot of a surface where the user clicks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, FloatProperty, FloatVectorProperty

from ....core.errors import MaterialError, RoughSpectraError
from ....core.limits import SPOT_DIAMETER
from . import background, common, targets

if TYPE_CHECKING:
    from ...instrument.spot_measure import SpotMeasurement
    from ...readings.document import Reading

_APERTURES = (1, 2, 3, 4, 6, 8, 11, 16, 25, 30, 50, 80)
"""Diameters in millimeters that the wheel goes through: those of instruments, and a few more."""
_NAVIGATION = {
    *("MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE"),
    *("TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "NDOF_MOTION", "TIMER", "WINDOW_DEACTIVATE"),
    *("LEFT_CTRL", "RIGHT_CTRL", "LEFT_SHIFT", "RIGHT_SHIFT", "LEFT_ALT", "RIGHT_ALT"),
}
"""What goes to Blender while a place is chosen: turning the view, and what changes nothing."""


class ROUGHSPECTRA_OT_measure_here(background.InBackground, bpy.types.Operator):
    """Click on a surface, to measure a spot of it as it stands in the scene; ESC stops"""

    bl_idname = "rough_spectra.measure_here"
    bl_label = "Measure Here"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 3, 5

    diameter: FloatProperty(
        name="Spot",
        description="Diameter that the instrument sees, in millimeters",
        default=SPOT_DIAMETER,
        min=0.01,
        soft_min=1.0,
        soft_max=100.0,
        max=1e6,
    )
    keep_neighbors: BoolProperty(
        name="Keep Neighbors",
        description="Let other objects shade and light the spot",
    )
    leave_mark: BoolProperty(
        name="Mark",
        description="Leave an empty at the place; no render shows it",
        default=True,
    )
    origin: FloatVectorProperty(
        name="From", description="Where the ray begins", options={"HIDDEN", "SKIP_SAVE"}
    )
    direction: FloatVectorProperty(
        name="Direction",
        description="Of the ray that meets the surface",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    _is_choosing = False

    @classmethod
    def poll(cls, _context: Any) -> bool:
        """Need a material that can be read."""
        return targets.has_materials(cls)

    def draw(self, _context: Any) -> None:
        """Draw what may be changed of the last measurement."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "diameter")
        layout.prop(self, "keep_neighbors")
        layout.prop(self, "leave_mark")

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose a place in a 3D viewport, unless the caller has chosen one."""
        if any(self.direction):
            return self.execute(context)
        if not any(area.type == "VIEW_3D" for area in context.window.screen.areas):
            common.report_error(self, rpt_("Open a 3D viewport beside, to click in."))
            return {"CANCELLED"}
        self._is_choosing, self._workspace = True, context.workspace.name
        context.window.cursor_modal_set("EYEDROPPER")
        context.window_manager.modal_handler_add(self)
        self._ask()
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Wait for a click, and then for the second Blender."""
        if not self._is_choosing:
            return super().modal(context, event)
        if event.type in {"WHEELUPMOUSE", "WHEELDOWNMOUSE"} and event.ctrl:
            self._resize(up=event.type == "WHEELUPMOUSE")
        elif event.type in _NAVIGATION or event.type.startswith("NUMPAD"):
            return {"PASS_THROUGH"}
        elif event.value != "PRESS":
            pass
        elif event.type in {"ESC", "RIGHTMOUSE"}:
            self._chosen(context)
            return {"CANCELLED"}
        elif event.type == "N":
            self.keep_neighbors = not self.keep_neighbors
            self._ask()
        elif event.type == "LEFTMOUSE":
            return self._clicked(context, event)
        return {"RUNNING_MODAL"}

    def cancel(self, context: Any) -> None:
        """Blender is closing, or another file was opened."""
        if self._is_choosing:
            self._chosen(context)
        super().cancel(context)

    def start(self, context: Any) -> SpotMeasurement:
        """Put the instrument down, and start."""
        from ...instrument import bake, spot, spot_measure, surfaces
        from ...material import last_measurement

        if not any(self.direction):
            msg = "There is no place to measure; click on a surface in a 3D viewport."
            raise RoughSpectraError(msg)
        how = {"diameter": self.diameter, "is_alone": not self.keep_neighbors}
        place = spot.at_ray(context, self.origin, self.direction, **how)
        if place is None:
            raise RoughSpectraError("There is no surface at this place; click on one.")
        self._prepared = bake.prepare([place.surface])
        material = place.material
        # Pointers to materials and objects do not survive an undo while the measurement runs.
        self._uid, self._state = material.session_uid, last_measurement.fingerprint(material)
        self._carrier, self._units, self._scene = place.carrier, place.units, context.scene.name
        wanted = surfaces.arrangements([place], self._prepared)
        return spot_measure.SpotMeasurement([place], wanted)

    def state(self, done: int, total: int) -> str:
        """Say how many renders are done."""
        return rpt_("Measuring a spot: {done} of {total} rendered").format(done=done, total=total)

    def finish(self, job: SpotMeasurement) -> str:
        """Keep the reading with the material, mark the place, and tell both."""
        from ...instrument import mark, surfaces

        [entry] = surfaces.compare(self._prepared, job.result())
        if entry.measured is None:
            raise MaterialError(entry.fault)
        for sentence in filter(None, (*entry.warnings, entry.fault)):
            self.report({"WARNING"}, f"{entry.surface}, {entry.material}: {sentence}")
        self._note(entry)
        scene = bpy.data.scenes.get((self._scene, None))
        if self.leave_mark and scene is not None:
            mark.put(scene, self._carrier, entry, self._units)
        return _sentence(entry)

    def _note(self, entry: Reading) -> None:
        from ...material import last_measurement

        assert entry.measured is not None
        assert entry.spot is not None
        for material in bpy.data.materials:
            if material.session_uid == self._uid and material.is_editable:
                last_measurement.note(
                    material,
                    self._state,
                    entry.measured.rgb,
                    entry.delta_e_00,
                    instrument=entry.instrument,
                    place=f"{entry.surface}, {entry.spot.diameter:g} mm",
                    spread=entry.spot.spread_95,
                )

    def _clicked(self, context: Any, event: Any) -> set[str]:
        ray = _ray(context, event.mouse_x, event.mouse_y)
        if ray is None:
            return {"PASS_THROUGH"}  # a click on something else in the window
        self.origin, self.direction = ray
        self._chosen(context)
        return self.begin(context)

    def _resize(self, *, up: bool) -> None:
        beyond = [size for size in _APERTURES if (size > self.diameter) == up]
        beyond = [size for size in beyond if size != self.diameter]
        if beyond:
            self.diameter = min(beyond) if up else max(beyond)
        self._ask()

    def _ask(self) -> None:
        neighbors = rpt_("kept") if self.keep_neighbors else rpt_("hidden")
        sentence = rpt_(
            "Click on a surface: spot of {size:g} mm   |   Ctrl Wheel: size   |   "
            "N: neighbors {neighbors}   |   ESC: leave"
        )
        bpy.data.workspaces[self._workspace].status_text_set(
            sentence.format(size=self.diameter, neighbors=neighbors)
        )

    def _chosen(self, context: Any) -> None:
        """Take away what is shown while a place is chosen."""
        self._is_choosing = False
        if context.window is not None:
            context.window.cursor_modal_restore()
        if self._workspace in bpy.data.workspaces:
            bpy.data.workspaces[self._workspace].status_text_set(None)


def _ray(context: Any, x: int, y: int) -> tuple[Any, Any] | None:
    """Give the ray under the mouse in a 3D viewport of the window, or None beside them."""
    from bpy_extras import view3d_utils

    for area in context.window.screen.areas:
        if area.type != "VIEW_3D":
            continue
        here = [
            region
            for region in area.regions
            if region.width > 1
            and 0 <= x - region.x < region.width
            and 0 <= y - region.y < region.height
        ]
        if not here or any(region.type != "WINDOW" for region in here):
            continue  # a sidebar may lie over the view
        region = here[0]
        with context.temp_override(area=area, region=region):
            seen = bpy.context.region_data
        at = x - region.x, y - region.y
        return (
            view3d_utils.region_2d_to_origin_3d(region, seen, at),
            view3d_utils.region_2d_to_vector_3d(region, seen, at),
        )
    return None


def _sentence(entry: Reading) -> str:
    assert entry.measured is not None
    assert entry.spot is not None
    about = {
        "place": f"{entry.surface}, {entry.material}",
        "spread": entry.spot.spread_95 or 0.0,
        "rgb": ", ".join(f"{value:.3f}" for value in entry.measured.rgb),
    }
    if entry.delta_e_00 is None:
        sentence = rpt_("{place}: reads RGB {rgb}, 95 % of the spot within ΔE00 {spread:.2f}")
        return sentence.format(**about)
    sentence = rpt_(
        "{place}: measured ΔE00 {difference:.2f} from its spectrum, 95 % of the spot within ΔE00 "
        "{spread:.2f}"
    )
    return sentence.format(difference=entry.delta_e_00, **about)


classes = (ROUGHSPECTRA_OT_measure_here,)
