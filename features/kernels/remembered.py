"""Room for a new entry among remembered walls or doors."""

from __future__ import annotations

from typing import Any, TypeAlias

from semnav_env.features.kernels.compiling import kernel

Ends: TypeAlias = tuple[float, float, float, float]
"""Start and end of a wall or door: x1, y1, x2, y2 in metres."""


@kernel
def place_for_new(memory: Any, used: int) -> tuple[int, int]:
    """Place of a new entry, and how many are used then; a full memory replaces the rarest one."""
    if used < len(memory):
        return used, used + 1
    place = 0
    for k in range(used):
        if memory[k].hits < memory[place].hits:
            place = k
    return place, used
