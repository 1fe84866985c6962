"""The bundled agent that hears the command."""

import json
from dataclasses import replace

import pytest

from semnav_agents.base import steps
from semnav_agents.hearing.agent import HearingAgent, hearing_names
from semnav_agents.hearing.network import NetworkShape
from semnav_agents.learned import agent_label
from semnav_agents.networks.bundled import BUNDLED_FOLDER
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import load_episodes
from semnav_env.networks.card import Card
from tests.support.paths import GOLDEN

EXPECTED = json.loads((GOLDEN / "listener.json").read_text())
"""Verdicts of the clauses of some episodes of `val_seen`, wheelchair."""


@pytest.fixture(scope="module")
def env():
    return SemNavEnv(observation="command", max_seconds=100.0)


@pytest.fixture(scope="module")
def episodes():
    return {episode.id: episode for episode in load_episodes("val_seen")}


@pytest.mark.parametrize("name", EXPECTED)
def test_bundled_agent_does_what_it_did(env, episodes, name):
    episode, agent = episodes[name], make_agent("listener")
    observation, info = env.reset(seed=episode.number, options={"episode": episode})
    *_, last = steps(env, agent, observation, info)
    assert [str(verdict) for verdict in last.info["verdicts"]] == EXPECTED[name]


def test_bundled_agent_drives_another_body(episodes):
    env, agent = SemNavEnv("spot", observation="command", max_seconds=100.0), make_agent("listener")
    episode = episodes["val_seen-00007"]
    observation, info = env.reset(seed=episode.number, options={"episode": episode})
    *_, last = steps(env, agent, observation, info)
    assert last.info["is_success"]


def test_it_observes_neither_goal_nor_clause():
    space = SemNavEnv(observation=HearingAgent.observation).observation_space
    assert not {"goal", "clause"} & set(space)


def test_every_bundled_card_has_its_curve_and_limits():
    assert "listener" in hearing_names()
    for name in hearing_names():
        card = Card.read(BUNDLED_FOLDER / name, NetworkShape)
        assert card.curve
        assert {"data", "results", "limits"} <= card.notes.keys()


def test_its_results_are_named_by_preset_and_seed(tmp_path):
    assert agent_label("listener") == {"agent": "listener", "training_seed": 0}
    replace(Card.read(BUNDLED_FOLDER / "listener", NetworkShape), seed=3).write(tmp_path)
    assert agent_label(str(tmp_path)) == {"agent": "listener", "training_seed": 3}
