"""Following a path at bounded speed: turns on the spot exactly, lines and arcs by feedback."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from semnav_agents.planning.motion import REVERSE, SIDEWAYS, TURN
from semnav_agents.planning.track import PathLeg, PathTrack
from semnav_features.frames import Pose, Twist, compose, wrap_angle

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
    axle = compose(pose, (track.robot.axle, 0.0, 0.0))
    while progress.leg < len(track.legs):
        leg = track.legs[progress.leg]
        act = _turn if leg.kind == TURN else _drive
        steering = act(track, leg, progress, axle, velocity)
        if steering is not None:
            return steering
        progress = PathProgress(progress.leg + 1, leg.last)
    return Steering(0.0, 0.0, 0.0, progress, 0.0, True)


def _turn(
    track: PathTrack, leg: PathLeg, progress: PathProgress, axle: Pose, velocity: Twist
) -> Steering | None:
    s, poses = track.settings, track.path.axle_poses
    x, y, known = poses[progress.sample]
    heading = known + wrap_angle(axle[2] - known)
    span = poses[progress.sample : leg.last + 1, 2]
    sample = progress.sample + int(np.argmin(np.abs(span - heading)))
    error = poses[leg.last, 2] - heading
    if abs(error) < s.done_angle and abs(velocity[2]) < 0.2 and abs(velocity[0]) < 0.05:
        return None
    braking = s.braking * track.robot.max_turn_acceleration
    rate = min(s.turn_rate, 3.0 * abs(error), math.sqrt(2.0 * braking * abs(error)))
    forward, left = _towards(axle, (x, y)) if track.robot.holonomic else (0.0, 0.0)
    if abs(velocity[0]) > 0.15 and not track.robot.holonomic:
        rate = 0.0
    return Steering(
        forward,
        left,
        math.copysign(rate, error),
        PathProgress(progress.leg, sample),
        _strayed(track, math.dist(axle[:2], (x, y)), velocity),
    )


def _drive(
    track: PathTrack, leg: PathLeg, progress: PathProgress, axle: Pose, velocity: Twist
) -> Steering | None:
    s, poses = track.settings, track.path.axle_poses
    sample = _nearest(track, leg, progress.sample, axle)
    along, across, error = _errors(track, leg, sample, axle)
    left_over = track.distance[leg.last] - track.distance[sample] - along
    if left_over < s.done_distance and (
        leg.last < len(poses) - 1 or left_over < 0.005 or abs(velocity[0]) < 0.1
    ):
        return None
    speed = _speed(track, sample, along, left_over, across, error)
    preview = s.preview * min(speed, math.hypot(velocity[0], velocity[1]))
    bend = track.curvature[_ahead(track, leg, sample, preview)]
    here = PathProgress(progress.leg, sample)
    if track.robot.holonomic:
        return _holonomic(track, leg, here, speed, across, error, bend)
    k = s.stiffness
    signed = -speed if leg.kind == REVERSE else speed
    turn = signed * bend - k * k * signed * across * _sinc(error) - 2.0 * k * speed * error
    rate = 1.3 * s.turn_rate
    return Steering(signed, 0.0, float(np.clip(turn, -rate, rate)), here, abs(across))


def _holonomic(
    track: PathTrack,
    leg: PathLeg,
    progress: PathProgress,
    speed: float,
    across: float,
    error: float,
    bend: float,
) -> Steering:
    """Steering along the path's direction, and straight back to the path after a deviation."""
    direction = _direction(track, leg, progress.sample)
    heading = float(track.path.axle_poses[progress.sample, 2]) + error
    off = -across if leg.kind == REVERSE else across
    side = float(np.clip(-track.settings.stiffness * off, -0.25, 0.25))
    c, s = math.cos(direction - heading), math.sin(direction - heading)
    forward, left = speed * c - side * s, speed * s + side * c
    limit = track.settings.sideways
    shrink = min(1.0, limit / abs(left)) if left else 1.0
    signed = -speed if leg.kind == REVERSE else speed
    turn = signed * bend - 3.0 * error
    rate = 1.3 * track.settings.turn_rate
    return Steering(
        forward * shrink, left * shrink, float(np.clip(turn, -rate, rate)), progress, abs(across)
    )


def _speed(
    track: PathTrack, sample: int, along: float, left_over: float, across: float, error: float
) -> float:
    """Speed of the profile, m/s, less where the robot is off the path or close to a stop."""
    s = track.settings
    last = len(track.speed) - 1
    step = max(track.distance[min(sample + 1, last)] - track.distance[sample], 1e-9)
    share = min(1.0, max(0.0, along / step))
    planned = (1 - share) * track.speed[sample] + share * track.speed[min(sample + 1, last)]
    off = max(0.0, 1.0 - abs(across) / 0.15 - abs(error) / 0.5)
    braking = s.braking * track.robot.max_acceleration
    stop = min(math.sqrt(2.0 * braking * max(0.0, left_over)), 2.0 * max(0.0, left_over) + 0.02)
    return float(min(max(planned * off, s.creep), stop))


def _nearest(track: PathTrack, leg: PathLeg, sample: int, axle: Pose) -> int:
    first = max(sample, leg.first)
    ahead = track.path.axle_poses[first : min(first + SAMPLES_AHEAD, leg.last + 1)]
    return first + int(np.argmin(np.hypot(ahead[:, 0] - axle[0], ahead[:, 1] - axle[1])))


def _errors(track: PathTrack, leg: PathLeg, sample: int, axle: Pose) -> tuple[float, float, float]:
    """Distance past the sample along the motion and to its left, metres, and the heading error."""
    x, y, heading = track.path.axle_poses[sample]
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


def _direction(track: PathTrack, leg: PathLeg, sample: int) -> float:
    """Direction of motion at a sample, radians."""
    heading = float(track.path.axle_poses[sample, 2])
    if leg.kind == REVERSE:
        return heading + math.pi
    if leg.kind == SIDEWAYS:
        left = track.path.moves[track.path.move_of[min(sample, leg.last - 1)], 1]
        return heading + math.copysign(math.pi / 2, left)
    return heading


def _ahead(track: PathTrack, leg: PathLeg, sample: int, distance: float) -> int:
    there = int(np.searchsorted(track.distance, track.distance[sample] + distance))
    return min(max(sample, there), leg.last - 1)


def _strayed(track: PathTrack, distance: float, velocity: Twist) -> float:
    """Deviation of a robot from the place at which it should turn, metres.

    While the robot brakes, the distance that braking needs is left out. Once it stands, every
    centimetre counts more, because the turn was tested at that place alone.
    """
    speed = math.hypot(velocity[0], velocity[1])
    if speed > 0.05:
        return max(0.0, distance - speed * speed / (1.6 * track.robot.max_acceleration))
    return distance * track.settings.lost / track.settings.lost_at_turn


def _towards(axle: Pose, place: tuple[float, float]) -> tuple[float, float]:
    """Velocity (forward, left) back to a place, m/s: its offset, to be driven within a second."""
    dx, dy = place[0] - axle[0], place[1] - axle[1]
    c, s = math.cos(axle[2]), math.sin(axle[2])
    return c * dx + s * dy, c * dy - s * dx


def _sinc(angle: float) -> float:
    return math.sin(angle) / angle if abs(angle) > 1e-6 else 1.0
