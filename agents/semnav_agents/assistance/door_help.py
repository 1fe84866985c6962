"""Help through a door: the robot steers, and whoever drives says how fast."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_agents.assistance.door_intent import INTENT_DISTANCE, DoorIntent, first_door
from semnav_agents.planning.door_aims import SAME_DOOR_DISTANCE
from semnav_agents.planning.doorway import target_behind
from semnav_agents.planning.driver import Driver
from semnav_agents.planning.known_obstacles import JoinedObstacles, Obstacles, as_obstacles
from semnav_agents.planning.nudge import path_clearance
from semnav_env.approach import DoorSide
from semnav_env.robots import RobotSpec
from semnav_env.robots.actions import shares_of
from semnav_features.frames import FloatArray, Pose, Twist, points_to_parent
from semnav_features.scene import Door

OWN_CLEARANCE = 0.02
"""Clearance with which a driver passes a door without help, metres."""

SURE_SECONDS, DOUBT_SECONDS = 0.3, 0.5
"""How long a driver must mean a door before the robot steers; and how long not to mean it, until
the robot lets go."""

IN_DOORWAY, PASSED_DISTANCE = 0.8, 0.6
"""Distance of the centre from the line of a door at which the body is in it: then only stopping or
backing means something else; and distance behind it at which the door is passed, metres."""

LEAST_FORWARD, MEANT_FORWARD = 0.05, 0.15
"""Shares of the largest speed from which a driver drives forward; and from which a driver means a
door: who creeps is about to turn."""

TURNING_SHARE = 0.15
"""Share of the largest speed from which a driver who waits for the robot to turn on the spot does
not slow the turn down."""


class DoorHelp:
    """Steers a robot through the door that its driver means, if the driver would hit a jamb.

    A driver means the first door whose line lies on the way that the wanted velocity leads. The
    robot plans a path through it, and takes the velocity along the path, at most as fast as the
    driver wants to go. It never backs for a driver who drives forward. A driver who steers away,
    stops or backs, gets the wanted velocity again.

    Args:
        robot: the body.
        control_hz: actions a second.

    Attributes:
        door: the door, from the side of the robot, odometry frame; None if the robot does not help.
    """

    def __init__(self, robot: RobotSpec, control_hz: float) -> None:
        self._robot, self._intent, self._driver = (
            robot,
            DoorIntent(robot, control_hz),
            Driver(robot),
        )
        self._sure_steps, self._doubt_steps = SURE_SECONDS * control_hz, DOUBT_SECONDS * control_hz
        self.door: DoorSide | None = None
        self._candidate: DoorSide | None = None
        self._steps = 0

    def helped(
        self,
        action: NDArray[np.float32],
        obstacles: Obstacles,
        doors: FloatArray,
        pose: Pose,
        velocity: Twist,
        moving: FloatArray,
    ) -> NDArray[np.float32]:
        """The action, or one that leads through the door that it means.

        Args:
            action: of the driver.
            obstacles: that stand, in the frame of `pose`.
            doors: x and y of both jambs of the known doors, robot frame, shape (n, 4).
            pose: of the robot's centre, odometry frame.
            velocity: of the robot's centre.
            moving: points on what moves, in the frame of `pose`, shape (m, 2).
        """
        self._intent.note(action)
        jambs = doors.reshape(-1, 2, 2)
        meant = self._meant(jambs, obstacles, pose)
        if self.door is None:
            self._consider(meant)
        else:
            self._go_on(meant, jambs, pose)
        if self.door is None or action[0] < LEAST_FORWARD:
            return action
        return self._steered(self.door, action, obstacles, pose, velocity, moving)

    def _meant(self, jambs: FloatArray, obstacles: Obstacles, pose: Pose) -> DoorSide | None:
        """The door that the driver means, odometry frame; None where no help is wanted."""
        helping = self.door is not None
        if self._intent.forward < (LEAST_FORWARD if helping else MEANT_FORWARD):
            return None
        way = self._intent.way
        door = first_door(way, jambs)
        if door is None or not (helping or self._would_touch(way, door, obstacles, pose)):
            return None
        return _door_side(points_to_parent(pose, door), pose)

    def _would_touch(
        self, way: FloatArray, door: FloatArray, obstacles: Obstacles, pose: Pose
    ) -> bool:
        """Whether a way through a door, both in the robot frame, leaves too little room."""
        near = np.vstack((obstacles.near(pose, INTENT_DISTANCE + self._robot.length), door))
        size = self._robot.length, self._robot.width
        return bool(path_clearance(near, way, *size, 0.0, 0.0, OWN_CLEARANCE) < OWN_CLEARANCE)

    def _consider(self, meant: DoorSide | None) -> None:
        """Begin to help, once the driver has meant the same door for a while."""
        self._steps = self._steps + 1 if _are_one(meant, self._candidate) else 1
        self._candidate = meant
        if meant is not None and self._steps >= self._sure_steps:
            self.door, self._steps = meant, 0
            self._driver.reset()

    def _go_on(self, meant: DoorSide | None, jambs: FloatArray, pose: Pose) -> None:
        """Take the latest place of the door, and let go where it is passed or not meant."""
        assert self.door is not None
        before = self.door.distance_before(pose[:2])
        for each in jambs if before > 0.0 else ():
            latest = _door_side(points_to_parent(pose, each), pose)
            self.door = latest if _are_one(latest, self.door) else self.door
        is_meant = _are_one(meant, self.door) or abs(before) < IN_DOORWAY
        is_meant = is_meant and self._intent.forward >= LEAST_FORWARD
        self._steps = 0 if is_meant else self._steps + 1
        if before < -PASSED_DISTANCE or self._steps > self._doubt_steps:
            self.door = self._candidate = None

    def _steered(
        self,
        door: DoorSide,
        action: NDArray[np.float32],
        obstacles: Obstacles,
        pose: Pose,
        velocity: Twist,
        moving: FloatArray,
    ) -> NDArray[np.float32]:
        """An action along the path through the door; the driver's own if there is no such path."""
        solid = JoinedObstacles((obstacles, as_obstacles(np.array((door.right, door.left)))))
        x, y = door.before(np.array(((1.0, 0.0),)))[0].tolist()
        target = target_behind(Door(door.right, door.left), (x, y))
        steering = self._driver.drive(solid, target, pose, velocity, moving=moving)
        path = self._driver.path
        if path is None or not path.complete or steering.done or steering.forward < 0.0:
            return action
        shares = shares_of(steering.twist, self._robot)
        fastest = min(1.0, float(action[0]) / max(float(shares[0]), TURNING_SHARE))
        return np.asarray(fastest * shares, np.float32)


def _door_side(jambs: FloatArray, pose: Pose) -> DoorSide:
    """A door, jambs of shape (2, 2), from the side of a pose in the same frame."""
    (x1, y1), (x2, y2) = jambs.tolist()
    return DoorSide.seen_from(Door((x1, y1), (x2, y2)), pose[:2])


def _are_one(a: DoorSide | None, b: DoorSide | None) -> bool:
    """Whether both are the same door, in one frame."""
    if a is None or b is None:
        return False
    return bool(np.hypot(*np.subtract(a.middle, b.middle)) < SAME_DOOR_DISTANCE)
