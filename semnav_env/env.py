"""The environment: the one place where simulator, belief, judge and picture meet."""

from __future__ import annotations

import math
from numbers import Real
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from semnav_env.belief import Belief, BeliefTracker
from semnav_env.commands import encode
from semnav_env.dynamics import OFF, Dynamics, PlanSource
from semnav_env.features import ExtractorSettings
from semnav_env.features.frames import Pose
from semnav_env.features.lidar_spec import LidarSpec, lidar_spec
from semnav_env.features.validation import check_kind
from semnav_env.maps import FloorPlan
from semnav_env.observations import Moment, ObservationType, as_observation
from semnav_env.rendering.renderer import Renderer
from semnav_env.robots import RobotSpec, robot_spec
from semnav_env.robots.actions import Actions
from semnav_env.rules import Rules, with_doors_of
from semnav_env.simulator import OdometrySettings, RobotSetup, Sensed, Simulator
from semnav_env.tasks import (
    AdaptiveTask,
    EpisodeJudge,
    EpisodeRequest,
    Episodes,
    FrozenEpisodes,
    MissionMaker,
    Rewards,
    RewardWeights,
    Task,
    Tick,
    as_task,
    spelled_out,
)
from semnav_env.verifier import Mission
from semnav_env.world import World


class SemNavEnv(gym.Env[Any, NDArray[np.float32]]):
    """A robot in an office carries out a spoken-style command.

    ## Description
    A wheelchair or a SPOT robot stands in a floor plan and is told where to go ("go down the
    hallway, turn left at the intersection and go in the first door on the right"). It has a 2D
    lidar and drifting odometry. Each scan is turned into walls, doors, corners and corridors, these
    are remembered, and the command is grounded on what was seen, never on the map. A verifier that
    does know the map says clause by clause whether the command was carried out.

    ## Action Space
    `Box(-1, 1, (2,))` for the wheelchair: forward speed and turn rate, as shares of the robot's
    largest; `Box(-1, 1, (3,))` for SPOT: forward, left, turn. Values outside are clipped; NaN,
    infinity and other shapes raise `ValueError`. Accelerations are bounded by the robot.

    ## Observation Space
    A `Dict` of flat arrays; lengths in metres, features and goal in the robot frame (x forward,
    y left, origin at the centre of the footprint). Row i of a feature counts where its mask is 1;
    `observations.table(observation, "walls")` gives those rows.

    | entry | size | meaning |
    |---|---|---|
    | walls, walls_mask | 48 * 4, 48 | x, y of start and end; the robot is to the left |
    | doors, doors_mask | 16 * 4, 16 | x, y of the jambs of open doors in this scan |
    | corners, corners_mask | 48 * 3, 48 | x, y, kind: 0 outer, 1 inner, 2 potential |
    | corridors, corridors_mask | 24 * 2, 24 | x, y of midpoints of corridor entrances |
    | remembered_doors, .._mask | 16 * 4, 16 | doors seen in three or more scans so far |
    | bumps, bumps_mask | 16 * 4, 16 | x, y of ends of walls bumped into unseen, such as glass |
    | command | 8 * 5 | the command as tokens, see `commands.encode` |
    | clause | 8 | one-hot: the clause that the robot believes to be under way |
    | odometry | 7 | x, y, cosine and sine of heading as the robot believes; its speeds |
    | goal | 13 | seek, reach, pass or stop; x, y, cosine, sine; jambs; has a door |
    | scan | beams | ranges; no return reads as the lidar's range |

    `observation="semantic"` has all but the scan; `"raw"` has scan, command, clause and odometry;
    `"all"` has everything; `"truth"` has the entries of "semantic" without errors: features from an
    exact scan, the true pose in the world as odometry, and the goal grounded on the floor plan.
    An object with `space(robot, lidar)` and `observe(moment)` makes observations of its own;
    `EntryObservation(mode, extra)` adds entries to a mode.

    ## Rewards
    The sum of named terms (`RewardWeights`), all in `info["reward_terms"]`: progress along the
    shortest way, clauses done, success, failure, contact, time. `AddedTerms` adds terms of one's
    own; an object with `terms(tick)` replaces them all.

    ## Starting State
    `reset(options=...)` takes "command" (text or `Command`), its "language", "implicit_steps" (or
    not), "pose" (x, y, heading; world frame) and "floor_plan", or "episode", an `Episode` or the id
    of one of `episodes`. Without options the task says what the episode is asked to be. What is not
    asked for is drawn: a free pose in a corridor looking along it, and a command that can be
    carried out from there.

    ## Episode End
    Terminates when the command has been carried out, at a wrong door or a wrong turn, and after
    standing still for 10 s ("stopped short"). Truncates after `max_seconds`. Contact does not end
    an episode; it is counted in `info["collisions"]`.

    ## Arguments
    robot: "wheelchair", "spot" or a `RobotSpec`. floor_plan: a name, a path or a `FloorPlan`.
    observation: a mode, see above, or an observation type. lidar: "tim561", "barbret" or a
    `LidarSpec`; its rate is the control rate. odometry: how dead reckoning errs. extractor: limits
    of the feature extractor. corrects_drift: whether walls that are seen again correct odometry.
    rules: what a door is, how words are grounded, and what success is; robot and judge follow the
    same. rewards: `RewardWeights`, or an object with `terms(tick)`. dynamics: what else moves.
    task: a command, a list of commands, or a `Task`: what episodes are asked to be. episodes: to
    draw from instead: the name of a split, a file, or `Episode`s. max_seconds: of simulated time.
    render_mode: "rgb_array" or "human" (extra `render`).

    ## Version History
    v0: first version.

    ## References
    Barbret 2021; Weerakoon et al.; Yan et al.; Mes 2021: see CITATION.cff.
    """

    metadata = {  # noqa: RUF012 - declared so by gymnasium.Env
        "render_modes": ["rgb_array", "human"],
        "render_fps": 15,
    }

    def __init__(
        self,
        robot: str | RobotSpec = "wheelchair",
        floor_plan: str | FloorPlan = "heidelberg_hallway",
        observation: str | ObservationType = "semantic",
        lidar: str | LidarSpec = "tim561",
        odometry: OdometrySettings = OdometrySettings(),
        extractor: ExtractorSettings = ExtractorSettings(),
        corrects_drift: bool = True,
        rewards: Rewards = RewardWeights(),
        dynamics: Dynamics = OFF,
        task: object = None,
        episodes: Episodes | None = None,
        rules: Rules = Rules(),
        max_seconds: float = 120.0,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"no render mode {render_mode!r}; there are: rgb_array, human")
        check_kind("max_seconds", max_seconds, Real)
        if not 0 < max_seconds < math.inf:
            raise ValueError(f"max_seconds is {max_seconds!r}; it must be positive and finite")
        check_kind("odometry", odometry, OdometrySettings)
        check_kind("extractor", extractor, ExtractorSettings)
        if not isinstance(rewards, Rewards) or isinstance(rewards, type):
            raise ValueError(
                f"rewards is {rewards!r:.80}; it must be a semnav_env.tasks.RewardWeights or have "
                "terms(tick)"
            )
        if task is not None and episodes is not None:
            raise ValueError("give task= or episodes=, not both")
        check_kind("rules", rules, Rules)
        self.rules, self.extractor = with_doors_of(rules, extractor)
        self.corrects_drift, self.rewards = corrects_drift, rewards
        self.episodes = None if episodes is None else FrozenEpisodes(episodes)
        self.task: Task = as_task(task) if self.episodes is None else self.episodes
        self.observation_type = as_observation(observation)
        exact = bool(getattr(self.observation_type, "exact", False))
        self.usual = RobotSetup(robot_spec(robot), lidar_spec(lidar), odometry, exact)
        self.max_steps = round(max_seconds * self.usual.control_hz)
        self.render_mode = render_mode
        self.metadata = self.metadata | {"render_fps": self.usual.control_hz}
        self.plan_source = PlanSource(floor_plan, dynamics, self.usual.robot)
        self._enter(self.plan_source.plan(), self.usual)
        self.action_space = self._actions.space
        self.observation_space = self.observation_type.space(self.robot, self.lidar_spec)
        self._started = False

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
        asked = EpisodeRequest.from_options(options)
        self._asked_by_task = asked is None
        request = self.task.request(self.np_random) if asked is None else asked
        request = spelled_out(request, self.episodes)
        floor_plan = self.plan_source.plan(request.floor_plan, request.pose, self.np_random)
        setup = self.usual.with_changes(request.robot, request.lidar, request.odometry)
        if floor_plan is not self.floor_plan or setup != self.setup:
            self._enter(floor_plan, setup)
        mission = self._missions.make(request, self.np_random)
        sensed = self.simulator.reset(mission.start, self.np_random)
        self._begin(mission)
        belief = self._believe(sensed)
        self._started = True
        return self._observation(belief), self._reset_info(request)

    def step(self, action: ArrayLike) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Drive for one control period.

        Raises:
            ValueError: the action is not finite or has another shape.
            RuntimeError: before the first `reset`.
        """
        if not self._started:
            raise RuntimeError("call reset() before step()")
        sensed = self.simulator.step(self._actions.twist(action))
        motion = sensed.motion
        self._renderer.note(motion.pose)
        belief = self._believe(sensed)
        judgement, verifier = self.judge.update(motion), self.judge.verifier
        terms = self.rewards.terms(Tick(*judgement, motion, belief, np.asarray(action)))
        terminated = verifier.over
        truncated = not terminated and self.simulator.steps >= self.max_steps
        if truncated:
            verifier.out_of_time()
        if self.render_mode == "human":
            self.render()
        info = self.judge.info | {
            "in_contact": motion.in_contact,
            "reward_terms": terms,
            "pose": motion.pose,
        }
        if terminated or truncated:
            info |= self._end()
        return self._observation(belief), sum(terms.values()), terminated, truncated, info

    def render(self) -> NDArray[np.uint8] | None:
        """The picture, shape (height, width, 3), or a window in "human" mode."""
        if self.render_mode is None:
            gym.logger.warn("render() does nothing: give render_mode to gymnasium.make")
            return None
        return self._renderer.draw(self, self.render_mode)

    def close(self) -> None:
        """Close the window, if any."""
        self._renderer.close()

    @property
    def robot(self) -> RobotSpec:
        """The body of this episode."""
        return self.setup.robot

    @property
    def lidar_spec(self) -> LidarSpec:
        """The lidar of this episode."""
        return self.setup.lidar

    @property
    def world(self) -> World:
        """The physics."""
        return self.simulator.world

    @property
    def believed_pose(self) -> Pose:
        """Pose that the robot believes, seen from its start; on the truth, in the world."""
        return self.belief.pose

    @property
    def seconds(self) -> float:
        """Simulated time since the start of the episode."""
        return self.simulator.steps / self.setup.control_hz

    def _enter(self, floor_plan: FloorPlan, setup: RobotSetup) -> None:
        """Set everything up that belongs to one floor plan and one robot."""
        self.floor_plan, self.setup = floor_plan, setup
        self.simulator = Simulator(floor_plan, setup, self.plan_source.dynamics)
        self._missions = MissionMaker(floor_plan, setup.robot, self.rules)
        self._actions = Actions(setup.robot)
        self._renderer = Renderer(self.world.still)
        self.tracker = BeliefTracker(
            setup.lidar,
            setup.robot.lidar_mount,
            self.extractor,
            corrects_drift=self.corrects_drift and not setup.exact,
            known_scene=floor_plan.scene_by(self.rules.door) if setup.exact else None,
            rules=self.rules,
        )

    def _begin(self, mission: Mission) -> None:
        """Give a mission to the judge, and its command to the robot."""
        self.judge = EpisodeJudge(mission)
        self._tokens = encode(mission.command, self.floor_plan.room_names)
        odometry_frame = (0.0, 0.0, 0.0) if self.setup.exact else mission.start
        ways = {clause: way.seen_from(odometry_frame) for clause, way in mission.ways.items()}
        self.tracker.begin(mission.command, ways)
        self._renderer.begin(mission.start)

    def _believe(self, sensed: Sensed) -> Belief:
        self.belief = self.tracker.update(
            sensed.ranges, sensed.odometry, sensed.velocity, sensed.bumps
        )
        return self.belief

    def _observation(self, belief: Belief) -> Any:
        command = self.judge.verifier.mission.command
        return self.observation_type.observe(Moment(belief, self.tracker, command, self._tokens))

    def _reset_info(self, request: EpisodeRequest) -> dict[str, Any]:
        mission = self.judge.verifier.mission
        info = {
            "command": str(mission.command),
            "floor_plan": self.floor_plan,
            "robot_spec": self.robot,
            "lidar_spec": self.lidar_spec,
            "pose": mission.start,
            **mission.info,
        }
        return info | ({"episode_id": request.episode_id} if request.episode_id else {})

    def _end(self) -> dict[str, Any]:
        """What is known at the end, for `info`; a task that learns is told."""
        if self._asked_by_task and isinstance(self.task, AdaptiveTask):
            self.task.note(self.judge.verifier.success)
        return self.judge.outcome | self.world.social() | {"impossible": self.belief.impossible}
