"""Training of an agent that hears: from nothing to a folder that drives."""

import shutil
from dataclasses import replace

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason='needs the extra "rl"')

from semnav_agents.base import steps  # noqa: E402
from semnav_agents.hearing.agent import HearingAgent  # noqa: E402
from semnav_agents.hearing.learning import batches  # noqa: E402
from semnav_agents.hearing.mirror import mirrored  # noqa: E402
from semnav_agents.hearing.network import NetworkShape  # noqa: E402
from semnav_agents.hearing.presets import HEARING_PRESETS, HearingRound  # noqa: E402
from semnav_agents.hearing.training import STATE_FILE, HearingTrainer  # noqa: E402
from semnav_agents.registry import make_agent  # noqa: E402
from semnav_env.env import SemNavEnv  # noqa: E402
from semnav_env.networks.card import CARD_FILE, Card  # noqa: E402
from semnav_env.networks.weights import WEIGHTS_FILE, load_tensors  # noqa: E402
from semnav_scripts import main as cli  # noqa: E402

TINY = replace(
    HEARING_PRESETS["listener"],
    name="tiny_listener",
    rounds=(
        HearingRound(2, 2, drivers=("scripted",)),
        HearingRound(2, 2, drivers=("planner", "policy"), robots=("wheelchair", "spot")),
    ),
    chunk=1,
    batch_size=16,
    max_seconds=8.0,
    shape=NetworkShape(width=8, heads=2, layers=1, hidden=8),
)


@pytest.fixture(scope="module")
def trained(tmp_path_factory):
    folder = tmp_path_factory.mktemp("trained")
    rows = list(HearingTrainer(TINY, folder, seed=0).advance())
    return folder, rows


def test_every_chunk_and_epoch_is_in_the_curve(trained):
    folder, rows = trained
    assert [(row["round"], "epoch" in row) for row in rows] == [
        *((0, is_epoch) for is_epoch in (False, False, True, True)),
        *((1, is_epoch) for is_epoch in (False, False, True, True)),
    ]
    assert Card.read(folder, NetworkShape).curve == rows
    assert all(np.isfinite(row["loss"]) for row in rows if "epoch" in row)


def test_what_was_trained_drives(trained):
    agent = make_agent(str(trained[0]))
    assert isinstance(agent, HearingAgent)
    env = SemNavEnv(observation="command", max_seconds=0.3)
    observation, info = env.reset(seed=0)
    assert all(env.action_space.contains(s.action) for s in steps(env, agent, observation, info))


def test_interrupted_training_ends_as_an_uninterrupted_one(trained, tmp_path):
    for _ in range(len(trained[1])):  # a new process would do the same
        trainer = HearingTrainer(TINY, tmp_path, seed=0)
        for _ in trainer.advance():
            break
    whole, parts = (load_tensors(folder / WEIGHTS_FILE) for folder in (trained[0], tmp_path))
    assert all(np.array_equal(whole[name], parts[name]) for name in whole)


def test_kill_between_state_and_card_loses_nothing(trained, tmp_path):
    shutil.copytree(trained[0], tmp_path, dirs_exist_ok=True)
    card = Card.read(tmp_path, NetworkShape)
    card.curve.pop()
    card.write(tmp_path)
    assert list(HearingTrainer(TINY, tmp_path, seed=0).advance()) == []
    assert len(Card.read(tmp_path, NetworkShape).curve) == len(trained[1])
    before, after = (load_tensors(folder / WEIGHTS_FILE) for folder in (trained[0], tmp_path))
    assert all(np.array_equal(before[name], after[name]) for name in before)


def test_further_rounds_go_on_from_the_weights_of_a_finished_training(trained, tmp_path):
    longer = replace(TINY, rounds=(*TINY.rounds, HearingRound(1, 1)))
    straight = list(HearingTrainer(longer, tmp_path / "straight", seed=0).advance())
    shutil.copytree(trained[0], tmp_path / "later")
    (tmp_path / "later" / STATE_FILE).unlink()  # a bundled agent has weights and card alone
    assert len(list(HearingTrainer(longer, tmp_path / "later", seed=0).advance())) == 2
    whole, parts = (load_tensors(tmp_path / at / WEIGHTS_FILE) for at in ("straight", "later"))
    assert all(np.array_equal(whole[name], parts[name]) for name in whole)
    assert len(Card.read(tmp_path / "later", NetworkShape).curve) == len(straight)


def test_a_preset_with_other_first_rounds_is_refused(trained):
    other = replace(TINY, rounds=(HearingRound(1, 1), *TINY.rounds))
    with pytest.raises(ValueError, match="another preset"):
        HearingTrainer(other, trained[0], seed=0)


def test_the_last_chunk_of_a_round_is_not_learned_from(trained):
    trainer = HearingTrainer(TINY, trained[0], seed=0)
    learned = [row["samples"] for row in trained[1] if row.get("chunk") == 0]
    assert len(trainer._samples(1)["count"]) == sum(learned)


def test_other_seed_is_refused(trained):
    with pytest.raises(ValueError, match="another seed"):
        HearingTrainer(TINY, trained[0], seed=1)


def test_mirror_twice_changes_nothing(trained):
    trainer = HearingTrainer(TINY, trained[0], seed=0)
    samples = trainer._samples(1)
    twice = mirrored(mirrored(samples))
    assert all(np.array_equal(samples[name], twice[name]) for name in samples)
    assert not np.array_equal(mirrored(samples)["elements"], samples["elements"])


def test_batches_hold_every_sample_once():
    rng = np.random.default_rng(0)
    parts = batches(rng.integers(5, 20, 1000).astype(np.int8), 32, rng)
    assert sorted(np.concatenate(parts).tolist()) == list(range(1000))


def test_command_line_trains_and_goes_on(monkeypatch, tmp_path, capsys):
    shown = HearingRound(1, 2, drivers=("scripted",))
    preset = replace(TINY, name="tiny_listener", rounds=(shown,))
    monkeypatch.setitem(HEARING_PRESETS, preset.name, preset)
    arguments = ["train", preset.name, "--out", str(tmp_path / "a")]
    assert cli.main([*arguments, "--minutes", "0.0001"]) == 0
    assert "1 of 3 steps" in capsys.readouterr().out
    assert cli.main(arguments) != 0  # it would have to be told to go on
    assert cli.main([*arguments, "--resume"]) == 0
    assert "3 of 3 steps" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "named"),
    [
        ("{", "not JSON"),
        ("[]", "format"),
        ('{"format": 3}', "network"),
        ('{"format": 2}', "format 2"),
    ],
)
def test_damaged_card_is_named(tmp_path, content, named):
    (tmp_path / CARD_FILE).write_text(content)
    with pytest.raises(ValueError, match=named):
        HearingAgent.load(tmp_path)
