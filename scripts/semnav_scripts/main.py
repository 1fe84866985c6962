"""The `semnav` command."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_scripts.dispatch import CommandTable

SEMNAV = CommandTable(
    "semnav",
    "Semantic indoor navigation: see, understand, drive.",
    {
        name: (f"semnav_scripts.{name.replace(' ', '_')}", help)
        for name, help in {
            "extract": "turn a log of lidar scans into walls, doors, corners and corridors",
            "map": "list, show, check, generate, build, import and export floor plans",
            "demo": "let a robot carry out a command",
            "play": "drive a robot by keyboard or gamepad",
            "serve": "open a page in the browser to try it in",
            "follow": "follow a command on a recorded log, as a robot would",
            "habits": "measure how drivers pass doorways, in logs and episodes",
            "node": "carry out spoken commands on a robot, by ROS 1, ROS 2 or DDS",
            "simulate": "be a simulated robot for such a node",
            "ground": "say what a command refers to in a floor plan",
            "approach": "plan the pose before a door from which a robot can pass it",
            "describe": "say the command that leads to a door or a room",
            "demonstrate": "write what an agent sees and does as a dataset",
            "episodes": "list, check and generate frozen episodes, import others, buildings",
            "evaluate": "measure an agent on a suite of commands",
            "evaluate language": "count how much of people's commands is understood",
            "view": "see a kept result or episode again, or write it as a film or picture",
            "leaderboard": "make a table of agents from kept results",
            "train": "teach an agent, and keep what it learned",
            "bench": "time a step of the environment and its parts",
            "completion": "print what lets bash, zsh or fish complete commands and options",
            "doctor": "check the installation, mend its cache, say what a bug report needs",
        }.items()
    },
)
"""The sub-commands; each is a module of its name in this package."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run `semnav` with these arguments, by default those of the process; see `CommandTable`."""
    return SEMNAV.main(argv)


if __name__ == "__main__":
    raise SystemExit(main())
