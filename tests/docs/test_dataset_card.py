"""The dataset card counts the frozen episodes as they are."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from semnav_env.judge.episodes import Episode, load_episodes
from tests.support.paths import ROOT

CARD = (ROOT / "docs" / "guides" / "dataset_card.md").read_text(encoding="utf-8")

SPLITS = ("train", "val_seen", "val_unseen", "test_long")
"""Splits of feasible commands in offices."""

COUNTS: dict[str, Callable[[Sequence[Episode]], str]] = {
    "episodes": lambda split: str(len(split)),
    "floor plans": lambda split: str(len({each.floor_plan for each in split})),
    "different texts": lambda split: str(len({each.command for each in split})),
    "German": lambda split: f"{np.mean([each.language == 'de' for each in split]):.2f}",
    "words, median": lambda split: (
        f"{np.median([len(each.command.split()) for each in split]):.0f}"
    ),
}


@pytest.mark.parametrize("name", COUNTS)
def test_the_card_counts_what_the_files_hold(name: str) -> None:
    lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in CARD.splitlines()]
    splits = next(
        [cell.strip("`") for cell in cells[1:]] for cells in lines if cells[1:2] == ["`train`"]
    )
    shown = next(cells[1:] for cells in lines if cells[:1] == [name])
    assert shown == [COUNTS[name](load_episodes(split)) for split in splits]


def test_the_card_counts_the_offices() -> None:
    splits = [*SPLITS, "test_ambiguous", "test_infeasible"]
    plans = {each.floor_plan for split in splits for each in load_episodes(split)}
    assert f"| {len(plans)} offices |" in CARD
