# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spot of a surface, measured where the mouse clicks in the 3D view."""

import bpy
from bpy_extras import view3d_utils
from driver import TICK, area, click, find, grab, move, over, press, scene, window
from scenes_background import jobs
from stage import green_file, ours, wall

PLACE = (0.3, 0.2, 0.0)


def _read():
    found = ours("addon.material.last_measurement").get(wall())
    return None if found is None else [found.delta_e, found.spread, found.place]


def _marks():
    return [thing.name for thing in bpy.data.objects if thing.type == "EMPTY"]


def _modal():
    return [op.bl_idname for op in window().modal_operators]


def _at(place):
    """Point of the window where the 3D view shows a place."""
    view = area("VIEW_3D")
    region = next(region for region in view.regions if region.type == "WINDOW")
    x, y = view3d_utils.location_3d_to_region_2d(region, view.spaces.active.region_3d, place)
    return region.x + x, region.y + y


def _wheel_up():
    window().event_simulate(type="WHEELUPMOUSE", value="PRESS", ctrl=True)
    yield 2 * TICK


@scene
def measuring_a_spot(found):
    """Click the button, make the spot larger, click on the plane, and undo; then leave by ESC."""
    yield from green_file("VIEW_3D")
    with over(area("VIEW_3D")):
        bpy.ops.view3d.view_axis(type="TOP")
    yield 1.0
    panel = area("PROPERTIES")
    x, y = yield from find(panel, "rough_spectra.measure_here")
    yield from click(x, y)
    yield 0.5
    found["choosing"] = _modal()
    yield from move(*_at(PLACE))
    yield from _wheel_up()
    yield 0.5
    grab("choosing")
    yield from click(*_at(PLACE))
    yield lambda: bool(jobs())
    found["running"] = _modal()
    yield lambda: not jobs()
    yield 1.0
    found["read"], found["marks"], found["after"] = _read(), _marks(), _modal()
    [mark] = [bpy.data.objects[name] for name in found["marks"]]
    found["place"] = list(mark.matrix_world.translation)
    grab("measured")
    yield from move(*_at((-0.5, -0.5, 0.0)))
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = [_read(), _marks()]
    x, y = yield from find(panel, "rough_spectra.measure_here")
    yield from click(x, y)
    yield 0.3
    yield from press("ESC")
    yield 0.3
    found["left"] = [_modal(), _read(), _marks(), len(jobs())]
