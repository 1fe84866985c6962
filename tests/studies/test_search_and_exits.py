"""The tables of the searches and of the exits say what was measured, and how sure that is."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from studies.exits.command import table
from studies.search.command import Arguments
from studies.search.searches import Search, row, summary

ONE = Search(
    seed=1,
    agent="searcher",
    house="office:house:1",
    verdict="success",
    success=True,
    coverage=(1.0, 0.96),
    around=(0.99, 0.94),
    floor_coverage=(0.9, 0.8),
    victims=2,
    found=2,
    false_reports=0,
    report_errors=(0.1, 0.2),
    contacts=1,
    metres=150.0,
    seconds=300.0,
    from_start=0.2,
    cpu=5.0,
)


def test_a_room_counts_by_either_measure_of_what_can_be_seen() -> None:
    figures = summary([ONE, replace(ONE, coverage=(0.9, 1.0), around=(0.95, 1.0))])
    assert figures["rooms"] == 4
    assert figures["rooms covered"] == pytest.approx(3 / 4)
    assert figures["rooms covered, looking all around from the middle"] == pytest.approx(3 / 4)
    assert figures["least coverage"] == pytest.approx(0.9)
    assert figures["least coverage, looking all around from the middle"] == pytest.approx(0.94)
    assert figures["all rooms covered"] == pytest.approx(1 / 2)
    assert figures["contacts per 100 m"] == pytest.approx(2 / 3)


def test_an_interval_holds_its_share_and_shrinks_with_more_rooms() -> None:
    few, many = summary([ONE]), summary([ONE] * 50)
    for figures in (few, many):
        assert figures["rooms covered, 95 % from"] < 1.0
        assert figures["rooms covered, 95 % to"] == pytest.approx(1.0)
    assert few["rooms covered, 95 % from"] < many["rooms covered, 95 % from"]


def test_a_file_of_searches_is_gone_on_with(tmp_path, capsys) -> None:
    kept = tmp_path / "searches.jsonl"
    kept.write_text(json.dumps(row(ONE)) + "\n")
    Arguments(houses=1, first=1, agents=("searcher",), out=kept).run()
    assert "| searches | 1 |" in capsys.readouterr().out
    assert len(kept.read_text().splitlines()) == 1


def test_a_share_of_exits_comes_with_its_interval() -> None:
    rows = [
        {"rule": "rule", "robot": "spot", "passed": k < 150, "contact": k < 1, "seconds": 1.0}
        for k in range(161)
    ]
    assert table(rows).splitlines()[1].split() == [
        *("rule", "spot", "161", "0.9317", "0.882", "to", "0.961"),
        *("0.0062", "0.001", "to", "0.034", "1.0"),
    ]
