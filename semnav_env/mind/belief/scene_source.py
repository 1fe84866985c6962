"""Sources of the scene of a belief: a known scene, or the robot's memory."""

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
    """The robot's memory at one moment, copied only if the belief is used beyond the next scan.

    Most beliefs are dropped before the next scan; copying for these would cost a tenth of a scan.

    Args:
        memory: walls and doors.
        bumps: the bump map.
    """

    __slots__ = ("__weakref__", "_bumps", "_memory")

    def __init__(self, memory: SceneMemory, bumps: BumpMap) -> None:
        self._memory, self._bumps = memory, bumps

    def keep(self) -> None:
        """Copy the memory before the next scan changes it."""
        self._memory, self._bumps = self._memory.copy(), self._bumps.copy()

    def scene(self) -> Scene:
        """All walls and doors that count, and the walls of the bump map."""
        return self._bumps.join(self._memory.scene())


def nothing() -> None:
    """Stands for a weak reference to a dropped object."""
