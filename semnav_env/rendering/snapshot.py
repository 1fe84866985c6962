"""Collects the contents of the picture of an environment at one moment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from semnav_env.judge import Judge, Verdict
from semnav_env.judge.payload import Payload, PayloadMarks
from semnav_env.language.command import reference_of
from semnav_env.language.language import Language
from semnav_env.language.references import DoorReference
from semnav_env.mind.belief import Belief, BeliefTracker
from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal
from semnav_env.mind.observations import ObservationType
from semnav_env.mind.observations.cloud_entry import rig_of
from semnav_env.rendering.depth_layer import cloud_on_the_map, jambs_on_the_map
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.picture_words import label, spoken_language
from semnav_env.robots import RobotSpec
from semnav_env.world.physics import World
from semnav_env.world.simulator import Simulator
from semnav_features.clouds import PointCloud
from semnav_features.extraction import to_scene
from semnav_features.frames import ORIGIN, Point, Pose, compose, points_to_parent, relative
from semnav_features.scene import Door, Scene

NO_MARKS = PayloadMarks(np.zeros((0, 2)), np.zeros((0, 2)), "")
"""Marks of a robot without a payload."""


class RenderedEnvironment(Protocol):
    """The parts of an environment that a picture shows."""

    render_mode: str | None
    tracker: BeliefTracker
    judge: Judge
    simulator: Simulator
    observation_type: ObservationType
    metadata: dict[str, Any]
    payload: Payload | None
    robot: RobotSpec
    world: World
    instruction: str
    spoken: str | None

    @property
    def belief(self) -> Belief:
        """The robot's belief."""
        ...

    @property
    def seconds(self) -> float:
        """Simulated time since the start of the episode."""
        ...


def snapshot(env: RenderedEnvironment, trail: Sequence[Point]) -> Frame:
    """The present moment of an episode as a frame, world frame."""
    tracker, judge, pose = env.tracker, env.judge, env.world.pose
    odometry_frame = compose(pose, relative(env.belief.pose, ORIGIN))
    lidar = compose(pose, tracker.mount)
    remembered = tracker.scene()
    people, leaves = env.world.moving_shapes
    rig = rig_of(env.observation_type)
    cloud = PointCloud() if rig is None else env.simulator.see(rig)
    marks = NO_MARKS if env.payload is None else env.payload.marks()
    language = spoken_language(env.instruction, env.spoken)
    return Frame(
        floor_plan=env.world.still,
        robot=env.robot,
        pose=pose,
        lidar=lidar[:2],
        hits=points_to_parent(lidar, tracker.hits()),
        scene=to_scene(tracker.features).placed(lidar),
        remembered=remembered.placed(odometry_frame),
        door_numbers=door_numbers(remembered, tracker.follower),
        goal=_moved(tracker.follower.goal, odometry_frame),
        trail=np.array(trail),
        route=judge.mission.route,
        command=tuple(clause.say(language) for clause in judge.mission.command.clauses),
        language=language.code,
        active_clause=judge.follower.active,
        skipped=judge.follower.skipped,
        status=(*_status(env.seconds, env.judge, language), *filter(None, (marks.status,))),
        looked=marks.floor,
        flags=marks.flags,
        people=people.copy(),
        leaves=leaves.copy(),
        cloud=cloud_on_the_map(cloud, pose),
        jambs=jambs_on_the_map(cloud, tracker, pose),
        in_contact=env.world.in_contact,
        failed=judge.failure is not None,
    )


def door_numbers(scene: Scene, follower: Follower) -> dict[int, int]:
    """The numbers of a scene's doors as the active clause counts them, by index."""
    corridor = follower.goal.corridor
    if corridor is None:
        return {}
    clauses = follower.command.clauses
    clause = clauses[min(follower.active, len(clauses) - 1)]
    reference = reference_of(clause)
    side = reference.side if isinstance(reference, DoorReference) else None
    counted = doors_along(scene, corridor, side, follower.rules.grounding)
    order = {id(item.door): number for number, item in enumerate(counted, start=1)}
    return {i: order[id(d)] for i, d in enumerate(scene.doors) if id(d) in order}


def _moved(goal: Goal, frame: Pose) -> Goal:
    """The goal as the picture shows it, in the parent of its frame."""
    pose = compose(frame, goal.pose)
    match goal:
        case PassGoal(door=door) | ReachGoal(door=Door() as door):
            return replace(goal, pose=pose, door=Scene(doors=(door,)).placed(frame).doors[0])
        case _:
            return replace(goal, pose=pose)


_SETTLED = (Verdict.DONE, Verdict.SKIPPED, Verdict.PENDING)


def _status(seconds: float, judge: Judge, language: Language) -> tuple[str, ...]:
    current = next((v for v in judge.verdicts if v not in _SETTLED), Verdict.DONE)
    time = f"{seconds:.1f}".replace(".", language.decimal)
    return (
        f"t = {time} s   {label(current, language.code)}",
        f"{label('collisions', language.code)}: {judge.period.collisions}",
    )
