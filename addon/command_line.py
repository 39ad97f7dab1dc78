# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: `blender -b scene.blend --command rough_spectra VERB …`.

Exit status: 0 done, 1 a check failed, 2 the input is unusable, 130 interrupted. A failure is one
line on standard error; results go to files, since Blender itself prints on standard output.
"""

from __future__ import annotations

import contextlib
import importlib
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

NAME = "rough_spectra"
VERBS = ("analyze", "assets", "assign", "bake", "check", "import", "merge", "search", "validate")
_MODULES = {"import": "import_files"}
"""Of verbs that are words of Python's own."""

_UNUSABLE = 2
_INTERRUPTED = 130


def main(arguments: Sequence[str]) -> int:
    """Run one verb.

    Parameters
    ----------
    arguments
        The words after `rough_spectra`.

    Returns
    -------
    The exit status.
    """
    from ..core.errors import CancelledError, RoughSpectraError

    parser = _parser()
    # Help texts hold letters such as Δ and σ, which not every terminal or pipe can take.
    with contextlib.suppress(AttributeError):
        sys.stdout.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]
    try:
        options = parser.parse_args(list(arguments))
    except SystemExit as stop:  # argparse printed help or the fault
        return stop.code if isinstance(stop.code, int) else _UNUSABLE
    try:
        if options.blend is not None:
            _open(options.blend)
        else:
            _check_opened()
        return int(options.run(options))
    except CancelledError as error:
        status, sentence = _INTERRUPTED, str(error)
    except KeyboardInterrupt:
        status, sentence = _INTERRUPTED, "Interrupted; nothing was written."
    except RoughSpectraError as error:
        status, sentence = _UNUSABLE, str(error)
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        reason = error.strerror or _one_line(error)
        sentence = f"{place}{reason}; free the disk or choose another place."
        status = _UNUSABLE
    print(f"{NAME} {options.verb}: {sentence}", file=sys.stderr)
    return status


def _parser() -> argparse.ArgumentParser:
    import argparse  # here, because registering the command must not cost Blender's start

    parser = argparse.ArgumentParser(
        prog=f"blender -b scene.blend --command {NAME}",
        description="Measured rough materials that read the same when measured again.",
    )
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    for verb in VERBS:
        module = importlib.import_module(f".verbs.{_MODULES.get(verb, verb)}", __package__)
        sub = verbs.add_parser(verb, help=module.SUMMARY, description=module.DESCRIPTION)
        sub.add_argument(
            "--blend",
            type=Path,
            metavar="FILE",
            help="open this file first; the same as naming it before --command",
        )
        module.add_arguments(sub)
        sub.set_defaults(run=module.run)
    return parser


def _open(path: Path) -> None:
    import bpy

    from ..core.errors import InputError

    if not path.is_file():
        fault = "is no file" if path.exists() else "does not exist"
        msg = f"{path} {fault}; check the path after --blend."
        raise InputError(msg)
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), load_ui=False, use_scripts=False)
    except RuntimeError as error:
        msg = f"{path} cannot be opened as a .blend ({_one_line(error)}); check the file."
        raise InputError(msg) from error


def _check_opened() -> None:
    """Refuse to go on when Blender could not open the file named before --command.

    Blender itself says so among other lines and continues with an empty file.
    """
    import bpy

    from ..core.errors import InputError

    words = sys.argv[: sys.argv.index("--command")] if "--command" in sys.argv else []
    named = [word for word in words[1:] if word.endswith(".blend")]
    if named and not bpy.data.filepath:
        msg = f"{named[-1]} could not be opened by Blender; check the path before --command."
        raise InputError(msg)


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())


_handles: list[Any] = []


def register() -> None:
    """Add the command to Blender's `--command`."""
    import bpy

    _handles.append(bpy.utils.register_cli_command(NAME, main))


def unregister() -> None:
    """Take the command away."""
    import bpy

    while _handles:
        bpy.utils.unregister_cli_command(_handles.pop())
