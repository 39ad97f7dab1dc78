# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Build an asset library: ask a second Blender for the .blend, then put it into its folder."""

from __future__ import annotations

import json
import re
import shutil
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from ...core.errors import OutputError
from ...core.instruments import DEFAULT
from ..blender import blend_file
from ..blender.background_job import Job, waited
from ..samples.readers.formats import library as library_format
from ..support import atomic_files, journal
from . import catalogs, shelf
from .plan import Asset

LONGEST_NAME = 63 if bpy.app.version < (5, 0, 0) else 255
"""Bytes that Blender leaves for the name of a material."""

AUTHOR = "Rough Spectra"
SHADER = "PRINCIPLED"
"""What others understand too: exporters to glTF make a Diffuse BSDF white."""

_BLEND, _RESULT = "assets.blend", "result.json"


@dataclass(frozen=True)
class Settings:
    """What all materials of a library share.

    Parameters
    ----------
    model, illuminant, observer, read_at
        As in `request.Request`.
    shader
        Node that is made, as in `shader_nodes.find`.
    author
        Of the assets.
    """

    model: str = "auto"
    illuminant: str = "D65"
    observer: int = 2
    shader: str = SHADER
    author: str = AUTHOR
    read_at: str = DEFAULT


@dataclass(frozen=True)
class Built:
    """A finished library.

    Parameters
    ----------
    blend, catalogs
        The files written.
    count
        Materials in it.
    warnings
        Sentences of each material that has any, by its name.
    """

    blend: Path
    catalogs: Path
    count: int
    warnings: dict[str, list[str]]


class Build(Job):
    """A library under way in a second Blender; `total` and `done` count previews.

    Parameters
    ----------
    assets
        Its materials.
    folder
        Of the asset library; made if need be. Other files in it stay as they are.
    settings
        What all materials share.

    Raises
    ------
    InputError
        If the catalog file in the folder cannot be read.
    OutputError
        If the folder cannot be written, or the second Blender not be started.
    """

    doing = "builds the asset library"
    interrupted = "Building was interrupted; nothing was written."
    smaller = "build the library of fewer samples at once"

    def __init__(
        self, assets: Sequence[Asset], folder: Path, settings: Settings | None = None
    ) -> None:
        settings = settings or Settings()
        titles = list(dict.fromkeys(asset.catalog for asset in assets))
        self.blend = folder.absolute() / _file_name(titles)
        self._catalogs = folder.absolute() / catalogs.FILE_NAME
        self._titles = titles
        self._count = len(assets)
        atomic_files.check_base(self.blend)
        for path in (self.blend, self._catalogs):
            atomic_files.check_target(path)
        journal.finish(self._catalogs.parent)
        ids = catalogs.merge(self._catalogs, titles).ids

        def prepare(_folder: Path) -> dict[str, Any]:
            return {
                "path": sys.path,
                "model": settings.model,
                "illuminant": settings.illuminant,
                "observer": settings.observer,
                "shader": settings.shader,
                "read_at": settings.read_at,
                "assets": [
                    {
                        "name": asset.name,
                        "sigma": asset.sigma,
                        "catalog": asset.catalog,
                        "catalog_id": ids[asset.catalog],
                        "author": settings.author,
                        "sample": library_format.record(asset.sample),
                    }
                    for asset in assets
                ],
            }

        super().__init__(Path(__file__).with_name("worker.py"), prepare)

    def publish(self) -> Built:
        """Put the library into its folder, once `poll` says that the job has ended.

        Raises
        ------
        OutputError
            If the second Blender failed, or the folder cannot be written; it is as it was then.
        """
        warnings = json.loads(self.output(_RESULT).read_text(encoding="utf-8"))
        made = self.output(_BLEND)
        if not blend_file.is_whole(made):
            msg = f"{made} is not whole; is the disk full? Nothing was written."
            raise OutputError(msg)
        journal.finish(self._catalogs.parent)
        # Read again: somebody may have added a catalog meanwhile.
        merged = catalogs.merge(self._catalogs, self._titles)
        with atomic_files.publication() as files:
            part = files.stage(self.blend)
            try:
                shutil.copyfile(made, part)
            except OSError as error:
                msg = f"{self.blend} cannot be written ({error.strerror}); nothing was changed."
                raise OutputError(msg) from error
            files.write(self._catalogs, merged.text.encode())
        return Built(self.blend, self._catalogs, self._count, warnings)


def build(
    assets: Sequence[Asset],
    folder: Path,
    settings: Settings | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Built:
    """Build a library and wait for it.

    Parameters
    ----------
    assets, folder, settings
        As in `Build`.
    progress
        Called with previews done and previews in all; may raise to stop.

    Raises
    ------
    InputError, OutputError
        As in `Build`; the folder is as it was then.
    CancelledError
        On an interrupt from the keyboard.
    """
    with waited(Build(assets, folder, settings), progress) as job:
        return job.publish()


def add_to_preferences(folder: Path) -> str | None:
    """Make a folder an asset library of the user's preferences, unless it is one.

    Returns
    -------
    The name that the preferences show, or None where the folder was there already.
    """
    libraries = bpy.context.preferences.filepaths.asset_libraries
    wanted = folder.resolve()
    if any(known.path and Path(known.path).resolve() == wanted for known in libraries):
        return None
    return shelf.add(libraries, str(wanted))


def _file_name(titles: Sequence[str]) -> str:
    """Name the file after its catalog, so that another collection gets a file beside it."""
    slug = re.sub(r"[^\w]+", "-", titles[0].lower()).strip("-") if len(titles) == 1 else ""
    return f"rough-spectra-{slug}.blend" if slug else "rough-spectra.blend"
