"""The Gymnasium environment, which connects simulator, belief tracker, judge and renderer."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from semnav_env import language
from semnav_env.control_period import RobotLoop, ends, info_of
from semnav_env.gym_env import GymnasiumEnv, takes_plain_settings
from semnav_env.judge import Judge, Mission, tasks
from semnav_env.judge.payload import Payload, as_payload
from semnav_env.mind.belief import Belief, BeliefTracker
from semnav_env.mind.observations import (
    EntryObservation,
    Moment,
    ObservationType,
    as_observation,
    check_observation,
)
from semnav_env.rendering.renderer import Renderer
from semnav_env.robots import RobotSpec, robot_spec
from semnav_env.robots.actions import Actions
from semnav_env.rules import Rules, with_doors_of
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics, PlanSource
from semnav_env.world.maps import FloorPlan
from semnav_env.world.physics import World
from semnav_env.world.simulator import OdometrySettings, RobotSetup, Simulator, odometry_settings
from semnav_features import ExtractorSettings
from semnav_features.frames import ORIGIN
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import lidar_spec
from semnav_features.one_thread import for_one_thread
from semnav_features.scene import Scene


class SemNavEnv(GymnasiumEnv[Any]):
    """A robot in an office carries out a command in natural language.

    ## Description
    A wheelchair or a SPOT robot gets a command ("go down the hallway, turn left at the
    intersection and go in the first door on the right"). It has a 2D lidar and drifting odometry.
    Walls, doors, corners and corridors are found in each scan and remembered, and the command is
    grounded on what was seen, never on the floor plan. A judge, which knows the floor plan, says
    clause by clause whether the command was carried out.

    ## Action Space
    `Box(-1, 1, (2,), float32)` for the wheelchair, `Box(-1, 1, (3,), float32)` for SPOT: shares of
    the largest speeds of the robot (`RobotSpec`).

    - first: forward speed; below 0 the robot drives backward;
    - second, only SPOT: speed to the left;
    - last: yaw rate, counter-clockwise.

    Values outside are clipped; NaN, infinity and other shapes raise `ValueError`. Accelerations are
    bounded by the robot.

    ## Observation Space
    A `Dict` of flat arrays, which `semnav_env.mind.observations.layout` declares; lengths in
    metres, features and goal in the robot frame (x forward, y left, origin at the centre of the
    footprint).
    NAME_mask says which rows count; `observations.table(observation, "walls")` gives these rows.

    - walls, doors, corners, corridors: features of this scan; scan: its ranges, the lidar's range
      for a missing return; remembered_doors: remembered doors that count; bumps: walls that the
      robot bumped into and that the lidar does not show.
    - command: tokens, see `language.encode`; clause: the clause that the robot believes to be
      active; odometry: believed pose and velocity; goal: the target to drive to now.

    `observation="semantic"` has all entries except the scan; `"raw"` has scan, command, clause and
    odometry; `"all"` has all of these. `"truth"` is "semantic" without errors: features of an
    exact scan, the true pose (world frame) as odometry, and the goal grounded on the floor plan.
    `"command"` is for policies that hear the command: it has the robot's memory, but neither goal
    nor clause. Other observations are made by an object with `space(robot, lidar)` and
    `observe(moment)`, and by `EntryObservation(mode, extra)`.

    ## Rewards
    The sum of the terms in `info["reward_terms"]`, by default (`RewardWeights`)

    - progress: 1 for each metre by which the shortest path to the goal of the clause shrinks;
    - clause: 2 when a clause was carried out; success: 10 when all were;
    - failure: -5 at a wrong door or turn, or after standing still too long;
    - contact: -0.1 and time: -0.01, each step in which the robot touches something, each step.

    `AddedTerms` adds terms; an object with `terms(tick)` replaces all of them.

    ## Starting State
    `reset(options=...)` takes "command" (text or `Command`), its "language", "ask" (answers the
    question about an ambiguous text), "implicit_steps" (or not), "pose" (x, y, heading; world
    frame) and "floor_plan", or "episode", an `Episode` or the id of one of `episodes`; without
    options the task decides. Values that are not given are drawn: a free pose in a corridor, facing
    along it, and a command that can be carried out from there.

    ## Episode End
    - Termination: the command is carried out, at a wrong door or turn, and after 10 s of standing
      still ("stopped short").
    - Truncation: after `max_seconds` of simulated time.

    Contacts end no episode; `info["collisions"]` counts them.

    ## Arguments
    - robot: "wheelchair", "spot" or a `RobotSpec`.
    - floor_plan: a name, a path or a `FloorPlan`; "heidelberg_hallway" if it is not given.
    - observation: a mode, see above, or an observation type.
    - lidar: the name of a lidar, such as "tim561" or "rplidar_a1", or a `LidarSpec`; its rate is
      the control rate.
    - odometry: errors of dead reckoning: "usual", "exact", "wheelchair", "spot" or an
      `OdometrySettings`.
    - extractor: limits of the extractor.
    - corrects_drift: whether walls that are seen again correct odometry.
    - rewards: `RewardWeights`, or an object with `terms(tick)`.
    - dynamics: people, doors and furniture that move.
    - payload: a `Payload`, such as a person detector.
    - task: a command, a list of commands, or a `Task`.
    - episodes: frozen episodes instead of a task: the name of a split, a file, or `Episode`s.
    - rules: what a door is, how words are grounded and what success is, for robot and judge.
    - max_seconds: time limit of an episode, simulated seconds.
    - render_mode: "rgb_array" or "human".

    ## Vectorized Environment
    `gymnasium.make_vec(..., vectorization_mode="vector_entry_point")` makes a `SemNavVectorEnv`:
    many robots in compiled calls, bit for bit as single environments.

    ## Version History
    - v0: the first version.

    ## References
    CITATION.cff names the works that features, grounding and poses before doors build on.
    """

    rules: Rules
    extractor: ExtractorSettings
    corrects_drift: bool
    rewards: tasks.Rewards
    payload: Payload | None
    episode_source: tasks.EpisodeSource
    observation_type: ObservationType
    usual: RobotSetup
    plan_source: PlanSource
    floor_plan: FloorPlan
    setup: RobotSetup
    robot: RobotSpec
    lidar_spec: LidarSpec
    simulator: Simulator
    world: World
    renderer: Renderer
    tracker: BeliefTracker
    judge: Judge
    instruction: str
    spoken: str | None
    tokens: NDArray[np.int64]
    loop: RobotLoop

    @takes_plain_settings
    def __init__(
        self,
        robot: str | RobotSpec = "wheelchair",
        floor_plan: str | FloorPlan | None = None,
        observation: str | ObservationType = "semantic",
        lidar: str | LidarSpec = "tim561",
        odometry: str | OdometrySettings = "usual",
        extractor: ExtractorSettings = ExtractorSettings(),
        corrects_drift: bool = True,
        rewards: tasks.Rewards = tasks.RewardWeights(),
        dynamics: Dynamics = NO_DYNAMICS,
        payload: Payload | None = None,
        task: object = None,
        episodes: tasks.Episodes | None = None,
        rules: Rules = Rules(),
        max_seconds: float = 120.0,
        render_mode: str | None = None,
    ) -> None:
        self.rules, self.extractor = with_doors_of(rules, extractor)
        self.corrects_drift, self.rewards = corrects_drift, tasks.as_rewards(rewards)
        self.payload = as_payload(payload)
        self.episode_source = tasks.EpisodeSource(task, episodes)
        self.observation_type = as_observation(observation)
        exact = bool(getattr(self.observation_type, "exact", False))
        sensors = lidar_spec(lidar), odometry_settings(odometry)
        self.usual = RobotSetup(robot_spec(robot), *sensors, exact)
        super().__init__(self.usual.control_hz, max_seconds, render_mode)
        plan = self.episode_source.usual_plan(floor_plan)
        self.plan_source = PlanSource(plan, dynamics, self.usual.robot)
        self._enter(self.plan_source.plan(), self.usual)
        self.action_space = self._actions.space
        self.observation_space = self.observation_type.space(self.robot, self.lidar_spec)

    @for_one_thread
    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode; see the class for `options`.

        Raises:
            ValueError: unknown options, a pose that is not free, a command that is not understood
                (`CommandError`) or cannot be carried out from there (`GroundingError`).
        """
        super().reset(seed=seed)
        self._started = False
        request = self.episode_source.next(options, self.np_random)
        floor_plan = self.plan_source.plan(request.floor_plan, request.pose, self.np_random)
        setup = self.usual.with_changes(request.robot, request.lidar, request.odometry)
        if floor_plan is not self.floor_plan or setup != self.setup:
            self._enter(floor_plan, setup)
        mission = self._missions.make(request, self.np_random)
        sensed = self.simulator.reset(mission.start, self.np_random)
        info = mission.info | setup.info | request.info
        self._begin(mission, info["instruction"])
        self.spoken = request.language
        self.loop.look()
        if self.payload is not None:
            self.payload.begin(self.floor_plan, self.setup, mission.start, self.np_random)
            self.payload.update(sensed.motion, self.tracker)
            info |= self.payload.start_info()
        observation = self.observe()
        self._started = True
        return observation, info

    @for_one_thread
    def step(self, action: ArrayLike) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Drive for one control period.

        Raises:
            ValueError: the action is not finite or has another shape.
            RuntimeError: before the first `reset`, or while another thread is in `reset` or `step`.
        """
        self._require_reset("step")
        period = self.loop.drive(self._actions.twist(action))
        terms = self.loop.terms(self.rewards, period, action)
        terminated, truncated = ends(period, self.max_steps)
        ended = self.conclude(truncated) if terminated or truncated else {}
        info = info_of(period, self.judge.verdicts) | {"reward_terms": terms, **ended}
        self.renderer.note(self, period.pose)
        return self.observe(), sum(terms.values()), terminated, truncated, info

    def observe(self) -> Any:
        """Return a new observation from the robot's present pose.

        Raises:
            ValueError: an observation of the user's own type is not in its space.
        """
        observation = self.observation_type.observe(self.moment)
        if type(self.observation_type) is not EntryObservation:  # which checks its own entries
            check_observation(observation, self.observation_space)
        return observation

    @property
    def moment(self) -> Moment:
        """The data of this step from which observations are made."""
        told = self.tokens, self.instruction, self.simulator.see, self.payload
        return Moment(self.tracker, *told)

    def conclude(self, truncated: bool) -> dict[str, Any]:
        """End the episode, and return the entries of `info` that are added at its end."""
        ended = self.judge.conclude(truncated) | self.world.social()
        self.episode_source.note(ended["is_success"])
        ended |= {} if self.payload is None else self.payload.final_info()
        return ended | {"impossible": self.belief.impossible}

    def render(self) -> NDArray[np.uint8] | None:
        """Return the picture, shape (height, width, 3), or show it in a window in "human" mode.

        Raises:
            RuntimeError: before the first `reset`.
        """
        self._require_reset("render")
        return self.renderer.draw(self)

    def close(self) -> None:
        """Close the window, if any."""
        self.renderer.close()

    @property
    def belief(self) -> Belief:
        """The robot's present belief."""
        return self.tracker.belief

    @property
    def seconds(self) -> float:
        """Simulated time since the start of the episode, seconds."""
        return self.simulator.steps / self.setup.control_hz

    def _enter(self, floor_plan: FloorPlan, setup: RobotSetup) -> None:
        """Make the objects that depend on the floor plan and the robot.

        A tracker without a floor plan behaves like a new one after `begin`, so it may be kept.
        """
        may_stay = not setup.exact and self.__dict__.get("setup") == setup
        self.floor_plan, self.setup = floor_plan, setup
        self.robot, self.lidar_spec = setup.robot, setup.lidar
        self.simulator = Simulator(floor_plan, setup, self.plan_source.dynamics)
        self.world = self.simulator.world
        self._missions = tasks.MissionMaker(floor_plan, setup.robot, self.rules)
        self._actions = Actions(setup.robot)
        self.renderer = Renderer(self.world.still)
        if not may_stay:
            self.tracker = self._new_tracker()

    def _new_tracker(self, known_scene: Scene | None = None) -> BeliefTracker:
        setup = self.setup
        return BeliefTracker(
            setup.lidar,
            setup.robot.lidar_mount,
            self.extractor,
            corrects_drift=self.corrects_drift and not setup.exact,
            known_scene=known_scene,
            rules=self.rules,
            observes_features=getattr(self.observation_type, "observes_features", True),
        )

    def _begin(self, mission: Mission, instruction: str) -> None:
        """Give a mission to the judge, and its command to the robot."""
        self.judge, self.instruction = Judge(mission, self.payload), instruction
        self.tokens = language.encode(mission.command, self.floor_plan.room_names)
        odometry_frame = ORIGIN if self.setup.exact else mission.start
        if self.setup.exact:
            self.tracker = self._new_tracker(mission.scene)
        self.tracker.begin(mission.command, mission.ways_seen_from(odometry_frame))
        self.loop = RobotLoop(self.simulator, self.tracker, self.judge, self.payload)
        self.renderer.begin(mission.start)
