"""Writes docs/rules.md: every rule of `Rules` with its value, unit and reason."""

from __future__ import annotations

import inspect
import re
from dataclasses import fields

from semnav_env.rules import GroundingRules, SuccessRules
from semnav_features.rules import DoorRules
from studies.figures import IMAGES

PAGE = IMAGES.parent / "rules.md"

TITLE = """# Rules

Robot and judge follow the same rules, which `SemNavEnv(rules=Rules(...))` takes: what a door is,
what words refer to, and what is accepted. Distances are those of the robot's centre. How they come
together, [commands](commands.md) says.
"""


def page() -> str:
    """The page, made of the classes and their docstrings."""
    parts = (TITLE, *map(_section, (DoorRules, GroundingRules, SuccessRules)))
    return "\n".join(parts)


def _section(rules: type) -> str:
    said = _attributes(rules)
    rows = [f"| `{f.name}` | {f.default:.3g} | {said[f.name]} |" for f in fields(rules)]
    first = inspect.cleandoc(rules.__doc__ or "").split("\n", 1)[0]
    return "\n".join(
        (f"## {rules.__name__}\n\n{first}\n\n| rule | usual | meaning |\n|---|---|---|", *rows, "")
    )


def _attributes(rules: type) -> dict[str, str]:
    """What a class's docstring says of each of its fields."""
    text = inspect.cleandoc(rules.__doc__ or "").split("Attributes:\n")[1].split("\n\n")[0]
    found = re.findall(r"^    (\w+): (.*(?:\n {5,}.*)*)", text, flags=re.MULTILINE)
    return {name: " ".join(said.split()) for name, said in found}


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
