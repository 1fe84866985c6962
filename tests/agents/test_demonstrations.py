"""Demonstrations on disk: all that was driven is there, and reads back as it was."""

from __future__ import annotations

import json
import os
import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from semnav_env.agents import demonstrations
from semnav_env.agents.demonstrations import Demonstration, DemonstrationFile, demonstrate
from semnav_env.agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.episodes import evenly, load_episodes
from semnav_env.scripts import demonstrate as script
from semnav_env.scripts.main import main

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
    file = DemonstrationFile(str(tmp_path / "data set"), env, "oracle")
    file.add(demonstration)
    file.add(demonstration)
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
    file = DemonstrationFile("new set", env, "oracle")
    file.add(demonstration)
    assert file.count == 1
    assert minari.MinariDataset(tmp_path / "new set" / "data").total_episodes == 1


def test_what_was_driven_before_an_interruption_is_kept(
    driven: tuple[SemNavEnv, Demonstration],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    calls: list[str] = []

    def interrupted(env: Any, agent: Any, episode: Any) -> Demonstration:
        calls.append(episode.id)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return driven[1]

    monkeypatch.setattr(script, "demonstrate", interrupted)
    words = ["demonstrate", "test_real", "--out", str(tmp_path / "d"), "--agent", "oracle"]
    assert main(words) == 130
    dataset = minari.MinariDataset(tmp_path / "d" / "data")
    assert len(list(dataset.iterate_episodes())) == 2


def test_an_interruption_waits_until_the_episode_is_written() -> None:
    written: list[int] = []

    def write() -> None:
        with demonstrations._uninterrupted():
            os.kill(os.getpid(), signal.SIGINT)
            written.append(1)

    with pytest.raises(KeyboardInterrupt):
        write()
    assert written == [1]


def test_a_named_dataset_is_found_by_its_name(
    driven: tuple[SemNavEnv, Demonstration], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    file = DemonstrationFile("mine/oracle-v3", driven[0], "oracle")
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
