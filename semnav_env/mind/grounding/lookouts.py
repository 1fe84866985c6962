"""Finds lookout points in a room, from which to look for its door."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_env.language.told import Told
from semnav_env.mind.grounding.room_exits import distances_to, room_exits, without_gaps
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.situation import Situation, turned
from semnav_features.frames import FloatArray, Pose
from semnav_features.scene import Door, Scene, ends_of

REFERENT = Told("the door of the room")
"""The referent of the search, in words."""

HEADINGS: FloatArray = math.pi / 12 * np.arange(24.0)
"""Directions in which a lookout may lie, from the heading of the last one, radians."""

HALF_WIDTH = 0.4
"""Half of the width that must be free on the path to a lookout, metres: half of a body's width."""

WALL_DISTANCE = 0.9
"""Distance from a lookout to the wall behind it, metres: room to turn."""

MAX_STEP, MIN_STEP = 4.0, 1.0
"""Largest and least distance of a lookout from those before it, metres: within a room, and far
enough to see past another piece of furniture."""

MAX_LOOKOUTS = 5
"""Largest number of lookouts in a room, including the first one."""


def exits_in_view(situation: Situation) -> list[Door] | Searching:
    """The exits of the room that are in view, or the search for them.

    The robot turns around first; then it looks from other places in the room. None if no further
    lookout helps.
    """
    scene, begin, rules = situation.scene, situation.begin, situation.rules.grounding
    for place in (begin, *situation.lookouts):
        scene, around = without_gaps(scene, place, rules)
        exits = room_exits(around, scene, place, rules)
        if exits:
            return exits
    if not situation.lookouts:
        return situation.turn_to(turned(begin)[2], REFERENT)
    lookout = next_lookout(scene, situation.lookouts)
    return [] if lookout is None else Searching(REFERENT, lookout)


def next_lookout(scene: Scene, lookouts: Sequence[Pose]) -> Pose | None:
    """The place on a free straight line from the last lookout that is farthest from all lookouts.

    Args:
        scene: the remembered scene; the robot does not drive through a known door.
        lookouts: poses from which the robot has looked, in the order of time.

    Returns:
        The place, and the heading to it; None if no place would show more.
    """
    if len(lookouts) >= MAX_LOOKOUTS:
        return None
    last = lookouts[-1]
    solid = np.vstack((ends_of(scene.walls), ends_of(scene.doors)))
    headings = last[2] + HEADINGS
    c, s = np.cos(headings), np.sin(headings)
    steps = np.full(len(headings), MAX_STEP)
    for aside in (-HALF_WIDTH, 0.0, HALF_WIDTH):
        begins = np.column_stack((last[0] - aside * s, last[1] + aside * c))
        steps = np.minimum(steps, distances_to(solid, begins, headings) - WALL_DISTANCE)
    x, y = last[0] + steps * c, last[1] + steps * s
    apart = np.min([np.hypot(x - px, y - py) for px, py, _ in lookouts], axis=0)
    apart[steps < MIN_STEP] = 0.0
    best = int(np.argmax(apart))
    if apart[best] < MIN_STEP:
        return None
    return float(x[best]), float(y[best]), float(headings[best])
