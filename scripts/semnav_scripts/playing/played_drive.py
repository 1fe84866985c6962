"""A robot that a person drives, from one command to the next."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from semnav_agents.assistance.assisted import Assisted
from semnav_agents.assistance.hand import Hand
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode
from semnav_env.judge.episodes.said import said_episode
from semnav_env.judge.metrics import Recorder, Recording
from semnav_env.judge.tasks import EpisodeRequest, MissionMaker
from semnav_env.language import Command
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.snapshot import snapshot
from semnav_features.frames import Point, Pose


@dataclass(frozen=True)
class PlayedRun:
    """What a person drove after one command.

    Attributes:
        episode: the command and where it was given.
        recording: of the robot's motion, until the next command.
        success: whether the command was carried out.
        verdicts: of its clauses, in words.
    """

    episode: Episode
    recording: Recording
    success: bool
    verdicts: tuple[str, ...]

    @property
    def outcome(self) -> dict[str, Any]:
        """The run as one plain object."""
        return {
            "episode": self.episode.id,
            "command": self.episode.command,
            "success": self.success,
            "verdicts": list(self.verdicts),
            "collisions": self.recording.collisions,
            "seconds": round(self.recording.seconds, 2),
        }


class PlayedDrive:
    """Drives a robot as a hand says, with assistance or without.

    A new command begins an episode where the robot stands; what it has seen before is forgotten.

    Args:
        env: with the observation "all".
        plan_name: name or path by which its floor plan is found again.
        seed: of the first episode; each further one has the next number.
        assist: whether to begin with assistance.

    Attributes:
        agent: the hand with its assistance.
        runs: those that are over.
        over: whether the judge has ended the episode; the robot can still be driven.
        info: what the environment has told of the episode so far, the latest of each entry.
    """

    def __init__(self, env: SemNavEnv, plan_name: str, seed: int, assist: bool) -> None:
        self.env, self._plan_name, self._seed = env, plan_name, seed
        self._plan = env.floor_plan
        self._hand = Hand()
        self.agent = Assisted(self._hand)
        self.agent.active = assist
        self.runs: list[PlayedRun] = []
        self.info: dict[str, Any] = {}
        self.over = False
        self._recorder: Recorder | None = None

    def begin(self, said: tuple[str, str, Command] | None = None, pose: Pose | None = None) -> None:
        """Begin an episode.

        Args:
            said: text and language of the command, and what it means; if not given, one is drawn.
            pose: of the robot's centre; drawn if not given.

        Raises:
            ValueError: the robot cannot start there, or the command cannot be carried out from
                there (`GroundingError`); then the last episode goes on.
        """
        options: dict[str, Any] = {} if pose is None else {"pose": pose}
        if said is not None:
            options |= {"command": said[2], "language": said[1]}
            self._check(options)
        self.finish()
        self._observation, self.info = self.env.reset(seed=self._seed, options=options)
        command = self.env.judge.mission.command
        self._said = said or (command.say("en"), "en", command)
        self.agent.reset(self.info)
        self._recorder = Recorder(self.env.world)
        self._start: Pose = self.info["pose"]
        self._trail: list[Point] = [self._start[:2]]
        self.over = False

    def _check(self, options: dict[str, Any]) -> None:
        """Raise what `env.reset` would raise, which leaves no episode that could go on."""
        maker = MissionMaker(self.env.floor_plan, self.env.robot, self.env.rules)
        maker.make(EpisodeRequest(**options), np.random.default_rng(self._seed))

    def finish(self) -> None:
        """Add what was driven since the last command to the runs."""
        if self._recorder is None:
            return
        recording, self._recorder = self._recorder.recording(), None
        name, route = f"played-{self._seed:05d}", self.env.judge.mission.route
        named = self._plan_name, self._plan
        episode = said_episode(name, named, self._start, self._said, route)
        verdicts = tuple(map(str, self.env.judge.verdicts))
        done = bool(self.info.get("is_success", False))
        self.runs.append(PlayedRun(episode, recording, done, verdicts))
        self._seed += 1

    def step(self, action: ArrayLike) -> None:
        """Drive for one control period.

        Args:
            action: what the person wants, in the environment's action space.
        """
        assert self._recorder is not None
        self._hand.hold(action)
        self._observation, _, terminated, truncated, info = self.env.step(
            self.agent.act(self._observation)
        )
        self.info |= info
        self.over = self.over or terminated or truncated
        self._recorder.note()
        self._trail.append(info["pose"][:2])

    @property
    def verdict(self) -> str:
        """Whether the command was carried out, clause by clause if it was not."""
        if self.info.get("is_success", False):
            return "done"
        return " / ".join(map(str, self.env.judge.verdicts))

    def frame(self, prompt: str) -> Frame:
        """The present moment, with what the assistance does."""
        frame = snapshot(self.env, self._trail)
        return replace(frame, prompt=prompt, status=(*frame.status, self._assistance))

    @property
    def _assistance(self) -> str:
        if not self.agent.active:
            return "assistance: off"
        if self.agent.door is not None:
            return "assistance: through the door"
        return f"assistance: {'corrects' if self.agent.changed else 'on'}"
