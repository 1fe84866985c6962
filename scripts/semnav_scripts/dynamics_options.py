"""The settings of what moves, as options of a command."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, TypeAlias

from tyro.conf import Suppress, arg

from semnav_env.world.dynamics import Dynamics


@dataclass(frozen=True)
class OfferedDynamics(Dynamics):
    """People, doors and furniture that move.

    Attributes:
        by_hand: no option, for it only makes room for what a program adds to an episode that runs.
    """

    by_hand: Suppress[int] = 0


NOTHING_MOVES = OfferedDynamics()
"""The settings if no option is given."""

DynamicsOptions: TypeAlias = Annotated[OfferedDynamics, arg(name="")]
"""The fields of `OfferedDynamics` as options of the command itself."""
