"""Following a path at bounded speed: turns on the spot exactly, lines and arcs by feedback."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from semnav_agents.planning.motion import REVERSE, SIDEWAYS, TURN
from semnav_agents.planning.track import FollowerLimits, PathLeg, PathTrack, TrackArrays
from semnav_features.frames import Pose, Twist, compose, wrap_angle
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot

SAMPLES_AHEAD = 12
"""Samples of the path among which the nearest is looked for: about half a metre, more than a robot
drives in one step."""


@dataclass(frozen=True, slots=True)
class PathProgress:
    """The progress along a path: the index of the leg, and of the last sample passed."""

    leg: int = 0
    sample: int = 0


@dataclass(frozen=True, slots=True)
class Steering:
    """The velocity for one step, and how far the path has been driven.

    Attributes:
        forward: m/s.
        left: m/s; 0 for a robot that cannot.
        yaw_rate: rad/s.
        progress: to be passed in at the next step.
        deviation: distance from the path, metres.
        done: whether the path's end is reached.
    """

    forward: float
    left: float
    yaw_rate: float
    progress: PathProgress
    deviation: float = 0.0
    done: bool = False

    @property
    def twist(self) -> Twist:
        """The velocity as a twist."""
        return self.forward, self.left, self.yaw_rate

    def slowed(self, share: float) -> Steering:
        """A steering with a share of the velocity and the same curvature."""
        forward, left, yaw_rate = (share * value for value in self.twist)
        return replace(self, forward=forward, left=left, yaw_rate=yaw_rate)


def follow(track: PathTrack, progress: PathProgress, pose: Pose, velocity: Twist) -> Steering:
    """Compute the velocities that keep the robot on its path.

    Args:
        track: the path and the robot.
        progress: `PathProgress()` at first, then that of the last answer.
        pose: the centre's pose, in the path's frame.
        velocity: the centre's velocity now.
    """
    leg, sample, forward, left, turn, off, done = steer(
        track.arrays, track.limits, progress.leg, progress.sample, pose, velocity
    )
    return Steering(forward, left, turn, PathProgress(leg, sample), off, done)


@kernel
def steer(
    track: TrackArrays, s: FollowerLimits, leg: int, sample: int, pose: Pose, velocity: Twist
) -> tuple[int, int, float, float, float, float, bool]:
    """See `follow`: leg and sample of the progress, the velocities, the deviation, and done."""
    axle = compose(pose, (s.axle, 0.0, 0.0))
    while leg < len(track.legs):
        here = PathLeg(track.legs[leg, 0], track.legs[leg, 1], track.legs[leg, 2])
        if here.kind == TURN:
            over, at, forward, left, turn, off = _turn(track, s, here, sample, axle, velocity)
        else:
            over, at, forward, left, turn, off = _drive(track, s, here, sample, axle, velocity)
        if not over:
            return leg, at, forward, left, turn, off, False
        leg, sample = leg + 1, here.last
    return leg, sample, 0.0, 0.0, 0.0, 0.0, True


@kernel
def _turn(
    track: TrackArrays, s: FollowerLimits, leg: PathLeg, sample: int, axle: Pose, velocity: Twist
) -> tuple[bool, int, float, float, float, float]:
    """Whether a turn on the spot is over; sample, velocities and deviation if it is not."""
    poses = track.poses
    x, y, known = poses[sample, 0], poses[sample, 1], poses[sample, 2]
    heading = known + wrap_angle(axle[2] - known)
    nearest = sample
    for k in range(sample + 1, leg.last + 1):
        if abs(poses[k, 2] - heading) < abs(poses[nearest, 2] - heading):
            nearest = k
    error = poses[leg.last, 2] - heading
    if abs(error) < s.done_angle and abs(velocity[2]) < 0.2 and abs(velocity[0]) < 0.05:
        return True, nearest, 0.0, 0.0, 0.0, 0.0
    rate = min(s.turn_rate, 3.0 * abs(error), math.sqrt(2.0 * s.turn_braking * abs(error)))
    forward, left = _towards(axle, x, y) if s.holonomic else (0.0, 0.0)
    if abs(velocity[0]) > 0.15 and not s.holonomic:
        rate = 0.0
    off = _strayed(s, exact_hypot(axle[0] - x, axle[1] - y), velocity)
    return False, nearest, forward, left, math.copysign(rate, error), off


@kernel
def _drive(
    track: TrackArrays, s: FollowerLimits, leg: PathLeg, sample: int, axle: Pose, velocity: Twist
) -> tuple[bool, int, float, float, float, float]:
    """Whether a line or an arc is over; sample, velocities and deviation if it is not."""
    sample = _nearest(track, leg, sample, axle)
    along, across, error = _errors(track, leg, sample, axle)
    left_over = track.distance[leg.last] - track.distance[sample] - along
    if left_over < s.done_distance and (
        leg.last < len(track.poses) - 1 or left_over < 0.005 or abs(velocity[0]) < 0.1
    ):
        return True, sample, 0.0, 0.0, 0.0, 0.0
    speed = _speed(track, s, sample, along, left_over, across, error)
    preview = s.preview * min(speed, exact_hypot(velocity[0], velocity[1]))
    bend = track.curvature[_ahead(track, leg, sample, preview)]
    signed = -speed if leg.kind == REVERSE else speed
    rate = 1.3 * s.turn_rate
    if s.holonomic:
        forward, left = _back_to_path(track, s, leg, sample, speed, across, error)
        turn = signed * bend - 3.0 * error
        return False, sample, forward, left, min(max(turn, -rate), rate), abs(across)
    k = s.stiffness
    turn = signed * bend - k * k * signed * across * _sinc(error) - 2.0 * k * speed * error
    return False, sample, signed, 0.0, min(max(turn, -rate), rate), abs(across)


@kernel
def _back_to_path(
    track: TrackArrays,
    s: FollowerLimits,
    leg: PathLeg,
    sample: int,
    speed: float,
    across: float,
    error: float,
) -> tuple[float, float]:
    """Velocity along the path's direction, and straight back to the path after a deviation."""
    direction = _direction(track, leg, sample)
    heading = track.poses[sample, 2] + error
    off = -across if leg.kind == REVERSE else across
    side = min(max(-s.stiffness * off, -0.25), 0.25)
    cosine, sine = math.cos(direction - heading), math.sin(direction - heading)
    forward, left = speed * cosine - side * sine, speed * sine + side * cosine
    shrink = min(1.0, s.sideways / abs(left)) if left != 0.0 else 1.0
    return forward * shrink, left * shrink


@kernel
def _speed(
    track: TrackArrays,
    s: FollowerLimits,
    sample: int,
    along: float,
    left_over: float,
    across: float,
    error: float,
) -> float:
    """Speed of the profile, m/s, less where the robot is off the path or close to a stop."""
    after = min(sample + 1, len(track.speed) - 1)
    step = max(track.distance[after] - track.distance[sample], 1e-9)
    share = min(1.0, max(0.0, along / step))
    planned = (1 - share) * track.speed[sample] + share * track.speed[after]
    off = max(0.0, 1.0 - abs(across) / 0.15 - abs(error) / 0.5)
    left_over = max(0.0, left_over)
    stop = min(math.sqrt(2.0 * s.braking * left_over), 2.0 * left_over + 0.02)
    speed: float = min(max(planned * off, s.creep), stop)
    return speed


@kernel
def _nearest(track: TrackArrays, leg: PathLeg, sample: int, axle: Pose) -> int:
    """The sample nearest to the axle among the next `SAMPLES_AHEAD` of a leg."""
    first = max(sample, leg.first)
    nearest, least = first, math.inf
    for k in range(first, min(first + SAMPLES_AHEAD, leg.last + 1)):
        away = math.hypot(track.poses[k, 0] - axle[0], track.poses[k, 1] - axle[1])
        if away < least:
            nearest, least = k, away
    return nearest


@kernel
def _errors(
    track: TrackArrays, leg: PathLeg, sample: int, axle: Pose
) -> tuple[float, float, float]:
    """Distance past the sample along the motion and to its left, metres, and the heading error."""
    x, y, heading = track.poses[sample, 0], track.poses[sample, 1], track.poses[sample, 2]
    direction = _direction(track, leg, sample)
    c, s = math.cos(direction), math.sin(direction)
    dx, dy = axle[0] - x, axle[1] - y
    along, across = c * dx + s * dy, c * dy - s * dx
    bend = track.curvature[min(sample, leg.last - 1)] if along > 0 else 0.0
    sign = -1.0 if leg.kind == REVERSE else 1.0
    if leg.kind == REVERSE:
        across = -across
    wanted = heading + sign * bend * along
    bow = 0.5 * bend * along * along
    return along, across - bow, wrap_angle(axle[2] - wanted)


@kernel
def _direction(track: TrackArrays, leg: PathLeg, sample: int) -> float:
    """Direction of motion at a sample, radians."""
    heading: float = track.poses[sample, 2]
    if leg.kind == REVERSE:
        return heading + math.pi
    if leg.kind == SIDEWAYS:
        return heading + math.copysign(math.pi / 2, track.left[min(sample, leg.last - 1)])
    return heading


@kernel
def _ahead(track: TrackArrays, leg: PathLeg, sample: int, distance: float) -> int:
    """The sample so far ahead along a leg."""
    there: int = np.searchsorted(track.distance, track.distance[sample] + distance)
    return min(max(sample, there), leg.last - 1)


@kernel
def _strayed(s: FollowerLimits, distance: float, velocity: Twist) -> float:
    """Deviation of a robot from the place at which it should turn, metres.

    While the robot brakes, the distance that braking needs is left out. Once it stands, every
    centimetre counts more, because the turn was tested at that place alone.
    """
    speed = exact_hypot(velocity[0], velocity[1])
    if speed > 0.05:
        return max(0.0, distance - speed * speed / (1.6 * s.max_acceleration))
    return distance * s.lost / s.lost_at_turn


@kernel
def _towards(axle: Pose, x: float, y: float) -> tuple[float, float]:
    """Velocity (forward, left) back to a place, m/s: its offset, to be driven within a second."""
    dx, dy = x - axle[0], y - axle[1]
    c, s = math.cos(axle[2]), math.sin(axle[2])
    return c * dx + s * dy, c * dy - s * dx


@kernel
def _sinc(angle: float) -> float:
    return math.sin(angle) / angle if abs(angle) > 1e-6 else 1.0
