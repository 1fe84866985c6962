"""The parts of the physics: walls, a robot's body and the joints that drive it."""

from __future__ import annotations

import pymunk
from pymunk.constraints import GearJoint, PivotJoint

from semnav_env.robots import RobotSpec
from semnav_env.world.maps.placement import corners
from semnav_env.world.physics.walls import add_walls
from semnav_features.frames import FloatArray, Pose, to_parent

SLOP = 1e-3
"""Largest overlap of shapes at rest, metres."""

OVERLAP_LEFT = 0.7**60
"""Share of a deeper overlap that is left after a second: 0.7 of it after each substep."""

GRIP = 0.7
"""Friction between tyres or feet and the floor; it bounds the force of a robot."""

SCRAPE = 0.3
"""Friction between robots and walls."""

GRAVITY = 9.81
"""Acceleration of gravity, m/s^2."""


def solid_space(segments: FloatArray) -> pymunk.Space:
    """A space in which these segments are solid, shape (n, 4): x1, y1, x2, y2 in metres."""
    space = pymunk.Space()
    space.collision_slop = SLOP
    space.collision_bias = OVERLAP_LEFT
    add_walls(space, segments)
    return space


def vacant_space(segments: FloatArray, last: pymunk.Space | None) -> pymunk.Space:
    """A space with only the solid segments; it behaves like a new one, to the last bit.

    Args:
        segments: as in `solid_space`.
        last: a space with the same segments that is no longer needed, which is cleared and taken.
    """
    if last is None:
        return solid_space(segments)
    bodies = last.bodies
    shapes = [shape for body in bodies for shape in body.shapes if shape.space is last]
    last.remove(*last.constraints, *shapes, *bodies)
    last._removed_shapes.clear()  # kept for callbacks until Pymunk's own next step
    return last


def robot_body(robot: RobotSpec, start: Pose) -> tuple[pymunk.Body, pymunk.Shape]:
    """A body whose origin and centre of gravity are the axle's middle, centre at `start`."""
    body = pymunk.Body(robot.mass, _inertia(robot))
    put_body(robot, body, start)
    shape = pymunk.Poly(body, [(x - robot.axle, y) for x, y in corners(robot).tolist()])
    shape.friction = SCRAPE
    return body, shape


def put_body(robot: RobotSpec, body: pymunk.Body, pose: Pose) -> None:
    """Put a robot's body where its footprint's centre is at `pose`."""
    body.position = to_parent(pose, (robot.axle, 0.0))
    body.angle = pose[2]


def driving_joints(
    robot: RobotSpec, control: pymunk.Body, body: pymunk.Body
) -> tuple[PivotJoint, GearJoint]:
    """Joints that match velocities with bounded force and never correct positions."""
    pivot = PivotJoint(control, body, (0.0, 0.0), (0.0, 0.0))
    gear = GearJoint(control, body, 0.0, 1.0)
    pivot.max_bias = gear.max_bias = 0.0
    pivot.max_force, gear.max_force = _grip(robot)
    return pivot, gear


def joint_accelerations(robot: RobotSpec) -> tuple[float, float]:
    """Largest accelerations for which the joints have the force, m/s^2 and rad/s^2."""
    force, torque = _grip(robot)
    return force / robot.mass, torque / _inertia(robot)


def _grip(robot: RobotSpec) -> tuple[float, float]:
    """The largest force and torque of the joints, N and N m."""
    force = GRIP * GRAVITY * robot.mass
    return force, force * robot.width / 2


def _inertia(robot: RobotSpec) -> float:
    """About the axle's middle, kg m^2."""
    return robot.mass * ((robot.length**2 + robot.width**2) / 12.0 + robot.axle**2)
