# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said when Rough Spectra itself fails: one sentence, and a file with where it failed."""

from __future__ import annotations

import platform
import tempfile
import traceback
from pathlib import Path

from ..support.version import version, where_to_report


def sentence(error: BaseException, doing: str, with_file: bool = True) -> str:
    """Say in one sentence that this is our fault, and where to report it.

    Parameters
    ----------
    error
        What was raised and expected by nobody.
    doing
        What was asked for, such as "bake".
    with_file
        Whether to write the traceback to a file among the temporary ones, which the sentence names.
    """
    what = " ".join(f"{type(error).__name__}: {error}".split())
    told = (
        f"Rough Spectra {version()} itself failed ({what}); please report it to {where_to_report()}"
    )
    path = _write(error, doing) if with_file else None
    return f"{told}, with {path}." if path else f"{told}."


def _write(error: BaseException, doing: str) -> Path | None:
    """Write the traceback to a new file; None where there is no place for it."""
    head = f"Rough Spectra {version()}, {doing}, {platform.platform()}\n"
    text = head + "".join(traceback.format_exception(error))
    try:
        with tempfile.NamedTemporaryFile(
            "w",
            prefix="rough-spectra-failed-",
            suffix=".txt",
            delete=False,
            encoding="utf-8",
            errors="backslashreplace",
        ) as file:
            file.write(text)
    except OSError:
        return None
    return Path(file.name)
