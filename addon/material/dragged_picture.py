# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture that a material dragged from an asset library brings along as its icon.

Blender takes it for one that the user loaded, and never draws the material itself in its place.
"""

from __future__ import annotations

from typing import Any


def drop(material: Any) -> None:
    """Let Blender draw the icon of a dragged copy: it shows another sample from now on.

    An asset keeps its picture, which is what its library shows, and may be the user's own.
    """
    preview = material.preview
    if preview is None or material.asset_data is not None:
        return
    if preview.is_image_custom:
        preview.is_image_custom = False
    if preview.is_icon_custom:
        preview.is_icon_custom = False
