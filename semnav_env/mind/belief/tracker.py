"""From ranges, odometry and bumps to what the robot believes; runs on a real robot as it is."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike

from semnav_env.language import Command
from semnav_env.mind.belief.belief import Belief, SceneSource
from semnav_env.mind.belief.bump_map import BumpMap
from semnav_env.mind.belief.estimate import (
    BELIEVED,
    BELIEVED_OFFSET,
    ESTIMATE,
    SENSED,
    mean_velocity,
)
from semnav_env.mind.belief.scene_source import KnownScene, RememberedScene, nothing
from semnav_env.mind.belief.told_ways import ToldWays
from semnav_env.mind.belief.understand import (
    FIRST_SCAN,
    LOOK_DUE,
    Senses,
    Workbench,
    extract_features,
    note_look,
    read_ranges_in,
    understand,
)
from semnav_env.mind.grounding.clause_progress import (
    CLAUSE_DONE,
    CLAUSE_PROGRESS,
    NO_NEARER,
    ON_WAY,
    goal_bytes,
    put_goal,
)
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.ways import KnownWays, Way
from semnav_env.rules import Rules, with_doors_of
from semnav_features import ExtractorSettings
from semnav_features.frames import MOST_CONTACTS, Contact, FloatArray, Pose, Twist
from semnav_features.kernels.scratch import FEATURES, Features, features_of, scratch_array
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import lidar_spec
from semnav_features.memory import SceneMemory
from semnav_features.one_thread import ThreadDoor, for_one_thread
from semnav_features.scene import Scene
from semnav_features.validation import finite_triple

NO_WAYS: Mapping[int, Way] = MappingProxyType({})


class BeliefTracker:
    """Follows a command on what one robot senses.

        tracker = BeliefTracker(lidar="tim561", mount=(0.45, 0.0, 0.0))
        tracker.begin(parse("go through the second door on the right"))
        belief = tracker.update(ranges, odometry=(x, y, heading))
        tracker.begin(parse("go to the first door"), keep=True)  # in the building it knows by now

    An update has three parts: `take` writes what was sensed into `senses`, the compiled
    `understand` does what is to be done at every scan, and `think` what its events call for.

    Args:
        lidar: name of a lidar or its spec; its rate is that of the updates.
        mount: pose of the lidar in the robot frame.
        extractor: limits of the feature extractor.
        corrects_drift: walls that are seen again correct the odometry (Mes 2021).
        known_scene: all walls and doors, odometry frame, where they are known; then commands are
            grounded on them and not on what is remembered.
        rules: what a door is, and the distances and tolerances of grounding. What a door is may be
            said by `extractor` instead.
        observes_features: whether all features stand in `senses` after each scan. Otherwise corners
            and corridors, which a belief does not need, are found when `features` is asked for.

    Attributes:
        ranges: of the last scan, metres, shape (beams,).
        senses: arrays of the belief, as kernels take them.
        memory: walls and doors seen so far, odometry frame.
        bumps: walls that were bumped into unseen, odometry frame.
        follower: how far the command has come, as the robot believes; made by `begin`.
        asked: those of the trackers that share this set whose belief was asked for since the scan.
    """

    lidar: LidarSpec
    mount: Pose
    corrects_drift: bool
    known_scene: Scene | None
    ranges: FloatArray
    bumps: BumpMap
    rules: Rules
    memory: SceneMemory
    thread_door: ThreadDoor
    senses: Senses
    follower: Follower

    @property
    def command(self) -> Command:
        """The command that is followed."""
        return self.follower.command

    def __init__(
        self,
        lidar: str | LidarSpec = "tim561",
        mount: Pose = (0.0, 0.0, 0.0),
        extractor: ExtractorSettings = ExtractorSettings(),
        corrects_drift: bool = True,
        known_scene: Scene | None = None,
        rules: Rules = Rules(),
        observes_features: bool = True,
    ) -> None:
        self.lidar, self.mount = lidar_spec(lidar), finite_triple("mount", mount)
        self.corrects_drift, self.known_scene = corrects_drift, known_scene
        self.ranges = np.zeros(self.lidar.beams)
        self._features, self._observes_features = np.zeros(1, FEATURES), observes_features
        self.bumps = BumpMap(self.lidar, mount)
        self._belief: Belief | None = None
        self.asked: set[BeliefTracker] = set()
        self.rules, extractor = with_doors_of(rules, extractor)
        self.memory = SceneMemory(self.rules.door)
        self._record = extractor.as_record()
        self._workbench = Workbench.of(scratch=scratch_array(self.lidar.beams))
        self._estimate = np.zeros(1, ESTIMATE)
        self._progress = np.zeros(1, CLAUSE_PROGRESS)
        self._told = ToldWays()
        self._period = 1.0 / self.lidar.rate_hz
        self._begun, self._is_first = False, True
        self.thread_door = ThreadDoor()
        self._known_scene = None if known_scene is None else KnownScene(known_scene)
        self._last_source: Callable[[], RememberedScene | None] = nothing
        self.senses = self._join()

    def _join(self) -> Senses:
        self._buffer, self._contacts = self._estimate.data, self._estimate["contacts"][0]
        self._bytes = goal_bytes(self._estimate, "target"), goal_bytes(self._progress, "goal")
        return Senses.of(
            limits=self.lidar.sensor,
            beams=self.lidar.shared_directions,
            record=self._record,
            workbench=self._workbench,
            mount=self.mount,
            ranges=self.ranges,
            features=self._features,
            remembered=self.memory.arrays,
            bumps=self.bumps.arrays,
            estimate=self._estimate,
            progress=self._progress,
            told=self._told.arrays,
        )

    def __getstate__(self) -> dict[str, Any]:
        self._keep_last_scene()
        rejoined = ("senses", "_buffer", "_contacts", "_bytes")
        left_out = (*rejoined, "_last_source", "_workbench", "asked")
        return {name: value for name, value in self.__dict__.items() if name not in left_out}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._last_source, self.asked = nothing, set()
        self._workbench = Workbench.of(scratch=scratch_array(self.lidar.beams))
        self.senses = self._join()

    def read_ranges_in(self, ranges: FloatArray) -> None:
        """Take the array that a simulator writes, shape (beams,), for `ranges`."""
        if ranges is not self.ranges:
            self.ranges = ranges
            read_ranges_in(self.senses, ranges)

    @for_one_thread
    def begin(
        self, command: Command, ways: Mapping[int, Way] = NO_WAYS, keep: bool = False
    ) -> None:
        """Begin to follow a command, and forget everything that is not kept.

        What is kept are the walls, doors and bumps that are remembered, and the believed pose. The
        odometry frame stays the same, so odometry must go on, and no scan may come from another
        building. The command begins where the robot stands at the next scan. When the memory is
        full, what was seen most rarely makes room (`SceneMemory`).

        Args:
            command: to follow.
            ways: to the named rooms of the command, by the number of the clause, odometry frame:
                the words in which somebody who knows the building points them out.
            keep: whether the robot goes on with what it saw under the commands before.
        """
        self.let_go()
        if not keep:
            self._forget()
        self._told.tell(ways)
        self.follower = Follower(
            command,
            complete=self.known_scene is not None,
            care=self.rules.grounding.care,
            jamb_margin=self.rules.grounding.jamb_margin,
            guide=KnownWays(dict(ways)),
            rules=self.rules,
            progress=self._progress,
        )
        self._estimate["scan"], self._estimate["clause"] = -1, 0
        self._estimate["corrects_drift"] = self.corrects_drift
        self._estimate["observes_features"] = self._observes_features
        self._is_first = self._is_first or not keep
        self._begun = True

    def _forget(self) -> None:
        """Forget what is remembered, and where the robot is believed to be."""
        self.memory.clear()
        self.bumps.clear()
        self._estimate[:] = np.zeros(1, ESTIMATE)

    @for_one_thread
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
            bumps: where the body touches something, robot frame; the first `MOST_CONTACTS` count.
            seconds: since the last update; the lidar's period if not given.

        Raises:
            RuntimeError: before the first `begin`, or another thread is at it.
            ValueError: other ranges (shape, or a first scan in mm), what is not finite, no time.
        """
        self.take(ranges, odometry, velocity, bumps, seconds)
        events = understand(self.senses)
        if events:
            self.think(events)
        return self.belief

    def take(
        self,
        ranges: ArrayLike,
        odometry: Pose,
        velocity: Twist | None = None,
        bumps: Sequence[Contact] = (),
        seconds: float | None = None,
    ) -> None:
        """Check what was sensed and write it into the senses; as `update`."""
        if not self._begun:
            raise RuntimeError("call begin(command) before update()")
        from semnav_env.mind.belief import sensed_check  # a simulated robot needs none
        from semnav_features.scan import check_unit, plain_codes

        own = self.ranges
        array = sensed_check.checked_ranges(ranges, len(own), self.lidar.name)
        if self._is_first:
            check_unit(array, self.lidar.range_max)
        seconds = self._period if seconds is None else seconds
        sensed_check.check_sensed(odometry, velocity, bumps, seconds)
        x, y, heading = odometry
        if velocity is None:
            velocity = mean_velocity(self._estimate[0], odometry, seconds)
        self.let_go()
        own[:] = plain_codes(array, self.lidar.range_min, self.lidar.range_max)
        self._is_first = False
        felt = min(len(bumps), MOST_CONTACTS)
        SENSED.pack_into(self._buffer, 0, felt, x, y, heading, seconds, *velocity)
        if felt:
            self._contacts[:felt] = bumps[:felt]

    def think(self, events: int) -> None:
        """Do what the events of `understand` call for; nothing without one."""
        follower = self.follower
        pose = BELIEVED.unpack_from(self._buffer, BELIEVED_OFFSET)[3:]
        looked = True
        if events & FIRST_SCAN:
            follower.start(self.scene(), pose)
        else:
            follower.think(events, self.scene, pose)
            looked = bool(events & (CLAUSE_DONE | LOOK_DUE | NO_NEARER))
            if looked and not events & CLAUSE_DONE:
                follower.look(self.scene(), pose)
        if looked:
            note_look(self.senses)
        if looked or events & ON_WAY:
            self._target = follower.target(pose)
            self._estimate["clause"] = follower.active
            if self._target is follower.goal:
                self._bytes[0][:] = self._bytes[1]  # much faster than to write it anew
            else:
                put_goal(self._estimate, "target", self._target)

    @property
    def belief(self) -> Belief:
        """What is believed after the last scan; a `RuntimeError` before the first `begin`."""
        if not self._begun:
            raise RuntimeError("call begin() with a command first")
        if self._belief is None:
            self._belief = self._believe()
            self.asked.add(self)
        return self._belief

    def _believe(self) -> Belief:
        follower = self.follower
        source: SceneSource | None = self._known_scene
        if source is None:
            source = remembered = RememberedScene(self.memory, self.bumps)
            self._last_source = ref(remembered)
        forward, left, yaw_rate, x, y, heading = BELIEVED.unpack_from(self._buffer, BELIEVED_OFFSET)
        told = follower.active, follower.goal, self._target, follower.impossible
        return Belief((x, y, heading), (forward, left, yaw_rate), *told, source, follower.pace)

    def scene(self) -> Scene:
        """What is known now, in the odometry frame."""
        return self.known_scene or self.bumps.join(self.memory.scene())

    @property
    def features(self) -> Features:
        """Of the last scan, lidar frame."""
        if not self._observes_features:
            extract_features(self.senses, True)
        return features_of(self._features)

    def hits(self) -> FloatArray:
        """Where the last beams ended, lidar frame, shape (n, 2); NaN without a return."""
        spec = self.lidar
        valid = (spec.range_min <= self.ranges) & (self.ranges < spec.range_max)
        return np.where(valid, self.ranges, np.nan)[:, None] * spec.shared_directions

    def let_go(self) -> None:
        """Forget the last belief, before `understand`; who still has it keeps its scene."""
        self.asked.discard(self)
        if self._belief is not None:
            self._belief = None
            self._keep_last_scene()

    def _keep_last_scene(self) -> None:
        """Copy what the last belief remembers, if somebody still has that belief."""
        if (source := self._last_source()) is not None:
            source.keep()
        self._last_source = nothing
