# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of the shelf: drag a picture onto an object, from the 3D view and the Asset Browser."""

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from driver import TICK, area, move, over, scene, window
from stage import ours

_THRESHOLD = 24  # pixels after which a press has become a drag


def drag(start, end):
    """Press, move slowly until it is a drag, move on, and let go."""
    yield from move(*start)
    yield 0.5  # the picture has to notice the pointer, else this selects objects
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=int(start[0]), y=int(start[1]))
    yield 0.1
    points = [(start[0], start[1] + step) for step in range(2, _THRESHOLD, 2)]
    points += [
        tuple(a + (b - a) * step / 6 for a, b in zip(start, end, strict=True))
        for step in range(1, 7)
    ]
    for point in points:
        yield from move(*point)
        yield 2 * TICK
    yield 0.3
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=int(end[0]), y=int(end[1]))
    yield 0.5


def on_screen(view, place):
    """Give where in the window a 3D view shows a place."""
    region = region_of(view, "WINDOW")
    seen = location_3d_to_region_2d(region, view.spaces.active.region_3d, place)
    return region.x + seen.x, region.y + seen.y


def _cube():
    return on_screen(area("VIEW_3D"), (0, 0, 0))


def region_of(where, kind):
    """Give the region of a kind in an area."""
    return next(region for region in where.regions if region.type == kind)


def _material():
    return bpy.data.objects["Cube"].active_material


@scene
def dragging_from_the_shelf(found):
    """From the factory's startup file: the library is there, and one drag is a measured cube."""
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield 0.3
    libraries = bpy.context.preferences.filepaths.asset_libraries
    shelf = ours("addon.assets.shelf")
    yield lambda: any(known.path == str(shelf.folder()) for known in libraries)
    found["libraries"] = [
        known.import_method for known in libraries if known.path == str(shelf.folder())
    ]
    yield 3.0
    pictures = region_of(area("VIEW_3D"), "ASSET_SHELF")
    first = pictures.x + 40, pictures.y + pictures.height // 2
    state = ours("addon.material.state")
    names = []
    for _ in range(2):
        before = _material().name
        yield from drag(first, _cube())
        yield lambda before=before: _material().name != before
        names.append(_material().name)
    found["names"] = names
    found["here"] = [_material().is_editable, _material().library is None]
    found["sample"] = _material().rough_spectra.sample_name
    found["preset"] = found["sample"] in {one.name for one in _presets().load_all()}
    _material().rough_spectra.sigma = 0.7
    yield 0.3
    found["state"] = state.state(_material()).kind
    yield from _from_the_browser(found)


def _from_the_browser(found):
    """Drag from the Asset Browser in place of the Properties editor."""
    browser = area("PROPERTIES")
    browser.ui_type = "ASSETS"
    yield 0.5
    space = browser.spaces.active
    space.show_region_toolbar = False
    space.params.asset_library_reference = ours("addon.assets.catalogs").ROOT
    yield 3.0
    files = region_of(browser, "WINDOW")
    before = _material().name
    with over(browser):
        bpy.ops.view2d.reset()
    yield from drag((files.x + 50, files.y + files.height - 50), _cube())
    yield lambda: _material().name != before
    found["browser"] = [bool(_material().rough_spectra.spectrum), _material().is_editable]


def _presets():
    return ours("addon.samples.presets")
