# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: `blender -b scene.blend --command rough_spectra VERB …`.

Exit status: 0 done, 1 a check failed, 2 the input is unusable, 3 Rough Spectra itself failed, 130
interrupted, 141 nobody reads what is printed. A failure is one line on standard error; results go
to files, since Blender itself prints on standard output.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import argparse

NAME = "rough_spectra"
_UNUSABLE = 2
_FAILED_ITSELF = 3
_INTERRUPTED = 130
_UNREAD = 141
"""What a shell says of a program that a closed pipe ended."""


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
    from ..support.shown_text import listening

    told = _Told()
    with listening(told.said):
        status = _guarded(arguments, told)
    if told.json:
        told.result(status)
    _let_go()
    return status


def _guarded(arguments: Sequence[str], told: _Told) -> int:
    """Run one verb and give its status, whatever happens."""
    try:
        status = _run(arguments, told)
        sys.stdout.flush()
    except SystemExit as stop:  # argparse printed help or the fault
        status = stop.code if isinstance(stop.code, int) else 0
        if isinstance(stop.code, str):
            status = told.failed(_UNUSABLE, stop.code)
        with contextlib.suppress(BrokenPipeError):
            sys.stdout.flush()
    except KeyboardInterrupt:
        status = told.failed(_INTERRUPTED, "Interrupted; nothing was written.")
    except BrokenPipeError:
        status = _UNREAD
    except Exception as error:  # whatever nobody expected: Blender would end with 1, a failed check
        status = told.unexpected(error)
    return status


class _Told:
    """What goes to standard error, with the verb as soon as it is known."""

    def __init__(self) -> None:
        from ..support.shown_text import Said

        self.verb = ""
        self.debug = self.json = False
        self.error = ""
        self.said = Said()
        self.facts: dict[str, Any] = {}

    def heed(self, options: argparse.Namespace) -> None:
        """Take down what the options say of how it is to be told."""
        self.verb, self.debug, self.json = options.verb, options.debug, options.json
        self.said.quiet, self.said.keeps_rows = options.quiet, options.json
        self.said.engine = options.progress or ""
        options.result = self.facts
        options.call = self.call

    def call(self, words: Sequence[str]) -> tuple[int, str, dict[str, Any]]:
        """Run another verb within this one: its status, the sentence that ended it, and result."""
        options = _parser().parse_args(list(words))
        before, self.verb, self.error = self.verb, options.verb, ""
        options.result = {}
        options.call = self.call
        try:
            status = _carry_out(options, self)
        finally:
            self.verb = before
        return status, self.error, options.result

    def failed(self, status: int, sentence: str) -> int:
        """Print one line, and give the status back."""
        from ..support.shown_text import tell

        self.error = sentence
        name = f"{NAME} {self.verb}".rstrip()
        with contextlib.suppress(OSError, ValueError):  # closed: there is nobody to tell
            tell(f"{name}: {sentence}")
            sys.stderr.flush()
        return status

    def unexpected(self, error: Exception) -> int:
        """Say that Rough Spectra failed, and where to report it."""
        from . import unexpected

        if self.debug:
            import traceback

            traceback.print_exception(error, file=sys.stderr)
        sentence = unexpected.sentence(error, self.verb or NAME, with_file=not self.debug)
        return self.failed(_FAILED_ITSELF, sentence)

    def result(self, status: int) -> None:
        """Print the result as one line of JSON, on standard output."""
        from ..support.shown_text import close
        from . import result

        with contextlib.suppress(OSError, ValueError):  # closed: there is nobody to tell
            close(result.line(self.verb, status, self.error, self.said, self.facts))


def _run(arguments: Sequence[str], told: _Told) -> int:
    """Run one verb and give its status."""
    # Help texts hold letters such as Δ and σ, which not every terminal or pipe can take.
    with contextlib.suppress(AttributeError):
        sys.stdout.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]
    options = _parser().parse_args(list(arguments))
    told.heed(options)
    with _terminable():
        return _carry_out(options, told)


@contextlib.contextmanager
def _terminable() -> Iterator[None]:
    """Let a request to end, as farms send it, be an interrupt: nothing half-done is left then."""
    import signal
    import threading

    usual = signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    if not usual or threading.current_thread() is not threading.main_thread():
        yield
        return
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _carry_out(options: argparse.Namespace, told: _Told) -> int:
    """Do what the options say; what is expected to go wrong is told here."""
    from ...core.errors import CancelledError, OwnFaultError, RoughSpectraError
    from ..blender import second_blender

    try:
        if options.blend is not None:
            _open(options.blend)
        else:
            _check_opened()
        with second_blender.kept():  # a verb may have one job after the other
            return int(options.run(options))
    except CancelledError as error:
        return told.failed(_INTERRUPTED, str(error))
    except OwnFaultError as error:
        return told.failed(_FAILED_ITSELF, str(error))
    except RoughSpectraError as error:
        return told.failed(_UNUSABLE, str(error))
    except BrokenPipeError:
        raise
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        reason = error.strerror or _one_line(error)
        sentence = f"{place}{reason}; free the disk or choose another place."
        return told.failed(_UNUSABLE, sentence)


def _let_go() -> None:
    """Leave nothing that Python would print, in vain, to a closed pipe at its end."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            with contextlib.suppress(OSError, ValueError):
                os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _parser() -> argparse.ArgumentParser:
    import argparse  # here, because registering the command must not cost Blender's start

    import bpy

    from ..support.version import version
    from .progress import ENGINES
    from .verbs import verbs

    parser = argparse.ArgumentParser(
        prog=f"blender -b scene.blend --command {NAME}",
        description="Measured rough materials that read the same when measured again.",
    )
    which = f"Rough Spectra {version()}, Blender {bpy.app.version_string}"
    about: dict[str, Any] = {
        "action": "version",
        "version": which,
        "help": "say which version this is",
    }
    parser.add_argument("--version", **about)
    subparsers = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    for verb in verbs():
        sub = subparsers.add_parser(verb.NAME, help=verb.SUMMARY, description=verb.DESCRIPTION)
        sub.add_argument(
            "--blend",
            type=Path,
            metavar="FILE",
            help="open this file first; the same as naming it before --command",
        )
        sub.add_argument(
            "--debug",
            action="store_true",
            help="when Rough Spectra itself fails, print where, instead of writing it to a file",
        )
        sub.add_argument(
            "--quiet",
            action="store_true",
            help="no progress and no summary: only results, warnings and what went wrong",
        )
        sub.add_argument(
            "--json",
            action="store_true",
            help="end standard output with one line of JSON: status, error, messages and results",
        )
        sub.add_argument(
            "--progress",
            choices=ENGINES,
            help="tell progress in the lines of a farm's engine: openjd for Open Job Description",
        )
        sub.add_argument("--version", **about)
        verb.add_arguments(sub)
        sub.set_defaults(run=verb.run)
    return parser


def _open(path: Path) -> None:
    import bpy

    from ...core.errors import InputError

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

    from ...core.errors import InputError

    ends = [i for i, word in enumerate(sys.argv) if word in ("-c", "--command")]
    words = sys.argv[: ends[0]] if ends else []
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
