"""From ranges, odometry and bumps to what the robot believes; runs on a real robot as it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike

from semnav_env.belief.attention import Attention
from semnav_env.belief.belief import Belief, SceneSource
from semnav_env.belief.bump_map import BumpMap
from semnav_env.belief.understand import Senses, join_senses, understand
from semnav_env.commands import Command
from semnav_env.features import ExtractorSettings
from semnav_env.features.frames import Contact, FloatArray, Pose, Twist
from semnav_env.features.kernels.scratch import allocate_features, allocate_scratch
from semnav_env.features.lidar_spec import LidarSpec, lidar_spec
from semnav_env.features.memory import SceneMemory
from semnav_env.features.scene import Scene
from semnav_env.grounding.follower import Follower
from semnav_env.grounding.ways import KnownWays, Way
from semnav_env.rules import Rules, with_doors_of

NO_WAYS: Mapping[int, Way] = MappingProxyType({})
ORIGIN: Pose = (0.0, 0.0, 0.0)


class BeliefTracker:
    """Follows a command on what one robot senses.

        tracker = BeliefTracker(lidar="tim561", mount=(0.45, 0.0, 0.0))
        tracker.begin(parse("go through the second door on the right"))
        belief = tracker.update(ranges, odometry=(x, y, heading))

    Args:
        lidar: name of a lidar or its spec; its rate is that of the updates.
        mount: pose of the lidar in the robot frame.
        extractor: limits of the feature extractor.
        corrects_drift: walls that are seen again correct the odometry (Mes 2021).
        known_scene: all walls and doors, odometry frame, where they are known; then commands are
            grounded on them and not on what is remembered.
        rules: what a door is, and the distances and tolerances of grounding. What a door is may be
            said by `extractor` instead.

    Attributes:
        ranges: of the last scan, metres, shape (beams,).
        features: of the last scan, lidar frame.
        senses: arrays of the belief, as kernels take them.
        memory: walls and doors seen so far, odometry frame.
        bumps: walls that were bumped into unseen, odometry frame.
        follower: how far the command has come, as the robot believes; made by `begin`.
    """

    follower: Follower

    @property
    def command(self) -> Command:
        """The command that is followed."""
        return self.follower.command

    def __init__(
        self,
        lidar: str | LidarSpec = "tim561",
        mount: Pose = ORIGIN,
        extractor: ExtractorSettings = ExtractorSettings(),
        corrects_drift: bool = True,
        known_scene: Scene | None = None,
        rules: Rules = Rules(),
    ) -> None:
        self.lidar, self.mount = lidar_spec(lidar), mount
        self.corrects_drift, self.known_scene = corrects_drift, known_scene
        self.ranges = np.zeros(self.lidar.beams)
        self.features = allocate_features()
        self.memory = SceneMemory()
        self.bumps = BumpMap(self.lidar, mount)
        self._updates = -1
        self._beams = self.lidar.directions
        self.rules, extractor = with_doors_of(rules, extractor)
        self._record = extractor.as_record()
        self._scratch = allocate_scratch(self.lidar.beams)
        self._attention = Attention()
        self._last_source: Callable[[], _Remembered | None] = _nothing
        self.senses = self._join()

    def _join(self) -> Senses:
        return join_senses(
            self.lidar.sensor,
            self._beams,
            self._record,
            self._scratch,
            self.mount,
            self.ranges,
            self.features,
            self.memory.arrays,
        )

    def __getstate__(self) -> dict[str, Any]:
        self._keep_last_scene()
        left_out = ("senses", "_last_source")
        return {name: value for name, value in self.__dict__.items() if name not in left_out}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._last_source = _nothing
        self.senses = self._join()

    def begin(self, command: Command, ways: Mapping[int, Way] = NO_WAYS) -> None:
        """Forget everything and begin to follow a command.

        Args:
            command: to follow.
            ways: to the named rooms of the command, by the number of the clause, odometry frame:
                the words in which somebody who knows the building points them out.
        """
        self._keep_last_scene()
        self.memory.clear()
        self.bumps.clear()
        self.follower = Follower(
            command,
            complete=self.known_scene is not None,
            care=self.rules.grounding.care,
            jamb_margin=self.rules.grounding.jamb_margin,
            guide=KnownWays(dict(ways)),
            rules=self.rules,
        )
        self._attention = Attention()
        self._updates = 0
        self._pose, self._odometry = ORIGIN, ORIGIN

    def update(
        self,
        ranges: ArrayLike,
        odometry: Pose,
        velocity: Twist | None = None,
        bumps: Sequence[Contact] = (),
        seconds: float | None = None,
    ) -> Belief:
        """Take in one scan and what came with it.

        Args:
            ranges: metres, shape (beams,), counter-clockwise; no return is anything outside
                [range_min, range_max) of the lidar, NaN included.
            odometry: pose of the robot's centre by dead reckoning, odometry frame.
            velocity: of the robot; from the change of odometry if not given.
            bumps: where the body touches something, robot frame.
            seconds: since the last update; the lidar's period if not given.

        Raises:
            RuntimeError: before the first `begin`.
            ValueError: another number of ranges, or odometry that is not finite.
        """
        if self._updates < 0:
            raise RuntimeError("call begin(command) before update()")
        self._take(ranges, odometry)
        self._keep_last_scene()
        seconds = 1.0 / self.lidar.rate_hz if seconds is None else seconds
        if velocity is None:
            velocity = _velocity(self._odometry, odometry, seconds) if self._updates else ORIGIN
        follower, last, before = self.follower, self._pose, (self._odometry, self._pose)
        pose = understand(self.senses, odometry, before, self.corrects_drift)
        self._pose, self._odometry = pose, odometry
        if bumps and self.bumps.note(bumps, self.ranges, pose):
            self._attention.demand()
        if self.bumps:
            self.bumps.pass_on(last, pose)
        self._follow(pose, math.hypot(velocity[0], velocity[1]), seconds)
        self._updates += 1
        return Belief(
            pose,
            velocity,
            follower.active,
            follower.goal,
            follower.target(pose),
            follower.impossible,
            self._snapshot(),
        )

    def scene(self) -> Scene:
        """What is known now, in the odometry frame."""
        if self.known_scene is not None:
            return self.known_scene
        return self.bumps.join(self.memory.scene())

    def hits(self) -> FloatArray:
        """Where the last beams ended, lidar frame, shape (n, 2); NaN without a return."""
        spec = self.lidar
        valid = (self.ranges >= spec.range_min) & (self.ranges < spec.range_max)
        return np.where(valid, self.ranges, np.nan)[:, None] * self._beams

    def _take(self, ranges: ArrayLike, odometry: Pose) -> None:
        """Check what was sensed and copy the ranges."""
        array = np.asarray(ranges)
        if array.shape != self.ranges.shape:
            raise ValueError(
                f"ranges have shape {array.shape}; {self.lidar.name} gives {self.ranges.shape}"
            )
        if not all(map(math.isfinite, odometry)):
            raise ValueError(f"odometry is {odometry}; it must be a finite (x, y, heading)")
        self.ranges[:] = array

    def _follow(self, pose: Pose, speed: float, seconds: float) -> None:
        """Move on to the next clause or ground this one anew, if there is reason to."""
        follower, size = self.follower, self._memory_size
        if self._updates == 0:
            follower.start(self.scene(), pose)
        elif follower.advance(self.scene, pose, speed, seconds) or self._attention.is_due(
            pose, self._updates, size
        ):
            follower.look(self.scene(), pose)
        else:
            return
        self._attention.note(pose, self._updates, size())

    def _memory_size(self) -> tuple[int, int]:
        return self.memory.size

    def _snapshot(self) -> SceneSource:
        """What is known now, unchanged by later updates."""
        if self.known_scene is not None:
            return _KnownScene(self.known_scene)
        source = _Remembered(self.memory, self.bumps)
        self._last_source = ref(source)
        return source

    def _keep_last_scene(self) -> None:
        """Copy what the last belief remembers, if somebody still has that belief."""
        source = self._last_source()
        if source is not None:
            source.keep()
        self._last_source = _nothing


def _nothing() -> None:
    """Stands for a weak reference to what is gone."""


class _KnownScene(NamedTuple):
    """A scene that is known beforehand."""

    known: Scene

    def scene(self) -> Scene:
        return self.known


class _Remembered:
    """What a robot remembers at one moment: its memory itself, and a copy once it goes on.

    Most beliefs are let go before the next scan; copying for these would cost a tenth of a scan.
    """

    __slots__ = ("__weakref__", "_bumps", "_memory")

    def __init__(self, memory: SceneMemory, bumps: BumpMap) -> None:
        self._memory, self._bumps = memory, bumps

    def keep(self) -> None:
        """Copy what is remembered, because the robot goes on."""
        self._memory, self._bumps = self._memory.copy(), self._bumps.copy()

    def scene(self) -> Scene:
        return self._bumps.join(self._memory.scene())


def _velocity(before: Pose, after: Pose, seconds: float) -> Twist:
    """The mean velocity between two poses, in the robot frame of the first."""
    x, y = after[0] - before[0], after[1] - before[1]
    c, s = math.cos(before[2]), math.sin(before[2])
    yaw = math.remainder(after[2] - before[2], math.tau)
    return (c * x + s * y) / seconds, (c * y - s * x) / seconds, yaw / seconds
