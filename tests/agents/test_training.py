"""Training, what it keeps, and going on with it."""

import os
import pickle
import signal
import sys
import threading
import time
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')
torch = pytest.importorskip("torch", reason='needs the extra "rl"')

from semnav_env.agents.learned import LearnedAgent  # noqa: E402
from semnav_env.agents.learning.compact import compact  # noqa: E402
from semnav_env.agents.learning.files import (  # noqa: E402
    POLICY_FILE,
    TRAINING_FILE,
    AgentDescription,
    load_tensors,
    save_tensors,
)
from semnav_env.agents.learning.presets import PRESETS, PPOSettings  # noqa: E402
from semnav_env.agents.learning.training import Trainer  # noqa: E402
from semnav_env.metrics import spl  # noqa: E402
from semnav_env.scripts import main as cli  # noqa: E402

TINY = replace(
    PRESETS["quick"],
    name="tiny",
    max_seconds=3.0,
    envs=2,
    steps=128,
    ppo=PPOSettings(hidden=(8,), rollout=32, batch_size=32, epochs=2),
)
ROLLOUT = TINY.envs * TINY.ppo.rollout


@pytest.fixture
def tiny(monkeypatch):
    monkeypatch.setitem(PRESETS, "tiny", TINY)


def train(folder, rollouts=1, seed=0):
    trainer = Trainer(TINY, folder, seed)
    for _ in range(rollouts):
        trainer.advance()
    trainer.save()
    trainer.close()
    return trainer


def weights(trainer):
    return {name: w.numpy().copy() for name, w in trainer.model.policy.state_dict().items()}


def same(a, b):
    return a.keys() == b.keys() and all(np.array_equal(a[name], b[name]) for name in a)


def test_learning_changes_the_policy_and_counts_decisions(tmp_path):
    trainer = Trainer(TINY, tmp_path, seed=0)
    before = weights(trainer)
    report = trainer.advance()
    assert report.steps == ROLLOUT
    assert report.rate > 0
    assert not same(before, weights(trainer))
    trainer.close()
    assert any((tmp_path / "tensorboard").iterdir())


def test_the_curves_are_of_the_measures_that_the_evaluation_has(tmp_path):
    trainer = Trainer(replace(TINY, max_seconds=0.5), tmp_path, seed=0)
    report = trainer.advance()
    episodes = list(trainer.model.ep_info_buffer)
    trainer.close()
    assert episodes
    assert report.contact_free == np.mean([episode["collisions"] == 0 for episode in episodes])
    expected = [spl(e["is_success"], e["path_length"], e["route_length"]) for e in episodes]
    assert report.spl == np.mean(expected)
    assert all(episode["route_length"] > 1.0 for episode in episodes)


def test_the_same_seed_learns_the_same(tmp_path):
    first, again = train(tmp_path / "a", seed=4), train(tmp_path / "b", seed=4)
    other = train(tmp_path / "c", seed=5)
    assert same(weights(first), weights(again))
    assert not same(weights(first), weights(other))


def test_a_loaded_agent_acts_as_the_trained_model_does(tmp_path):
    trainer = train(tmp_path)
    agent = LearnedAgent.load(tmp_path)
    rng = np.random.default_rng(0)
    for _ in range(50):
        seen = {
            "scan": rng.uniform(0.05, 10, 811).astype(np.float32),
            "odometry": rng.normal(size=7).astype(np.float32),
            "goal": rng.normal(size=13).astype(np.float32),
        }
        agent.reset({"robot": vars(trainer.model.get_env().get_attr("robot")[0])})
        expected, _ = trainer.model.predict(compact(seen), deterministic=True)
        assert np.allclose(agent.act(seen), expected, atol=1e-5)


def test_resuming_restores_weights_optimizer_and_count(tmp_path):
    trainer = train(tmp_path, rollouts=2)
    resumed = Trainer.resume(TINY, tmp_path)
    assert resumed.steps == 2 * ROLLOUT
    assert resumed.seed == trainer.seed
    assert same(weights(trainer), weights(resumed))
    old = trainer.model.policy.optimizer.state_dict()["state"]
    new = resumed.model.policy.optimizer.state_dict()["state"]
    assert old.keys() == new.keys()
    assert all(torch.equal(old[i][name], new[i][name]) for i in old for name in old[i])
    assert resumed.advance().steps == 3 * ROLLOUT
    resumed.close()


def test_resuming_at_once_starts_from_the_same_weights(tmp_path):
    trainer = train(tmp_path, rollouts=0)
    resumed = Trainer.resume(TINY, tmp_path)
    assert resumed.steps == 0
    assert same(weights(trainer), weights(resumed))


def test_neither_loading_nor_resuming_unpickles_anything(tmp_path, monkeypatch):
    train(tmp_path)  # numba has read its own cache by now

    def refuse(*_, **__):
        pytest.fail("something was unpickled")

    for owner, name in (
        (pickle, "load"),
        (pickle, "loads"),
        (pickle, "Unpickler"),
        (torch, "load"),
    ):
        monkeypatch.setattr(owner, name, refuse)
    LearnedAgent.load(tmp_path)
    assert Trainer.resume(TINY, tmp_path).steps == ROLLOUT


def test_another_preset_is_not_resumed(tmp_path):
    train(tmp_path, rollouts=0)
    changed = replace(TINY, repeat=2)
    with pytest.raises(ValueError, match="another preset: repeat was 3, 'tiny' has 2"):
        Trainer.resume(changed, tmp_path)


def test_a_damaged_training_is_not_resumed(tmp_path):
    train(tmp_path)
    tensors = load_tensors(tmp_path / TRAINING_FILE)
    for name, wrong, message in (
        ("steps", np.array([1]), "'steps' must be one whole number"),
        ("policy.log_std", np.zeros(3, np.float32), r"'policy.log_std' is float32 of shape \(3,\)"),
        ("optimizer.0.exp_avg", np.full(2, np.nan, np.float32), r"'optimizer.0.exp_avg'"),
    ):
        save_tensors(tmp_path / TRAINING_FILE, {**tensors, name: wrong})
        with pytest.raises(ValueError, match=message):
            Trainer.resume(TINY, tmp_path)


def test_an_interruption_leaves_a_folder_that_works(tmp_path, monkeypatch):
    """Whichever of the three files was the last one written, both uses of the folder go on."""
    train(tmp_path)
    trainer = Trainer.resume(TINY, tmp_path)
    trainer.advance()
    real = os.replace
    for last in range(3):
        moves = []

        def stop(source, target, moves=moves, last=last):
            if len(moves) == last:
                raise KeyboardInterrupt
            moves.append(target)
            real(source, target)

        monkeypatch.setattr("os.replace", stop)
        with pytest.raises(KeyboardInterrupt):
            trainer.save()
        monkeypatch.setattr("os.replace", real)
        LearnedAgent.load(tmp_path)
        assert Trainer.resume(TINY, tmp_path).steps == ROLLOUT * (1 if last == 0 else 2)


def run(capsys, *words):
    code = cli.main([str(word) for word in words])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


@pytest.mark.usefixtures("tiny")
def test_train_makes_an_agent_that_evaluate_and_demo_can_run(capsys, tmp_path):
    out = tmp_path / "run"
    code, text, _ = run(capsys, "train", "tiny", "--out", out)
    assert code == 0
    assert text.startswith("128 decisions, success 0%")
    assert AgentDescription.read(out).steps == 128
    words = ("go through the first door on the right", "--pose", "-2.5,-0.3,0.24", "--agent", out)
    code, text, _ = run(capsys, "demo", *words, "--json")
    assert code in (0, 1)
    assert '"success"' in text


@pytest.mark.usefixtures("tiny")
def test_train_does_not_overwrite_and_resumes_when_told_to(capsys, tmp_path):
    run(capsys, "train", "tiny", "--out", tmp_path, "--steps", 0)
    before = load_tensors(tmp_path / POLICY_FILE)
    code, _, err = run(capsys, "train", "tiny", "--out", tmp_path)
    assert code == 2
    assert "holds a trained agent; go on with it by --resume" in err
    assert same(before, load_tensors(tmp_path / POLICY_FILE))
    code, *_ = run(capsys, "train", "tiny", "--out", tmp_path, "--resume", "--steps", 64)
    assert code == 0
    assert AgentDescription.read(tmp_path).steps == 64
    assert not same(before, load_tensors(tmp_path / POLICY_FILE))


@pytest.mark.usefixtures("tiny")
def test_an_interrupted_training_is_saved(capsys, tmp_path):
    def interrupt():
        while not (tmp_path / POLICY_FILE).exists():
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt, daemon=True)
    thread.start()
    code, text, _ = run(capsys, "train", "tiny", "--out", tmp_path, "--steps", 10**9)
    thread.join()
    assert code == 130
    assert text.startswith("interrupted; ")
    assert Trainer.resume(TINY, tmp_path).steps == AgentDescription.read(tmp_path).steps


def test_without_the_extra_the_error_says_what_to_install(capsys, tmp_path, monkeypatch):
    monkeypatch.delitem(sys.modules, "semnav_env.agents.learning.training")
    monkeypatch.setitem(sys.modules, "stable_baselines3", None)
    code, _, err = run(capsys, "train", "quick", "--out", tmp_path / "none")
    assert code == 2
    assert err == 'semnav: training needs stable_baselines3: pip install "semnav-env[rl]"\n'


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("slow",), "no preset 'slow'; there are: quick"),
        (("--steps", -1), "--steps is -1; it must be at least 0"),
        (("--minutes", 0), "--minutes is 0.0; it must be positive and finite"),
        (("--minutes", "nan"), "--minutes is nan; it must be positive and finite"),
        (("--seed", -1), "--seed is -1; it must be at least 0"),
        (("--resume",), "holds no trained agent"),
    ],
)
def test_bad_arguments_are_named(capsys, tmp_path, words, message):
    code, _, err = run(capsys, "train", *words, "--out", tmp_path / "none")
    assert code == 2
    assert message in err
    assert not (tmp_path / "none").exists()
