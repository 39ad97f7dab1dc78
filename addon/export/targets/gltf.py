# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""glTF 2.0: an asset with a square for each material, so that any program shows and gives them.

glTF's diffuse is Lambert's law below a gloss that KHR_materials_specular takes away. Spectrum and σ
are in each material's `extras`.
"""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ....core.lobes import LAMBERT
from ..entry import Entry
from ..names import creator, facts
from ..spaces import REC709

NAME = "gltf"
TITLE = "glTF"
PLACE = 30
ENDING = "gltf"
LOBES = (LAMBERT,)
SPACES = (REC709,)

_NO_GLOSS = "KHR_materials_specular"
EXTRAS = "rough-spectra"
"""Not as the extension's property of materials: up to Blender 4.5 the importer would write it."""
_APART = 1.25
"""From square to square, each of side 1."""
_FLOAT, _SHORT, _VERTICES, _INDICES = 5126, 5123, 34962, 34963
"""Codes of glTF."""


def content(entries: Sequence[Entry]) -> bytes:
    """Give the asset, with its buffer inside."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 0, -1], [0, 0, -1]], "<f4")
    normals = np.tile(np.array([0, 1, 0], "<f4"), (4, 1))
    indices = np.array([0, 1, 2, 0, 2, 3], "<u2")
    data = corners.tobytes() + normals.tobytes() + indices.tobytes()
    columns = math.ceil(math.sqrt(len(entries)))
    buffer = base64.b64encode(data).decode("ascii")
    document = {
        "asset": {"generator": creator(), "version": "2.0"},
        "extensionsUsed": [_NO_GLOSS],
        "scene": 0,
        "scenes": [{"nodes": list(range(len(entries)))}],
        "nodes": [
            {
                "name": entry.identifier,
                "mesh": place,
                "translation": [place % columns * _APART, 0.0, place // columns * _APART],
            }
            for place, entry in enumerate(entries)
        ],
        "meshes": [
            {
                "name": entry.identifier,
                "primitives": [
                    {"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": place}
                ],
            }
            for place, entry in enumerate(entries)
        ],
        "materials": [_material(entry) for entry in entries],
        "buffers": [
            {"byteLength": len(data), "uri": f"data:application/octet-stream;base64,{buffer}"}
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48, "target": _VERTICES},
            {"buffer": 0, "byteOffset": 48, "byteLength": 48, "target": _VERTICES},
            {"buffer": 0, "byteOffset": 96, "byteLength": 12, "target": _INDICES},
        ],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": _FLOAT,
                "count": 4,
                "type": "VEC3",
                "min": corners.min(axis=0).tolist(),
                "max": corners.max(axis=0).tolist(),
            },
            {"bufferView": 1, "componentType": _FLOAT, "count": 4, "type": "VEC3"},
            {"bufferView": 2, "componentType": _SHORT, "count": 6, "type": "SCALAR"},
        ],
    }
    return (json.dumps(document, indent=1, ensure_ascii=False) + "\n").encode()


def _material(entry: Entry) -> dict[str, Any]:
    return {
        "name": entry.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*(float(f"{each:.8g}") for each in entry.color), 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 1.0,
        },
        "extensions": {_NO_GLOSS: {"specularFactor": 0.0}},
        "extras": {EXTRAS: facts(entry)},
    }
