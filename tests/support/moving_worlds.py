"""Worlds in which others move, and how deep anything in them overlaps."""

from __future__ import annotations

import math

import numpy as np
import shapely

from semnav_env.robots import ROBOTS
from semnav_env.world.dynamics import Dynamics, PlanSource
from semnav_env.world.maps.placement import footprint, sample_pose
from semnav_env.world.physics import World
from tests.support.driving import random_commands

EPISODE = 250
"""Steps after which the world is reset."""


def world_of(plan: str, robot: str, dynamics: Dynamics) -> World:
    body = ROBOTS[robot]
    return World(PlanSource(plan, dynamics, body).plan(), body, dynamics=dynamics)


def deepest_overlap(world: World) -> float:
    """How deep robot, people, leaves and walls are in each other, metres."""
    assert world.moving is not None
    discs = world.moving.discs
    body, people = footprint(world.robot, world.pose), shapely.points(discs[:, :2])
    leaves = shapely.linestrings(world.moving.segments.reshape(-1, 2, 2))
    walls = shapely.linestrings(world.still.segments.reshape(-1, 2, 2))
    solid = np.concatenate((walls, leaves))
    radii = discs[:, 2]
    apart = np.hypot(*(discs[:, None, :2] - discs[None, :, :2]).transpose(2, 0, 1))
    np.fill_diagonal(apart, math.inf)
    depths = [
        (radii - shapely.distance(body, people)).max(initial=0.0),
        (2.0 * radii - apart).max(initial=0.0),
        (radii[:, None] - shapely.distance(people[:, None], solid[None])).max(initial=0.0),
    ]
    hit = solid[shapely.intersects(body, solid)]
    return max(*map(float, depths), *(_depth(body, line) for line in hit), 0.0)


def _depth(body: shapely.Polygon, line: shapely.LineString) -> float:
    """By how much the body would have to shrink to be free of the line, to half a millimetre."""
    depth = 0.0
    while body.buffer(-depth, join_style="mitre").intersects(line):
        depth += 0.0005
    return depth


def drive_about(world: World, steps: int, seed: int) -> tuple[float, int]:
    """Deepest overlap over random driving, and in how many steps the robot touched something."""
    rng, deepest, touched = np.random.default_rng(seed), 0.0, 0
    for step, command in enumerate(random_commands(seed, steps)):
        if step % EPISODE == 0:
            world.reset(sample_pose(world.floor_plan, world.robot, rng), rng)
        world.step(command)
        assert world.moving is not None
        assert all(map(math.isfinite, (*world.pose, *world.velocity)))
        assert np.isfinite(world.moving.discs).all()
        deepest, touched = max(deepest, deepest_overlap(world)), touched + world.in_contact
    return deepest, touched
