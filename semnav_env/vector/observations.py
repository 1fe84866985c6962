"""The observations of many robots: written in one call, or one by one for user-defined types."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from gymnasium import Space
from gymnasium.spaces import Box
from gymnasium.vector.utils import concatenate, create_empty_array

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import EntryObservation
from semnav_env.mind.observations.checking import check_observation
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
    """The entries of a mode, written by compiled calls, and extra entries, robot by robot."""

    def __init__(self, envs: Sequence[SemNavEnv], kinds: Sequence[EntryObservation]) -> None:
        self._envs, self._kinds, self._kind = envs, kinds, kinds[0]
        spaces: Any = envs[0].observation_space
        self._extra = {each.name: spaces[each.name] for each in kinds[0].extra}
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
        entries["command"] = self._tokens.copy()
        return entries | self._observe_extra() if self._extra else entries

    def _observe_extra(self) -> dict[str, Any]:
        return {name: self._entry(n, name) for n, name in enumerate(self._extra)}

    def _entry(self, number: int, name: str) -> Any:
        """The values of an extra entry; they are checked together, and one by one for a message."""
        values, space = [], self._extra[name]
        for k, (env, kind) in enumerate(zip(self._envs, self._kinds, strict=True)):
            with naming_robot(k):
                values.append(kind.extra[number].observe(env.moment))
        together = _within(space, values)
        if together is not None:
            return together
        for k, value in enumerate(values):
            with naming_robot(k):
                check_observation(value, space, f"observation entry {name!r}")
        return _stacked(space, values)


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
        return _stacked(self._space, values)


def _within(space: Space[Any], values: Sequence[Any]) -> Any:
    """Arrays of a box, stacked; None if they are of another kind or not all in it."""
    if not isinstance(space, Box) or not all(
        type(value) is np.ndarray and (value.shape, value.dtype) == (space.shape, space.dtype)
        for value in values
    ):
        return None
    together = np.stack(values)
    inside = (together >= space.low) & (together <= space.high)  # NaN is neither
    return together if inside.all() else None


def _stacked(space: Space[Any], values: Sequence[Any]) -> Any:
    """One value for each robot, as Gymnasium stacks them."""
    fresh: Any = create_empty_array(space, len(values), fn=np.zeros)
    return concatenate(space, values, fresh)


def team_observations(envs: Sequence[SemNavEnv]) -> TeamObservations:
    """Choose the fast implementation where possible, for environments that have been reset."""
    kinds = [env.observation_type for env in envs if type(env.observation_type) is EntryObservation]
    if len(kinds) == len(envs) and all(
        (kind.mode, _names(kind)) == (kinds[0].mode, _names(kinds[0])) for kind in kinds
    ):
        return EntryRows(envs, kinds)
    return EachObservation(envs)


def _names(kind: EntryObservation) -> list[str]:
    return [entry.name for entry in kind.extra]
