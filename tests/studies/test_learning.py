"""The learning track: what its policies are given, and what they learn from."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("torch")
pytest.importorskip("sb3_contrib")

from semnav_agents.hearing.tokens import describe_clauses
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import evenly, load_episodes
from studies.figures import learning as figure
from studies.learning import cloning
from studies.learning.command import Arguments
from studies.learning.command_envs import measured, training_envs
from studies.learning.demonstrations import demonstrations, first_of, is_taught, lessons
from studies.learning.heard_vector import DOOR_SIZE, DOORS_A_SIDE, SIZE, WORDS, HeardVectors
from tests.support.paths import ROOT


def seen(command: str) -> dict[str, np.ndarray]:
    """Observations of one robot in the hallway that has been told a command."""
    env = SemNavEnv(observation="command", floor_plan="heidelberg_hallway")
    observation, _ = env.reset(seed=0, options={"command": command, "pose": (-2.5, -0.6, 0.25)})
    return {name: np.array(values)[None] for name, values in observation.items()}


def test_two_commands_differ_in_the_words_alone() -> None:
    """Nothing of the vector comes from the grounding."""
    first, second = (
        HeardVectors(1, 0.2).observe(seen(f"go through the {which} door on the right"))[0]
        for which in ("second", "third")
    )
    assert first.shape == (SIZE,)
    assert (first[:WORDS] != second[:WORDS]).any()
    assert (first[WORDS:] == second[WORDS:]).all()


def test_a_finger_that_moves_on_shows_the_next_clause() -> None:
    told = seen("turn left at the intersection and take the first door on the right")
    tokens, vectors = told["command"].reshape(-1, 5).astype(int), HeardVectors(1, 0.2)
    for clause in range(2):
        expected = describe_clauses(tokens, clause)
        assert (vectors.observe(told)[0, : len(expected)] == expected).all()
        vectors.advance(np.array([True]), told)
    vectors.forget(np.array([True]))
    assert (vectors.observe(told)[0, : len(expected)] == describe_clauses(tokens, 0)).all()


def test_doors_are_sorted_by_side_and_distance() -> None:
    told = seen("go through the first door on the right")
    doors = np.zeros((1, 16, 4), np.float32)
    for row, (x, y) in enumerate(((5.0, -1.0), (2.0, -1.0), (3.0, 1.0), (4.0, -9.0))):
        doors[0, row] = x - 0.5, y, x + 0.5, y
    told["remembered_doors"] = doors.reshape(1, -1)
    told["remembered_doors_mask"] = (np.arange(16) < 4).astype(np.float32)[None]
    vector = HeardVectors(1, 0.2).observe(told)[0, WORDS:]
    left, right, _ = np.split(vector, np.array([1, 2]) * DOORS_A_SIDE * DOOR_SIZE)
    along = [side.reshape(DOORS_A_SIDE, -1)[:3, 4] for side in (left, right)]
    squashed = [x / (1.0 + x) for x in (2.0, 3.0, 5.0)]
    assert along[0] == pytest.approx([squashed[1], 0.0, 0.0], abs=1e-6)
    assert along[1] == pytest.approx([squashed[0], squashed[2], 0.0], abs=1e-6)


def test_robots_under_training_are_seen_as_vectors() -> None:
    envs = training_envs(2)
    assert envs.observation_space.contains(envs.reset()[0])
    rng = np.random.default_rng(0)
    for _ in range(3):
        vectors, _, _, _ = envs.step(rng.uniform(-1.0, 1.0, (2, 3)).astype(np.float32))
    assert envs.observation_space.contains(vectors[1])


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Some demonstrations."""
    made = tmp_path_factory.mktemp("track")
    demonstrations(600, made, robots=2)
    return made


def test_demonstrations_are_the_same_when_they_are_read_again(folder: Path) -> None:
    again = demonstrations(600, folder)
    assert sum(each.steps for each in again[:-1]) < 600 <= sum(each.steps for each in again)
    assert first_of(again, 1) == again[:1]
    direct = next(lessons(1000, 2))
    assert (direct.actions == again[0].actions).all()
    assert np.abs(direct.vectors - again[0].vectors).max() < 0.01


def test_a_demonstration_moves_the_finger_once_for_each_clause_but_the_last(folder: Path) -> None:
    """At the end the robot may be told that the last clause is over as well."""
    for lesson in demonstrations(600, folder):
        words, told = lesson.vectors[:, : WORDS // 3], lesson.actions[:, -1] > 0
        changes = np.flatnonzero((np.diff(words, axis=0) != 0).any(axis=1))
        assert told[changes].all()
        assert is_taught(lesson)[told].all()


def test_a_learner_that_drives_is_told_what_the_expert_would_do() -> None:
    standing = next(lessons(3, 1, lambda vectors: np.zeros((len(vectors), 3), np.float32)))
    assert not standing.success
    assert np.abs(standing.actions[:, :2]).max() > 0.1


def test_the_same_seed_clones_the_same_policy(folder: Path, tmp_path: Path) -> None:
    kept = cloning.cloned(0, 600, folder, 600)
    lessons_ = [each for each in demonstrations(600, folder) if each.success]
    again = cloning.new_policy(0)
    cloning.teach(again, lessons_, 0, cloning.PASSES, cloning.RATE)
    vectors = lessons_[0].vectors
    assert (cloning.act(kept, vectors) == cloning.act(again, vectors)).all()


def test_each_episode_is_measured_once() -> None:
    episodes = evenly(load_episodes("val_unseen"), 3)
    rows = list(measured(lambda vectors, _: np.ones((len(vectors), 3)), episodes, robots=2))
    assert sorted(row["episode"] for row in rows) == sorted(each.id for each in episodes)


def test_the_study_keeps_rows_that_say_what_made_them(folder: Path) -> None:
    study = Arguments(folder, ("cloning",), (0,), steps=600, measured=2)
    study.run()
    rows = [json.loads(line) for line in (folder / "cloning-0.jsonl").read_text().splitlines()]
    assert [row["steps"] for row in rows] == [150, 300, 600]
    assert all(row["n"] == 2 and row["rules"] and row["version"] for row in rows)
    assert len(figure.results_table(rows).splitlines()) == 4
    assert "cloning half | 2 |" in figure.pairs_table(rows)


def test_an_unknown_method_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no method 'sarsa'; there are: ppo, recurrent_ppo"):
        Arguments(tmp_path, ("sarsa",)).run()


@pytest.mark.skipif(not figure.ROWS.exists(), reason="no rows are kept")
def test_the_tables_of_the_page_follow_from_the_kept_rows() -> None:
    """If this fails: `python -m studies.figures learning`."""
    shown = (ROOT / "docs" / "lab" / "learning.md").read_text(encoding="utf-8")
    assert shown == figure.page(shown)
