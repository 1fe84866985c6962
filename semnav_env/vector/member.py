"""A single environment as part of a vector."""

from __future__ import annotations

from typing import Any, NoReturn

from semnav_env.env import SemNavEnv

TOGETHER = "a robot of a vector environment is reset and stepped with the others: call {0}() of it"


class TeamMember(SemNavEnv):
    """An environment that a vector environment alone resets and steps."""

    def begin(self, seed: int | None, options: dict[str, Any] | None) -> dict[str, Any]:
        """Begin an episode for the vector environment, see `SemNavEnv.reset`; returns the info."""
        return super().reset(seed=seed, options=options)[1]

    def reset(self, **_: Any) -> NoReturn:
        """Refuse.

        Raises:
            RuntimeError: always.
        """
        raise RuntimeError(TOGETHER.format("reset"))

    def step(self, action: object) -> NoReturn:
        """Refuse.

        Raises:
            RuntimeError: always.
        """
        raise RuntimeError(TOGETHER.format("step"))
