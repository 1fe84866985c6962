"""Observation types: they turn the robot's belief into the observation of an agent."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from operator import itemgetter
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, runtime_checkable

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_env.language import Command
from semnav_env.mind.belief import Belief, BeliefTracker
from semnav_env.mind.observations.checking import check_observation
from semnav_env.mind.observations.layout import (
    ENTRIES,
    MEMORY_ENTRIES,
    MEMORY_SIZE,
    MEMORY_STARTS,
    MODES,
    ROW_SIZE,
    STARTS,
    command_space,
    scan_space,
)
from semnav_env.mind.observations.row import write_row
from semnav_env.robots import RobotSpec
from semnav_features.lidar_spec import LidarSpec

if TYPE_CHECKING:
    from semnav_env.robots import DepthRig
    from semnav_features.clouds import PointCloud

Array = NDArray[Any]


class Moment(NamedTuple):
    """The data from which an observation may be made, at one step.

    Attributes:
        tracker: ranges and features of the last scan, lidar frame, among others.
        tokens: of the command, shape (8, 5).
        instruction: the words in which the command was given.
        see: function that gives the present cloud of depth cameras; None if there are none.
        payload: the payload of the robot, see `SemNavEnv(payload=...)`; None without one.
    """

    tracker: BeliefTracker
    tokens: NDArray[np.int64]
    instruction: str = ""
    see: Callable[[DepthRig], PointCloud] | None = None
    payload: Any = None

    @property
    def belief(self) -> Belief:
        """Pose, goal, clause and scene, odometry frame."""
        return self.tracker.belief

    @property
    def command(self) -> Command:
        """The command that the robot was told."""
        return self.tracker.command


@runtime_checkable
class ObservationType(Protocol):
    """Makes the observations of an environment."""

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        """The space of the observations; called once, before the first `observe`."""
        ...

    def observe(self, moment: Moment) -> Any:
        """Make a new observation."""


class ExtraEntry(Protocol):
    """An entry of your own beside those of a mode.

    Attributes:
        name: its key in the observation.
    """

    name: str

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        """The space of the entry."""
        ...

    def observe(self, moment: Moment) -> Any:
        """Make a new value."""


class EntryObservation:
    """A dictionary of the entries of a mode, and of extra entries.

    Args:
        mode: "semantic", "raw", "truth", "all" or "command", see `layout.MODES`.
        extra: entries of your own.

    Attributes:
        exact: whether lidar and odometry have no errors and the scene is that of the floor plan.
        observes_features: whether features of the scan are among the entries.
        remembers: whether `layout.MEMORY_ENTRIES` follow the scan in the row.
        row_size: number of values that the kernels write; set by `space`.
        places: slices of the entries in that row, by name; set by `space`.

    Raises:
        ValueError: no such mode, or a name that is taken.
    """

    mode: str
    extra: tuple[ExtraEntry, ...]
    exact: bool
    remembers: bool
    observes_features: bool
    row_size: int
    places: dict[str, slice]

    def __init__(self, mode: str = "semantic", extra: Sequence[ExtraEntry] = ()) -> None:
        if mode not in tuple(MODES):
            raise ValueError(f"no observation {mode!r:.80}; there are: {', '.join(MODES)}")
        taken = {entry.name for entry in extra} & set(MODES[mode])
        if taken:
            raise ValueError(
                f"observation {mode!r} has {sorted(taken)} already; choose other names"
            )
        self.mode, self.extra, self.exact = mode, tuple(extra), mode == "truth"
        self.remembers = MEMORY_ENTRIES[0].name in MODES[mode]
        self.observes_features = "corners" in MODES[mode]
        self._write = write_row
        if self.remembers:
            from semnav_env.mind.observations.memory_row import write_command_row

            self._write = write_command_row
        self._names = tuple(name for name in MODES[mode] if name != "command")

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.spaces.Dict:
        """The Gymnasium space of what `observe` returns."""
        behind_scan = ROW_SIZE + lidar.beams
        parts = [(ENTRIES, STARTS, 0), (MEMORY_ENTRIES, MEMORY_STARTS, behind_scan)]
        places = {
            entry.name: slice(first + starts[entry.name], first + starts[entry.name] + entry.size)
            for entries, starts, first in parts
            for entry in entries
        }
        places["scan"] = slice(ROW_SIZE, behind_scan)
        self.row_size = behind_scan if "scan" in self._names else ROW_SIZE
        self.row_size += MEMORY_SIZE if self.remembers else 0
        self.places = {name: places[name] for name in self._names}
        self._split = itemgetter(*self.places.values())
        spaces: dict[str, gym.Space[Any]] = {
            entry.name: entry.space for entries, _, _ in parts for entry in entries
        }
        spaces |= {"scan": scan_space(lidar), "command": command_space()}
        chosen = {name: spaces[name] for name in MODES[self.mode]}
        self._extra = [(entry, entry.space(robot, lidar)) for entry in self.extra]
        return gym.spaces.Dict(chosen | {entry.name: space for entry, space in self._extra})

    def observe(self, moment: Moment) -> dict[str, Array]:
        """The entries as new arrays.

        Raises:
            ValueError: an extra entry is not in its space.
        """
        row = np.empty(self.row_size, np.float32)
        self._write(row, moment.tracker.senses)
        entries: dict[str, Array] = dict(zip(self._names, self._split(row)))  # noqa: B905, slower
        entries["command"] = moment.tokens.ravel().astype(np.int16)
        return entries | self.observe_extra(moment)

    def observe_extra(self, moment: Moment) -> dict[str, Any]:
        """The extra entries alone.

        Raises:
            ValueError: one of them is not in its space.
        """
        entries = {}
        for entry, space in self._extra:
            value = entries[entry.name] = entry.observe(moment)
            check_observation(value, space, f"observation entry {entry.name!r}")
        return entries


def as_observation(value: object) -> ObservationType:
    """Make an observation type from an argument `observation=`: a mode, or an object.

    Raises:
        ValueError: no such mode, or an object that makes no observations.
    """
    if isinstance(value, EntryObservation):
        return copy(value)  # its layout is that of one environment's lidar
    if isinstance(value, ObservationType) and not isinstance(value, type):
        return value
    if isinstance(value, str):
        return EntryObservation(value)
    raise ValueError(
        f"no observation {value!r:.80}; there are: {', '.join(MODES)}, or an object with "
        "space(robot, lidar) and observe(moment)"
    )
