# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The work of a farm's job: which scenes there are, in which parts, and which of them are a task's.

Every machine works the same list out of the same options, so nobody has to hand it round.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...core.errors import InputError
from ..support import user_files

ENDING = ".blend"


@dataclass(frozen=True)
class Unit:
    """One scene, or one part of it: what a task does in one go.

    Parameters
    ----------
    scene
        The .blend; None where the verb needs none.
    name
        Its path below the folder that all scenes share, without its ending, with `/`.
    shard, shards
        Which part of how many; 0 for all of them.
    """

    scene: Path | None
    name: str
    shard: int = 1
    shards: int = 1

    def words(self, words: Sequence[str], output: Path | None) -> list[str]:
        """Give the words of a command for this unit.

        `{name}` and `{file}` in them become the scene's name and path. `bake` and `merge` get what
        they need of shards, parts and output.
        """
        marks = {"{name}": self.name, "{file}": "" if self.scene is None else str(self.scene)}
        found = list(words)
        for mark, text in marks.items():
            found = [word.replace(mark, text) for word in found]
        verb, rest = found[0], found[1:]
        base = None if output is None else output / self.name
        if verb == "merge":
            if base is None:
                raise InputError("Say where the parts are, with --output FOLDER.")
            return ["merge", *map(str, self._parts(base)), "--output", str(base), *rest]
        if verb in ("bake", "check") and base is not None and "--output" not in rest:
            rest = ["--output", str(base), *rest]
        if verb == "bake" and self.shards > 1:
            rest = ["--shard", f"{self.shard}/{self.shards}", *rest]
        if self.scene is not None:
            rest = ["--blend", str(self.scene), *rest]
        return [verb, *rest]

    def _parts(self, base: Path) -> list[Path]:
        if self.shards == 1:
            return [base.with_name(f"{base.name}.json")]
        return [
            base.with_name(f"{base.name}.part-{number}-of-{self.shards}.json")
            for number in range(1, self.shards + 1)
        ]

    def __str__(self) -> str:
        several = self.shards > 1 and self.shard > 0
        of = f", part {self.shard} of {self.shards}" if several else ""
        return f"{self.scene or 'the command'}{of}"


def units(files: Sequence[str], shards: int, *, whole: bool) -> list[Unit]:
    """List the work of a job, in the same order on every machine.

    Parameters
    ----------
    files
        Scenes; folders, of which all scenes below count; and lists, texts with a path a line.
    shards
        Parts that each scene is to be baked in.
    whole
        Whether a unit is a scene, whatever its parts.

    Raises
    ------
    InputError
        If there is no scene.
    """
    given = [name for name in files if name]
    if not given:
        return [Unit(None, "")]
    scenes = list(dict.fromkeys(scene for name in given for scene in _scenes(Path(name))))
    if not scenes:
        msg = f"There is no {ENDING} in {', '.join(given)}; name files, folders or a list of files."
        raise InputError(msg)
    shared = Path(os.path.commonpath([scene.parent for scene in scenes]))
    found = []
    for scene in scenes:
        name = scene.relative_to(shared).with_suffix("").as_posix()
        if whole:
            found.append(Unit(scene, name, 0, shards))
        else:
            found += [Unit(scene, name, number, shards) for number in range(1, shards + 1)]
    return found


def share(text: str) -> tuple[int, int]:
    """Read which task of how many, or which shard, as in "2/8"."""
    try:
        index, count = (int(word) for word in text.split("/"))
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is not I/N, as in 2/8") from error
    if not 1 <= index <= count:
        raise argparse.ArgumentTypeError(f"{text!r}: I runs from 1 to N")
    return index, count


def _scenes(path: Path) -> list[Path]:
    if path.suffix == ENDING:
        return [path.absolute()]
    if path.is_dir():
        return sorted(found.absolute() for found in path.rglob(f"*{ENDING}"))
    try:
        lines = user_files.read(path).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError as error:
        msg = f"{path} is no list of files ({error}); give a text in UTF-8 with a path a line."
        raise InputError(msg) from error
    names = [line.strip() for line in lines]
    return [(path.parent / name).absolute() for name in names if name and not name.startswith("#")]
