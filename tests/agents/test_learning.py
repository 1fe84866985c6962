"""What a small policy computes and is kept in; none of it needs torch."""

import json
import pickle
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.learned import PRETRAINED_FOLDER, LearnedAgent, pretrained_names
from semnav_agents.learning.actions import for_body, from_body
from semnav_agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_agents.learning.files import (
    AGENT_FILE,
    POLICY_FILE,
    AgentDescription,
    save_tensors,
)
from semnav_agents.learning.policy import Policy
from semnav_agents.learning.presets import PRESETS
from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import GOAL
from semnav_env.robots import ROBOTS
from tests.golden import drive
from tests.support.compact_observations import LIDAR, compact, observation

pytest.importorskip("safetensors", reason='needs the extra "rl"')

WIDTHS = (COMPACT_SIZE, 16, 2)


def policy(seed=0, widths=WIDTHS):
    rng = np.random.default_rng(seed)
    shapes = list(pairwise(widths))
    return Policy(
        tuple(rng.normal(size=(o, i)).astype(np.float32) for i, o in shapes),
        tuple(rng.normal(size=o).astype(np.float32) for _, o in shapes),
    )


def save(folder, a_policy, **changes):
    folder.mkdir(exist_ok=True)
    save_tensors(folder / POLICY_FILE, a_policy.tensors())
    fields = {"robots": ("wheelchair",), "repeat": 3, "widths": WIDTHS, "preset": {}}
    AgentDescription(**{**fields, "seed": 0, "steps": 5, **changes}).write(folder)
    return folder


@pytest.fixture
def saved(tmp_path):
    return save(tmp_path / "agent", policy())


@pytest.mark.parametrize("robot", ROBOTS)
def test_an_action_of_a_body_comes_back_from_that_of_the_policy(robot):
    size = ROBOTS[robot].action_size
    action = np.arange(size) / 4
    assert np.array_equal(for_body(from_body(action, 3), size), action)


def test_every_preset_has_its_name():
    assert all(name == p.name for name, p in PRESETS.items())


def test_the_agents_that_come_along_can_be_loaded_by_name():
    assert pretrained_names() == ("drive",)
    assert all(LearnedAgent.load(name).policy.weights for name in pretrained_names())


def test_all_weights_that_come_along_are_small():
    assert sum(path.stat().st_size for path in PRETRAINED_FOLDER.rglob("*")) < 5_000_000


@pytest.mark.parametrize("name", drive.EPISODES)
def test_the_agents_that_drive_do_what_they_did_when_they_were_made(name):
    """Another processor may round otherwise, hence a tolerance of one.

    If this fails for a good reason: `python -m tests.golden.drive`.
    """
    expected = json.loads(drive.GOLDEN.read_text())[name]
    found = drive.counts(name)
    assert found["episodes"] == expected["episodes"]
    assert abs(found["success"] - expected["success"]) <= 1
    assert abs(found["contact_free"] - expected["contact_free"]) <= 1


def test_a_policy_is_what_its_formula_says():
    net = policy(3)
    values = np.linspace(-1, 1, COMPACT_SIZE, dtype=np.float32)
    hidden = np.tanh(net.weights[0] @ values + net.biases[0])
    expected = np.clip(net.weights[1] @ hidden + net.biases[1], -1, 1)
    assert np.allclose(net.act(values), expected)


@given(st.integers(0, 1000))
def test_a_policy_comes_back_from_its_tensors(seed):
    net = policy(seed)
    again = Policy.from_tensors(net.tensors(), WIDTHS)
    values = np.random.default_rng(seed).uniform(-1, 1, COMPACT_SIZE).astype(np.float32)
    assert np.array_equal(net.act(values), again.act(values))


def test_a_saved_agent_acts_as_its_policy(saved):
    """It also holds each action for as many steps, if none is checked."""
    agent, net = LearnedAgent.load(saved), policy()
    agent.shielded = False
    env = SemNavEnv(observation=agent.observation)
    seen, info = env.reset(seed=0)
    agent.reset(info)
    observer = CompactObserver([env.robot], env.lidar_spec)
    for step in range(9):
        if step % 3 == 0:
            row = {name: entry[None] for name, entry in seen.items()}
            expected = net.act(observer.observe(row)[0])
        action = agent.act(seen)
        assert np.array_equal(action, expected)
        seen, *_ = env.step(action)


def test_a_new_episode_begins_with_a_new_action(saved):
    agent = LearnedAgent.load(saved)
    info = {"robot": vars(ROBOTS["wheelchair"]), "lidar": vars(LIDAR)}
    near, far = observation(np.full(811, 0.5)), observation(np.full(811, 9.0))
    agent.shielded = False
    agent.reset(info)
    agent.act(near)
    agent.reset(info)
    assert np.array_equal(agent.act(far), policy().act(compact(far)))


def test_it_stands_still_where_the_goal_is_to_stop(saved):
    agent, goal = LearnedAgent.load(saved), np.zeros(GOAL.size, np.float32)
    goal[GOAL.columns.index("stop")] = 1.0
    agent.reset({"robot": vars(ROBOTS["wheelchair"]), "lidar": vars(LIDAR)})
    assert not agent.act(observation(np.full(811, 2.0), goal)).any()
    assert agent.act(observation(np.full(811, 2.0))).any()


def test_another_robot_is_refused(saved):
    with pytest.raises(ValueError, match="trained on 'wheelchair', not 'spot'"):
        LearnedAgent.load(saved).reset({"robot": vars(ROBOTS["spot"])})


def test_a_policy_that_does_not_fit_is_refused(tmp_path):
    folder = save(tmp_path / "a", policy(widths=(3, 4, 2)), widths=(3, 4, 2))
    with pytest.raises(ValueError, match=f"takes 3 values .* has {COMPACT_SIZE} and 2"):
        LearnedAgent.load(folder)


def edit(saved, **changes):
    path = saved / AGENT_FILE
    path.write_text(json.dumps({**json.loads(path.read_text()), **changes}))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": 1}, "has format 1; this version reads format 2"),
        ({"widths": [COMPACT_SIZE, -1, 2]}, "'widths' must be"),
        ({"widths": [COMPACT_SIZE, True, 2]}, "'widths' must be"),
        ({"widths": "wide"}, "'widths' must be of type list"),
        ({"repeat": 0}, "'repeat' must be at least 1"),
        ({"repeat": 1.5}, "'repeat' must be of type int"),
        ({"robots": ["bicycle"]}, "no robot named 'bicycle'"),
        ({"robots": []}, "'robots' must be one or more names"),
    ],
)
def test_a_wrong_description_is_refused_by_name(saved, changes, message):
    edit(saved, **changes)
    with pytest.raises(ValueError, match=message):
        LearnedAgent.load(saved)


@pytest.mark.parametrize("text", ["", "[]", "nonsense", "[" * 100_000, '"\\ud800"'])
def test_a_wrong_description_is_refused(saved, text):
    (saved / AGENT_FILE).write_text(text)
    with pytest.raises(ValueError, match=AGENT_FILE):
        LearnedAgent.load(saved)


def test_a_folder_without_an_agent_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"holds no trained agent: there is no agent\.json"):
        LearnedAgent.load(tmp_path)


@pytest.mark.parametrize(
    ("name", "tensor", "message"),
    [
        ("1.bias", np.zeros(3, np.float32), r"'1.bias' is float32 of shape \(3,\); it must be"),
        ("1.bias", np.zeros(2, np.float64), "'1.bias' is float64"),
        ("1.bias", np.full(2, np.nan, np.float32), "'1.bias' is not finite"),
        ("2.bias", np.zeros(2, np.float32), "'2.bias' is unknown"),
    ],
)
def test_wrong_weights_are_refused_by_name(saved, name, tensor, message):
    save_tensors(saved / POLICY_FILE, {**policy().tensors(), name: tensor})
    with pytest.raises(ValueError, match=message):
        LearnedAgent.load(saved)


def test_missing_weights_are_refused_by_name(saved):
    tensors = policy().tensors()
    del tensors["0.weight"]
    save_tensors(saved / POLICY_FILE, tensors)
    with pytest.raises(ValueError, match=r"'0.weight' is missing"):
        LearnedAgent.load(saved)


class Trap:
    def __reduce__(self):
        return pytest.fail, ("unpickled",)


@pytest.mark.parametrize("data", [b"", b"\0" * 8, b"\xff" * 64, pickle.dumps(Trap())])
def test_a_file_that_is_not_safetensors_is_never_unpickled(saved, data):
    (saved / POLICY_FILE).write_bytes(data)
    with pytest.raises(ValueError, match="is not a safetensors file"):
        LearnedAgent.load(saved)


@given(cut=st.integers(0, 400))
def test_a_file_cut_short_is_refused(tmp_path_factory, cut):
    folder = save(tmp_path_factory.mktemp("cut"), policy())
    whole = (folder / POLICY_FILE).read_bytes()
    (folder / POLICY_FILE).write_bytes(whole[: len(whole) * cut // 401])
    with pytest.raises(ValueError, match="is not a safetensors file"):
        LearnedAgent.load(folder)
