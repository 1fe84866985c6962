"""What a small policy sees, computes and is kept in; none of it needs torch."""

import json
import pickle
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_env.agents.learned import PRETRAINED_FOLDER, LearnedAgent, pretrained_names
from semnav_env.agents.learning.actions import for_body, from_body
from semnav_env.agents.learning.clearance_memory import NO_HIT, SECTORS, ClearanceMemory
from semnav_env.agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_env.agents.learning.files import (
    AGENT_FILE,
    POLICY_FILE,
    AgentDescription,
    save_tensors,
)
from semnav_env.agents.learning.policy import Policy
from semnav_env.agents.learning.presets import PRESETS
from semnav_env.env import SemNavEnv
from semnav_env.features.lidar_spec import lidar_spec
from semnav_env.observations import GOAL, UNBOUNDED
from semnav_env.robots import ROBOTS
from semnav_env.vector import SemNavVectorEnv
from tests.golden import drive

pytest.importorskip("safetensors", reason='needs the extra "rl"')

WIDTHS = (COMPACT_SIZE, 16, 2)


def observation(scan, goal=None, velocity=(0, 0, 0)):
    odometry = np.array([0, 0, 1, 0, *velocity], np.float32)
    goal = np.zeros(GOAL.size, np.float32) if goal is None else goal
    return {"scan": np.asarray(scan, np.float32), "odometry": odometry, "goal": goal}


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


LIDAR = lidar_spec("tim561")


def compact(seen, robot="wheelchair", lidar=LIDAR):
    """The compact observation at the start of an episode."""
    row = {name: entry[None] for name, entry in seen.items()}
    return CompactObserver([ROBOTS[robot]], lidar).observe(row)[0]


@given(
    arrays(np.float32, LIDAR.beams, elements=st.floats(0, 50, width=32)),
    arrays(np.float32, GOAL.size, elements=st.floats(-UNBOUNDED, UNBOUNDED, width=32)),
    st.tuples(*[st.floats(-3, 3)] * 3),
)
def test_every_value_lies_between_minus_one_and_one(scan, goal, velocity):
    goal[:4], goal[6:8], goal[-1] = 0, 1, 1
    values = compact(observation(scan, goal, velocity))
    assert values.shape == (COMPACT_SIZE,)
    assert values.dtype == np.float32
    assert np.abs(values).max() <= 1


@pytest.mark.parametrize(
    ("beam", "x", "y"), [(405, 1.45, 0.0), (135, 0.45, -1.0), (675, 0.45, 1.0)]
)
def test_a_hit_is_as_near_as_it_is_to_the_footprint(beam, x, y):
    """The lidar is 0.45 m before the centre, beams are 1/3 of a degree apart; beam 405 is ahead."""
    scan = np.full((1, LIDAR.beams), LIDAR.range_max, np.float32)
    scan[0, beam] = 1.0
    robot = ROBOTS["wheelchair"]
    room = ClearanceMemory([robot], LIDAR).clearances(np.array([0]), np.zeros((1, 3)), scan)[0]
    [sector] = np.flatnonzero(room < NO_HIT)
    sides = max(abs(x) - robot.length / 2, 0.0), max(abs(y) - robot.width / 2, 0.0)
    assert room[sector] == pytest.approx(np.hypot(*sides), abs=0.01)
    assert sector == pytest.approx((np.arctan2(y, x) / np.pi + 1) * SECTORS / 2, abs=1)


def test_what_was_ahead_is_remembered_behind():
    scan = np.full((1, LIDAR.beams), 2.0, np.float32)
    clear = np.full((1, LIDAR.beams), LIDAR.range_max, np.float32)
    around, here = ClearanceMemory([ROBOTS["spot"]], LIDAR), np.array([0])
    seen = around.clearances(here, np.zeros((1, 3)), scan)[0]
    turned = around.clearances(here, np.array([[0.0, 0.0, np.pi]]), clear)[0]
    assert seen[0] == NO_HIT
    assert np.allclose(np.roll(turned, SECTORS // 2)[14:-14], seen[14:-14], atol=0.1)
    around.forget(np.array([True]))
    assert (around.clearances(here, np.zeros((1, 3)), clear) == NO_HIT).all()


def test_a_place_keeps_its_direction():
    goal = np.zeros(GOAL.size, np.float32)
    goal[4:6] = 30.0, 40.0
    x, y = compact(observation(np.ones(LIDAR.beams), goal))[5:7]
    assert (x, y) == pytest.approx((30 / 51, 40 / 51))


@pytest.mark.parametrize("robot", ROBOTS)
def test_many_observations_become_compact_to_the_bits_of_single_ones(robot):
    envs = SemNavVectorEnv(5, robot=robot, observation="all")
    first, _ = envs.reset(seed=0)
    spec, lidar = envs.envs[0].robot, envs.envs[0].lidar_spec
    together, alone = CompactObserver([spec] * 5, lidar), CompactObserver([spec] * 5, lidar)
    for seen in (first, envs.step(envs.action_space.sample())[0]):
        rows = together.observe(seen)
        assert np.abs(rows).max() <= 1
        for k, row in enumerate(rows):
            of_one = {name: entry[k : k + 1] for name, entry in seen.items()}
            assert row.tobytes() == alone.observe(of_one, [k])[0].tobytes()


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


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_drive_agent_does_what_it_did_when_it_was_made(robot):
    """Ten episodes of each body; another processor may round otherwise, hence a tolerance of one.

    If this fails for a good reason: `python -m tests.golden.drive`.
    """
    expected = json.loads(drive.GOLDEN.read_text())[robot]
    found = drive.counts(robot)
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
    """It also holds each action for as many steps."""
    agent, net = LearnedAgent.load(saved), policy()
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
