"""What a small policy computes and is kept in; none of it needs torch."""

import json
import pickle
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.learned import LearnedAgent, pretrained_names
from semnav_agents.learning.actions import for_body, from_body
from semnav_agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_agents.learning.policy import Policy, PolicySettings
from semnav_agents.learning.presets import PRESETS
from semnav_agents.networks.bundled import BUNDLED_FOLDER
from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import GOAL
from semnav_env.networks.card import CARD_FILE, Card
from semnav_env.networks.weights import WEIGHTS_FILE, load_weights, save_weights
from semnav_env.robots import ROBOTS
from tests.golden import drive
from tests.support.compact_observations import LIDAR, compact, observation

WIDTHS = (COMPACT_SIZE, 16, 2)


def policy(seed=0, widths=WIDTHS):
    rng = np.random.default_rng(seed)
    shapes = list(pairwise(widths))
    weights = [rng.normal(size=(o, i)).astype(np.float32) for i, o in shapes]
    biases = [rng.normal(size=o).astype(np.float32) for _, o in shapes]
    return Policy.of_layers(list(zip(weights, biases, strict=True)))


def save(folder, a_policy):
    folder.mkdir(exist_ok=True)
    save_weights(folder, a_policy.tensors)
    Card(PolicySettings(("wheelchair",), 3, a_policy.widths, 5), {}, 0).write(folder)
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
    assert all(LearnedAgent.load(name).policy.tensors for name in pretrained_names())


def test_all_weights_that_come_along_are_small():
    assert sum(path.stat().st_size for path in BUNDLED_FOLDER.rglob("*")) < 5_000_000


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
    hidden = np.tanh(net.tensors["0.weight"] @ values + net.tensors["0.bias"])
    expected = np.clip(net.tensors["1.weight"] @ hidden + net.tensors["1.bias"], -1, 1)
    assert np.allclose(net.act(values), expected)


def test_half_precision_is_widened(tmp_path):
    save_weights(tmp_path, {"w": np.array([0.1, -7.0], np.float16)})
    found = load_weights(tmp_path, {"w": (2,)})["w"]
    assert found.dtype == np.float32
    assert np.array_equal(found, np.array([0.1, -7.0], np.float16))


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
    folder = save(tmp_path / "a", policy(widths=(3, 4, 2)))
    with pytest.raises(ValueError, match=f"takes 3 values .* has {COMPACT_SIZE} and 2"):
        LearnedAgent.load(folder)


def edit(saved, **changes):
    path = saved / CARD_FILE
    card = json.loads(path.read_text())
    for name, value in changes.items():
        (card if name in card else card["settings"])[name] = value
    path.write_text(json.dumps(card))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": 2}, "has format 2; this version reads format 3"),
        ({"network": "grounding"}, "the card of a 'grounding', not of a 'policy'"),
        ({"seed": -1}, "'seed' must be at least 0, not -1"),
        ({"seed": "zero"}, "'seed' must be of type int, not 'zero'"),
        ({"widths": [COMPACT_SIZE, -1, 2]}, r"settings: widths\[1\] is -1; it must be"),
        ({"widths": [COMPACT_SIZE, True, 2]}, r"settings: widths\[1\] is True; it must be"),
        ({"widths": [COMPACT_SIZE]}, "settings: widths is .* two or more"),
        ({"widths": "wide"}, "settings: widths is 'wide'; it must be a tuple"),
        ({"repeat": 0}, "settings: repeat is 0; it must be"),
        ({"repeat": 1.5}, "settings: repeat is 1.5; it must be"),
        ({"steps": -1}, "settings: steps is -1; it must be"),
        ({"robots": ["bicycle"]}, "no robot named 'bicycle'"),
        ({"robots": []}, "settings: robots is empty; it must be one or more names"),
        ({"wheels": 4}, "settings: .*'wheels'"),
    ],
)
def test_a_wrong_description_is_refused_by_name(saved, changes, message):
    edit(saved, **changes)
    with pytest.raises(ValueError, match=message):
        LearnedAgent.load(saved)


@pytest.mark.parametrize("text", ["", "[]", "nonsense", "[" * 100_000, '"\\ud800"'])
def test_a_wrong_description_is_refused(saved, text):
    (saved / CARD_FILE).write_text(text)
    with pytest.raises(ValueError, match=CARD_FILE):
        LearnedAgent.load(saved)


def test_a_folder_without_an_agent_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"holds no trained network: there is no card\.json"):
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
    save_weights(saved, {**policy().tensors, name: tensor})
    with pytest.raises(ValueError, match=message):
        LearnedAgent.load(saved)


def test_missing_weights_are_refused_by_name(saved):
    tensors = dict(policy().tensors)
    del tensors["0.weight"]
    save_weights(saved, tensors)
    with pytest.raises(ValueError, match=r"'0.weight' is missing"):
        LearnedAgent.load(saved)


class Trap:
    def __reduce__(self):
        return pytest.fail, ("unpickled",)


@pytest.mark.parametrize("data", [b"", b"\0" * 8, b"\xff" * 64, pickle.dumps(Trap())])
def test_a_file_that_is_not_safetensors_is_never_unpickled(saved, data):
    (saved / WEIGHTS_FILE).write_bytes(data)
    with pytest.raises(ValueError, match="is not a safetensors file"):
        LearnedAgent.load(saved)


@given(cut=st.integers(0, 400))
def test_a_file_cut_short_is_refused(tmp_path_factory, cut):
    folder = save(tmp_path_factory.mktemp("cut"), policy())
    whole = (folder / WEIGHTS_FILE).read_bytes()
    (folder / WEIGHTS_FILE).write_bytes(whole[: len(whole) * cut // 401])
    with pytest.raises(ValueError, match="is not a safetensors file"):
        LearnedAgent.load(folder)
