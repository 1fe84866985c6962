"""Keeps the spaces of floor plans that no world uses any more, for the next world there.

A space of an office has hundreds of walls, which Pymunk makes one by one: that takes most of the
time of a reset onto another floor plan.
"""

from __future__ import annotations

from queue import SimpleQueue
from threading import Lock
from weakref import finalize, ref

import pymunk

from semnav_env.world.maps.floor_plan import FloorPlan

MOST_SPARE = 128
"""The most spaces that are kept, each of some 0.5 MB: about one for each floor plan of a split."""


class SpareSpaces:
    """Spaces of floor plans that somebody still has; those given back last are kept."""

    def __init__(self) -> None:
        self._kept: list[tuple[ref[FloorPlan], pymunk.Space]] = []
        self._given: SimpleQueue[tuple[ref[FloorPlan], pymunk.Space]] = SimpleQueue()
        self._lock = Lock()

    def take(self, floor_plan: FloorPlan) -> pymunk.Space | None:
        """A space with the walls of that very floor plan, and what was left in it, or None."""
        with self._lock:
            while not self._given.empty():
                self._kept.append(self._given.get())
            self._kept = [entry for entry in self._kept if entry[0]() is not None][-MOST_SPARE:]
            for number, (plan, space) in enumerate(self._kept):
                if plan() is floor_plan:
                    del self._kept[number]
                    return space
        return None

    def give(self, floor_plan: FloorPlan, space: pymunk.Space) -> None:
        """Keep a space that nothing uses any more.

        It only goes into a queue, because the garbage collector may call this at any moment.
        """
        self._given.put((ref(floor_plan), space))

    def give_when_gone(self, user: object, floor_plan: FloorPlan, space: pymunk.Space) -> None:
        """Keep a space as soon as an object that uses it is gone."""
        finalize(user, self.give, floor_plan, space).atexit = False


SPARE_SPACES = SpareSpaces()
"""Those of this process."""
