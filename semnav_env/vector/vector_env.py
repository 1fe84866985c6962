"""The vector environment, which drives many robots in one call."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.error import ClosedEnvironmentError
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from semnav_env.control_period import ends, info_of
from semnav_env.vector.actions import TeamActions
from semnav_env.vector.arguments import joined, made, naming_robot, one_each, one_seed_each
from semnav_env.vector.held_action import HeldAction
from semnav_env.vector.infos import Infos, plain_info, step_infos, without
from semnav_env.vector.member import TeamMember
from semnav_env.vector.observations import TeamObservations, team_observations
from semnav_env.vector.rewards import Mask, TeamRewards
from semnav_env.vector.team import Team
from semnav_features.one_thread import ThreadDoor, for_one_thread
from semnav_features.validation import check_count

Arrays = NDArray[Any]


class SemNavVectorEnv(VectorEnv[Any, Arrays, Arrays]):
    """Many `SemNavEnv` at once.

        envs = gym.make_vec("semnav_env:SemNav-v0", num_envs=64,
                            vectorization_mode="vector_entry_point")

    Every robot gets, bit for bit, the observations of an environment of its own, whatever the
    number of threads. Physics, lidar, understanding and judging run in compiled code in threads;
    Python runs only after an event.

    Infos are arrays with one entry for each robot, and beside each NAME a mask `_NAME`, as
    Gymnasium has them. "pose" has shape (n, 3).

    Args:
        num_envs: number of robots.
        each: arguments of `SemNavEnv` that differ, one mapping for each robot.
        threads: number of threads; by default one for each core, and 1 for the caller's alone.
        repeat: control periods for which an action holds. Rewards and their terms are summed. A
            robot whose episode is over waits until the others are done with the action.
        autoreset_mode: when a robot whose episode is over begins the next one: in the next step, in
            the same one, or not by itself.
        max_episode_steps: calls of `step` after which an episode is truncated, if its `max_seconds`
            are not over before; -1 for `max_seconds` alone. `gymnasium.make_vec` gives that of a
            spec.
        options: arguments of `SemNavEnv` for all robots.

    Attributes:
        envs: the single environments; they are stepped together only.
        autoreset_mode: as an `AutoresetMode`; TorchRL reads it, as of Gymnasium's own.

    Raises:
        ValueError: as `SemNavEnv`; or the environments' spaces or control rates differ.
    """

    envs: list[TeamMember]
    thread_door: ThreadDoor
    autoreset_mode: AutoresetMode

    def __init__(
        self,
        num_envs: int = 1,
        *,
        each: Sequence[Mapping[str, Any]] | None = None,
        threads: int | None = None,
        repeat: int = 1,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        max_episode_steps: int = -1,
        **options: Any,
    ) -> None:
        # Gymnasium 1.2 also closes what was never made.
        self.envs = []
        self._team: Team | None = None
        self.thread_door = ThreadDoor()
        check_count("num_envs", num_envs)
        check_count("threads", 1 if threads is None else threads)
        check_count("repeat", repeat)
        self.num_envs, self._threads, self._repeat = num_envs, threads, repeat
        each = one_each("each", [{}] * num_envs if each is None else each, num_envs)
        self.envs = made(each, options)
        if max_episode_steps != -1:
            check_count("max_episode_steps", max_episode_steps)
            for env in self.envs:
                env.max_steps = min(env.max_steps, max_episode_steps * repeat)
        first = self.envs[0]
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = first.metadata | {"autoreset_mode": self.autoreset_mode}
        self.render_mode = first.render_mode
        self.single_action_space = first.action_space
        self.single_observation_space = first.observation_space
        self.action_space = batch_space(first.action_space, num_envs)
        self.observation_space = batch_space(first.observation_space, num_envs)
        self._actions = TeamActions(self.envs)
        self.read_settings()
        self._over = np.zeros(num_envs, dtype=bool)
        self._verdicts = np.full(num_envs, None, dtype=object)
        self._unbegun = np.ones(num_envs, dtype=bool)
        self._resting = np.zeros(num_envs, dtype=bool)
        self._observations: TeamObservations

    @for_one_thread
    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Begin episodes.

        Args:
            seed: seed of the first robot, from which the others count up; or one for each robot.
            options: options of `SemNavEnv.reset` for all robots; also "each", one mapping (or None)
                for each robot, and "reset_mask", which robots begin a new episode.

        Raises:
            ValueError: as `SemNavEnv.reset`, with the number of the robot; or lists of another
                length.
            gymnasium.error.ClosedEnvironmentError: after `close`.
        """
        self._check_open()
        seeds = one_each("seed", one_seed_each(seed, self.num_envs), self.num_envs)
        common = dict(options or {})
        mask = np.asarray(common.pop("reset_mask", np.ones(self.num_envs, dtype=bool)))
        if mask.shape != (self.num_envs,) or mask.dtype != bool or not mask.any():
            raise ValueError(f"reset_mask must be {self.num_envs} booleans, not all False")
        own = one_each("each", common.pop("each", [None] * self.num_envs), self.num_envs)
        if self._team is None and not mask.all():
            raise ValueError("the first reset must be of all robots: leave out reset_mask")
        infos: Infos = {}
        self._unbegun |= mask
        for k in _indices(mask):
            infos = self._begin(infos, k, seeds[k], joined(k, common, own[k]))
        return self.observe(), infos

    def begin(
        self, index: int, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> dict[str, Any]:
        """Begin an episode of one robot, as its environment's `reset`; returns its info alone.

        For who drives many episodes one after the other, with `autoreset_mode="Disabled"`: begin an
        episode of each robot, `observe`, `step`; begin the next one where one is over, or `rest`.

        Raises:
            ValueError: as `SemNavEnv.reset`.
            gymnasium.error.ClosedEnvironmentError: after `close`.
        """
        self._check_open()
        self._unbegun[index] = True
        env = self.envs[index]
        info = env.begin(seed, options)
        self._over[index] = self._unbegun[index] = self._resting[index] = False
        self._verdicts[index] = env.judge.verdicts
        self._actions.renew(index, env)
        if self._team is not None:
            self._team.renew(index)
            self._observations.renew(index, env)
        return info

    def rest(self, index: int) -> None:
        """Let a robot whose episode is over stand still until it begins another one."""
        self._resting[index] = True

    def observe(self) -> Any:
        """New observations of all robots.

        Raises:
            RuntimeError: a robot has never begun an episode.
        """
        if self._team is None:
            self._check_begun()
            self._gather()
        return self._observations.observe(self._gathered)

    @for_one_thread
    def step(self, actions: Arrays) -> tuple[Any, Arrays, Arrays, Arrays, dict[str, Any]]:
        """Drive all robots while the action holds; robots that begin a new episode stand still.

        Raises:
            ValueError: the actions are not finite or have another shape.
            RuntimeError: before the first `reset`, or while another thread is in `reset` or `step`.
            gymnasium.error.ClosedEnvironmentError: after `close`.
        """
        self._check_open()
        if self._team is None:
            raise RuntimeError("call reset() before step()")
        self._check_begun()
        driven = ~self._over
        is_autoreset = self.autoreset_mode is not AutoresetMode.DISABLED
        if not is_autoreset and np.count_nonzero(self._over & ~self._resting):
            waiting = np.flatnonzero(self._over & ~self._resting)
            raise RuntimeError(f"robots {waiting} must be reset first")
        held = self._hold(actions, driven)
        known = info_of(self._team.period, self._verdicts)
        infos = step_infos(known, held.terms, driven)
        for k, end in held.ends.items():
            infos = self._add_info(infos, end, k)
        begin, self._over = self._over & is_autoreset, self._over | held.over
        if self.autoreset_mode is AutoresetMode.SAME_STEP:
            begin, self._over = held.over, np.zeros_like(held.over)
            infos = self._final(infos, held.over)
        self._unbegun |= begin
        for k in _indices(begin):
            infos = self._begin(infos, k)
        observations = self._observations.observe(self._team)
        return observations, held.rewards, held.terminated, held.truncated, infos

    def render(self) -> tuple[Any, ...]:
        """The picture of each robot."""
        return tuple(env.render() for env in self.envs)

    def call(self, name: str, *arguments: Any, **options: Any) -> tuple[Any, ...]:
        """Results of a method of each single environment, or the values of an attribute."""
        found = [env.get_wrapper_attr(name) for env in self.envs]
        return tuple(each(*arguments, **options) if callable(each) else each for each in found)

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """The value of an attribute of each single environment."""
        return self.call(name)

    def set_attr(self, name: str, values: Any) -> None:
        """Set an attribute of the single environments: a list with one for each, or one value."""
        values = values if isinstance(values, list | tuple) else [values] * self.num_envs
        for env, value in zip(self.envs, one_each("values", values, self.num_envs), strict=True):
            env.set_wrapper_attr(name, value)
        self.read_settings()

    def read_settings(self) -> None:
        """Read the rewards and time limits of the single environments again, after a change."""
        self._rewards = TeamRewards(self.envs)
        self._latest = np.array([env.max_steps for env in self.envs])

    def close_extras(self, **_: Any) -> None:
        """Stop the threads and close the windows."""
        if self._team is not None:
            self._team.close()
        for env in self.envs:
            env.close()

    def __getstate__(self) -> dict[str, Any]:
        if self._team is not None:
            self._team.hand_over_log()
        return self.__dict__ | {"_team": None if self._team is None else self._team.periods}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        periods = state["_team"]
        if periods is not None:
            self._gather()
            self._gathered.periods[:] = periods

    @property
    def _gathered(self) -> Team:
        assert self._team is not None
        return self._team

    def _gather(self) -> None:
        """Gather the data of all robots after a reset."""
        self._team = Team(self.envs, self._threads)
        self._observations = team_observations(self.envs)

    def _hold(self, actions: Arrays, driven: Mask) -> HeldAction:
        """Drive robots for the control periods of one action."""
        team, twists, held = self._gathered, self._actions.twists(actions), HeldAction(driven)
        for period in range(self._repeat):
            going = held.going
            if not np.count_nonzero(going):
                break
            if period == self._repeat - 1:
                self._observations.prepare(team)
            thought = team.drive(twists, going)
            terms = self._rewards.terms(team.period, actions, going)
            terminated, truncated = (each & going for each in ends(team.period, self._latest))
            held.add(terms, terminated, truncated)
            over = _indices(terminated | truncated)
            for k in over:
                held.ends[k] = self.envs[k].conclude(bool(truncated[k]))
            for k in (*thought, *over):
                self._verdicts[k] = self.envs[k].judge.verdicts
            if self.render_mode is not None:
                self._show(going)
        return held

    def _begin(
        self,
        infos: Infos,
        index: int,
        seed: int | None = None,
        options: dict[str, Any] | None = None,
    ) -> Infos:
        """Reset one robot; returns the infos with its own."""
        with naming_robot(index):
            info = self.begin(index, seed, options)
        if "pose" not in infos:
            infos = infos | {"pose": np.zeros((self.num_envs, 3))}
        return self._add_info(infos, info, index)

    def _final(self, infos: Infos, over: Mask) -> Infos:
        """Move the infos of episodes that are over into "final_info"."""
        finals = {k: plain_info(infos, k) for k in _indices(over)}
        infos = without(infos, over) if finals else infos
        for k, info in finals.items():
            final = {"final_obs": self.envs[k].observe(), "final_info": info}
            infos = self._add_info(infos, final, k)
        return infos

    def _show(self, driven: Mask) -> None:
        """Update the pictures, and the windows that show them."""
        for k in _indices(driven):
            self.envs[k].renderer.note(self.envs[k], self.envs[k].world.pose)

    def _check_begun(self) -> None:
        if np.count_nonzero(self._unbegun):
            waiting = np.flatnonzero(self._unbegun)
            raise RuntimeError(
                f"reset robots {waiting} first: their command or options were refused"
            )

    def _check_open(self) -> None:
        if self.closed:
            raise ClosedEnvironmentError("the environment has been closed; make another one")


def _indices(mask: Mask) -> list[int]:
    indices: list[int] = mask.nonzero()[0].tolist()
    return indices
