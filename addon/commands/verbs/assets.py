# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`assets`: a Blender asset library of measured materials."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...support.shown_text import inform, tell

NAME = "assets"
SUMMARY = "build a Blender asset library of measured materials"
DESCRIPTION = (
    "Build a folder that Blender takes for an asset library: materials with rendered previews, "
    "catalogs, tags and descriptions. Without samples it is the ColorChecker. The open .blend is "
    "not changed."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `assets`."""
    from ....core.instruments import DEFAULT, REGISTRY
    from ....core.models import NAMES
    from ...colorimetry.tristimulus import ILLUMINANTS, OBSERVERS
    from ...matching import shaders

    parser.add_argument("--output", type=Path, required=True, metavar="DIR", help="the folder")
    sigma = parser.add_mutually_exclusive_group()
    sigma.add_argument(
        "--sigma",
        type=float,
        nargs="+",
        default=[],
        metavar="DEGREES",
        help="roughnesses, each of which every sample gets; without any, what the samples say",
    )
    for name, formula in (("rdq", "tan σ"), ("sdq", "√2 tan σ")):
        sigma.add_argument(
            f"--{name}",
            type=float,
            nargs="+",
            default=[],
            metavar="SLOPE",
            help=f"the same as a profilometer's {name.title()} = {formula}",
        )
    parser.add_argument(
        "--collection",
        nargs="+",
        default=[],
        metavar="NAME",
        help="all samples of collections, such as colorchecker or everyday",
    )
    parser.add_argument(
        "--preset", nargs="+", default=[], metavar="NAME", help="presets or samples of the library"
    )
    parser.add_argument(
        "--file", type=Path, nargs="+", default=[], metavar="FILE", help="measurement files"
    )
    parser.add_argument(
        "--library", type=Path, metavar="DIR", help="the user's library, if not the usual folder"
    )
    parser.add_argument("--illuminant", choices=ILLUMINANTS, default="D65")
    parser.add_argument("--observer", type=int, choices=OBSERVERS, default=2)
    parser.add_argument(
        "--read-at",
        choices=tuple(REGISTRY),
        default=DEFAULT,
        metavar="INSTRUMENT",
        help="virtual instrument that the materials read right at, and are measured with "
        f"({DEFAULT}): {', '.join(REGISTRY)}",
    )
    parser.add_argument("--model", choices=("auto", *NAMES), default="auto")
    parser.add_argument(
        "--shader", choices=[name.lower() for name in shaders.NAMES], default="principled"
    )
    parser.add_argument("--author", metavar="NAME", help="author of the assets")


def run(options: argparse.Namespace) -> int:
    """Build the library; exit status 0."""
    from ...assets import build, plan
    from ...material import preferences
    from ...samples.stated_sigma import StatedSigma
    from ..progress import ProgressLine, counted
    from ..result import add

    folder = options.library or preferences.user_folder()
    chosen = [
        *(item for name in options.collection for item in plan.of_collection(name, folder)),
        *(plan.of_name(name, folder) for name in options.preset),
        *(item for path in options.file for item in plan.of_file(path)),
    ]
    if not (options.collection or options.preset or options.file):
        chosen = plan.of_collection("colorchecker")
    sigma = [
        *map(StatedSigma, options.sigma),
        *(StatedSigma(rdq=slope) for slope in options.rdq),
        *(StatedSigma(sdq=slope) for slope in options.sdq),
    ]
    assets = plan.assets(chosen, sigma, build.LONGEST_NAME)
    settings = build.Settings(
        model=options.model,
        illuminant=options.illuminant,
        observer=options.observer,
        shader=options.shader.upper(),
        author=options.author or build.AUTHOR,
        read_at=options.read_at,
    )
    with ProgressLine("rendering previews") as progress:
        built = build.build(assets, options.output, settings, progress)
    for name, sentences in built.warnings.items():
        for sentence in sentences:
            tell(f"warning: material {name!r}: {sentence}")
    add(options, files=[built.blend], materials=built.count)
    inform(f"{counted(built.count, 'material')} in {built.blend}")
    return 0
