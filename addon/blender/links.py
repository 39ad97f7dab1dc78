# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What reaches a socket, and its numbers in a form that compares."""

from __future__ import annotations

import math
from typing import Any


def comparable(value: float) -> float:
    """Give NaN as `math.nan` itself: no other is equal to itself in a tuple."""
    return math.nan if math.isnan(value) else value


def link_to(socket: Any) -> Any:
    """Give the link that ends in a socket. `socket.links` would look twice at each of the tree."""
    for link in socket.id_data.links:
        if link.to_socket == socket:
            return link
    msg = f"{socket.name!r} is not linked"
    raise ValueError(msg)
