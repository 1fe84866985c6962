"""One robot in one scene of the page: where it stands, and the run of its last command."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Any

from semnav_agents.base import PlanReader
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.language import Command
from semnav_env.rendering.film import STEPS_PER_FRAME
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.snapshot import snapshot
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.dynamics.boxes import box_corners, check_box_place
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.floor_plan import Material, Surface
from semnav_features.frames import Point, Pose
from semnav_scripts.page.frame_message import frame_message
from semnav_scripts.page.plan_message import body_message, plan_message
from semnav_scripts.page.requests import MAX_BOXES, OWN, SceneRequest

BY_HAND_ONLY = sys.float_info.min
"""Probability of a door to change by itself: above 0, so that leaves hang, and never drawn."""

MAX_FILM_FRAMES = 800
"""The most frames of a film that are kept, each of `STEPS_PER_FRAME` steps: 160 s."""


class PageDrive:
    """A robot, its world and its agent, which carry out one command after the other.

    Args:
        scene: what to build.
        own_plan: the floor plan that the scene means by "own"; None if there is none.

    Raises:
        ValueError: there is no such floor plan, or robot or people find no room in it.

    Attributes:
        floor_plan: the plan with its boxes, before leaves are hung into its doors.
        env: the environment.
        start: pose at which every command begins, world frame.
        suggestion: a command that can be carried out from there.
        info: the last `info` of the environment.
        said: text, language and meaning of the last command; None before the first.
        over: whether the run has ended, or none has begun.
        frames: of the film of the run.
    """

    def __init__(self, scene: SceneRequest, own_plan: FloorPlan | None = None) -> None:
        self.scene = scene
        self._agent = make_agent(scene.agent)
        self.floor_plan = _with_boxes(_plan_of(scene, own_plan), scene.boxes)
        self.env = SemNavEnv(
            scene.robot,
            self.floor_plan,
            observation=self._agent.observation,
            dynamics=Dynamics(
                pedestrians=scene.people,
                changing_doors=BY_HAND_ONLY if scene.leaves else 0.0,
                by_hand=MAX_BOXES,
            ),
        )
        options = None if scene.pose is None else {"pose": scene.pose}
        _, self.info = self.env.reset(seed=scene.seed, options=options)
        self.start: Pose = self.info["pose"]
        self.suggestion: str = self.info["command"]
        self.said: tuple[str, str, Command] | None = None
        self.over, self.frames = True, list[Frame]()
        self._trail: list[Point] = []
        self._seen: Frame | None = None

    def begin(self, text: str, command: Command, language: str) -> None:
        """Begin the run of a command at the start of the scene.

        Args:
            text: what was said.
            command: what it means.
            language: of the speaker, "en" or "de".

        Raises:
            ValueError: it cannot be carried out from there (`GroundingError`).
        """
        self.over = True
        told = {"command": command, "language": language, "pose": self.start}
        self._observation, self.info = self.env.reset(seed=self.scene.seed, options=told)
        if isinstance(self._agent, PlanReader):
            self._agent.read_plan(self.env.floor_plan)
        self._agent.reset(self.info)
        self.said = text, language, command
        self.over, self._steps, self._trail = False, 0, [self.start[:2]]
        self._seen = None
        self.frames = [self._snapshot()]

    def step(self) -> None:
        """Let the agent drive for one control period."""
        action = self._agent.act(self._observation)
        self._observation, _, terminated, truncated, self.info = self.env.step(action)
        self.over = terminated or truncated
        self._steps, self._seen = self._steps + 1, None
        self._trail.append(self.info["pose"][:2])
        due = self.over or self._steps % STEPS_PER_FRAME == 0
        if due and len(self.frames) < MAX_FILM_FRAMES:
            self.frames.append(self._snapshot())

    def stop(self) -> None:
        """End the run where the robot is."""
        self.over = True

    def frame(self) -> dict[str, Any]:
        """The present moment as a message."""
        return frame_message(self.env, self._snapshot())

    def _snapshot(self) -> Frame:
        """The present moment; made once, although it may be filmed and shown."""
        if self._seen is None:
            self._seen = snapshot(self.env, self._trail or [self.start[:2]])
        return self._seen

    def shut(self, door: str, shut: bool) -> None:
        """Shut a door by hand, or open it; it stays so until the next command.

        Raises:
            ValueError: it has no leaf that can swing.
        """
        if door not in self.swinging:
            known = ", ".join(self.swinging) or "none"
            raise ValueError(f"door is {door!r:.80}; doors with a leaf that can swing: {known}")
        self.env.world.hold_door(door, shut)

    def put(self, what: str, place: Point, heading: float | None = None) -> None:
        """Put down a box, let a person walk from a place, or carry the robot there.

        Box and person stay until the next command. Each is sensed in the next step.

        Args:
            what: "box", "person" or "robot".
            place: of its middle, metres.
            heading: of the robot, radians; as it is if None.

        Raises:
            ValueError: nothing drives, or the place is not free.
        """
        if self.over:
            raise ValueError("nothing drives; give a command first")
        world = self.env.world
        match what:
            case "box":
                world.add_box(place)
            case "person":
                world.add_person(place)
            case _:
                world.place_robot((*place, world.pose[2] if heading is None else heading))

    @property
    def swinging(self) -> tuple[str, ...]:
        """Names of the doors that can be shut."""
        moving = self.env.world.moving
        return () if moving is None else tuple(leaf.door for leaf in moving.doors.leaves)

    @property
    def control_hz(self) -> float:
        """Steps in a simulated second."""
        return self.env.setup.control_hz

    def scene_message(self) -> dict[str, Any]:
        """The scene as the page draws it, and what can be asked to bring it back."""
        asked = {**vars(self.scene), "boxes": [list(box) for box in self.scene.boxes]}
        return {
            "type": "scene",
            "scene": asked,
            "plan": plan_message(self.env.world.still, self.swinging),
            "body": body_message(self.env.robot),
            "start": [round(value, 3) for value in self.start],
            "suggestion": self.suggestion,
        }


def _plan_of(scene: SceneRequest, own_plan: FloorPlan | None) -> FloorPlan:
    """The floor plan of a scene, without boxes.

    Raises:
        ValueError: there is none, or none in which a robot could start.
    """
    plan = own_plan if scene.plan == OWN else load_floor_plan(scene.plan)
    if plan is None:
        raise ValueError("there is no floor plan of yours; drop a file, or draw on another plan")
    if not plan.corridors:
        raise ValueError(f"{plan.name} has no corridor, where a robot could start; draw one")
    return plan


def _with_boxes(plan: FloorPlan, places: tuple[Point, ...]) -> FloorPlan:
    """The plan with a box at each place; itself without places.

    Raises:
        ValueError: a box would not stand on free floor.
    """
    if not places:
        return plan
    for place in places:
        check_box_place(plan, place)
    outlines = (box_corners(place).tolist() for place in places)
    boxes = (
        Surface(tuple((x, y) for x, y in (*outline, outline[0])), Material.FURNITURE)
        for outline in outlines
    )
    return replace(plan, surfaces=(*plan.surfaces, *boxes))
