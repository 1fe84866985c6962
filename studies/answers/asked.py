"""A command, its right answers, and what it means in all variants of its floor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from semnav_env.judge.episodes.stable_answers import (
    TIMES,
    StableAnswers,
    Variant,
    answer_in,
    moved_walls,
)
from semnav_env.judge.readings import Answer, same_answer, same_goal
from semnav_env.mind.grounding.goal import Goal
from semnav_env.mind.grounding.ways import KnownWays
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Pose, compose
from semnav_features.scene import StillScene
from studies.answers.first_commands import FirstCommand
from studies.answers.jumps import Jump, View, jumps

Goals: TypeAlias = tuple[Goal, ...]
"""The goals of a command; empty if it cannot be carried out."""

SAME_DOORS = "walls, same doors"
"""The cause of variants with moved walls in which the plan's doors are doors, however wide."""

SETS = {
    "all": {"walls", "start", "limits"},
    "walls": {"walls"},
    "start": {"start"},
    "limits": {"limits"},
    SAME_DOORS: {SAME_DOORS},
    "start, and walls with the same doors": {"start", SAME_DOORS},
}
"""Sets of causes by what they are called."""

RULES = {
    "one answer, and possible in every variant": (False, True),
    "several answers, and possible in every variant": (True, True),
    "one answer": (False, False),
    "several answers": (True, False),
}
"""Rules by which a command may be kept: whether all right answers are accepted, and whether it must
be possible in every variant. The last one is that of `StableAnswers`."""


def same_doors(plan: FloorPlan) -> tuple[Variant, ...]:
    """The plan with the moved walls of `StableAnswers`, and the same doors as before."""
    rng, names = np.random.default_rng(0), {door.name for door in plan.scene.doors}
    moved = [moved_walls(plan, rng) for _ in range(TIMES)]
    doors = [[door.as_door() for door in each.doors if door.name in names] for each in moved]
    return tuple(
        Variant(SAME_DOORS, StillScene(each.scene.walls, tuple(its)))
        for each, its in zip(moved, doors, strict=True)
    )


@dataclass(frozen=True)
class Asked:
    """A command and its answers.

    Attributes:
        said: the command.
    """

    said: FirstCommand

    @property
    def kept_by(self) -> Iterator[str]:
        """The names of the `SETS` in which no variant has an answer that is not accepted."""
        causes = {variant.cause for variant, _ in (*self._changed, *self._changed_by_walls)}
        return (name for name, those in SETS.items() if not those & causes)

    @property
    def kept_if(self) -> Iterator[str]:
        """The names of the `RULES` by which the command is kept."""
        for name, (several, possible) in RULES.items():
            accepted = self._accepted if several else self._accepted[:1]
            found = self._others(self._stable.variants, accepted)
            if not any(possible or goals for _, goals in found):
                yield name

    @cached_property
    def jumps(self) -> frozenset[Jump]:
        """What jumps in the variants with an answer that is not accepted; nothing without one."""
        return frozenset(jump for each in self._changed for jump in self._jumps(*each))

    @cached_property
    def _stable(self) -> StableAnswers:
        return self.said.plan.derived(StableAnswers)

    @cached_property
    def _accepted(self) -> tuple[Answer, ...]:
        return self._stable.accepted(self.said.command, self.said.start)

    @cached_property
    def _changed(self) -> tuple[tuple[Variant, Goals], ...]:
        return self._unaccepted(self._stable.variants)

    @cached_property
    def _changed_by_walls(self) -> tuple[tuple[Variant, Goals], ...]:
        return self._unaccepted(self.said.plan.derived(same_doors))

    def _unaccepted(self, variants: tuple[Variant, ...]) -> tuple[tuple[Variant, Goals], ...]:
        """The variants with an answer that is not accepted, and that answer."""
        return tuple(each for each in self._others(variants, self._accepted) if each[1])

    def _others(
        self, variants: tuple[Variant, ...], accepted: tuple[Answer, ...]
    ) -> Iterator[tuple[Variant, Goals]]:
        """The variants with another answer than some, or with none, and that answer."""
        ways = KnownWays(self._accepted[0].ways)
        for variant in variants:
            goals = answer_in(variant, self.said.plan, self.said.command, self.said.start, ways)
            if not goals or not any(same_answer(each.goals, goals) for each in accepted):
                yield variant, goals or ()

    def _start(self, variant: Variant) -> Pose:
        return compose(self.said.start, variant.shift)

    def _jumps(self, variant: Variant, goals: Goals) -> frozenset[Jump]:
        """What of the corridor differs where the first clause with another answer begins."""
        usual = self._accepted[0].goals
        pairs = list(zip(usual, goals, strict=False))
        clause = next((k for k, pair in enumerate(pairs) if not same_goal(*pair)), len(pairs))
        here = usual[clause - 1].next_begin if clause else self.said.start
        there = goals[clause - 1].next_begin if clause else self._start(variant)
        return jumps(View(self.said.plan.scene, here), View(variant.scene, there))
