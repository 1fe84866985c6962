"""The leaderboard fits a terminal, whatever is in it."""

from __future__ import annotations

from semnav_scripts.leaderboard import HEADINGS
from semnav_scripts.leaderboard_text import plain_table

INTERVAL = "0.967 (0.92 to 1.00)"


def row(split: str, agent: str, measured: str = INTERVAL) -> list[str]:
    rest = [""] * (len(HEADINGS) - 10)
    return [split, "wheelchair", agent, "10000", "5", *([measured] * 3), "0.33", "0.961", *rest]


def test_no_line_of_the_table_is_longer_than_a_terminal() -> None:
    table = plain_table(
        HEADINGS, [row("val_unseen", "listener_drives"), row("test_long", "x" * 60)]
    )
    assert max(map(len, table.splitlines())) <= 80
    assert table.splitlines()[0].endswith("IQM")


def test_a_value_stands_above_its_interval_in_its_column() -> None:
    heading, _, _, values, intervals = plain_table(
        HEADINGS, [row("val_seen", "drive")]
    ).splitlines()
    for name in ("success", "no contact", "SPL"):
        end = heading.index(name) + len(name)
        assert values[:end].endswith("0.967")
        assert intervals[:end].endswith("0.92-1.00")


def test_rows_of_one_split_and_robot_share_a_heading() -> None:
    table = plain_table(
        HEADINGS, [row("val_seen", "a"), row("val_seen", "b"), row("test_long", "c")]
    )
    assert table.count("val_seen, wheelchair") == 1
    assert table.index("val_seen") < table.index("b ") < table.index("test_long")


def test_a_row_without_intervals_takes_one_line() -> None:
    assert len(plain_table(HEADINGS, [row("val_seen", "a", "0.9")]).splitlines()) == 4
