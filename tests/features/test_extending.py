"""What docs/guides/extending.md says can be added from outside can be, and its files are there."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from shapely import box

from semnav_env.env import SemNavEnv
from semnav_env.language import Clause, Command, Follow, GoToDoor, OwnClause, encode, parse
from semnav_env.mind.belief.log_following import follow_log
from semnav_env.mind.grounding import Goal, GroundedClause, GroundingError, ReachGoal, Situation
from semnav_env.world.maps import FloorPlan, FloorPlanError, Region, Surface, load_floor_plan
from semnav_env.world.maps.importers import (
    ImportedPlan,
    ImportReport,
    import_map,
    register_importer,
)
from semnav_features import extract
from semnav_features.frames import compose
from semnav_features.readers import LogReader, LogRecord
from semnav_features.scan import Scan
from tests.support.paths import ROOT, source

MIND = ("mind/belief", "mind/grounding", "mind/observations")
PAGE = (ROOT / "docs" / "guides" / "extending.md").read_text()
POSE = (-2.5, -0.3, 0.24)


@dataclass(frozen=True)
class Advance(GroundedClause):
    """Drive on by some metres, where there is so much of a corridor."""

    metres: float
    stand_in: ClassVar[Clause] = Follow()

    def say(self, language: object) -> str:
        return "advance"

    def goal(self, situation: Situation) -> Goal:
        if situation.corridor.end < self.metres:
            raise GroundingError("no room to advance")
        return ReachGoal(compose(situation.begin, (self.metres, 0.0, 0.0)), 0.3, because="advance")


def read_rooms(path: Path) -> ImportedPlan:
    """A file with the width and the depth of one room."""
    width, depth = map(float, path.read_text().split())
    corners = ((0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth), (0.0, 0.0))
    inside = Region("hall", box(0.0, 0.0, width, depth))
    outline = box(-1.0, -1.0, width + 1.0, depth + 1.0)
    plan = FloorPlan(path.stem, (Surface(corners),), (), (), (inside,), (), outline)
    return ImportedPlan(plan, ImportReport((str(path),), "rooms", {"rooms": 1}))


class RangesLog(LogReader):
    """A text with a row of ranges for each scan, half a circle."""

    expected = "rows of ranges"
    fraction = None

    def records(self) -> Iterator[LogRecord]:
        for number, line in enumerate(self.path.read_text().splitlines(), 1):
            ranges = np.array(line.split(), float)
            scan = Scan(ranges, -np.pi / 2, np.pi / (len(ranges) - 1))
            yield LogRecord(scan, None, (0.0, 0.0, 0.0), number)

    def close(self) -> None:
        pass


def test_an_own_clause_is_carried_out_and_judged() -> None:
    env = SemNavEnv(observation="all")
    command = Command((Advance(1.0), *parse("go through the first door on the right").clauses))
    _, info = env.reset(seed=0, options={"command": command, "pose": POSE})
    assert info["command"] == "advance and go through the first door on the right"
    assert env.belief.goal.because == "advance"
    for _ in range(60):
        verdicts = env.step(np.array([0.3, 0.0]))[4]["verdicts"]
    assert verdicts[0] == "done"
    assert env.belief.clause == 1
    assert isinstance(env.judge.mission.command.clauses[1], GoToDoor)


def test_an_own_clause_has_the_token_of_its_stand_in() -> None:
    assert np.array_equal(encode(Command((Advance(1.0),))), encode(Command((Follow(),))))


def test_an_own_clause_that_cannot_be_carried_out_is_refused() -> None:
    env = SemNavEnv()
    far = {"command": Command((Advance(200.0),)), "pose": POSE}
    with pytest.raises(GroundingError, match="no room to advance"):
        env.reset(seed=0, options=far)


def test_an_own_clause_without_a_goal_cannot_be_made() -> None:
    class Mute(OwnClause):
        pass

    with pytest.raises(TypeError, match="abstract"):
        Mute()  # type: ignore[abstract]


def test_a_registered_importer_reads_its_files(tmp_path: Path) -> None:
    file = tmp_path / "one.ROOMS"
    file.write_text("6 3")
    with pytest.raises(FloorPlanError, match="no map of a known kind"):
        import_map(tmp_path / "one.unknown")
    register_importer(".rooms", read_rooms)
    plan, report = import_map(file)
    assert load_floor_plan(plan).region("hall").polygon.area == 18.0
    assert "taken: 1 room" in str(report)


@pytest.mark.parametrize("suffix", ["", ".", "rooms", ".yaml", ".PNG", ".json"])
def test_an_importer_needs_a_suffix_of_a_new_kind(suffix: str) -> None:
    with pytest.raises(ValueError, match="suffix of a new kind"):
        register_importer(suffix, read_rooms)


def test_the_records_of_an_own_reader_are_extracted_and_followed(tmp_path: Path) -> None:
    path = tmp_path / "scans.txt"
    angles = np.linspace(-np.pi / 2, np.pi / 2, 541)
    ranges = np.minimum(1.0 / np.maximum(abs(np.sin(angles)), 0.05), 8.0)
    path.write_text("\n".join([" ".join(f"{r:.3f}" for r in ranges)] * 4))
    with RangesLog(path) as log:
        assert all(len(extract(record.scan).walls) >= 2 for record in log)
    with RangesLog(path) as log:
        beliefs = [belief for _, belief in follow_log(log, parse("turn around"))]
    assert [belief.clause for belief in beliefs] == [0] * 4


def test_the_files_that_the_page_names_are_there() -> None:
    named = set(re.findall(r"`([\w/]+\.(?:py|json))`", PAGE))
    assert len(named) > 15
    for name in named:
        assert source(name).exists() or source(f"semnav_env/{name}").exists(), name


def test_the_page_names_every_file_that_all_clauses_stand_in() -> None:
    """The clauses of the package show where a new one goes; its words are the reader's."""
    kinds = ("Turn", "GoToDoor", "Stop", "Leave")
    texts = {path: path.read_text() for path in (ROOT / "semnav_env").rglob("*.py")}
    everywhere = {
        path.relative_to(ROOT / "semnav_env").as_posix()
        for path, text in texts.items()
        if all(re.search(rf"\b{kind}\b", text) for kind in kinds)
    }
    reader = {"language/one_reading.py"}
    shown = {
        *("language/clauses.py", "language/clause_kinds.py", "language/__init__.py"),
        "mind/grounding/ground.py",
    }
    assert everywhere - reader == shown
    assert [name for name in shown if f"`{name}`" not in PAGE] == []


def test_the_page_has_a_row_for_each_part_that_can_be_given() -> None:
    parts = re.findall(r"^\| ([a-z][\w ]+) \|", PAGE, re.MULTILINE)
    for part in ("reward term", "observation entry", "task", "agent", "body", "lidar", "clause"):
        assert part in parts
    assert "floor plan importer" in parts
