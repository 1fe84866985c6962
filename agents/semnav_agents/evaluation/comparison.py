"""Two agents on the same episodes: differences, episode by episode."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import isnan
from typing import TypeAlias

import numpy as np

from semnav_agents.evaluation.attempts import Attempt
from semnav_agents.evaluation.intervals import paired_interval, sign_test
from semnav_agents.evaluation.leaderboard import INTERVAL, RESAMPLES, Estimate
from semnav_features.frames import FloatArray

MEASURES = ("success", "contact_free", "spl")
"""What is compared, by its name in an `Attempt`."""

_Place: TypeAlias = tuple[str, str]
"""Split and body."""


@dataclass(frozen=True)
class MeasureComparison:
    """One measure of two agents on the same episodes.

    Attributes:
        first: mean of the first agent.
        second: mean of the second one.
        difference: first minus second, with its interval of 95 %.
        first_better: number of episodes in which the first agent was better.
        second_better: in which the second one was.
        p_value: of the two-sided sign test of these numbers.
    """

    first: float
    second: float
    difference: Estimate
    first_better: int
    second_better: int
    p_value: float


@dataclass(frozen=True)
class Comparison:
    """Two agents on one split with one body.

    Attributes:
        split: where they drove.
        robot: name of the body.
        agents: their names.
        episodes: number of episodes.
        versions: of semnav-env.
        rules: fingerprints of the rules.
        measures: by name; without SPL where an episode has none.
        only_first: ids of the episodes in which only the first agent succeeded.
        only_second: in which only the second one did.
    """

    split: str
    robot: str
    agents: tuple[str, str]
    episodes: int
    versions: tuple[str, str]
    rules: tuple[str, str]
    measures: dict[str, MeasureComparison]
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]


def compare(
    first: Iterable[Attempt], second: Iterable[Attempt], mixed: bool = False
) -> list[Comparison]:
    """Compare two evaluations episode by episode, for each split and body.

    Args:
        first: results of one training of an agent.
        second: of another agent, training or state of the code.
        mixed: whether versions and rules may differ.

    Raises:
        ValueError: the episodes are not the same, one was driven twice, or versions or rules
            differ.
    """
    ours, theirs = _by_place(first), _by_place(second)
    _check_same(ours, theirs, "split and body")
    return [_compared(place, ours[place], theirs[place], mixed) for place in sorted(ours)]


def _by_place(attempts: Iterable[Attempt]) -> dict[_Place, dict[str, Attempt]]:
    """The attempts by split and body, and by episode."""
    found: dict[_Place, dict[str, Attempt]] = {}
    for each in attempts:
        episodes = found.setdefault((each.split, each.robot), {})
        if each.episode in episodes:
            raise ValueError(
                f"{each.agent} drove {each.episode!r:.80} twice; compare one training at a time"
            )
        episodes[each.episode] = each
    return found


def _compared(
    place: _Place, ours: Mapping[str, Attempt], theirs: Mapping[str, Attempt], mixed: bool
) -> Comparison:
    _check_same(ours, theirs, f"episode of {place[0]} with {place[1]}")
    pairs = [(ours[name], theirs[name]) for name in sorted(ours)]
    agents, versions, rules = (_of_both(pairs, name) for name in ("agent", "version", "rules"))
    for what, told in (("versions", versions), ("rules", rules)):
        if told[0] != told[1] and not mixed:
            raise ValueError(
                f"different {what} are not compared unless --mixed is given: "
                f"{agents[0]} drove with {told[0]}, {agents[1]} with {told[1]}"
            )
    measures = {name: _measured(pairs, name) for name in MEASURES if _is_known(pairs, name)}
    return Comparison(
        split=place[0],
        robot=place[1],
        agents=agents,
        episodes=len(pairs),
        versions=versions,
        rules=rules,
        measures=measures,
        only_first=tuple(a.episode for a, b in pairs if a.success > b.success),
        only_second=tuple(a.episode for a, b in pairs if a.success < b.success),
    )


def _check_same(ours: Iterable[object], theirs: Iterable[object], what: str) -> None:
    """Refuse names that only one of two sides has."""
    mine, other = set(ours), set(theirs)
    if mine == other:
        return
    lone = min(mine ^ other, key=str)
    side = "first" if lone in mine else "second"
    raise ValueError(
        f"only the same episodes are compared: {len(mine & other)} of {len(mine)} and "
        f"{len(other)} are in both; only the {side} has the {what} {_named(lone)}"
    )


def _named(thing: object) -> str:
    return ", ".join(thing) if isinstance(thing, tuple) else f"{thing!r:.80}"


def _of_both(pairs: list[tuple[Attempt, Attempt]], name: str) -> tuple[str, str]:
    """A property of each side; several values are joined by commas."""
    ours, theirs = (
        ", ".join(sorted({getattr(pair[side], name) for pair in pairs})) for side in (0, 1)
    )
    return ours, theirs


def _is_known(pairs: list[tuple[Attempt, Attempt]], name: str) -> bool:
    return not any(isnan(getattr(each, name)) for pair in pairs for each in pair)


def _measured(pairs: list[tuple[Attempt, Attempt]], name: str) -> MeasureComparison:
    """Compare one measure: shares by Newcombe's interval, others by a paired bootstrap."""
    ours, theirs = (np.array([getattr(p[side], name) for p in pairs], float) for side in (0, 1))
    better, worse = int((ours > theirs).sum()), int((ours < theirs).sum())
    if name == "spl":
        low, high = _bootstrap(ours - theirs)
    else:
        both = int((ours * theirs).sum())
        low, high = paired_interval(both, better, worse, len(pairs) - both - better - worse)
    difference = Estimate(float((ours - theirs).mean()), low, high)
    means = float(ours.mean()), float(theirs.mean())
    return MeasureComparison(*means, difference, better, worse, sign_test(better, worse))


def _bootstrap(differences: FloatArray) -> tuple[float, float]:
    """Interval of the mean difference: percentiles of resampled episodes."""
    drawn = np.random.default_rng(0).integers(len(differences), size=(RESAMPLES, len(differences)))
    low, high = np.percentile(differences[drawn].mean(axis=1), INTERVAL).tolist()
    return low, high
