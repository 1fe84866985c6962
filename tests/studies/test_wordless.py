"""The listener that is trained and measured without the words."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("torch")

from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode, load_episodes
from semnav_env.language import GoToRoom
from semnav_env.mind.observations import table
from studies.wordless.wordless import WordlessAgent, WordlessObservation, train


def to_a_room() -> Episode:
    """An episode whose command names a room."""
    return next(
        each
        for each in load_episodes("val_unseen")
        if any(isinstance(clause, GoToRoom) for clause in each.meanings()[0].clauses)
    )


def test_without_words_two_commands_look_the_same() -> None:
    episode = to_a_room()
    options = {"floor_plan": episode.floor_plan, "pose": episode.start}
    env = SemNavEnv(observation="command")
    told, _ = env.reset(seed=0, options={"episode": episode})
    assert len(table(told, "told_ways"))
    wordless = SemNavEnv(observation=WordlessObservation("command"))
    rows = [
        wordless.reset(seed=0, options=each)[0]
        for each in ({"episode": episode}, {**options, "command": "turn around"})
    ]
    for name in rows[0]:
        assert (rows[0][name] == rows[1][name]).all(), name


def test_a_tiny_training_gives_an_agent_that_drives(tmp_path: Path) -> None:
    episode = load_episodes("train")[0]
    rows = list(train(tmp_path, [episode], 1, 0))
    assert rows[0]["samples"] > 0
    agent = WordlessAgent.load(tmp_path)
    env = SemNavEnv(observation=agent.observation)
    observation, info = env.reset(seed=0, options={"episode": episode})
    agent.reset(info)
    assert env.action_space.contains(agent.act(observation))
