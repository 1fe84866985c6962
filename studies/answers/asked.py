"""A command and its right answers in all variants of its floor."""

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
    moved_walls,
    same_answer,
    same_goal,
)
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.mind.grounding.goal import Goal
from semnav_env.mind.grounding.ways import KnownWays
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import Pose, compose
from semnav_features.scene import StillScene
from studies.answers.first_commands import FirstCommand
from studies.answers.jumps import Jump, View, jumps

Answer: TypeAlias = tuple[Goal, ...]
"""The goals of a command."""

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
        """The names of the `SETS` of which no variant changes the answer."""
        causes = {variant.cause for variant, _ in (*self._changed, *self._changed_by_walls)}
        return (name for name, those in SETS.items() if not those & causes)

    @cached_property
    def jumps(self) -> frozenset[Jump]:
        """What jumps in the variants that change the answer; nothing if none does."""
        return frozenset(jump for each in self._changed for jump in self._jumps(*each))

    @cached_property
    def _stable(self) -> StableAnswers:
        return self.said.plan.derived(StableAnswers)

    @cached_property
    def _guide(self) -> RoomGuide:
        plan = self.said.plan
        return RoomGuide(plan, self.said.command, plan.derived(Geodesic))

    @cached_property
    def _answer(self) -> Answer:
        return self._stable.answer(self.said.command, self.said.start, self._guide)

    @cached_property
    def _changed(self) -> tuple[tuple[Variant, Answer], ...]:
        return tuple(self._changed_in(self._stable.variants))

    @cached_property
    def _changed_by_walls(self) -> tuple[tuple[Variant, Answer], ...]:
        return tuple(self._changed_in(self.said.plan.derived(same_doors)))

    def _changed_in(self, variants: tuple[Variant, ...]) -> Iterator[tuple[Variant, Answer]]:
        """The variants that change the answer, with what it is there."""
        right = self._answer  # found first, as it tells the ways
        for variant in variants:
            start, ways = self._start(variant), KnownWays(self._guide.ways)
            answer = self._stable.answer(self.said.command, start, ways, variant.scene)
            if not same_answer(right, answer):
                yield variant, answer

    def _start(self, variant: Variant) -> Pose:
        return compose(self.said.start, variant.shift)

    def _jumps(self, variant: Variant, answer: Answer) -> frozenset[Jump]:
        """What of the corridor differs where the first clause with another answer begins."""
        pairs = list(zip(self._answer, answer, strict=False))
        clause = next((k for k, pair in enumerate(pairs) if not same_goal(*pair)), len(pairs))
        here = self._answer[clause - 1].next_begin if clause else self.said.start
        there = answer[clause - 1].next_begin if clause else self._start(variant)
        return jumps(View(self.said.plan.scene, here), View(variant.scene, there))
