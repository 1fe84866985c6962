"""Writes docs/concepts/rules.md: every rule of `Rules` with its value, unit and reason."""

from __future__ import annotations

import inspect
import re
from dataclasses import fields

from semnav_env.rules import GroundingRules, SuccessRules
from semnav_features.rules import DoorRules
from studies.figures import IMAGES

PAGE = IMAGES.parent / "concepts" / "rules.md"

TITLE = """# Rules

Robot and judge follow the same rules, which are set by `SemNavEnv(rules=Rules(...))`: what a door
is, what words refer to, and what the judge accepts. Distances are those of the robot's centre.
[How commands are understood](commands.md) says how the rules work together.
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
        (
            f"## {rules.__name__}\n\n{first}\n\n| rule | default | meaning |\n|---|---|---|",
            *rows,
            "",
        )
    )


def _attributes(rules: type) -> dict[str, str]:
    """The description of each field in a class's docstring."""
    text = inspect.cleandoc(rules.__doc__ or "").split("Attributes:\n")[1].split("\n\n")[0]
    found = re.findall(r"^    (\w+): (.*(?:\n {5,}.*)*)", text, flags=re.MULTILINE)
    return {name: " ".join(said.split()) for name, said in found}


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
