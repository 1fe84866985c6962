"""`semnav train`: what it makes, refuses and saves."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from dataclasses import replace

import pytest

pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')
pytest.importorskip("torch", reason='needs the extra "rl"')

from semnav_agents.learning.cloning import EPOCHS
from semnav_agents.learning.cost import COST_FILE
from semnav_agents.learning.files import TRAINING_FILE
from semnav_agents.learning.policy import PolicySettings
from semnav_agents.learning.presets import PRESETS
from semnav_agents.learning.training import Trainer
from semnav_env.networks.card import CARD_FILE, Card
from semnav_env.networks.weights import WEIGHTS_FILE, load_tensors
from semnav_features.sole_writer import sole_writer
from semnav_scripts import main as cli
from tests.support.paths import ROOT
from tests.support.tiny_training import TINY, same

SHOWN = replace(PRESETS["quick"], name="shown", envs=2, steps=128, demonstrations=2, ppo=TINY.ppo)


@pytest.fixture
def tiny(monkeypatch):
    monkeypatch.setitem(PRESETS, "tiny", TINY)
    monkeypatch.setitem(PRESETS, "shown", SHOWN)


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
    assert Card.read(out, PolicySettings).settings.steps == 128
    words = ("go through the first door on the right", "--pose", "-2.5,-0.3,0.24", "--agent", out)
    code, text, _ = run(capsys, "demo", *words, "--json")
    assert code in (0, 1)
    assert '"success"' in text


@pytest.mark.usefixtures("tiny")
def test_a_training_notes_what_each_session_cost(capsys, tmp_path):
    run(capsys, "train", "tiny", "--out", tmp_path, "--steps", 0)
    run(capsys, "train", "tiny", "--out", tmp_path, "--steps", 64, "--resume")
    rows = [json.loads(line) for line in (tmp_path / COST_FILE).read_text().splitlines()]
    assert len(rows) == 2
    assert all(row["seconds"] >= 0.0 and row["cpu_seconds"] >= 0.0 for row in rows)
    assert all(row["processor"] and row["rules"] and row["version"] for row in rows)


@pytest.mark.usefixtures("tiny")
def test_train_does_not_overwrite_and_resumes_when_told_to(capsys, tmp_path):
    run(capsys, "train", "tiny", "--out", tmp_path, "--steps", 0)
    before = load_tensors(tmp_path / WEIGHTS_FILE)
    code, _, err = run(capsys, "train", "tiny", "--out", tmp_path)
    assert code == 2
    assert "holds a trained agent; go on with it by --resume" in err
    assert same(before, load_tensors(tmp_path / WEIGHTS_FILE))
    code, *_ = run(capsys, "train", "tiny", "--out", tmp_path, "--resume", "--steps", 64)
    assert code == 0
    assert Card.read(tmp_path, PolicySettings).settings.steps == 64
    assert not same(before, load_tensors(tmp_path / WEIGHTS_FILE))


@pytest.mark.usefixtures("tiny")
def test_an_interrupted_training_is_saved(capsys, tmp_path):
    def interrupt():
        while not (tmp_path / WEIGHTS_FILE).exists():
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt, daemon=True)
    thread.start()
    code, text, _ = run(capsys, "train", "tiny", "--out", tmp_path, "--steps", 10**9)
    thread.join()
    assert code == 130
    assert text.startswith("interrupted; ")
    assert (
        Trainer.resume(TINY, tmp_path).steps == Card.read(tmp_path, PolicySettings).settings.steps
    )


@pytest.mark.usefixtures("tiny")
def test_a_training_that_sigterm_ends_goes_on_as_if_it_had_not(capsys, tmp_path, monkeypatch):
    run(capsys, "train", "shown", "--out", tmp_path / "straight")
    straight = load_tensors(tmp_path / "straight" / TRAINING_FILE)
    real = Trainer.prepare
    for phase, number in (("demonstrations", 1), ("cloning", 7), ("cloning", EPOCHS)):
        out = tmp_path / f"{phase}{number}"

        def killed(trainer, phase=phase, number=number):
            for step in real(trainer):
                if (step.phase, step.done) == (phase, number):
                    os.kill(os.getpid(), signal.SIGTERM)
                yield step

        monkeypatch.setattr(Trainer, "prepare", killed)
        code, text, _ = run(capsys, "train", "shown", "--out", out)
        monkeypatch.setattr(Trainer, "prepare", real)
        assert code == 143
        assert text == f"interrupted; 0 decisions; saved in {out}; go on with --resume\n"
        assert Card.read(out, PolicySettings).settings.is_untrained == (number < EPOCHS)
        code, *_ = run(capsys, "train", "shown", "--out", out, "--resume")
        assert code == 0
        assert same(straight, load_tensors(out / TRAINING_FILE))


@pytest.mark.usefixtures("tiny")
def test_a_log_file_says_how_far_a_training_is(capsys, tmp_path):
    *_, err = run(capsys, "train", "shown", "--out", tmp_path)
    lines = err.splitlines()
    assert f"curves: tensorboard --logdir {tmp_path / 'tensorboard'}" in lines
    told = [line for line in lines if line.endswith(" left")]
    assert [line.partition(",")[0] for line in told] == [
        "demonstrations: 1 of 2 driven",
        "demonstrations: 2 of 2 driven",
        *(f"cloning: pass {k} of {EPOCHS}" for k in (1, *range(4, EPOCHS + 1, 4))),
        "64 decisions",
        "128 decisions",
    ]
    assert told[-1].endswith(", 0:00:00 left")


@pytest.mark.usefixtures("tiny")
def test_a_batch_that_does_not_divide_a_rollout_is_no_warning(tmp_path):
    Trainer(replace(TINY, ppo=replace(TINY.ppo, batch_size=48)), tmp_path, seed=0).close()


TRAIN_TINY = """
import sys
from semnav_agents.learning.presets import PRESETS
from semnav_features.sole_writer import sole_writer
from tests.support.tiny_training import TINY
PRESETS["tiny"] = TINY
from semnav_scripts.main import main
sys.exit(main(["train", "tiny", "--steps", "1000000000", "--out", sys.argv[1]]))
"""


@pytest.mark.usefixtures("tiny")
def test_a_folder_is_trained_by_one_process_at_a_time(capsys, tmp_path):
    """The lock ends with its process, even one that is killed."""
    first = subprocess.Popen([sys.executable, "-c", TRAIN_TINY, tmp_path], cwd=ROOT)
    try:
        while not (tmp_path / CARD_FILE).exists():
            time.sleep(0.01)
        for words in ([], ["--resume"]):
            code, _, err = run(capsys, "train", "tiny", "--out", tmp_path, *words)
            assert code == 2
            assert "another run is writing it; give another name" in err
    finally:
        first.kill()
        first.wait()
    code, *_ = run(capsys, "train", "tiny", "--out", tmp_path, "--resume", "--steps", 0)
    assert code == 0


def test_a_hearing_training_is_refused_in_a_folder_in_use(capsys, tmp_path):
    with sole_writer(tmp_path):
        code, _, err = run(capsys, "train", "listener", "--out", tmp_path)
    assert code == 2
    assert "another run is writing it" in err


def test_without_the_extra_the_error_says_what_to_install(capsys, tmp_path, monkeypatch):
    monkeypatch.delitem(sys.modules, "semnav_agents.learning.training")
    monkeypatch.setitem(sys.modules, "stable_baselines3", None)
    code, _, err = run(capsys, "train", "quick", "--out", tmp_path / "none")
    assert code == 2
    assert err == 'semnav: training needs stable_baselines3: pip install "semnav-env[rl]"\n'


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("slow",), "no preset 'slow'; there are: hallway, quick"),
        (("--steps", -1), "--steps is -1; it must be at least 0"),
        (("--minutes", 0), "--minutes is 0.0; it must be positive and finite"),
        (("--minutes", "nan"), "--minutes is nan; it must be positive and finite"),
        (("--seed", -1), "--seed is -1; it must be at least 0"),
        (("--resume",), "holds no trained network"),
    ],
)
def test_bad_arguments_are_named(capsys, tmp_path, words, message):
    code, _, err = run(capsys, "train", *words, "--out", tmp_path / "none")
    assert code == 2
    assert message in err
    assert not (tmp_path / "none").exists()
