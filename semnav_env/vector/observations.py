"""The observations of many robots: written in one call, or one by one for user-defined types."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from gymnasium.vector.utils import concatenate, create_empty_array

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import EntryObservation
from semnav_env.vector.arguments import naming_robot
from semnav_env.vector.team import Team


class TeamObservations(Protocol):
    """Makes the observations of a team."""

    def renew(self, index: int, env: SemNavEnv) -> None:
        """Update the data of a robot that has been reset."""

    def prepare(self, team: Team) -> None:
        """Return the rows that are written while robots are driven for a control period."""

    def observe(self, team: Team) -> Any:
        """Make new observations of all robots."""
        ...


class EntryRows:
    """The entries of a mode: all robots' rows are written by compiled calls."""

    def __init__(self, envs: Sequence[SemNavEnv], kind: EntryObservation) -> None:
        self._kind = kind
        self._tokens = np.stack([env.tokens.ravel() for env in envs]).astype(np.int16)

    def renew(self, index: int, env: SemNavEnv) -> None:
        """Update the command of a robot that has been reset."""
        self._tokens[index] = env.tokens.ravel()

    def prepare(self, team: Team) -> None:
        """The rows; with what is remembered they are written afterwards, in a call of their own."""
        if not self._kind.remembers:
            team.prepare_rows(self._kind.row_size)

    def observe(self, team: Team) -> dict[str, Any]:
        """Entries of shape (n, size)."""
        rows = (team.command_rows if self._kind.remembers else team.rows)(self._kind.row_size)
        entries: dict[str, Any] = {
            name: rows[:, place] for name, place in self._kind.places.items()
        }
        return entries | {"command": self._tokens.copy()}


class EachObservation:
    """Observations of any type, made robot by robot."""

    def __init__(self, envs: Sequence[SemNavEnv]) -> None:
        self._envs, self._space = envs, envs[0].observation_space

    def renew(self, index: int, env: SemNavEnv) -> None:
        """Nothing is kept."""

    def prepare(self, team: Team) -> None:
        """Nothing is written while robots are driven."""

    def observe(self, team: Team) -> Any:
        """As Gymnasium stacks them."""
        values = []
        for k, env in enumerate(self._envs):
            with naming_robot(k):
                values.append(env.observe())
        fresh: Any = create_empty_array(self._space, len(values), fn=np.zeros)
        return concatenate(self._space, values, fresh)


def team_observations(envs: Sequence[SemNavEnv]) -> TeamObservations:
    """Choose the fast implementation where possible, for environments that have been reset."""
    kinds = [env.observation_type for env in envs]
    first = kinds[0]
    if type(first) is EntryObservation and all(
        type(kind) is EntryObservation and kind.mode == first.mode and not kind.extra
        for kind in kinds
    ):
        return EntryRows(envs, first)
    return EachObservation(envs)
