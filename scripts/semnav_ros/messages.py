"""What a robot's node takes in and gives out, as plain data; no middleware is imported here."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from semnav_features.frames import FloatArray, Point, Pose, Twist

NO_ENDS: FloatArray = np.zeros((0, 4))


@dataclass(frozen=True)
class ScanMessage:
    """One scan of a 2D lidar; see sensor_msgs/LaserScan.

    Attributes:
        stamp: time of the first beam, seconds by the robot's clock.
        ranges: metres, shape (n,).
        angle_min: direction of the first beam, lidar frame, radians.
        angle_increment: angle between beams, radians; negative for a lidar that turns clockwise.
        range_min: metres; anything closer is no return.
        range_max: metres; anything at or beyond it is no return.
        scan_time: seconds between scans; 0 if the driver does not say.
        frame: name of the lidar frame.
    """

    stamp: float
    ranges: ArrayLike
    angle_min: float
    angle_increment: float
    range_min: float = 0.05
    range_max: float = 10.0
    scan_time: float = 0.0
    frame: str = "laser"


@dataclass(frozen=True)
class OdometryMessage:
    """Dead reckoning; see nav_msgs/Odometry.

    Attributes:
        stamp: seconds by the robot's clock.
        pose: of the base frame in the odometry frame, metres and radians.
        twist: forward, left, yaw rate of the base frame, m/s and rad/s.
        frame: name of the odometry frame.
    """

    stamp: float
    pose: Pose
    twist: Twist = (0.0, 0.0, 0.0)
    frame: str = "odom"


@dataclass(frozen=True)
class TransformMessage:
    """The place of one frame in another; see geometry_msgs/TransformStamped.

    Attributes:
        parent: name of the frame in which the pose is given.
        child: name of the frame that lies there.
        place: x and y of the child, metres.
        quaternion: its rotation, (x, y, z, w).
    """

    parent: str
    child: str
    place: Point
    quaternion: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)


class Phase(StrEnum):
    """What the node is doing."""

    IDLE = "idle"
    RUNNING = "running"
    ASKING = "asking"
    REFUSED = "refused"
    IMPOSSIBLE = "impossible"
    DONE = "done"
    STOPPED = "stopped"
    HELD = "held"


@dataclass
class Counts:
    """How many messages came, and what was wrong with them.

    Attributes:
        scans: that were used.
        doubled: scans with the stamp of the last one; ignored.
        late: scans with an older stamp; ignored.
        lost: scans that did not come, by the gaps between stamps.
        refused: scans of another lidar, or that make no scan.
        clock_jumps: times at which the robot's clock went back.
        odometry_jumps: times at which odometry went farther than the robot can drive.
    """

    scans: int = 0
    doubled: int = 0
    late: int = 0
    lost: int = 0
    refused: int = 0
    clock_jumps: int = 0
    odometry_jumps: int = 0


@dataclass(frozen=True)
class NodeStatus:
    """The state of the node.

    Attributes:
        phase: what it is doing.
        problem: why it stands although a command runs; empty if nothing is wrong.
        command: the text that was last told.
        clauses: the understood clauses, in words.
        clause: index of the active one; their number when all are done.
        reasons: for the present goal, and why the clause is impossible, if it is.
        counts: of the messages so far.
    """

    phase: Phase
    problem: str
    command: str
    clauses: tuple[str, ...]
    clause: int
    reasons: tuple[str, ...]
    counts: Counts


@dataclass(frozen=True)
class NodeReply:
    """What a call of the node answers.

    Attributes:
        velocity: forward, left, yaw rate of the base frame, m/s and rad/s.
        drives: whether the node now says how fast the robot moves. Where it is False the velocity
            is zero and need not be sent, so that somebody else may drive.
        status: the state after the call.
        said: the open question, or why the last text was refused; empty if there is neither.
        goal: where the base frame shall go, in the frame of odometry, where a navigator drives;
            None: nowhere, so that the robot has to stand.
    """

    velocity: Twist
    drives: bool
    status: NodeStatus
    said: str
    goal: Pose | None = None


@dataclass(frozen=True)
class BeliefMessage:
    """What the robot believes, in the odometry frame.

    Attributes:
        pose: of the base frame.
        walls: x and y of start and end, metres, shape (n, 4).
        doors: x and y of both jambs, metres, shape (m, 4).
        confidence: of each door, shape (m,), 0 to 1.
        goal: pose at which the active clause ends; None without one.
    """

    pose: Pose
    walls: FloatArray = field(default_factory=lambda: NO_ENDS)
    doors: FloatArray = field(default_factory=lambda: NO_ENDS)
    confidence: FloatArray = field(default_factory=lambda: np.zeros(0))
    goal: Pose | None = None


@dataclass(frozen=True)
class MarkerMessage:
    """Lines to draw; see visualization_msgs/Marker, LINE_LIST.

    Attributes:
        name: what they are: walls, doors or goal.
        points: ends of the lines, odometry frame, metres, shape (2 n, 2).
        colour: red, green, blue, 0 to 1.
        width: of the lines, metres.
    """

    name: str
    points: FloatArray
    colour: tuple[float, float, float]
    width: float


Bumps = Sequence[tuple[float, float, float]]
"""Where the body is touched: (x, y, direction into the touched object), base frame."""
