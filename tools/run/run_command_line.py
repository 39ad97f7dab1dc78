# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the extension's command line over the bpy module, without a Blender executable.

`dev.py run VERB ...` starts this file in an environment that has bpy: by its path, because it runs
in the caller's folder, whose files must not be taken for modules. The repository's root is loaded
as the package `rough_spectra`, because a clone's folder may have any name.
"""

import importlib
import importlib.util
import sys
import traceback
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = "rough_spectra"
FAILED_ITSELF, INTERRUPTED = 3, 130
"""Exit statuses, as `addon/commands/command_line.py` has them."""


def load_extension() -> ModuleType:
    """Make `import rough_spectra` find the repository's root, and return that package.

    Every tool that needs the extension comes here, and where it is loaded nothing happens.
    """
    if PACKAGE in sys.modules:
        return sys.modules[PACKAGE]
    spec = importlib.util.spec_from_file_location(
        PACKAGE, ROOT / "__init__.py", submodule_search_locations=[str(ROOT)]
    )
    if spec is None or spec.loader is None:
        raise ImportError(f"{ROOT / '__init__.py'} is missing: put it back from git.")
    module = importlib.util.module_from_spec(spec)
    sys.modules[PACKAGE] = module
    spec.loader.exec_module(module)
    return module


def main() -> int:
    """Hand the arguments to the extension and return its exit status."""
    extension = load_extension()
    importlib.import_module("bpy")  # before the extension: it brings mathutils and the like along
    extension.register()  # without it materials have no place to store a spectrum in
    command_line = importlib.import_module(f"{PACKAGE}.addon.commands.command_line")
    try:
        return int(command_line.main(sys.argv[1:]))
    finally:
        extension.unregister()  # the bpy module of 4.5 crashes at exit over what is left registered


def status() -> int:
    """Give the exit status; what fails around the command line is no failed check, so not 1."""
    try:
        return main()
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception:
        traceback.print_exc()
        return FAILED_ITSELF


if __name__ == "__main__":
    sys.exit(status())
