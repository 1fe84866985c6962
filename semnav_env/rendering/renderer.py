"""Writes down what an environment's picture shows, and has it drawn."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from semnav_env.belief import Belief, BeliefTracker
from semnav_env.commands.command import reference_of
from semnav_env.commands.references import DoorReference
from semnav_env.features.extract import to_scene
from semnav_env.features.frames import Point, Pose, compose, points_to_parent, relative
from semnav_env.features.scene import Door, Scene
from semnav_env.grounding.counted_doors import doors_along
from semnav_env.grounding.follower import Follower
from semnav_env.grounding.goal import Goal, PassGoal, ReachGoal
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.viewer import Viewer
from semnav_env.robots import RobotSpec
from semnav_env.tasks.judge import EpisodeJudge
from semnav_env.verifier import Verdict
from semnav_env.world import World


class RenderedEnvironment(Protocol):
    """What of an environment is shown."""

    tracker: BeliefTracker
    belief: Belief
    judge: EpisodeJudge
    metadata: dict[str, Any]

    @property
    def robot(self) -> RobotSpec:
        """The body."""

    @property
    def world(self) -> World:
        """The physics."""

    @property
    def seconds(self) -> float:
        """Simulated time since the start of the episode."""


class Renderer:
    """Makes the pictures of an environment; nothing is drawn or imported before the first one."""

    def __init__(self, floor_plan: FloorPlan) -> None:
        self._floor_plan = floor_plan
        self._viewer: Viewer | None = None
        self._trail: list[Point] = []

    def begin(self, start: Pose) -> None:
        """Start a new trail."""
        self._trail = [start[:2]]

    def note(self, pose: Pose) -> None:
        """Go on with the trail."""
        self._trail.append(pose[:2])

    def draw(self, env: RenderedEnvironment, mode: str) -> NDArray[np.uint8] | None:
        """The picture, or None in "human" mode, where it goes to a window."""
        if self._viewer is None:
            self._viewer = Viewer(self._floor_plan, fps=env.metadata["render_fps"])
        frame = self.frame(env)
        if mode == "human":
            self._viewer.show(frame)
            return None
        return self._viewer.draw(frame)

    def close(self) -> None:
        """Close the window, if any."""
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None

    def __getstate__(self) -> dict[str, Any]:
        """A picture is drawn anew after unpickling; windows do not travel."""
        return {**self.__dict__, "_viewer": None}

    def frame(self, env: RenderedEnvironment) -> Frame:
        """This moment of the episode, world frame."""
        tracker, verifier, pose = env.tracker, env.judge.verifier, env.world.pose
        odometry_frame = compose(pose, relative(env.belief.pose, (0.0, 0.0, 0.0)))
        lidar = compose(pose, tracker.mount)
        remembered = tracker.scene()
        people, leaves = env.world.moving_shapes
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
            trail=np.array(self._trail),
            route=verifier.mission.route,
            command=tuple(str(clause) for clause in verifier.mission.command.clauses),
            active_clause=verifier.follower.active,
            skipped=verifier.follower.skipped,
            status=_status(env.seconds, env.judge),
            people=people.copy(),
            leaves=leaves.copy(),
            in_contact=env.world.in_contact,
            failed=verifier.failure is not None,
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


def _status(seconds: float, judge: EpisodeJudge) -> tuple[str, ...]:
    current = [v for v in judge.verifier.verdicts if v not in _SETTLED]
    verdict = str(current[0]) if current else "done"
    return (
        f"t = {seconds:.1f} s   {verdict}",
        f"collisions: {judge.journey.collisions}",
    )
