"""Checks the arguments of each robot of a vector environment; errors name the robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from copy import deepcopy
from inspect import signature
from typing import Any

from semnav_env.env import SemNavEnv
from semnav_env.language.vocabulary.typos import did_you_mean
from semnav_env.vector.member import TeamMember

REMEMBERING = ("payload", "rewards")
"""Arguments whose objects may remember an episode; each robot gets a copy of an object for all
robots."""


def made(each: Sequence[Mapping[str, Any]], options: Mapping[str, Any]) -> list[TeamMember]:
    """Make the single environments.

    Args:
        each: arguments of `SemNavEnv` that differ, one mapping for each robot.
        options: arguments for all robots.

    Raises:
        ValueError: as `SemNavEnv`; or the environments cannot be stepped together.
    """
    envs = []
    for k, own in enumerate(each):
        _check_names(k, own)
        with naming_robot(k if own else None):
            copies = {name: deepcopy(options[name]) for name in REMEMBERING if name in options}
            envs.append(TeamMember(**{**options, **copies, **own}))
    _check_alike(envs)
    return envs


@contextmanager
def naming_robot(index: int | None) -> Iterator[None]:
    """Add the robot's number to errors raised inside; None adds nothing.

    Raises:
        ValueError: one was raised inside, and is its cause.
    """
    try:
        yield
    except ValueError as error:
        if index is None:
            raise
        raise ValueError(f"robot {index}: {error}") from error


def joined(index: int, common: Mapping[str, Any], own: object) -> dict[str, Any] | None:
    """Join the options of `reset` for all robots with those of one robot; None if there are none.

    Raises:
        ValueError: the robot's own options are not a mapping.
    """
    if not isinstance(own, Mapping | None):
        raise ValueError(f"each[{index}] is {own!r:.80}; it must be a dict of options, or None")
    return {**common, **(own or {})} or None


def one_each(name: str, values: Sequence[Any], count: int) -> Sequence[Any]:
    """The values, if there is one for each robot.

    Raises:
        ValueError: there are more or fewer.
    """
    if isinstance(values, Mapping | str) or len(values) != count:
        raise ValueError(
            f"{name} has {len(values)} entries for {count} robots; give a list with one for each"
        )
    return values


def one_seed_each(seed: int | Sequence[int | None] | None, count: int) -> Sequence[int | None]:
    """The seeds of all robots; from one seed, the others count up."""
    if seed is None:
        return [None] * count
    return [seed + k for k in range(count)] if isinstance(seed, int) else seed


def _check_names(index: int, own: object) -> None:
    known = list(signature(SemNavEnv).parameters)
    if not isinstance(own, Mapping):
        raise ValueError(f"each[{index}] is {own!r:.80}; it must be a dict of: {', '.join(known)}")
    for name in own:
        if name not in known:
            hint = did_you_mean(str(name), known)
            raise ValueError(
                f"each[{index}] has an unknown argument {name!r}{hint}; there are: "
                f"{', '.join(known)}"
            )


def _check_alike(envs: Sequence[SemNavEnv]) -> None:
    """Refuse environments that cannot be stepped together."""
    first = envs[0]
    for k, env in enumerate(envs):
        for name, own, usual in (
            ("action space", env.action_space, first.action_space),
            ("observation space", env.observation_space, first.observation_space),
            ("control rate", env.setup.control_hz, first.setup.control_hz),
        ):
            if own != usual:
                raise ValueError(f"robot {k} has the {name} {own}; robot 0 has {usual}")
