# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell whether the color in a material's shader node still follows from its spectrum.

Only compares what is stored, without numpy or color science: cheap enough for a panel to draw.
What takes a material reads its `snapshot` and asks what takes those.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Literal

from ...core import instruments, white_scale
from ...core.limits import MATCHED_SIGMA_DEGREES
from ...core.numerics.memoized import memoized
from ..blender import shader_nodes
from ..samples import stated_white
from . import snapshot
from .derivation import (
    DERIVATION,
    WHAT_CHANGED,
    Stamp,
    is_current,
    matched_flat,
    parse,
    settings,
)
from .properties import SCHEMA, title
from .snapshot import Inputs, Snapshot, has_spectrum

_LEVEL, _COAT = "Specular IOR Level", "Coat Weight"
_SOCKET_TOLERANCE = 1e-6
"""Sockets are single precision; a difference below this is not an edit by hand."""


Kind = Literal["none", "fresh", "stale", "kept", "error", "linked"]


@dataclass(frozen=True)
class State:
    """What the panel says of a material.

    Parameters
    ----------
    kind
        "none": no spectrum. "fresh": what is shown follows from it. "stale": it does not, for
        `reasons`. "kept": edited by hand, and the user chose to keep that. "error": it could not be
        derived, or was stored by a newer version. "linked": it belongs to another file; the first
        reason says what to do, the others why it would be stale.
    reasons
        Sentences without their first capital and their full stop, most important first.
    stamp
        What was derived, if anything was.
    """

    kind: Kind
    reasons: tuple[str, ...] = ()
    stamp: Stamp | None = None


def state(material: Any) -> State:
    """Tell whether the color still follows from the spectrum, and if not, why."""
    return evaluate(snapshot.of(material)) if has_spectrum(material) else _NONE


@memoized(maxsize=1024)
def evaluate(found: Snapshot) -> State:
    """Tell the same from a material's facts."""
    if not found.inputs.spectrum:
        return _NONE
    last = parse(found.stamp)
    reasons = tuple(_stale_reasons(found))
    if found.elsewhere:
        return State("linked", (found.elsewhere, *reasons), last)
    if found.schema > SCHEMA:
        newer = "it was stored by a newer Rough Spectra; update the extension to work with it"
        return State("error", (newer,), last)
    if found.error:
        return State("error", (found.error,), last)
    if reasons:
        return State("stale", reasons, last)
    if last is not None and last.kept:
        if last.measured:
            return State("kept", (f"{last.measured!r} was found by measuring, and is kept",), last)
        return State("kept", ("color or roughness was edited by hand, and is kept",), last)
    return State("fresh", (), last)


def stale_reasons(material: Any, working_space: str) -> list[str]:
    """Say why the color in the shader node no longer follows from the spectrum; empty if it does.

    Empty, too, where the user chose to keep edits by hand and nothing changed since.
    """
    return _stale_reasons(snapshot.of(material)._replace(working_space=working_space))


def follows(found: Snapshot) -> bool:
    """Whether the surface shows what was derived, so that it may be derived again unasked.

    Settings may have changed; edits by hand, kept or not, must not be overwritten.
    """
    stamp = parse(found.stamp)
    return (
        stamp is not None
        and not stamp.kept
        and found.schema <= SCHEMA
        and not found.elsewhere
        and not _changed_surface(found, stamp)
    )


def gloss_changed(found: Snapshot) -> bool:
    """Whether all that changed is the gloss, set by hand: the color below is then to follow.

    Never of files of earlier versions, which keep what they show until something else changes.
    """
    stamp = parse(found.stamp)
    if stamp is None or stamp.gloss is None or found.surface is None:
        return False
    return _gloss(found.surface) != stamp.gloss and follows(found)


def edited_by_hand(material: Any) -> bool:
    """Whether renewing would overwrite what the user set in the shader node, kept or not."""
    found = snapshot.of(material)
    stamp, surface = parse(found.stamp), found.surface
    if stamp is None or stamp.kept or surface is None:
        return stamp is not None and bool(stamp.kept)
    if surface.disturbing:
        return True
    # A change of the working space converted the sockets: what they held is not known. Another
    # node holds what somebody set, unless it is the same one by another name.
    return stamp.working_space == found.working_space and edited(surface, stamp)


def fingerprint(surface: shader_nodes.Surface | None) -> str:
    """Give all that a surface shows, as far as Rough Spectra sets it, in a text to compare."""
    if surface is None:
        return "no Diffuse or Principled BSDF"  # stored with what was kept: never another text
    linked = (surface.color_linked, surface.roughness_linked, surface.muted)
    values = (*surface.color, surface.roughness)
    # Gloss was told by the sockets in use before it was counted.
    shown = surface.gloss
    used = [] if shown is None else [_LEVEL] * (shown.level > 0) + [_COAT] * (shown.coat > 0)
    used += [name for name in surface.disturbing if name not in used]
    return repr((surface.node, values, linked, used))


def beyond(sigma_degrees: float) -> str:
    """Say what to do about a σ that materials are no longer matched at; empty where they are.

    Files of earlier versions have one, and it stays as it is.
    """
    if sigma_degrees <= MATCHED_SIGMA_DEGREES:
        return ""
    most = f"{MATCHED_SIGMA_DEGREES:g}°"
    return (
        f"σ is {_degrees(sigma_degrees)}, and materials are matched up to {most} only; set σ to "
        f"{most} or less, or keep what the node shows"
    )


_NONE = State("none")
_PERFECT = stated_white.told(white_scale.PERFECT, None, "")


def _stale_reasons(found: Snapshot) -> list[str]:
    stamp = parse(found.stamp)
    if stamp is None:
        return ["nothing was derived from the spectrum yet"]
    changed = [*_changed_inputs(found.inputs, stamp), *_changed_surface(found, stamp)]
    if not stamp.kept and found.surface is not None:
        changed += ["its gloss was changed"] * (_gloss(found.surface) != (stamp.gloss or ()))
    too_large = "" if stamp.kept else beyond(found.inputs.sigma_degrees)
    return [too_large, *changed] if too_large else changed


def _changed_inputs(found: Inputs, stamp: Stamp) -> list[str]:
    if is_current(stamp, found):
        return []
    as_matched = found._replace(flat=bool(matched_flat(stamp)))
    before, now = dict(stamp.settings), settings(as_matched)
    if before:
        # An older stamp knows no others.
        before.setdefault("white", _PERFECT)
        before.setdefault("virtual instrument", instruments.DEFAULT)
    changes = []
    for label, value in before.items():
        if now.get(label, value) == value:
            continue
        if label == "spectrum":
            changes.append("the spectrum was replaced")
            continue
        what = label if label == "σ" else f"the {label}"
        old, new = _told(label, value, now[label])
        changes.append(f"{what} was changed from {old} to {new}")
    return changes or ["the spectrum or a setting was changed"]


def _told(label: str, *values: str) -> list[str]:
    """Write two values of a setting as the panel does, with no more digits than tell them apart."""
    if label != "σ":
        return [title(label, value) for value in values]
    if not all(re.fullmatch(r"-?\d+(\.\d+)?°", value) for value in values):
        return list(values)  # no number of degrees, in a damaged stamp
    rounded = [_degrees(float(value.rstrip("°"))) for value in values]
    return rounded if len(set(rounded)) == len(values) else list(values)


def _degrees(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".") + "°"


def _changed_surface(found: Snapshot, stamp: Stamp) -> list[str]:
    surface, working_space = found.surface, found.working_space
    if stamp.kept and stamp.working_space == working_space:
        if stamp.kept == fingerprint(surface):
            return []
        return ["color or roughness was edited by hand after earlier edits were kept"]
    reasons = []
    if stamp.working_space != working_space:
        reasons.append(f"the working space changed from {stamp.working_space} to {working_space}")
    if stamp.derivation > DERIVATION:
        reasons.append(f"it was derived by a newer Rough Spectra {stamp.version}".rstrip())
    elif stamp.derivation < DERIVATION:
        since = f"since Rough Spectra {stamp.version}".rstrip()
        what = [WHAT_CHANGED[each] for each in WHAT_CHANGED if each > stamp.derivation]
        reasons.append(f"the model has changed {since} derived it: {'; '.join(what)}")
    if surface is None or surface.node != stamp.node:
        reasons.append(f"the surface no longer comes from {stamp.node!r}")
    elif linked := surface.linked:
        reasons += [f"{name} comes from another node" for name in linked]
    elif stamp.working_space == working_space and edited(surface, stamp):
        # A change of the working space converts sockets: whether they were edited can't be told.
        reasons.append("color or roughness was edited by hand")
    if surface is not None:
        if surface.muted:
            reasons.append(f"{surface.node!r} is muted")
        reasons += [f"{name} is in use" for name in surface.disturbing]
    return reasons


def _gloss(surface: shader_nodes.Surface) -> tuple[float, ...]:
    return () if surface.gloss is None else surface.gloss.numbers()


def edited(surface: shader_nodes.Surface, stamp: Stamp) -> bool:
    """Whether a surface shows another color or roughness than was derived."""
    if surface.linked:
        return True
    written, found = (*stamp.color, stamp.roughness), (*surface.color, surface.roughness)
    # Sockets may hold NaN, which is near to nothing.
    # A texture's scale may be above 1, with a last digit as much larger.
    near = (abs(a - b) <= _SOCKET_TOLERANCE * max(abs(a), 1.0)
            for a, b in zip(written, found, strict=True))  # fmt: skip
    return not all(near)
