"""`semnav map`: list, show, check, generate, build, import and export floor plans."""

from __future__ import annotations

from semnav_scripts.dispatch import CommandTable

COMMANDS = CommandTable(
    "semnav map",
    "List, show, check, generate, build, import and export floor plans.",
    {
        name: (f"semnav_scripts.map_{name}", help)
        for name, help in {
            "list": "list the floor plans that come with the package",
            "show": "show what a floor plan holds",
            "check": "say what is wrong with a floor plan",
            "generate": "generate an office",
            "build": "build a floor plan of walls and doors from a log of lidar scans",
            "import": "make a floor plan from a map of another program",
            "export": "write a floor plan as a map of ROS's map_server",
        }.items()
    },
)
"""The sub-commands; each is a module of this package, so that none loads the imports of another."""
