"""Compiled code decides for robots that cruise exactly as Python does."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

from semnav_agents import scripted
from semnav_agents.planning.cruise import MAX_SAMPLES, fits
from semnav_agents.planning.path import PlannedPath
from semnav_agents.planning.perception import Perception
from semnav_agents.planning.track import PathTrack
from semnav_agents.scripted import ScriptedTeam
from semnav_env.judge.episodes import Episode, evenly, load_episodes
from semnav_env.robots import WHEELCHAIR
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.dynamics import Dynamics
from semnav_features.lidars import TIM561

STEPS = 250


def decisions(episodes: list[Episode], robot: str, pedestrians: int = 0) -> list[bytes]:
    """The actions of a team in each of some steps; a robot whose episode is over stands still."""
    team = ScriptedTeam(len(episodes))
    envs = SemNavVectorEnv(
        len(episodes),
        robot=robot,
        observation=team.observation,
        threads=1,
        dynamics=Dynamics(pedestrians=pedestrians),
        autoreset_mode="Disabled",
    )
    for k, episode in enumerate(episodes):
        team.reset(k, envs.begin(k, episode.number, {"episode": episode}))
    observations, driven, actions = envs.observe(), set(range(len(episodes))), list[bytes]()
    for _ in range(STEPS):
        chosen = team.act(observations, driven)
        actions.append(chosen.tobytes())
        observations, _, terminated, truncated, _ = envs.step(chosen)
        for k in np.flatnonzero(terminated | truncated).tolist():
            driven.discard(k)
            envs.rest(k)
        if not driven:
            break
    return actions


class Counted:
    """A stand-in for the compiled decisions that counts them."""

    def __init__(self, cruise: Any, stopped: bool) -> None:
        self._cruise, self._stopped, self.decided, self.asked = cruise, stopped, 0, 0

    def __call__(self, *given: Any) -> None:
        *_, decided = given
        self._cruise(*given[:1], given[1][:0] if self._stopped else given[1], *given[2:])
        self.decided, self.asked = self.decided + int(decided.sum()), self.asked + len(given[1])


@pytest.mark.parametrize(("robot", "pedestrians"), [("wheelchair", 0), ("spot", 4)])
def test_what_compiled_code_decides_is_what_python_decides(
    robot: str, pedestrians: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The rules are the same kernels; this compares in which order they are asked."""
    episodes = evenly(load_episodes("val_unseen"), 3)
    compiled, python = (Counted(scripted.cruise, stopped) for stopped in (False, True))
    monkeypatch.setattr(scripted, "cruise", compiled)
    actions = decisions(episodes, robot, pedestrians)
    monkeypatch.setattr(scripted, "cruise", python)
    assert decisions(episodes, robot, pedestrians) == actions
    assert python.decided == 0 < compiled.decided
    assert compiled.decided > 0.5 * compiled.asked or pedestrians


def test_a_team_decides_as_its_robots_would_alone() -> None:
    episodes = evenly(load_episodes("val_unseen"), 3)
    together = np.array([np.frombuffer(each, np.float32) for each in decisions(episodes, "spot")])
    alone = [np.frombuffer(b"".join(decisions([each], "spot")), np.float32) for each in episodes]
    for k, actions in enumerate(alone):
        of_one = together[:, 3 * k : 3 * k + 3].ravel()
        assert np.array_equal(of_one[: len(actions)], actions[: len(of_one)])


def test_a_copied_perception_goes_on_seeing() -> None:
    perception, lidar = Perception(2), TIM561
    perception.reset(0, (0.0, 0.0, 0.0), lidar)
    perception.reset(1, (0.0, 0.0, 0.0), lidar)
    copy = pickle.loads(pickle.dumps(perception))
    here = np.array([(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0)] * 2, np.float32)
    scan = np.full((2, len(lidar.directions)), 2.0, np.float32)
    for each in (perception, copy):
        for _ in range(3):
            each.update(here, scan, np.array([1]))
        assert not len(each.obstacles(0).points())
        assert len(each.obstacles(1).points())
    assert np.array_equal(copy.obstacles(1).points(), perception.obstacles(1).points())


def test_a_path_that_is_too_long_for_a_record_does_not_fit() -> None:
    def of_length(metres: float) -> PathTrack:
        moves = np.array([(metres, 0.0, 0.0)])
        path = PlannedPath((0.0, 0.0, 0.0), moves, 0.0, True, 0.1, np.zeros(0))
        clearance = np.full(len(path.axle_poses), 0.3)
        return PathTrack(PlannedPath((0.0, 0.0, 0.0), moves, 0.0, True, 0.1, clearance), WHEELCHAIR)

    assert fits(of_length(20.0))
    assert not fits(of_length(0.04 * MAX_SAMPLES + 1.0))
