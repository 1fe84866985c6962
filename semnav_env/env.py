"""The environment: the one place where world, lidar, perception, task and picture meet."""

from __future__ import annotations

import math
from dataclasses import replace
from numbers import Real
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from semnav_env.actions import Actions
from semnav_env.dynamics import OFF, Dynamics, PlanSource
from semnav_env.episodes.options import EpisodeOptions, Episodes
from semnav_env.features import ExtractorSettings
from semnav_env.features.frames import Pose
from semnav_env.lidar.lidar import Lidar
from semnav_env.lidar.spec import LidarSpec, lidar_spec
from semnav_env.maps import FloorPlan
from semnav_env.observations import Observer
from semnav_env.odometry import Odometry, OdometrySettings
from semnav_env.perception import Perception, TruePerception
from semnav_env.rendering.renderer import Renderer
from semnav_env.robots import RobotSpec, robot_spec
from semnav_env.settings import check_kind
from semnav_env.tasks import CommandTask, RewardWeights
from semnav_env.verifier import Motion
from semnav_env.world import World

CONTROL_HZ = 15
"""Steps per second, the rate of the lidar."""


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
    | felt, felt_mask | 16 * 4, 16 | x, y of ends of what was run into unseen, such as glass |
    | command | 8 * 5 | the command as tokens, see `commands.tokens.encode` |
    | clause | 8 | one-hot: the clause that the robot believes to be under way |
    | odometry | 7 | x, y, cosine and sine of heading as the robot believes; its speeds |
    | goal | 13 | seek, reach, pass or stop; x, y, cosine, sine; jambs; has a door |
    | scan | beams | ranges; no return reads as the lidar's range |

    `observation="semantic"` has all but the scan; `"raw"` has scan, command, clause and odometry;
    `"all"` has everything; `"truth"` has the entries of "semantic" without errors: features from an
    exact scan, the true pose in the world as odometry, and the goal grounded on the floor plan.

    ## Rewards
    A weighted sum of named terms (`RewardWeights`), all in `info["reward_terms"]`: progress along
    the shortest way, clauses done, success, failure, contact, time.

    ## Starting State
    `reset(options=...)` takes "command" (text or `Command`), its "language", "implicit_steps" (or
    not), "pose" (x, y, heading; world frame) and "floor_plan". What is not given is drawn: a
    free pose in a corridor looking along it, and a command that can be carried out from there. Or
    "episode", an `Episode` or the id of one of `episodes`, which one is drawn from without options.

    ## Episode End
    Terminates when the command has been carried out, at a wrong door or a wrong turn, and after
    standing still for 10 s ("stopped short"). Truncates after `max_seconds`. Contact does not end
    an episode; it is counted in `info["collisions"]`.

    ## Arguments
    robot: "wheelchair", "spot" or a `RobotSpec`. floor_plan: a name, a path or a
    `FloorPlan`. observation: see above. lidar: "tim561", "barbret" or a `LidarSpec`. odometry:
    drift, and whether walls seen again correct it. extractor: limits of the feature extractor.
    rewards: weights. dynamics: what else moves. max_seconds: of simulated time. render_mode:
    "rgb_array" or "human" (extra `render`). episodes: to draw from: the name of a split, a file,
    or `Episode`s.

    ## Version History
    v0: first version.

    ## References
    Barbret 2021; Weerakoon et al.; Yan et al.; Mes 2021: see CITATION.cff.
    """

    metadata = {  # noqa: RUF012 - declared so by gymnasium.Env
        "render_modes": ["rgb_array", "human"],
        "render_fps": CONTROL_HZ,
    }

    def __init__(
        self,
        robot: str | RobotSpec = "wheelchair",
        floor_plan: str | FloorPlan = "heidelberg_hallway",
        observation: str = "semantic",
        lidar: str | LidarSpec = "tim561",
        odometry: OdometrySettings = OdometrySettings(),
        extractor: ExtractorSettings = ExtractorSettings(),
        rewards: RewardWeights = RewardWeights(),
        dynamics: Dynamics = OFF,
        max_seconds: float = 120.0,
        render_mode: str | None = None,
        episodes: Episodes | None = None,
    ) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"no render mode {render_mode!r}; there are: rgb_array, human")
        check_kind("max_seconds", max_seconds, Real)
        if not 0 < max_seconds < math.inf:
            raise ValueError(f"max_seconds is {max_seconds!r}; it must be positive and finite")
        check_kind("odometry", odometry, OdometrySettings)
        check_kind("extractor", extractor, ExtractorSettings)
        check_kind("rewards", rewards, RewardWeights)
        self.robot = robot_spec(robot)
        self.lidar_spec = lidar_spec(lidar)
        self.extractor = extractor
        self.rewards = rewards
        self.max_steps = round(max_seconds * CONTROL_HZ)
        self.render_mode = render_mode
        self.odometry = Odometry(odometry)
        self._observer = Observer(observation, self.lidar_spec.beams, self.lidar_spec.range_max)
        self.plan_source = PlanSource(floor_plan, dynamics, self.robot)
        self._enter(self.plan_source.plan())
        self._actions = Actions(self.robot)
        self.action_space = self._actions.space
        self.observation_space = self._observer.space
        self._asked, self._started = EpisodeOptions(episodes), False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """Begin an episode; see the class for `options`.

        Raises:
            ValueError: unknown options, a pose that is not free, a command that is not understood
                (`CommandError`) or cannot be carried out from there (`GroundingError`).
        """
        super().reset(seed=seed)
        self._started = False
        options = self._asked.complete(options, self.np_random)
        floor_plan = self.plan_source.plan(options, self.np_random)
        if floor_plan is not self.floor_plan:
            self._enter(floor_plan)
        start = self.task.begin(options, self.np_random)
        self.world.reset(start, self.np_random)
        self.odometry.reset(start, self.np_random)
        self.perception.begin(self.task.verifier.command, self.task.verifier.ways, start)
        self._noise_seed = int(self.np_random.integers(2**62))
        self._steps, self._started = 0, True
        self._sense(self.world.pose, self.world.velocity)
        self._renderer.begin(start)
        return self._observation(), self._reset_info(start)

    def step(
        self, action: ArrayLike
    ) -> tuple[dict[str, NDArray[Any]], float, bool, bool, dict[str, Any]]:
        """Drive for one control period.

        Raises:
            ValueError: the action is not finite or has another shape.
            RuntimeError: before the first `reset`.
        """
        if not self._started:
            raise RuntimeError("call reset() before step()")
        world = self.world
        world.step(self._actions.velocity(action))
        pose, velocity = world.pose, world.velocity
        self.odometry.update(pose)
        self._steps += 1
        self._renderer.note(pose)
        self._sense(pose, velocity)
        speed = math.hypot(velocity[0], velocity[1])
        terms = self.task.step(Motion(pose, speed, velocity[2], world.in_contact, 1.0 / CONTROL_HZ))
        verifier = self.task.verifier
        terminated = verifier.over
        truncated = not terminated and self._steps >= self.max_steps
        if truncated:
            verifier.out_of_time()
        if self.render_mode == "human":
            self.render()
        info = self._info(pose, terms, terminated or truncated)
        return self._observation(), sum(terms.values()), terminated, truncated, info

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
    def believed_pose(self) -> Pose:
        """Where the robot believes to be, seen from its start; on the truth, in the world."""
        return self.perception.pose

    @property
    def seconds(self) -> float:
        """Simulated time since the start of the episode."""
        return self._steps / CONTROL_HZ

    def _enter(self, floor_plan: FloorPlan) -> None:
        """Set everything up that belongs to one floor plan."""
        self.floor_plan = floor_plan
        self.world = World(floor_plan, self.robot, CONTROL_HZ, dynamics=self.plan_source.dynamics)
        self.task = CommandTask(floor_plan, self.robot, self.rewards)
        self._renderer = Renderer(self.world.still)
        self._truth = self._observer.mode == "truth"
        exact = replace(self.lidar_spec, sigma=0.0, dropout=0.0, systematic=0.0)
        spec = exact if self._truth else self.lidar_spec
        lidar = Lidar(self.world.still, spec, self.robot.lidar_mount, self.world.moving_shapes)
        corrected = self.odometry.settings.corrected
        self.perception: Perception = Perception(lidar, self.extractor, corrected)
        if self._truth:
            self.perception = TruePerception(lidar, self.extractor, floor_plan.scene)

    def _sense(self, pose: Pose, velocity: Pose) -> None:
        key = self._noise_seed, 0, self._steps
        odometry = pose if self._truth else self.odometry.pose
        self.perception.sense(pose, odometry, velocity, key, self.world.touches)

    def _observation(self) -> dict[str, NDArray[Any]]:
        return self._observer.pack(self.perception.row, self.task.verifier.tokens)

    def _reset_info(self, start: Pose) -> dict[str, Any]:
        verifier = self.task.verifier
        return {
            "command": str(verifier.command),
            "floor_plan": self.floor_plan,
            "robot_spec": self.robot,
            "lidar_spec": self.lidar_spec,
            "pose": start,
            **verifier.true_route(),
            **self._asked.info,
        }

    def _info(self, pose: Pose, terms: dict[str, float], over: bool) -> dict[str, Any]:
        verifier = self.task.verifier
        info: dict[str, Any] = {
            "verdicts": verifier.verdicts,
            "collisions": verifier.collisions,
            "in_contact": self.world.in_contact,
            "path_length": verifier.path_length,
            "reward_terms": terms,
            "pose": pose,
        }
        if over:
            info |= verifier.outcome() | self.world.social()
            info["impossible"] = self.perception.follower.impossible
        return info
