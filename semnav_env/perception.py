"""From the robot's pose to features, memory and the goal that it makes out."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from semnav_env.commands import Command
from semnav_env.features import ExtractorSettings
from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.kernels.scratch import allocate_features, allocate_scratch
from semnav_env.features.memory import SceneMemory
from semnav_env.features.scene import Scene
from semnav_env.grounding.follower import Follower
from semnav_env.grounding.goal import door_of
from semnav_env.grounding.ways import KnownWays, Way
from semnav_env.lidar.lidar import Lidar
from semnav_env.observation_row import door_ends, write_felt, write_state
from semnav_env.observations import ROW_SIZE
from semnav_env.senses import Senses, join_senses, observe
from semnav_env.touch import Felt, Touch

LOOK_EVERY, TURN_EVERY = 1.5, 0.5
"""A clause is grounded anew after so many metres, or so many radians, on the way."""

CHECK_DOORS, CHECK_REST = 5, 30
"""And after so many steps, if more doors count by then; or more walls, or if it has moved."""

STIRRED = 0.2
"""Less than this is not moved, metres."""

FIRST_SCANS = 3
"""After so many scans the first features count, see `SceneMemory`."""

NO_WAYS: Mapping[int, Way] = MappingProxyType({})
ORIGIN: Pose = (0.0, 0.0, 0.0)
NOWHERE: Pose = (math.inf, math.inf, 0.0)


class Perception:
    """What the robot knows, from its lidar and its odometry alone.

    Args:
        lidar: on its mount.
        settings: of the feature extractor.
        drifts: odometry does, and walls that are seen again correct it.

    Attributes:
        pose: where the robot takes itself to be, in the frame of its memory, which is that of
            odometry at the start.
        row: the observation of this step, `ROW_SIZE` values and the scan.
        features: of this step's scan, lidar frame.
        ranges: of this step's scan, metres.
        senses: all of these arrays, as the kernels take them.
        memory: what was seen so far, in that frame.
        felt: walls that were run into unseen, in that frame.
        follower: how far the command has come, as the robot sees it.
    """

    def __init__(self, lidar: Lidar, settings: ExtractorSettings, drifts: bool = True) -> None:
        beams = lidar.spec.beams
        self.lidar, self.drifts = lidar, drifts
        self.row = np.zeros(ROW_SIZE + beams, dtype=np.float32)
        self.ranges = np.zeros(beams)
        self.features = allocate_features()
        self.memory = SceneMemory()
        self.felt = Felt(lidar.spec, lidar.mount)
        self._beams = np.ascontiguousarray(lidar.spec.directions.T)
        self._record = settings.as_record()
        self._scratch = allocate_scratch(beams)
        self.senses = self._join()

    def _join(self) -> Senses:
        return join_senses(
            self.lidar.arrays,
            self._beams,
            self._record,
            self._scratch,
            self.lidar.mount,
            self.ranges,
            self.features,
            self.memory.arrays,
            self.row,
        )

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "senses"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.senses = self._join()

    def begin(
        self, command: Command, ways: Mapping[int, Way] = NO_WAYS, start: Pose = ORIGIN
    ) -> None:
        """Start an episode: forget the last one.

        Args:
            command: to follow.
            ways: that are pointed out for clauses of it, world frame.
            start: pose, world frame: the origin of the odometry frame.
        """
        self.memory.clear()
        self.felt.clear()
        write_felt(self.row, self.felt.ends, ORIGIN)
        guide = KnownWays({clause: way.seen_from(start) for clause, way in ways.items()})
        self.follower = Follower(command, care=0.5, jamb_margin=0.3, guide=guide)
        self._started, self.pose, self._odometry = False, ORIGIN, ORIGIN
        self._looked_from: Pose = (0.0, 0.0, 0.0)
        self._looked_at, self._looked_on = 0, (0, 0)

    def sense(
        self,
        true_pose: Pose,
        odometry: Pose,
        velocity: Pose,
        key: tuple[int, int, int],
        touches: Sequence[Touch] = (),
    ) -> None:
        """Take a scan and think about it; afterwards `row` is the observation.

        Args:
            true_pose: of the robot's centre in the world: where the beams start.
            odometry: the same by odometry alone.
            velocity: forward, left (m/s) and turning (rad/s), robot frame.
            key: (seed, episode, step) of the noise.
            touches: what the robot touches.
        """
        was, before = self.pose, (self._odometry, self.pose)
        pose = observe(self.senses, true_pose, odometry, before, self.drifts, key)
        self.pose, self._odometry = pose, odometry
        if touches and self.felt.note(touches, self.ranges, pose):
            self._looked_from = NOWHERE
        if self.felt:
            self.felt.pass_on(was, pose)
            write_felt(self.row, self.felt.ends, pose)
        self._think(pose, math.hypot(velocity[0], velocity[1]), key[2])
        follower = self.follower
        goal = follower.target(pose)
        write_state(
            self.row,
            follower.active,
            pose,
            velocity,
            goal.kind.value,  # numba is slow to recognise an enum
            goal.pose,
            door_ends(goal),
            door_of(goal) is not None,
        )

    def _think(self, pose: Pose, speed: float, step: int) -> None:
        """Move on to the next clause or ground this one anew, if there is reason to."""
        if not self._started:
            self._started = True
            self.follower.start(self.scene(), pose)
            self._note_look(pose, step)
        elif self.follower.advance(self.scene, pose, speed) or self._should_look(pose, step):
            self.follower.look(self.scene(), pose)
            self._note_look(pose, step)

    def hits(self) -> FloatArray:
        """Where this step's beams ended, lidar frame, shape (n, 2); NaN without a return."""
        spec = self.lidar.spec
        valid = (self.ranges >= spec.range_min) & (self.ranges < spec.range_max)
        return np.where(valid, self.ranges, np.nan)[:, None] * self._beams

    def scene(self) -> Scene:
        """What is remembered, in the frame of `pose`."""
        return self.felt.join(self.memory.scene())

    def _should_look(self, pose: Pose, step: int) -> bool:
        x, y, heading = self._looked_from
        moved = (pose[0] - x) ** 2 + (pose[1] - y) ** 2
        if moved > LOOK_EVERY**2:
            return True
        if abs(math.remainder(pose[2] - heading, math.tau)) > TURN_EVERY:
            return True
        since = step - self._looked_at
        if since % CHECK_DOORS and step != FIRST_SCANS:
            return False
        walls, doors = self.memory.size
        known_walls, known_doors = self._looked_on
        differs = walls != known_walls or moved > STIRRED**2
        return doors != known_doors or (differs and (since >= CHECK_REST or step == FIRST_SCANS))

    def _note_look(self, pose: Pose, step: int) -> None:
        self._looked_from, self._looked_at, self._looked_on = pose, step, self.memory.size


class TruePerception(Perception):
    """The same interface on the map: for the oracle, and to see what perception costs.

    The caller gives it a lidar without errors and the true pose as odometry, so its odometry
    frame is the world frame.

    Args:
        lidar: without noise.
        settings: of the feature extractor.
        scene: all walls and doors, world frame.
    """

    def __init__(self, lidar: Lidar, settings: ExtractorSettings, scene: Scene) -> None:
        super().__init__(lidar, settings, drifts=False)
        self._scene = scene

    def begin(
        self, command: Command, ways: Mapping[int, Way] = NO_WAYS, start: Pose = ORIGIN
    ) -> None:
        """Start an episode."""
        super().begin(command, ways)
        self.follower.complete = True

    def scene(self) -> Scene:
        """All there is, in the world frame."""
        return self._scene
