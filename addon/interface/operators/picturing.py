# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that render pictures of the scene with a second Blender, and show them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from bpy.app.translations import pgettext_rpt as rpt_

from ...support import durations
from . import background, image_window


class Picturing(background.InBackground):
    """What such operators share."""

    stopped = "Stopped; no picture was made"
    rendering: ClassVar[str]
    """What is rendered, for the status bar."""
    needs_cycles: ClassVar[bool] = True
    """Whether the scene itself has to be rendered with Cycles."""

    if TYPE_CHECKING:  # of bpy.types.Operator, which every such class is as well

        @classmethod
        def poll_message_set(cls, message: str) -> None: ...  # noqa: D102

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need Cycles and a camera."""
        scene = context.scene
        if scene is None or (cls.needs_cycles and scene.render.engine != "CYCLES"):
            cls.poll_message_set("Only Cycles renders such pictures; switch the engine to it")
            return False
        if scene.camera is None:
            cls.poll_message_set("The scene has no camera; add one")
            return False
        return True

    def state(self, _done: int, _total: int) -> str:
        """Say how much is rendered, and how long the rest takes."""
        what, left = rpt_(self.rendering), self._job.left
        if left is None:
            return f"{what}: {self._job.share:.0%}"
        sentence = rpt_("{what}: {share:.0%}, {left} left")
        return str(sentence.format(what=what, share=self._job.share, left=durations.words(left)))


def shown(image: Any) -> str:
    """Show an image; gives what to do where that is not wanted, to be added to a sentence."""
    if image_window.show(image):
        return ""
    return str(rpt_("; image {name} is in the file").format(name=image.name))
