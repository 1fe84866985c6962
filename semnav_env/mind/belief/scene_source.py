"""What the scene of a belief is made of: a known scene, or what a robot remembers."""

from __future__ import annotations

from typing import NamedTuple

from semnav_env.mind.belief.bump_map import BumpMap
from semnav_features.memory import SceneMemory
from semnav_features.scene import Scene


class KnownScene(NamedTuple):
    """A scene that is known beforehand."""

    known: Scene

    def scene(self) -> Scene:
        """All walls and doors."""
        return self.known


class RememberedScene:
    """What a robot remembers at one moment: its memory itself, and a copy once it goes on.

    Most beliefs are let go before the next scan; copying for these would cost a tenth of a scan.

    Args:
        memory: walls and doors.
        bumps: walls that were bumped into.
    """

    __slots__ = ("__weakref__", "_bumps", "_memory")

    def __init__(self, memory: SceneMemory, bumps: BumpMap) -> None:
        self._memory, self._bumps = memory, bumps

    def keep(self) -> None:
        """Copy what is remembered, because the robot goes on."""
        self._memory, self._bumps = self._memory.copy(), self._bumps.copy()

    def scene(self) -> Scene:
        """All walls and doors that count, and the walls that were bumped into."""
        return self._bumps.join(self._memory.scene())


def nothing() -> None:
    """Stands for a weak reference to what is gone."""
