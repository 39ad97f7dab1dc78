# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last scene: Blender quits when it is over."""

from driver import area, click, find, scene
from scenes_background import children, jobs
from stage import green_file


@scene
def quitting_while_measuring(found):
    """Measure, and go."""
    yield from green_file()
    yield from click(*(yield from find(area("PROPERTIES"), "rough_spectra.measure", 0.3)))
    yield lambda: bool(jobs())
    found["process"] = [process.pid for process in children()]
    found["folder"] = [str(path.parent) for path in jobs()]
