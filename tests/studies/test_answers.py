"""What the answers to commands on real floors depend on: each thing that jumps is named."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from semnav_features.frames import Pose
from semnav_features.scene import Door, Scene, StillScene
from studies.__main__ import STUDIES
from studies.answers.jumps import Jump, View, jumps
from tests.support.command_line import run
from tests.support.hand_made import SIDE_ARMS, box, corridor
from tests.support.kth_floors import long_floor

START: Pose = (0.0, 0.0, 0.0)


def view(scene: Scene, begin: Pose = START, without: Sequence[int] = ()) -> View:
    """A view of a scene in which each door has a name, and some of them do not count."""
    doors = [Door(door.start, door.end, name=f"D{k}") for k, door in enumerate(scene.doors)]
    counted = tuple(door for k, door in enumerate(doors) if k not in without)
    return View(StillScene(scene.walls, counted), begin)


HALLWAY = view(corridor(left=(3.0, 6.0), end_door=True))


@pytest.mark.parametrize(
    ("other", "jump"),
    [
        (HALLWAY, Jump.PLACE),
        (view(corridor(left=(3.0, 6.0), end_door=True), (0.0, 0.0, math.pi / 2)), Jump.AXIS),
        (view(corridor(left=(3.0, 6.0), end_door=True, half=1.5)), Jump.WAY),
        (view(corridor(left=(3.0, 6.0), end_door=True, length=12.0)), Jump.END),
        (view(corridor(left=(3.0, 6.0), end_door=True), without=[0]), Jump.DOOR),
        (view(corridor(left=(3.0, 6.0), end_door=True), without=[2]), Jump.DOOR),
    ],
)
def test_what_jumps_is_named(other: View, jump: Jump) -> None:
    assert jumps(HALLWAY, other) == jumps(other, HALLWAY) == {jump}


def test_an_arm_that_is_not_there_is_named() -> None:
    one, other = view(SIDE_ARMS), view(corridor(left_arms=[(3.0, 5.0)]))
    assert jumps(one, other) == {Jump.ARM}


def test_an_arm_behind_the_nearer_end_is_not_named() -> None:
    one = view(SIDE_ARMS)
    other = view(corridor(left_arms=[(3.0, 5.0)], extra=box(6.0, -1.0, 7.0, 1.0)))
    assert jumps(one, other) == {Jump.END}


def test_the_study_counts_what_changes_the_answers(tmp_path: Path, capsys: Any) -> None:
    (tmp_path / "B1").mkdir()
    (tmp_path / "B1" / "one.xml").write_text(long_floor(1.2))
    words = "answers", "--kth", tmp_path, "--split", "real_drawn_other", "--json"
    code, out, err = run(capsys, *words, command=STUDIES.main)
    assert code == 0, err
    rows = json.loads(out)
    kept = rows["kept by"]
    assert rows["commands"] == {"in all": 15}
    assert kept["all"] <= min(kept.get(cause, 0) for cause in ("walls", "start", "limits"))
    assert sum(rows["what jumps alone"].values()) <= 15 - kept["all"]
    assert sum(rows["what jumps"].values()) >= 15 - kept["all"]
