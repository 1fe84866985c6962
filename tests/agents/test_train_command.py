"""`semnav train`: what it makes, refuses and saves."""

import os
import signal
import sys
import threading
import time

import pytest

pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')
pytest.importorskip("torch", reason='needs the extra "rl"')

from semnav_env.agents.learning.files import (
    POLICY_FILE,
    AgentDescription,
    load_tensors,
)
from semnav_env.agents.learning.presets import PRESETS
from semnav_env.agents.learning.training import Trainer
from semnav_env.scripts import main as cli
from tests.support.tiny_training import TINY, same


@pytest.fixture
def tiny(monkeypatch):
    monkeypatch.setitem(PRESETS, "tiny", TINY)


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
        (("slow",), "no preset 'slow'; there are: hallway, quick"),
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
