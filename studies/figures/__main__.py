"""`python -m studies.figures`: draws a picture of the documentation, or prints its numbers."""

from importlib import import_module

import tyro

FIGURES = [
    "approach",
    "architecture",
    "arcs",
    "buildings",
    "cards",
    "clouds",
    "curves",
    "drift",
    "drift_success",
    "features_tables",
    "gallery",
    "headroom",
    "landmarks",
    "language",
    "learning",
    "leaderboard",
    "licences",
    "lines",
    "logs",
    "mapping",
    "observation_table",
    "of_commands",
    "offices",
    "page",
    "play",
    "real_floor",
    "report",
    "ros_graph",
    "routes",
    "rules",
    "rules_table",
    "situations",
    "speed",
    "tasks",
    "tour",
    "tutorials",
    "your_floor",
]

if __name__ == "__main__":
    mains = {name: import_module(f"studies.figures.{name}").main for name in FIGURES}
    tyro.extras.subcommand_cli_from_dict(
        mains, prog="python -m studies.figures", config=(tyro.conf.PositionalRequiredArgs,)
    )
