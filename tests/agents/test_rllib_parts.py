"""Training on RLlib: what needs no Ray."""

import sys
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')

from semnav_agents.learning.compact import COMPACT_SIZE, CompactObserver
from semnav_agents.learning.preset_envs import options_of_body
from semnav_agents.learning.presets import PRESETS
from semnav_agents.learning.rllib.options import RayOptions
from semnav_agents.learning.rllib.runner_env import runner_envs
from semnav_agents.learning.rllib.start import start_training
from semnav_agents.learning.rllib.weights import (
    RLlibState,
    beginning,
    policy_from,
)
from semnav_agents.learning.training import LOGGED_KEYS
from semnav_env.networks.card import CARD_FILE
from semnav_env.robots import robot_spec
from semnav_env.vector import SemNavVectorEnv
from semnav_scripts import main as cli

BRIEF = replace(PRESETS["hallway"], max_seconds=0.5, envs=6)


def rllib_weights(widths=(COMPACT_SIZE, 8, 8, 2), seed=0):
    """Weights by RLlib's names and in its order, for a policy of these widths."""
    rng = np.random.default_rng(seed)
    inputs, *hidden, outputs = widths
    weights = {}

    def layer(name, into, out):
        weights[f"{name}.weight"] = rng.normal(size=(out, into)).astype(np.float32)
        weights[f"{name}.bias"] = rng.normal(size=out).astype(np.float32)

    for part in ("actor", "critic"):
        sizes = [inputs, *hidden]
        for i, out in enumerate(hidden):
            layer(f"encoder.{part}_encoder.net.mlp.{2 * i}", sizes[i], out)
    weights["pi.log_std"] = np.zeros(outputs, np.float32)
    weights["pi.log_std_clip_param_const"] = np.array([20.0], np.float32)
    layer("pi.net.mlp.0", hidden[-1], outputs)
    layer("vf.net.mlp.0", hidden[-1], 1)
    return weights


def moments_of(weights):
    shapes = [w.shape for name, w in weights.items() if not name.endswith("_const")]
    return {
        i: {"step": 3.0, "exp_avg": np.full(s, i, np.float32), "exp_avg_sq": np.ones(s, np.float32)}
        for i, s in enumerate(shapes)
    }


def test_robots_of_a_preset_are_divided_among_the_runners():
    preset = replace(BRIEF, envs=64)
    assert RayOptions(runners=4).robots_each(preset) == 16
    assert RayOptions(runners=5).robots_each(preset) == 13
    assert RayOptions(runners=4, robots=64).robots_each(preset) == 64
    assert RayOptions(runners=4).decisions(preset) == 64 * preset.ppo.rollout


@pytest.mark.parametrize("wrong", [{"runners": 0}, {"threads": 0}, {"robots": 0}])
def test_bad_options_are_named(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        RayOptions(**wrong)


def test_a_runner_sees_what_the_policy_sees():
    envs = runner_envs(BRIEF, 3)
    native = SemNavVectorEnv(3, **options_of_body(BRIEF, robot_spec("wheelchair"), 3))
    observer = CompactObserver([native.envs[0].robot] * 3, native.envs[0].lidar_spec)
    seeds = np.random.SeedSequence(7).generate_state(3).tolist()
    seen, expected = envs.reset(seed=7)[0], native.reset(seed=seeds)[0]
    observer.forget(np.ones(3, bool))
    assert np.array_equal(seen, observer.observe(expected))
    assert envs.observation_space.contains(seen)
    over = np.zeros(3, bool)
    for _ in range(5):
        action = envs.action_space.sample()
        (seen, *told, _), (expected, *known, _) = envs.step(action), native.step(action)
        observer.forget(over)
        assert np.array_equal(seen, observer.observe(expected))
        assert all(np.array_equal(a, b) for a, b in zip(told, known, strict=True))
        over = known[1] | known[2]


def test_several_bodies_are_refused_before_ray_starts(tmp_path):
    with pytest.raises(ValueError, match="several bodies"):
        start_training(PRESETS["drive"], tmp_path, 0, RayOptions())


def test_infos_are_those_of_ended_episodes():
    envs = runner_envs(BRIEF, 3)
    assert envs.reset(seed=0)[1] == {}
    names = {*LOGGED_KEYS, *(f"_{key}" for key in LOGGED_KEYS)}
    for _ in range(6):
        *_, terminated, truncated, infos = envs.step(np.zeros((3, 2), np.float32))
        over = terminated | truncated
        assert set(infos) == (names if any(over) else set())
        assert all(np.array_equal(infos[f"_{k}"], over) for k in LOGGED_KEYS if infos)


def test_robots_of_two_runners_drive_different_episodes():
    """RLlib seeds its runners with whole numbers that follow each other."""
    first, second = (runner_envs(BRIEF, 4).reset(seed=seed)[0] for seed in (1, 2))
    assert not {row.tobytes() for row in first} & {row.tobytes() for row in second}


def test_the_policy_acts_as_the_layers_of_rllib():
    weights = rllib_weights()
    seen = np.linspace(-1, 1, COMPACT_SIZE, dtype=np.float32)
    layers = [f"encoder.actor_encoder.net.mlp.{i}" for i in (0, 2)]
    values = seen
    for name in layers:
        values = np.tanh(weights[f"{name}.weight"] @ values + weights[f"{name}.bias"])
    mean = weights["pi.net.mlp.0.weight"] @ values + weights["pi.net.mlp.0.bias"]
    assert np.allclose(policy_from(weights, 2).act(seen), np.clip(mean, -1, 1))


def test_a_training_begins_with_actions_about_zero():
    weights = beginning(rllib_weights(), log_std=-0.5)
    seen = np.ones(COMPACT_SIZE, np.float32)
    assert np.abs(policy_from(weights, 2).act(seen)).max() < 0.2
    assert weights["pi.log_std"].tolist() == [-0.5, -0.5]


@pytest.mark.parametrize("learned", [False, True])
def test_what_was_learned_is_written_and_read_alike(learned):
    weights = rllib_weights()
    state = RLlibState(weights, moments_of(weights) if learned else {}, 4096)
    again = RLlibState.from_tensors(state.tensors(), rllib_weights(seed=1))
    assert again.steps == 4096
    assert all(np.array_equal(again.weights[name], w) for name, w in weights.items())
    assert again.adam.keys() == state.adam.keys()
    for i, moments in state.adam.items():
        assert all(np.array_equal(again.adam[i][name], value) for name, value in moments.items())


@pytest.mark.parametrize(
    ("name", "wrong", "message"),
    [
        ("steps", np.array([1]), "'steps' must be one whole number"),
        (
            "weights.pi.log_std",
            np.zeros(3, np.float32),
            "'weights.pi.log_std' is float32 of",
        ),
        ("adam.pi.log_std.step", np.array(np.nan, np.float32), "'adam.pi.log_std.step' is not fin"),
        ("more", np.zeros(1, np.float32), "'more' is unknown"),
    ],
)
def test_a_damaged_state_is_refused(name, wrong, message):
    weights = rllib_weights()
    tensors = RLlibState(weights, moments_of(weights), 64).tensors()
    with pytest.raises(ValueError, match=message):
        RLlibState.from_tensors({**tensors, name: wrong}, weights)


def run(capsys, *words):
    code = cli.main([str(word) for word in ("train", "hallway", "--engine", "ray", *words)])
    return code, capsys.readouterr().err


def test_without_ray_the_error_says_what_to_install(capsys, tmp_path, monkeypatch):
    for name in ("RAY_USAGE_STATS_ENABLED", "RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER"):
        monkeypatch.setenv(name, "0")
    monkeypatch.setitem(sys.modules, "ray", None)
    code, err = run(capsys, "--out", tmp_path / "none")
    assert code == 2
    assert err == (
        'semnav: --engine ray needs ray: pip install "semnav-env[rl,ray]" in an environment of its '
        "own, for Ray takes an older Gymnasium than the rest\n"
    )
    assert not (tmp_path / "none").exists()


def test_what_cannot_be_resumed_is_said_before_ray_starts(capsys, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    assert "holds no trained network" in run(capsys, "--resume", "--out", tmp_path)[1]
    cli.main(["train", "hallway", "--steps", "0", "--out", str(tmp_path)])
    assert (tmp_path / CARD_FILE).exists()
    capsys.readouterr()
    assert "was not trained with --engine ray" in run(capsys, "--resume", "--out", tmp_path)[1]


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("somewhere", "--ray.address is 'somewhere'; it must be HOST:PORT or auto"),
        ("ray://127.0.0.1:6379", "it must be HOST:PORT or auto"),
        ("127.0.0.1:1", "no Ray cluster answers at 127.0.0.1:1: "),
        ("127.0.0.1:99999", "no Ray cluster answers at 127.0.0.1:99999: "),
    ],
)
def test_an_address_without_a_cluster_is_refused_at_once(capsys, tmp_path, address, message):
    code, err = run(capsys, "--ray.address", address, "--out", tmp_path / "none")
    assert code == 2
    assert message in err
    assert not (tmp_path / "none").exists()
