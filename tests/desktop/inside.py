# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of these tests that runs inside the desktop Blender."""

import importlib
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))
import driver
import scenes_at_first  # noqa: F401
import scenes_background  # noqa: F401
import scenes_comfort  # noqa: F401
import scenes_files  # noqa: F401
import scenes_gloss  # noqa: F401
import scenes_hour  # noqa: F401
import scenes_panel  # noqa: F401
import scenes_quitting  # noqa: F401
import scenes_rough  # noqa: F401
import scenes_shelf  # noqa: F401
import scenes_simple  # noqa: F401
import scenes_spectral  # noqa: F401
import scenes_spots  # noqa: F401
import stage

ZIP, FOLDER, *NAMES = sys.argv[sys.argv.index("--") + 1 :]


def main() -> None:
    """Install the extension, make room for the Material tab, and act out the scenes."""
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.use_preferences_save = False
    bpy.ops.extensions.package_install_files(
        filepath=ZIP, repo="user_default", enable_on_install=True, overwrite=True
    )
    # Where times of files are coarse, Python takes folders for what they were before: that of the
    # extension, and that of its wheels.
    importlib.invalidate_caches()
    if not hasattr(bpy.types, "ROUGHSPECTRA_FH_import"):
        bpy.ops.preferences.addon_enable(module=stage.PACKAGE)
    stage.open_details()
    driver.play(NAMES, Path(FOLDER) / "results.json")


if __name__ == "__main__":
    main()
