# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the .blend of an asset library: the script that runs inside a second Blender.

That Blender has factory settings, so the extension is loaded here from its own files. It gets the
path of a job (JSON, written by `build`) as its last argument and leaves a .blend beside it.
"""

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType

import bpy

PACKAGE = "rough_spectra"


def main(job_path: Path) -> None:
    """Load the extension and let `make` do the job."""
    job = json.loads(job_path.read_text(encoding="utf-8"))
    # Not read_factory_settings: it disables every add-on, and Blender then deletes the wheels of
    # all extensions of the user, on which the Blender that asked and the next lines rely.
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    # Where the asking Blender finds the wheels; at the end, so that nothing is overshadowed.
    sys.path.extend(path for path in job["path"] if path not in sys.path)
    extension = load(Path(__file__).resolve().parents[2])
    extension.register()
    try:
        make = importlib.import_module(f"{PACKAGE}.addon.assets.make")
        make.run(job, job_path.parent)
    finally:
        extension.unregister()  # the bpy module of 4.5 crashes at exit over what is left registered


def load(folder: Path) -> ModuleType:
    """Import the extension's folder, whatever it is called."""
    spec = importlib.util.spec_from_file_location(
        PACKAGE, folder / "__init__.py", submodule_search_locations=[str(folder)]
    )
    if spec is None or spec.loader is None:
        raise ImportError(f"{folder / '__init__.py'} is missing; install the extension again.")
    module = importlib.util.module_from_spec(spec)
    sys.modules[PACKAGE] = module
    spec.loader.exec_module(module)
    return module


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
