"""Cloning, then DAgger (Ross, Gordon and Bagnell 2011): the learner drives, the expert says how."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from studies.learning.cloning import act, cloned, teach
from studies.learning.demonstrations import Lesson, demonstrations, first_of, lessons
from studies.learning.progress import Learned, points

ROBOTS, PASSES, RATE = 32, 5, 5e-4
"""Robots at once; passes over all lessons in each round, and the largest step size."""


def train(seed: int, steps: int, folder: Path) -> Iterator[Learned]:
    """Clone half of the demonstrations, then learn in rounds; gives the policy after each."""
    half = steps // 2
    policy = cloned(seed, half, folder, steps)
    shown = first_of(demonstrations(steps, folder), half)
    known: list[Lesson] = [each for each in shown if each.success]
    done = half
    for number, end in enumerate(points(half, steps)):
        for lesson in lessons(1 + 100 * seed + number, ROBOTS, lambda seen: act(policy, seen)):
            known.append(lesson)
            done += lesson.steps
            if done >= end:
                break
        teach(policy, known, seed, PASSES, RATE)
        yield Learned(done, lambda seen, _: act(policy, seen))
