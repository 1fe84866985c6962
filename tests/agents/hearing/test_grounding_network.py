"""The network of agents that hear: what it sees, and that the robot runs what was trained."""

import numpy as np
import pytest

from semnav_agents.hearing.clause_state import ClauseState
from semnav_agents.hearing.elements import MOST_ELEMENTS, describe
from semnav_agents.hearing.network import GroundingNetwork, NetworkShape
from semnav_agents.hearing.tokens import COMMAND_SIZE, describe_clauses
from semnav_env.env import SemNavEnv
from semnav_env.language import encode, parse
from semnav_env.mind.observations import read_odometry, table
from semnav_env.mind.observations.layout import MEMORY_TABLES, TABLES

SHAPE = NetworkShape(width=16, heads=2, layers=2, hidden=24)
COMMAND = "go through the second door on the right and turn left"
TABLE_COLUMNS = {entry.name: len(entry.columns) for entry in (*TABLES, *MEMORY_TABLES)}


def random_network(seed=0):
    rng = np.random.default_rng(seed)
    tensors = {
        name: rng.normal(0.0, 0.3, size).astype(np.float32)
        for name, size in SHAPE.tensors().items()
    }
    return GroundingNetwork(SHAPE, tensors), tensors


@pytest.fixture(scope="module")
def moment():
    """An observation after some driving, and what is needed to describe it."""
    env = SemNavEnv(observation="command")
    options = {"command": COMMAND, "pose": (-2.5, -0.3, 0.24)}
    observation, _ = env.reset(seed=0, options=options)
    state = ClauseState(observation["command"], read_odometry(observation)[0])
    for _ in range(12):
        observation = env.step(np.array([0.5, 0.0], np.float32))[0]
        state.note(read_odometry(observation)[0], 0.5, 1 / 15)
    return observation, state, (env.lidar_spec, env.robot.lidar_mount)


def with_shuffled_rows(observation, seed):
    rng, other = np.random.default_rng(seed), dict(observation)
    for name, columns in TABLE_COLUMNS.items():
        rows = observation[name].reshape(-1, columns)
        if not name.startswith("told_"):  # the places of a way have an order
            order = rng.permutation(len(rows))
            other[name] = rows[order].ravel()
            other[f"{name}_mask"] = observation[f"{name}_mask"][order]
    return other


def test_order_of_rows_does_not_matter(moment):
    observation, state, lidar = moment
    assert len(table(observation, "remembered_doors")) > 1
    network, _ = random_network()
    said = [
        network.ground(describe(each, state, *lidar))
        for each in (observation, with_shuffled_rows(observation, 1))
    ]
    assert said[1].pose == pytest.approx(said[0].pose, abs=1e-3)
    assert said[1].kinds == pytest.approx(said[0].kinds, abs=1e-4)
    assert said[1].advances == pytest.approx(said[0].advances, abs=1e-4)


def test_description_is_in_the_frame_of_the_corridor(moment):
    """Where the robot is by now changes its own element alone, as far as it saw the same."""
    observation, state, lidar = moment
    description = describe(observation, state, *lidar)
    assert description.elements.shape[0] == MOST_ELEMENTS
    assert np.isfinite(description.elements).all()
    assert np.abs(description.elements).max() <= 4.0
    assert description.robot[0] > 0.1  # it has come forward


def test_numpy_says_what_torch_says(moment):
    torch = pytest.importorskip("torch")
    from semnav_agents.hearing.torch_network import TorchGrounding

    observation, state, lidar = moment
    description = describe(observation, state, *lidar)
    network, tensors = random_network(3)
    trained = TorchGrounding(SHAPE, seed=0)
    with torch.no_grad():
        for name, parameter in trained.named().items():
            parameter.copy_(torch.from_numpy(tensors[name]))
        batch = (description.elements, description.mask, description.command, description.bases)
        said = trained(
            *(torch.from_numpy(each)[None] for each in batch),
            torch.tensor([description.robot]),
        )
    found = network.ground(description)
    assert int(said.log_shares[0].argmax()) == found.element
    assert said.places[0, found.element].numpy() == pytest.approx(found.pose[:2], abs=1e-5)
    assert said.outputs[0, :4].softmax(0).numpy() == pytest.approx(found.kinds, abs=1e-5)
    assert said.advances[0].softmax(0).numpy() == pytest.approx(found.advances, abs=1e-5)


@pytest.mark.parametrize(
    "text",
    [
        "go 3 metres",
        "turn left by 45 degrees",
        "wait for 5 seconds",
        "go to the last door",
        COMMAND,
    ],
)
def test_every_clause_has_numbers(text):
    tokens = encode(parse(text))
    for clause in range(len(parse(text).clauses)):
        numbers = describe_clauses(tokens, clause)
        assert numbers.shape == (COMMAND_SIZE,)
        assert numbers.any()


def test_clauses_that_differ_have_different_numbers():
    texts = ("go to the first door", "go to the second door", "go to the last door", "go 2 metres")
    rows = [describe_clauses(encode(parse(text)), 0) for text in texts]
    assert len({row.tobytes() for row in rows}) == len(texts)


def test_pointer_goes_on_and_forgets():
    tokens = encode(parse(COMMAND))
    state = ClauseState(tokens, (0.0, 0.0, 0.0))
    state.note((2.0, 0.1, 0.0), 0.0, 0.5)
    assert state.farthest == (2.0, 0.1)
    assert state.still == 0.5
    state.start_clause(1, (2.5, 0.0, 0.0), (2.0, 0.1, 0.0))
    assert (state.clause, state.still, state.done) == (1, 0.0, False)
    state.start_clause(2, (2.5, 0.0, 0.0), (2.0, 0.1, 0.0))
    assert state.done


def test_weights_that_do_not_fit_are_named():
    _, tensors = random_network()
    tensors["embed.0.bias"] = tensors["embed.0.bias"][:-1]
    with pytest.raises(ValueError, match=r"embed\.0\.bias"):
        GroundingNetwork(SHAPE, tensors)
