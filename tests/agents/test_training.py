"""Training, what it keeps, and going on with it."""

import errno
import json
import os
import pickle
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')
torch = pytest.importorskip("torch", reason='needs the extra "rl"')

from semnav_agents.learned import LearnedAgent  # noqa: E402
from semnav_agents.learning.cloning import EPOCHS  # noqa: E402
from semnav_agents.learning.compact import CompactObserver  # noqa: E402
from semnav_agents.learning.files import (  # noqa: E402
    CURVE_FILE,
    TRAINING_FILE,
)
from semnav_agents.learning.imitation import load_demonstrations  # noqa: E402
from semnav_agents.learning.policy import PolicySettings  # noqa: E402
from semnav_agents.learning.presets import PRESETS  # noqa: E402
from semnav_agents.learning.training import Trainer  # noqa: E402
from semnav_env.judge.metrics import spl  # noqa: E402
from semnav_env.networks.card import CARD_FILE, Card  # noqa: E402
from semnav_env.networks.weights import (  # noqa: E402
    WEIGHTS_FILE,
    load_tensors,
    save_tensors,
)
from tests.support.paths import ROOT  # noqa: E402
from tests.support.tiny_training import (  # noqa: E402
    LONG,
    ROLLOUT,
    TINY,
    go_on,
    same,
    train,
    weights,
)


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
    agent.shielded = False
    [env, *_] = trainer.model.get_env().get_attr("unwrapped")
    info = {"robot": vars(env.robot), "lidar": vars(env.lidar_spec)}
    rng = np.random.default_rng(0)
    for _ in range(50):
        seen = {
            "scan": rng.uniform(0.05, 10, 811).astype(np.float32),
            "odometry": rng.normal(size=7).astype(np.float32),
            "goal": rng.normal(size=13).astype(np.float32),
            "bumps": np.zeros(64, np.float32),
            "bumps_mask": np.zeros(16, np.float32),
        }
        seen["goal"][3] = 0.0  # where it is to stop it asks no model
        agent.reset(info)
        row = {name: entry[None] for name, entry in seen.items()}
        compact = CompactObserver([env.robot], env.lidar_spec).observe(row)[0]
        expected, _ = trainer.model.predict(compact, deterministic=True)
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


@pytest.mark.parametrize("done", [3, 4, 5, 6])
def test_a_resumed_training_learns_bit_for_bit_what_an_uninterrupted_one_learns(tmp_path, done):
    """Checkpoints are three updates apart; what came after the last one is done again."""
    straight = train(tmp_path / "straight", 7, preset=LONG)
    train(tmp_path / "broken", done, preset=LONG)
    resumed = Trainer.resume(LONG, tmp_path / "broken")
    assert resumed.steps == done // 3 * 3 * ROLLOUT
    go_on(resumed, 7 - done // 3 * 3)
    assert same(weights(straight), weights(resumed))
    for name in (TRAINING_FILE, WEIGHTS_FILE):
        found = load_tensors(tmp_path / "straight" / name)
        assert same(found, load_tensors(tmp_path / "broken" / name))


def test_a_truncated_checkpoint_leaves_the_one_before(tmp_path):
    trainer = train(tmp_path, 2)
    whole = (tmp_path / TRAINING_FILE).read_bytes()
    for size in (0, 7, 100, len(whole) - 1):
        (tmp_path / TRAINING_FILE).write_bytes(whole[:size])
        resumed = Trainer.resume(TINY, tmp_path)
        assert resumed.steps == ROLLOUT
    resumed.advance()
    assert same(weights(trainer), weights(resumed))


def test_a_full_disk_leaves_the_last_checkpoint(tmp_path, monkeypatch):
    train(tmp_path, 1)
    trainer = Trainer.resume(TINY, tmp_path)
    trainer.advance()

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OSError, match=f"No space left on device.*{TRAINING_FILE}"):
        trainer.save()
    monkeypatch.undo()
    assert Trainer.resume(TINY, tmp_path).steps == ROLLOUT
    trainer.save()
    assert Trainer.resume(TINY, tmp_path).steps == 2 * ROLLOUT


def processor_seconds(process):
    """What a running process has used."""
    used = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[11:13]
    return sum(map(int, used)) / os.sysconf("SC_CLK_TCK")


TRAIN_LONG = """
import sys
from dataclasses import replace
from semnav_agents.learning.presets import PRESETS
from tests.agents.test_training import LONG
PRESETS["long"] = LONG
from semnav_scripts.main import main
sys.exit(main(["train", "long", "--out", sys.argv[1], "--steps", sys.argv[2], *sys.argv[3:]]))
"""


@pytest.mark.parametrize(
    ("kills", "seconds"), [(2, 8.0), pytest.param(20, 12.0, marks=pytest.mark.slow)]
)
def test_a_training_that_is_killed_at_random_moments_learns_the_same(tmp_path, kills, seconds):
    """By SIGTERM and SIGKILL in turn, as schedulers of clusters do it, with `semnav train`.

    A moment is given by the processor time of the training, at most so many seconds. At most a
    stretch is lost with each kill, so training gets on whatever happens.
    """
    rng, stretch = np.random.default_rng(kills), 3 * ROLLOUT
    total, reached, folder = 100 * kills * stretch, 0, tmp_path / "killed"
    for number in range(kills):
        resume = ["--resume"] if (folder / CARD_FILE).exists() else []
        words = [sys.executable, "-c", TRAIN_LONG, folder, str(total), *resume]
        running = subprocess.Popen(list(map(str, words)), cwd=ROOT, stderr=subprocess.DEVNULL)
        while not resume and not (folder / CARD_FILE).exists():
            time.sleep(0.01)
        after = rng.uniform(0.0, seconds)
        until = processor_seconds(running.pid) + after
        while running.poll() is None and processor_seconds(running.pid) < until:
            time.sleep(0.01)
        assert running.poll() is None  # or nothing is killed
        kill = (signal.SIGTERM, signal.SIGKILL)[number % 2]
        running.send_signal(kill)
        code = running.wait()
        now = Trainer.resume(LONG, folder).steps
        print(f"{kill.name} after {after:.1f} s, exit code {code}: {now} decisions")
        assert now >= reached
        assert now % stretch == 0
        reached = now
    resumed = Trainer.resume(LONG, folder)
    end = max(reached, stretch) + stretch
    go_on(resumed, (end - reached) // ROLLOUT)
    straight = train(tmp_path / "straight", end // ROLLOUT, preset=LONG)
    assert same(weights(straight), weights(resumed))


def test_what_a_preset_demonstrates_is_imitated_first(tmp_path):
    preset = replace(PRESETS["drive"], name="shown", envs=2, demonstrations=3, ppo=TINY.ppo)
    trainer = Trainer(preset, tmp_path / "a", seed=0)
    before = weights(trainer)
    driven, cloned = (
        [("demonstrations", k) for k in (1, 2, 3)],
        [("cloning", k + 1) for k in range(EPOCHS)],
    )
    assert [(step.phase, step.done) for step in trainer.prepare()] == driven + cloned
    losses = json.loads((tmp_path / "a" / CURVE_FILE).read_text())
    assert len(losses) == EPOCHS
    assert losses[-1] < losses[0]
    shown = load_demonstrations(tmp_path / "a" / "demonstrations")
    assert len(shown["observations"]) == len(shown["actions"]) == len(shown["returns"]) > 50
    again = Trainer(preset, tmp_path / "a", seed=0)  # from the file that is there
    assert same(before, weights(again))
    errors = [
        np.abs(each.model.predict(shown["observations"], deterministic=True)[0] - shown["actions"])
        for each in (trainer, again)
    ]
    assert errors[0].mean() < 0.9 * errors[1].mean()
    assert [step.done for step in again.prepare()] == [3, *range(1, EPOCHS + 1)]
    assert same(weights(trainer), weights(again))


def test_what_was_cloned_is_a_checkpoint(tmp_path):
    preset = replace(PRESETS["quick"], name="shown", envs=2, demonstrations=1, ppo=LONG.ppo)
    trainer = Trainer(preset, tmp_path, seed=0)
    trainer.save()
    assert Card.read(tmp_path, PolicySettings).settings.is_untrained
    for _ in trainer.prepare():
        pass
    assert not Card.read(tmp_path, PolicySettings).settings.is_untrained
    resumed = Trainer.resume(preset, tmp_path)
    assert same(weights(trainer), weights(resumed))
    assert list(resumed.prepare()) == []
    assert trainer.advance().steps == resumed.advance().steps == ROLLOUT
    assert same(weights(trainer), weights(resumed))


def test_an_untrained_policy_is_a_warning(tmp_path):
    trainer = train(tmp_path, rollouts=0)
    with pytest.warns(UserWarning, match="holds an untrained policy, of 0 decisions"):
        LearnedAgent.load(tmp_path)
    trainer.model.num_timesteps = 64
    trainer.save()
    LearnedAgent.load(tmp_path)


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
    """Whichever file was the last one moved, both uses of the folder go on."""
    train(tmp_path)
    trainer = Trainer.resume(TINY, tmp_path)
    trainer.advance()
    real = os.replace
    for last in range(4):
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
        assert Trainer.resume(TINY, tmp_path).steps == ROLLOUT * (1 if last < 2 else 2)
