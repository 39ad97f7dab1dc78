# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""JSON Schema 2020-12, as far as the schemas that ship use it."""

import re

TYPES = {
    "string": str,
    "array": list,
    "object": dict,
    "number": (int, float),
    "integer": int,
    "boolean": bool,
    "null": type(None),
}
_WORDS = ("$schema", "$defs", "title", "description")


def allowed(schema, value, root=None):
    """Whether a schema, which is `root` or a part of it, allows a value."""
    root = schema if root is None else root
    number = isinstance(value, int | float) and not isinstance(value, bool)
    for key, demand in schema.items():
        ok = {
            "$ref": lambda demand=demand: allowed(_definition(root, demand), value, root),
            "type": lambda demand=demand: any(
                isinstance(value, TYPES[name]) and isinstance(value, bool) == (name == "boolean")
                for name in ([demand] if isinstance(demand, str) else demand)
            ),
            "const": lambda demand=demand: type(value) is type(demand) and value == demand,
            "enum": lambda demand=demand: any(
                type(value) is type(item) and value == item for item in demand
            ),
            "pattern": lambda demand=demand: (
                not isinstance(value, str) or re.search(demand, value) is not None
            ),
            "minLength": lambda demand=demand: not isinstance(value, str) or len(value) >= demand,
            "minimum": lambda demand=demand: not number or value >= demand,
            "maximum": lambda demand=demand: not number or value <= demand,
            "minItems": lambda demand=demand: not isinstance(value, list) or len(value) >= demand,
            "maxItems": lambda demand=demand: not isinstance(value, list) or len(value) <= demand,
            "items": lambda demand=demand: (
                not isinstance(value, list) or all(allowed(demand, item, root) for item in value)
            ),
            "required": lambda demand=demand: (
                not isinstance(value, dict) or all(name in value for name in demand)
            ),
            "dependentRequired": lambda demand=demand: (
                not isinstance(value, dict)
                or all(
                    name not in value or set(others) <= set(value)
                    for name, others in demand.items()
                )
            ),
            "properties": lambda demand=demand: (
                not isinstance(value, dict)
                or all(
                    allowed(demand[name], item, root)
                    for name, item in value.items()
                    if name in demand
                )
            ),
            "anyOf": lambda demand=demand: any(allowed(each, value, root) for each in demand),
            "additionalProperties": lambda demand=demand: (
                not isinstance(value, dict) or _others(schema, demand, value, root)
            ),
        }
        if key not in _WORDS and not ok[key]():
            return False
    return True


def _definition(root, reference):
    return root["$defs"][reference.removeprefix("#/$defs/")]


def _others(schema, demand, value, root):
    others = [item for name, item in value.items() if name not in schema.get("properties", {})]
    return all(demand is not False and allowed(demand, item, root) for item in others)
