"""Demonstrations on disk: all that was driven is there, and reads back as it was."""

from __future__ import annotations

import json
import os
import signal
from dataclasses import fields
from pathlib import Path
from typing import Any

import gymnasium as gym
import numpy as np
import pytest

from semnav_agents.demonstration_file import DemonstrationFile
from semnav_agents.demonstrations import Demonstration, demonstrate
from semnav_agents.expert import Expert
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import evenly, load_episodes
from semnav_env.judge.tasks import RewardWeights
from semnav_env.mind.observations import MODES, EntryObservation
from semnav_features.interruption import uninterrupted
from semnav_scripts import demonstrate as script
from semnav_scripts.main import main

minari = pytest.importorskip("minari", reason="the extra 'data' is not installed")


@pytest.fixture(scope="module")
def driven() -> tuple[SemNavEnv, Demonstration]:
    agent = make_agent("oracle")
    env = SemNavEnv(observation=agent.observation)
    return env, demonstrate(env, agent, load_episodes("test_real")[0])


def test_a_demonstration_reads_back_as_it_was(
    driven: tuple[SemNavEnv, Demonstration], tmp_path: Path
) -> None:
    env, demonstration = driven
    with DemonstrationFile(str(tmp_path / "data set"), env, "oracle") as file:
        file.add(demonstration)
        file.add(demonstration)
        assert not file.folder.exists()
    assert file.count == 2
    dataset = minari.MinariDataset(file.folder / "data")
    assert dataset.total_episodes == 2
    assert dataset.total_steps == 2 * len(demonstration.actions)
    assert dataset.observation_space == env.observation_space
    again = dataset[1]
    assert again.observations.keys() == demonstration.observations.keys()
    for name, values in demonstration.observations.items():
        assert len(values) == len(demonstration.actions) + 1
        np.testing.assert_array_equal(again.observations[name], values)
    np.testing.assert_array_equal(again.actions, demonstration.actions)
    np.testing.assert_array_equal(again.rewards, demonstration.rewards)
    assert again.terminations[-1]
    assert not again.terminations[:-1].any()
    assert demonstration.success


def test_a_folder_may_be_named_from_where_one_stands(
    driven: tuple[SemNavEnv, Demonstration], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    env, demonstration = driven
    monkeypatch.chdir(tmp_path)
    with DemonstrationFile("new set", env, "oracle") as file:
        file.add(demonstration)
    assert file.count == 1
    assert minari.MinariDataset(tmp_path / "new set" / "data").total_episodes == 1


def test_what_was_driven_before_an_interruption_is_kept(
    driven: tuple[SemNavEnv, Demonstration],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    calls: list[str] = []

    def interrupted(env: Any, agent: Any, episode: Any, *_: Any) -> Demonstration:
        calls.append(episode.id)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return driven[1]

    monkeypatch.setattr(script, "demonstrate", interrupted)
    words = ["demonstrate", "test_real", "--out", str(tmp_path / "d"), "--agent", "oracle"]
    assert main(words) == 130
    dataset = minari.MinariDataset(tmp_path / "d" / "data")
    assert len(list(dataset.iterate_episodes())) == 2


def test_a_dataset_without_demonstrations_is_not_left_by_an_error(
    driven: tuple[SemNavEnv, Demonstration], tmp_path: Path
) -> None:
    with (
        pytest.raises(ValueError, match="no demonstration"),
        DemonstrationFile(str(tmp_path / "d"), driven[0], "oracle"),
    ):
        raise ValueError("no demonstration")
    assert list(tmp_path.iterdir()) == []


def test_an_interruption_waits_until_the_episode_is_written() -> None:
    written: list[int] = []

    def write() -> None:
        with uninterrupted():
            os.kill(os.getpid(), signal.SIGINT)
            written.append(1)

    with pytest.raises(KeyboardInterrupt):
        write()
    assert written == [1]


def test_a_named_dataset_is_found_by_its_name(
    driven: tuple[SemNavEnv, Demonstration], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    with DemonstrationFile("mine/oracle-v3", driven[0], "oracle") as file:
        file.add(driven[1])
    assert minari.load_dataset("mine/oracle-v3").total_episodes == 1
    with pytest.raises(FileExistsError, match="something already"):
        DemonstrationFile("mine/oracle-v3", driven[0], "oracle")


def test_the_command_drives_counts_and_keeps(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    episodes = evenly(load_episodes("test_real"), 2)
    monkeypatch.setattr(script, "load_episodes", lambda _: episodes)
    out = tmp_path / "folder"
    words = ["demonstrate", "test_real", "--agent", "oracle", "--robot", "spot", "--episodes", "2"]
    assert main([*words, "--out", str(out), "--failures", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {"folder": str(out), "driven": 2, "kept": 2}
    assert minari.MinariDataset(out / "data").total_episodes == 2


def test_what_cannot_be_demonstrated_is_refused(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def refused(*words: str) -> str:
        assert main(["demonstrate", *words, "--out", str(tmp_path / "none")]) == 2
        return capsys.readouterr().err

    assert "cannot be carried out" in refused("test_infeasible")
    assert "no split 'moon'" in refused("moon")
    assert "at least 1" in refused("test_real", "--episodes", "0")
    assert not (tmp_path / "none").exists()


def test_any_observation_is_recorded_while_any_agent_drives(tmp_path: Path) -> None:
    """The oracle drives by the truth, and what a learner would have seen is kept."""
    episode, oracle, expert = load_episodes("test_real")[0], make_agent("oracle"), Expert()
    shown = SemNavEnv(observation="command", max_seconds=300.0)
    told = demonstrate(SemNavEnv(observation="truth", max_seconds=300.0), oracle, episode, shown)
    alone = demonstrate(SemNavEnv(observation="truth", max_seconds=300.0), oracle, episode)
    np.testing.assert_array_equal(told.actions, alone.actions)
    np.testing.assert_array_equal(told.infos["pose"], alone.infos["pose"])
    assert told.success
    assert set(told.observations) == set(MODES["command"])
    labelled = demonstrate(shown, make_agent("blind"), episode, shown, expert)
    assert labelled.infos["expert_action"].shape == (len(labelled.actions) + 1, 2)


def test_a_dataset_has_a_specification_and_infos(tmp_path: Path) -> None:
    """`recover_environment` makes the environment that was shown."""
    words = ["test_real", "--agent", "oracle", "--observation", "command", "--episodes", "2"]
    out = tmp_path / "d"
    assert main(["demonstrate", *words, "--labels", "--rounds", "--out", str(out)]) == 0
    dataset = minari.MinariDataset(out / "data")
    env = dataset.recover_environment()
    assert env.unwrapped.observation_type.mode == "command"
    assert env.observation_space == dataset.observation_space
    assert env.reset(seed=1)[1]["episode_id"].startswith("test_real-")
    for driven, episode in zip(dataset, evenly(load_episodes("test_real"), 2), strict=True):
        steps = len(driven.actions)
        shapes = {"pose": (3,), "goal": (13,), "clause": (), "expert_action": (2,)}
        for name, shape in shapes.items():
            assert driven.infos[name].shape == (steps + 1, *shape)
        assert set(driven.infos["reward_terms"]) == {each.name for each in fields(RewardWeights)}
        total = sum(driven.infos["reward_terms"].values())[1:]
        np.testing.assert_allclose(total, driven.rewards, atol=1e-9)
        first = driven.infos["pose"][0]
        assert tuple(first) == pytest.approx(episode.start)
        [metadata] = dataset.storage.get_episode_metadata([driven.id])
        assert metadata["options"]["instruction"] == episode.command


@pytest.mark.parametrize(("rounds", "most"), [(False, 4500), (True, 3000)])
def test_a_step_takes_far_less_than_seven_kilobytes(
    rounds: bool, most: int, driven: tuple[SemNavEnv, Demonstration], tmp_path: Path
) -> None:
    """Of an observation with the scan, compressed; and what is rounded is near."""
    env = SemNavEnv(observation="all")
    shown = demonstrate(driven[0], make_agent("oracle"), driven[1].episode, env)
    with DemonstrationFile(str(tmp_path / "d"), env, "oracle", rounds) as file:
        file.add(shown)
    size = (file.folder / "data" / "main_data.hdf5").stat().st_size
    assert size / len(shown.actions) < most
    again = minari.MinariDataset(file.folder / "data")[0].observations
    for name, values in shown.observations.items():
        assert again[name].dtype == env.observation_space[name].dtype
        np.testing.assert_allclose(again[name], values, atol=2.0**-11 if rounds else 0.0)


def test_an_observation_of_ones_own_leaves_the_specification_out(tmp_path: Path) -> None:
    env = gym.make("semnav_env:SemNav-v0", observation=EntryObservation("raw")).unwrapped
    assert isinstance(env, SemNavEnv)
    with DemonstrationFile(str(tmp_path / "d"), env, "oracle") as file:
        assert "env_spec" not in file._storage.metadata
