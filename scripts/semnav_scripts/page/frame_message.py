"""One moment of a run as the page draws it: whole centimetres, so that it is short."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.language.languages import language_of
from semnav_env.language.told import in_words_of
from semnav_env.mind.grounding.goal import door_of
from semnav_env.rendering.frame import Frame
from semnav_features.frames import FloatArray
from semnav_features.scene import Door, Wall


def frame_message(env: SemNavEnv, frame: Frame) -> dict[str, Any]:
    """The frame with what the robot believes and what the judge says.

    Lengths are whole centimetres, angles radians, all in the world frame. Points are flat lists:
    x, y, x, y; walls and doors are x and y of start and end.

    Args:
        env: the environment, at that moment.
        frame: its `snapshot`.
    """
    belief, period, spoken = env.belief, env.judge.period, language_of(frame.language)
    return {
        "type": "frame",
        "seconds": round(env.seconds, 2),
        "pose": [round(value, 4) for value in frame.pose],
        "lidar": _flat(np.array([frame.lidar])),
        "hits": _flat(frame.hits),
        "walls": _ends(frame.scene.walls),
        "remembered": _ends(frame.remembered.walls),
        "doors": [
            _door(door, frame.door_numbers.get(index))
            for index, door in enumerate(frame.remembered.doors)
        ],
        "people": _flat(frame.people),
        "leaves": _flat(frame.leaves),
        "goal": _goal(frame),
        "reasons": [in_words_of(spoken, reason) for reason in belief.reasons],
        "believed": belief.clause,
        "verdicts": [str(verdict) for verdict in env.judge.verdicts],
        "contact": frame.in_contact,
        "collisions": period.collisions,
    }


def _goal(frame: Frame) -> dict[str, Any] | None:
    """Kind, pose and doorway of the goal."""
    goal = frame.goal
    if goal is None:
        return None
    door = door_of(goal)
    return {
        "kind": goal.kind.name.lower(),
        "pose": [round(value, 3) for value in goal.pose],
        "door": None if door is None else _ends([door]),
    }


def _door(door: Door, number: int | None) -> dict[str, Any]:
    confidence = None if door.confidence is None else round(door.confidence, 2)
    return {"ends": _ends([door]), "number": number, "confidence": confidence}


def _ends(things: Sequence[Wall | Door]) -> list[int]:
    return _flat(np.array([(*thing.start, *thing.end) for thing in things]))


def _flat(points: FloatArray | None) -> list[int]:
    """The rows that are finite, as whole centimetres one after the other."""
    if points is None or not len(points):
        return []
    whole = points[np.isfinite(points).all(axis=1)]
    numbers: list[int] = np.rint(100.0 * whole).astype(np.int64).ravel().tolist()
    return numbers
