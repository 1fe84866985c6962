"""The tables of docs/lab/features_evaluation.md, from what a study of the features wrote."""

import json
from pathlib import Path
from typing import Any

SIGMA = 20.0
COUNTED = ("in good view", "recall", "recall, all in view", "detections", "precision", "F1")

Row = dict[str, Any]
REST = (
    *("Doors by floor plan, sigma 20 mm", "Strategies", "Real doors, freiburg-079"),
    "Real logs, features a scan",
)


def written(value: object, column: str = "") -> str:
    if value is None:
        return "-"
    if column.endswith((", mm", "us a scan")):
        return f"{value:.0f}"
    return f"{value:.3f}" if isinstance(value, float) else str(value)


def table(rows: list[Row], columns: tuple[str, ...]) -> str:
    lines = [
        columns,
        ["---"] * len(columns),
        *([written(row[c], c) for c in columns] for row in rows),
    ]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def at_sigma(rows: list[Row]) -> list[Row]:
    return [row for row in rows if row["sigma, mm"] == SIGMA]


def main(path: Path) -> None:
    """Print the tables of docs/lab/features_evaluation.md.

    Args:
        path: the file features.json that `python -m studies features --out` wrote.
    """
    tables = json.loads(path.read_text())["tables"]
    found = tables["Found and missed, default settings"]
    errors = tables["Errors of what was found, default settings"]
    doors = [row for row in found if row["feature"] == "doors"]
    print(table(at_sigma(found), ("poses", "clutter", "feature", *COUNTED)), end="\n\n")
    print(table(doors, ("poses", "clutter", "sigma, mm", *COUNTED)), end="\n\n")
    print(table(errors, tuple(errors[0])), end="\n\n")
    for rows in (tables[name] for name in REST if name in tables):
        print(table(rows, tuple(rows[0])), end="\n\n")
