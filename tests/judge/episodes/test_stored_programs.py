"""Episodes carry their programs and tokens, so that nothing is parsed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from semnav_env import language
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import (
    SPLITS,
    EpisodeFileError,
    evenly,
    load_episodes,
    read_episodes,
    write_episodes,
)
from semnav_env.judge.episodes import episode as episode_module
from semnav_env.judge.episodes.check import faults
from semnav_env.judge.tasks import frozen as frozen_module
from semnav_env.language import encode


@pytest.mark.parametrize("name", SPLITS)
def test_programs_and_tokens_are_those_of_the_words(name: str) -> None:
    for episode in evenly(load_episodes(name), 8):
        bare = replace(episode, programs=(), token_rows=())
        assert episode.programs == bare.meanings()
        rooms = episode.plan().room_names
        np.testing.assert_array_equal(episode.tokens, encode(bare.meanings()[0], rooms))
        np.testing.assert_array_equal(episode.tokens, bare.tokens)


def test_no_episode_of_any_split_needs_parsing(monkeypatch: pytest.MonkeyPatch) -> None:
    def parsed(*_: object) -> None:
        raise AssertionError("parsed")

    for module in (language, episode_module):
        monkeypatch.setattr(module, "parse", parsed)
    assert not hasattr(frozen_module, "parse")
    for name in SPLITS:
        for episode in load_episodes(name):
            assert 1 <= episode.clauses == len(episode.token_rows)
            assert len(episode.programs) == len(episode.readings)
    env = SemNavEnv(episodes="test_real")
    _, info = env.reset(seed=1)
    assert info["episode_id"].startswith("test_real-")


def test_a_file_may_leave_programs_and_tokens_out(tmp_path: Path) -> None:
    episode = replace(load_episodes("test_real")[0], programs=(), token_rows=())
    write_episodes([episode], tmp_path / "mine.jsonl")
    assert "programs" not in (tmp_path / "mine.jsonl").read_text()
    assert read_episodes(tmp_path / "mine.jsonl") == (episode,)


@pytest.mark.parametrize(
    ("stored", "wrong", "problem"),
    [
        ('"programs":[[{"kind"', '"programs":[[{"kinds"', "programs: the kind of clause 0"),
        ('"programs":[', '"programs":[[],', "1 readings and 2 programs"),
        ('"token_rows":[[', '"token_rows":[[0.5,', "token_rows is .* 5 whole numbers"),
    ],
)
def test_a_damaged_program_names_its_line(
    stored: str, wrong: str, problem: str, tmp_path: Path
) -> None:
    path = tmp_path / "mine.jsonl"
    write_episodes(load_episodes("test_real")[:1], path)
    assert stored in path.read_text()
    path.write_text(path.read_text().replace(stored, wrong, 1))
    with pytest.raises(EpisodeFileError, match=rf"mine\.jsonl:1: .*{problem}"):
        read_episodes(path)


def test_the_check_finds_programs_of_another_command() -> None:
    first, *others = load_episodes("test_real")
    other = next(each for each in others if each.programs != first.programs)
    swapped = replace(first, programs=other.programs, token_rows=other.token_rows)
    [(_, found)] = faults([swapped])
    assert any("its programs" in each for each in found)
    assert any("its tokens" in each for each in found)
