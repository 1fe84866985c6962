"""Observation types: from what a robot believes to what an agent observes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol, runtime_checkable

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_env.belief import Belief, BeliefTracker
from semnav_env.commands import Command
from semnav_env.features.lidar_spec import LidarSpec
from semnav_env.grounding.goal import door_of
from semnav_env.observations.layout import (
    ENTRIES,
    MODES,
    ROW_SIZE,
    STARTS,
    command_space,
    scan_space,
)
from semnav_env.observations.row import DoorEnds, write_bumps, write_row
from semnav_env.robots import RobotSpec

Array = NDArray[Any]

NO_DOOR: DoorEnds = (0.0, 0.0, 0.0, 0.0)


class Moment(NamedTuple):
    """What an observation may be made of: the robot's side of one step.

    Attributes:
        belief: pose, goal, clause and scene, odometry frame.
        tracker: ranges and features of the last scan, lidar frame, among others.
        command: that the robot was told.
        tokens: of the command, shape (8, 5).
    """

    belief: Belief
    tracker: BeliefTracker
    command: Command
    tokens: NDArray[np.int64]


@runtime_checkable
class ObservationType(Protocol):
    """Makes the observations of an environment."""

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        """The space of the observations; called once, before the first `observe`."""
        ...

    def observe(self, moment: Moment) -> Any:
        """A fresh observation."""


class ExtraEntry(Protocol):
    """An entry of one's own beside those of a mode.

    Attributes:
        name: its key in the observation.
    """

    name: str

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        """The space of the entry."""
        ...

    def observe(self, moment: Moment) -> Any:
        """A fresh value."""


class EntryObservation:
    """A dictionary of the entries of a mode, and of one's own.

    Args:
        mode: "semantic", "raw", "truth" or "all", see `layout.MODES`.
        extra: entries of one's own.

    Attributes:
        exact: whether lidar and odometry are to have no errors and the scene is the floor plan's.

    Raises:
        ValueError: no such mode, or a name that is taken.
    """

    def __init__(self, mode: str = "semantic", extra: Sequence[ExtraEntry] = ()) -> None:
        if mode not in tuple(MODES):
            raise ValueError(f"no observation {mode!r:.80}; there are: {', '.join(MODES)}")
        taken = {entry.name for entry in extra} & set(MODES[mode])
        if taken:
            raise ValueError(f"observation {mode!r} has {sorted(taken)} already; name yours anew")
        self.mode, self.extra, self.exact = mode, tuple(extra), mode == "truth"
        self._names = tuple(name for name in MODES[mode] if name != "command")
        self._places = {e.name: slice(STARTS[e.name], STARTS[e.name] + e.size) for e in ENTRIES}
        self._row = np.zeros(ROW_SIZE, np.float32)
        self._has_bumps = False

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.spaces.Dict:
        """The Gymnasium space of what `observe` returns."""
        self._row = np.zeros(ROW_SIZE + lidar.beams, np.float32)
        self._places["scan"] = slice(ROW_SIZE, ROW_SIZE + lidar.beams)
        self._slices = tuple(self._places[name] for name in self._names)
        spaces: dict[str, gym.Space[Any]] = {entry.name: entry.space for entry in ENTRIES}
        spaces |= {"scan": scan_space(lidar), "command": command_space()}
        chosen = {name: spaces[name] for name in MODES[self.mode]}
        return gym.spaces.Dict(chosen | {e.name: e.space(robot, lidar) for e in self.extra})

    def observe(self, moment: Moment) -> dict[str, Array]:
        """The entries as fresh arrays."""
        self._write(moment)
        values = map(self._row.copy().__getitem__, self._slices)
        observation: dict[str, Array] = dict(zip(self._names, values, strict=True))
        observation["command"] = moment.tokens.ravel().copy()
        for entry in self.extra:
            observation[entry.name] = entry.observe(moment)
        return observation

    def _write(self, moment: Moment) -> None:
        belief, tracker = moment.belief, moment.tracker
        goal = belief.target
        door = door_of(goal)
        write_row(
            self._row,
            tracker.senses,
            belief.pose,
            belief.velocity,
            belief.clause,
            goal.kind.value,  # numba is slow to recognise an enum
            goal.pose,
            NO_DOOR if door is None else (*door.start, *door.end),
            door is not None,
        )
        if tracker.bumps or self._has_bumps:
            write_bumps(self._row, tracker.bumps.ends, belief.pose)
            self._has_bumps = bool(tracker.bumps)


def as_observation(value: object) -> ObservationType:
    """An observation type from what `observation=` takes: a mode, or an object.

    Raises:
        ValueError: no such mode, or an object that makes no observations.
    """
    if isinstance(value, ObservationType) and not isinstance(value, type):
        return value
    if isinstance(value, str):
        return EntryObservation(value)
    raise ValueError(
        f"no observation {value!r:.80}; there are: {', '.join(MODES)}, or an object with "
        "space(robot, lidar) and observe(moment)"
    )
