"""Frozen episodes: their files, what each split promises, and that a seed gives them again."""

from __future__ import annotations

import gzip
import json
from collections import Counter
from dataclasses import asdict, replace
from itertools import islice
from pathlib import Path
from typing import Any

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge import Verdict
from semnav_env.judge.episodes import (
    SPLITS,
    Episode,
    EpisodeFileError,
    Expected,
    evenly,
    load_episodes,
    read_episodes,
    write_episodes,
)
from semnav_env.judge.episodes.check import faults
from semnav_env.judge.episodes.files import to_line
from semnav_env.judge.episodes.fingerprint import fingerprint
from semnav_env.judge.episodes.generate import generate_split
from semnav_env.judge.episodes.random_clauses import topics_of
from semnav_env.language import parse
from semnav_env.world.maps import generate_office, load_floor_plan
from semnav_scripts.main import main
from tests.support.paths import DATA

EPISODE = Episode(
    id="mine-00007",
    floor_plan="office_cross",
    plan_hash=fingerprint(load_floor_plan("office_cross")),
    start=(1.3, 9.1, 0.0),
    command="enter the second door on the right",
    language="en",
    readings=("go through the second door on the right",),
    route=((1.3, 9.1), (10.0, 7.5)),
)
FIRST = 3
"""How many episodes of a split are made anew."""


@pytest.mark.parametrize("name", ["mine.jsonl", "mine.jsonl.gz"])
def test_episode_files_round_trip_to_the_same_bytes(name: str, tmp_path: Path) -> None:
    """Reading gives back what was written, and writing it again the same bytes."""
    path, again = tmp_path / name, tmp_path / f"again-{name}"
    other = replace(EPISODE, id="mine-00008", expected=Expected.INFEASIBLE)
    write_episodes([EPISODE, other], path)
    write_episodes([EPISODE, other], again)
    assert read_episodes(path) == (EPISODE, other)
    assert path.read_bytes() == again.read_bytes()


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"id": "seven"}, r'id is "seven"; it must be a split and a number'),
        ({"id": "train-" + "9" * 30}, "id is .* of at most 18 digits"),
        ({"id": "train-" + "9" * 5000}, "id is .* of at most 18 digits"),
        ({"start": [0.0, 1.0]}, r"start is \[0.0, 1.0\]; it must be \[x, y, heading\]"),
        ({"start": [0.0, 1.0, None]}, "start is"),
        ({"language": "xx"}, 'language is "xx"; it must be the code of a language'),
        ({"readings": []}, "readings is"),
        ({"readings": ["stop", "go back to the start"]}, "has 2 readings and is expected to be"),
        ({"route": [[1.0]]}, "route is"),
        ({"expected": "perhaps"}, "expected is .* one of feasible, infeasible, ambiguous"),
        ({"plan_hash": "12"}, "plan_hash is .* 16 hexadecimal digits"),
        ({"command": " "}, "command is"),
        ({"colour": "red"}, "has a 'colour'; an episode has only"),
    ],
)
def test_each_fault_names_its_file_line_and_field(
    change: dict[str, Any], problem: str, tmp_path: Path
) -> None:
    path = tmp_path / "bad.jsonl"
    bad = json.dumps(asdict(replace(EPISODE, id="mine-00001")) | change)
    path.write_text(to_line(EPISODE) + bad + "\n")
    with pytest.raises(EpisodeFileError, match=rf"bad\.jsonl:2: {problem}") as caught:
        read_episodes(path)
    assert "\n" not in str(caught.value)


def test_a_wrong_episode_file_is_refused(tmp_path: Path) -> None:
    def refused(name: str, content: bytes, problem: str) -> None:
        (tmp_path / name).write_bytes(content)
        with pytest.raises(EpisodeFileError, match=problem):
            read_episodes(tmp_path / name)

    line = to_line(EPISODE).encode()
    refused("a.jsonl", b"", "holds no episode")
    refused("a.jsonl", b"{", r"a\.jsonl:1: is no JSON")
    refused("a.jsonl", b"[]\n", "is a list; an episode is an object")
    refused("a.jsonl", line + line, "another episode 'mine-00007'")
    refused("a.jsonl", b"\xff\xfe", "not text in UTF-8")
    refused("a.jsonl.gz", line, "not gzip-compressed")
    refused("a.jsonl.gz", gzip.compress(line)[:-9], "is cut off")
    refused("a.txt", line, r"ends in \.jsonl or \.jsonl\.gz")
    missing = json.dumps({k: v for k, v in asdict(EPISODE).items() if k != "route"}).encode()
    refused("a.jsonl", missing, "has no 'route'; an episode has id, floor_plan")


def test_the_splits_hold_ten_thousand_episodes_as_documented() -> None:
    assert sum(split.episodes for split in SPLITS.values()) == 10_000
    for name, split in SPLITS.items():
        episodes = load_episodes(name)
        assert len(episodes) == split.episodes
        assert [episode.number for episode in episodes] == list(range(split.episodes))
        assert {episode.expected for episode in episodes} == {split.expected}
        assert {episode.floor_plan for episode in episodes} == {
            split.floor_plan(k) for k in range(split.episodes)
        }


def test_val_seen_is_in_offices_of_train_and_no_other_split_is() -> None:
    seen = {episode.floor_plan for episode in load_episodes("train")}
    for name in SPLITS:
        offices = {episode.floor_plan for episode in load_episodes(name)}
        if name in ("train", "val_seen"):
            assert offices <= seen
        else:
            assert not offices & seen
    starts = {(e.floor_plan, e.start) for e in load_episodes("train")}
    assert not starts & {(e.floor_plan, e.start) for e in load_episodes("val_seen")}


@pytest.mark.parametrize("name", ["train", "val_seen", "val_unseen", "test_long"])
def test_distributions_clauses_and_languages_are_balanced(name: str) -> None:
    episodes, split = load_episodes(name), SPLITS[name]
    offices = Counter(episode.floor_plan.split(":")[1] for episode in episodes)
    assert len(offices) == 4
    assert len(set(offices.values())) == 1
    clauses = Counter(episode.clauses for episode in episodes)
    assert set(clauses) == set(split.clauses)
    pairs = [n for n in split.clauses for _ in topics_of(n)]
    for n, count in clauses.items():
        assert count / split.episodes == pytest.approx(pairs.count(n) / len(pairs), rel=0.12)
    german = sum(episode.language == "de" for episode in episodes) / len(episodes)
    assert 0.12 < german < 0.28
    assert len({episode.command for episode in episodes}) > 0.5 * len(episodes)


@pytest.mark.parametrize("name", SPLITS)
def test_the_seed_gives_the_first_episodes_again(name: str) -> None:
    """If this fails after a change of the language or the grounding: `semnav episodes generate`."""
    frozen = load_episodes(name)[:FIRST]
    again = list(islice(generate_split(SPLITS[name]), FIRST))
    assert list(map(to_line, again)) == list(map(to_line, frozen))


@pytest.mark.slow
@pytest.mark.parametrize("name", SPLITS)
def test_the_seed_gives_all_episodes_again(name: str) -> None:
    again = map(to_line, generate_split(SPLITS[name]))
    assert list(again) == list(map(to_line, load_episodes(name)))


@pytest.mark.parametrize("name", SPLITS)
def test_what_a_split_promises_holds_for_a_sample(name: str) -> None:
    sample = evenly(load_episodes(name), 6)
    assert [problem for _, some in faults(sample) for problem in some] == []


def test_each_broken_guarantee_of_an_episode_is_named() -> None:
    hopeless = replace(EPISODE, command="go through the ninth door on the right")
    hopeless = replace(hopeless, readings=(hopeless.command,))
    blocked = replace(EPISODE, start=(1.3, 100.0, 0.0))
    otherwise = replace(EPISODE, command="enter the third door on the right")
    stale = replace(EPISODE, plan_hash="0" * 16)
    found = [some for _, some in faults([EPISODE, hopeless, blocked, otherwise, stale])]
    for words, some in zip(
        ("no ninth door", "outside", "now means", "has changed"), found[1:], strict=True
    ):
        assert words in " ".join(some)
    assert found[0] == ()


def test_the_fingerprint_tells_offices_and_any_door_apart() -> None:
    office = generate_office(3, "small")
    shut = replace(office.doors[0], open=not office.doors[0].open)
    changed = replace(office, doors=(shut, *office.doors[1:]))
    prints = {fingerprint(plan) for plan in (office, changed, generate_office(4, "small"))}
    assert len(prints) == 3
    assert fingerprint(generate_office(3, "small")) == fingerprint(office)


def test_evenly_takes_as_many_as_asked_for() -> None:
    episodes = load_episodes("test_real")
    assert evenly(episodes, 4) == (episodes[0], episodes[50], episodes[100], episodes[150])
    assert evenly(episodes[:3], 9) == episodes[:3]


def test_episodes_are_drawn_unless_one_is_asked_for() -> None:
    env = SemNavEnv(episodes="test_real")
    _, drawn = env.reset(seed=3)
    assert drawn["episode_id"].startswith("test_real-")
    _, again = env.reset(seed=3)
    assert again["episode_id"] == drawn["episode_id"]
    _, info = env.reset(options={"episode": "test_real-00005"})
    frozen = load_episodes("test_real")[5]
    assert info["pose"] == frozen.start
    assert info["command"] == str(frozen.meanings()[0])
    _, info = env.reset(options={"episode": EPISODE})
    assert info["episode_id"] == "mine-00007"
    assert parse(info["command"]) == parse(EPISODE.command)
    _, info = env.reset(seed=0, options={"floor_plan": "office_cross"})
    assert "episode_id" not in info


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        ({"episode": "train-1"}, "no episode 'train-1'; there are: mine-00007 to mine-00007"),
        ({"episode": EPISODE, "pose": (0, 0, 0)}, "an episode has its own pose"),
        ({"episode": replace(EPISODE, plan_hash="0" * 16)}, "has changed since"),
        ({"colour": 1}, "there are: command, language, .*, episode"),
        ({"episode": replace(EPISODE, expected=Expected.AMBIGUOUS)}, "nobody can carry it out"),
    ],
)
def test_options_that_make_no_episode_are_refused(options: dict[str, Any], problem: str) -> None:
    env = SemNavEnv(episodes=[EPISODE])
    with pytest.raises(ValueError, match=problem):
        env.reset(options=options)


def test_episodes_that_nobody_can_drive_are_refused_at_once() -> None:
    with pytest.raises(ValueError, match="can mean 2 things"):
        SemNavEnv(episodes="test_ambiguous")
    with pytest.raises(ValueError, match="no split 'moon'; there are: train, val_seen"):
        SemNavEnv(episodes="moon")
    with pytest.raises(ValueError, match="no episodes to draw from"):
        SemNavEnv(episodes=[])


def test_an_infeasible_episode_ends_when_the_robot_stands() -> None:
    env = SemNavEnv(observation="truth")
    words = "go through the ninth door on the right"
    hopeless = replace(
        EPISODE, command=words, readings=(words,), route=(), expected=Expected.INFEASIBLE
    )
    env.reset(seed=0, options={"episode": hopeless})
    over = False
    while not over:
        _, _, terminated, truncated, info = env.step([0.0, 0.0])
        over = terminated or truncated
    assert info["verdicts"] == (Verdict.STOPPED_SHORT,)
    assert "no ninth door" in info["impossible"]


def test_the_splits_are_listed_checked_and_made_by_commands(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["episodes", "list", "--json"]) == 0
    assert {row["name"] for row in json.loads(capsys.readouterr().out)} == set(SPLITS)
    few = replace(SPLITS["test_infeasible"], episodes=2, buildings=2)
    monkeypatch.setitem(SPLITS, "test_infeasible", few)
    assert main(["episodes", "generate", "test_infeasible", "--out", str(tmp_path)]) == 0
    made = tmp_path / "test_infeasible.jsonl.gz"
    assert "2 episodes" in capsys.readouterr().out
    assert main(["episodes", "check", str(made)]) == 0
    assert capsys.readouterr().out == "2 episodes checked, 0 faults\n"
    wrong = replace(read_episodes(made)[0], expected=Expected.FEASIBLE)
    write_episodes([wrong], made)
    assert main(["episodes", "check", str(made)]) == 1


@pytest.mark.slow
def test_episodes_are_made_in_maps_of_real_floors(tmp_path: Path) -> None:
    data = DATA / "gdc_floors" / "3ne"
    if not data.is_dir():
        pytest.skip("no maps of real floors beside the project")
    words = ["episodes", "import", str(data / "3ne.yaml"), "--episodes", "4"]
    assert main([*words, "--out", str(tmp_path)]) == 0
    episodes = read_episodes(tmp_path / "test_real_floors.jsonl.gz")
    assert len(episodes) == 4
    assert {Path(episode.floor_plan).parent for episode in episodes} == {tmp_path}
    assert [problem for _, some in faults(episodes) for problem in some] == []
