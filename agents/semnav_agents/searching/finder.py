"""An agent that carries out all clauses, those to find people among them, in a house it knows."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.pilot_rules import REACH_TOLERANCE
from semnav_agents.planning.guard import GUARD_REACH, GuardedBody, safe_share
from semnav_agents.planning.known_obstacles import JoinedObstacles, Obstacles, as_obstacles
from semnav_agents.planning.perception import Perception
from semnav_agents.planning.planner import PlannerSettings
from semnav_agents.scripted import with_felt_walls
from semnav_agents.searching.agent import (
    CAREFUL_PLANNER,
    NO_DOORS,
    STUCK_PLANNER,
    PlanSearcher,
    goal_at,
    people_of,
)
from semnav_agents.searching.finding_tasks import (
    FaceTask,
    FindingTask,
    LookTask,
    Percepts,
    PersonTask,
    SearchTask,
)
from semnav_agents.searching.house_plan import numbers_of, room_entered
from semnav_env.language import (
    CLAUSE_FEATURES,
    MAX_CLAUSES,
    AskName,
    Clause,
    Command,
    GoToPerson,
    LookAround,
    SearchHouse,
    SearchRoom,
    decode,
)
from semnav_env.mind.grounding.goal import GoalKind
from semnav_env.mind.observations import (
    EntryObservation,
    ObservationType,
    PaceEntry,
    SeenGoal,
    read_odometry,
    read_pace,
    table,
)
from semnav_env.rescue.microphones import USUAL_MICROPHONES, MicrophoneSettings
from semnav_env.rescue.people_entry import PeopleEntry
from semnav_env.rescue.voices_entry import VoicesEntry, read_voices
from semnav_env.robots.actions import shares_of
from semnav_features.frames import (
    FloatArray,
    Point,
    Pose,
    Twist,
    compose,
    points_to_parent,
    to_parent,
)

ALONE = np.zeros(1, np.int64)
"""The number of the only robot that a `Finder` drives."""

RECENT_SCAN_DISTANCE = 3.0
"""Distance within which obstacles are those of recent scans, metres: there the map of the whole
house is off by the drift since it was made."""

PRESENT_SCAN_DISTANCE = 1.0
"""Distance within which hits of the present scan count by themselves, metres: what is remembered is
a mean, which lags behind the drift."""

USUAL_PLANNER = PlannerSettings()
"""Planner settings of the way between clauses to find people, as `ScriptedAgent` has them."""


class Finder(PlanSearcher):
    """Drives like `ScriptedAgent`, and finds people like `PlanSearcher`.

    It hears the command by its tokens. It knows walls, doors and rooms of the plan, but neither
    furniture nor people. One pilot drives all ways, among the same obstacles: those of recent scans
    nearby, those of the map of the house farther off, and the walls that were not seen yet.
    """

    @property
    def observation(self) -> str | ObservationType:
        """All entries, the pace, the people and the voices."""
        return EntryObservation("all", (PaceEntry(), PeopleEntry(), VoicesEntry()))

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode with the body, the lidar and the detector of `info`."""
        super().reset(info)
        self._perception = Perception(1)
        self._perception.reset(0, self._pilot.robot.lidar_mount, self._lidar)
        told = info.get("microphones")
        self._microphones = MicrophoneSettings(**told) if told else USUAL_MICROPHONES
        self._command: Command | None = None
        self._under_way: tuple[int, GoalKind] | None = None
        self._task: FindingTask | None = None
        self._visited: list[Point] = []

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action."""
        observation = self._localised(observation)
        pose, velocity = read_odometry(observation)
        self._see(pose, observation["scan"])
        self._perception.update(observation["odometry"][None], observation["scan"][None], ALONE)
        goal = SeenGoal.read(observation["goal"])
        task = self._current_task(observation, goal)
        seen = Percepts(people_of(observation, pose), read_voices(observation, pose))
        step = None if task is None else task.next_step(pose, seen)
        self._pilot.tolerance = REACH_TOLERANCE if step is None else step.tolerance
        if step is None or (goal.kind is not GoalKind.STOP and step.is_idle):
            self._task = None
            doors = table(observation, "remembered_doors").astype(np.float64)
            return self._go(observation, goal, doors, USUAL_PLANNER)
        if step.yaw_rate:
            return self._turn(self.obstacles(observation), step.yaw_rate, pose, velocity)
        planner = CAREFUL_PLANNER if step.careful else STUCK_PLANNER
        return self._go(observation, goal_at(step.target, pose), NO_DOORS, planner)

    @property
    def recent(self) -> Obstacles:
        """What recent scans have shown, odometry frame."""
        return self._perception.obstacles(0)

    def obstacles(self, observation: Observation) -> Obstacles:
        """What is known to stand around, odometry frame."""
        pose, _ = read_odometry(observation)
        here, house = np.array(pose[:2]), self._points(observation, pose)
        beyond = np.hypot(*(house - here).T) > RECENT_SCAN_DISTANCE
        ranges = observation["scan"].astype(np.float64)
        near = (ranges > 0.0) & (ranges < PRESENT_SCAN_DISTANCE)
        eye = compose(pose, self._pilot.robot.lidar_mount)
        hits = points_to_parent(eye, ranges[near, None] * self._beams[near])
        sure = np.vstack((house[beyond], self._unseen, hits))
        known = JoinedObstacles((self.recent, as_obstacles(sure)))
        return with_felt_walls(known, observation, pose)

    def _go(
        self,
        observation: Observation,
        goal: SeenGoal,
        doors: FloatArray,
        planner: PlannerSettings,
    ) -> NDArray[np.float32]:
        """The action that leads to a goal."""
        pose, velocity = read_odometry(observation)
        self._pilot.driver.planner = planner
        moving = self._perception.moving(0, pose, observation["scan"])
        known, pace = self.obstacles(observation), read_pace(observation)
        return self._pilot.act(known, doors, goal, pose, velocity, moving, pace)

    def _turn(
        self, obstacles: Obstacles, yaw_rate: float, pose: Pose, velocity: Twist
    ) -> NDArray[np.float32]:
        """The action that turns on the spot, slower or not at all where the body would touch."""
        robot = self._pilot.robot
        near = obstacles.near(pose, GUARD_REACH * robot.length)
        share = safe_share(near, (0.0, 0.0, yaw_rate), velocity, GuardedBody.of(robot))
        return shares_of((0.0, 0.0, share * yaw_rate), robot)

    def _current_task(self, observation: Observation, goal: SeenGoal) -> FindingTask | None:
        """The task of the clause that the robot believes to be active; None if it only drives."""
        if self._command is None:
            rooms = self._known_plan.room_names
            tokens = observation["command"].reshape(MAX_CLAUSES, CLAUSE_FEATURES)
            self._command = decode(tokens.astype(np.int64), rooms)
        active = observation["clause"]
        under_way = (int(np.argmax(active)), goal.kind) if active.any() else None
        if under_way != self._under_way:
            self._under_way, self._task = under_way, None
            if under_way is not None:
                clause, motion = self._command.clauses[under_way[0]], read_odometry(observation)
                if goal.kind is GoalKind.STOP:
                    self._task = self._new_task(clause, *motion)
                elif isinstance(clause, SearchRoom) and goal.door is not None:
                    self._task = self._facing(goal.door, motion[0])
        return self._task

    def _facing(self, door: tuple[Point, Point], pose: Pose) -> FindingTask | None:
        """To face the door of a room that is to be searched, if it lies behind the robot."""
        (x1, y1), (x2, y2) = door
        middle = (x1 + x2) / 2, (y1 + y2) / 2
        if middle[0] >= 0.0:
            return None
        return FaceTask(self._chart, self._looker, pose, to_parent(pose, middle))

    def _new_task(self, clause: Clause, pose: Pose, velocity: Twist) -> FindingTask | None:
        match clause:
            case SearchHouse():
                return SearchTask(self._chart, self._looker, None)
            case SearchRoom():
                room = self._room_of(clause, pose, velocity)
                return SearchTask(self._chart, self._looker, room)
            case LookAround():
                return LookTask(self._chart, self._looker, pose)
            case GoToPerson() | AskName():
                own = self._chart, self._looker, self._microphones, self._visited
                return PersonTask(*own, again=isinstance(clause, AskName))
        return None

    def _room_of(self, clause: SearchRoom, pose: Pose, velocity: Twist) -> int:
        """The number of the room to search: the named one, or that which the robot enters."""
        numbers = numbers_of(self._known_plan, clause.room.name if clause.room else None)
        return room_entered(self._chart, numbers, pose, velocity, self._pilot.robot.width)
