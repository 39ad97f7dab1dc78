# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do one job after the other: the script that a second Blender which is kept starts with.

Its last two arguments are the first job: a worker, which is a script, and the path of its job. More
of them come as lines of JSON, for as long as whoever asked holds standard input open. Every worker
begins with a file of its own, so it finds this Blender as if it were the first. What fails ends
this Blender, as it would if that job were the only one.
"""

import json
import os
import runpy
import sys
from pathlib import Path


def main(worker: str, job: str) -> None:
    """Do a job and those that follow."""
    do(worker, job)
    for line in sys.stdin:
        do(*json.loads(line))


def do(worker: str, job: str) -> None:
    """Run a worker as it would run by itself, and say when it is through."""
    folder = Path(job).parent
    talk_to(folder / "log")
    sys.argv[1:] = [worker, job]
    runpy.run_path(worker, run_name="__main__")
    talk_to(Path(os.devnull))  # the folder is going to be removed, which Windows refuses else
    (folder / "done").touch()


def talk_to(path: Path) -> None:
    """Write to the end of a file what Python and Blender print from now on."""
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    with path.open("ab") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)


if __name__ == "__main__":
    main(*sys.argv[-2:])
