"""What pages take from the code when they are built: contracts of environments, public names.

A page holds a comment where this belongs:

    <!-- spaces: SemNav-v0 -->              the spaces of an environment, and how it is made
    <!-- contract: SemNav-v0 -->            the docstring of its entry point
    <!-- contract: SemNav-v0: Rewards -->   some sections of it
    <!-- names: semnav_env.language -->     every public name of a package
"""

from __future__ import annotations

import ast
import inspect
import pkgutil
import re
from functools import cache
from importlib import import_module
from itertools import pairwise
from textwrap import indent
from types import ModuleType
from typing import Any

import gymnasium

import semnav_env  # registers the environments

PACKAGES = ("semnav_features", semnav_env.__name__, "semnav_agents", "semnav_ros")
COMMENT = re.compile(r"<!-- (\w+): ([\w.-]+)(?:: ([^>]+?))? -->")


def filled(text: str) -> str:
    """A page with everything in it that its comments ask for."""
    return COMMENT.sub(lambda found: MAKERS[found[1]](found[2], found[3]), text)


def contract(name: str, only: str | None) -> str:
    """The docstring of an environment, or those of its sections that are named."""
    text = inspect.getdoc(_entry_point(name)) or ""
    sections = re.split(r"(?m)^(?=## )", text)[1:]
    wanted = only.split(", ") if only else [_title(section) for section in sections]
    by_title = {_title(section): section for section in sections}
    shown = "\n".join(by_title[title].rstrip() + "\n" for title in wanted)
    return re.sub(r"(?m)^- ([a-z_]+):", r"- `\1`:", shown)  # names of arguments and terms


def spaces(name: str, _only: str | None) -> str:
    """A table of the spaces of an environment."""
    env = gymnasium.make(f"semnav_env:{name}", disable_env_checker=True)
    entries = getattr(env.observation_space, "spaces", {})
    kinds = [f"`{key}` {_size(space)}" for key, space in entries.items() if "_mask" not in key]
    return "\n".join(
        (
            "| | |\n|---|---|",
            f"| Action space | `{env.action_space}` |",
            f"| Observation space | `Dict`: {', '.join(kinds)} |",
            f'| Make it | `gymnasium.make("semnav_env:{name}")` |',
        )
    )


def names(package: str, _only: str | None) -> str:
    """Directives for every name that a package exports and that is documented nowhere else."""
    here, elsewhere = [], []
    for name in sorted(public()[package], key=str.lower):
        if home(package, name) == package:
            here.append(_directive(package, name))
        elif name != "__version__":
            elsewhere.append(_link(home(package, name), name))
    others = f"\n\nAlso here: {', '.join(elsewhere)}." if elsewhere else ""
    return "```{eval-rst}\n" + "\n\n".join(here) + "\n```" + others


@cache
def public() -> dict[str, list[str]]:
    """The names that the packages export, by package."""
    found = {}
    for top in map(import_module, PACKAGES):
        below = pkgutil.walk_packages(top.__path__, f"{top.__name__}.")
        for package in (top.__name__, *(each.name for each in below if each.ispkg)):
            exported = getattr(import_module(package), "__all__", None)
            if exported:
                found[package] = exported
    return found


def home(package: str, name: str) -> str:
    """The package where a name is documented: the nearest above the module that defines it."""
    defined = _defined_in(import_module(package), name)
    exporting = [
        other
        for other, exported in public().items()
        if name in exported and _defined_in(import_module(other), name) == defined
    ]
    above = [other for other in exporting if f"{defined}.".startswith(f"{other}.")]
    return max(above or exporting, key=len)


def _directive(package: str, name: str) -> str:
    """How Sphinx documents a name: a class with its methods, a function, or a value."""
    it = getattr(import_module(package), name)
    if inspect.isclass(it):
        return f".. autoclass:: {package}.{name}\n   :members:"
    if inspect.isroutine(it):
        return f".. autofunction:: {package}.{name}"
    return f".. py:data:: {package}.{name}\n\n" + indent(said_of_value(package, name), "   ")


def said_of_value(package: str, name: str) -> str:
    """The string below the assignment of a value; empty where none stands there."""
    module = import_module(_defined_in(import_module(package), name))
    body = ast.parse(inspect.getsource(module)).body
    for node, below in pairwise(body):
        targets = getattr(node, "targets", [getattr(node, "target", None)])
        named = any(getattr(target, "id", None) == name for target in targets)
        if named and isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
            return inspect.cleandoc(str(below.value.value))
    return ""


def _link(package: str, name: str) -> str:
    it = getattr(import_module(package), name)
    role = "class" if inspect.isclass(it) else "func" if inspect.isroutine(it) else "data"
    return f"{{py:{role}}}`~{package}.{name}`"


def _defined_in(module: ModuleType, name: str) -> str:
    """The module that defines a name, which another one may only import."""
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if not isinstance(node, ast.ImportFrom) or not node.module:
            continue
        if any((each.asname or each.name) == name for each in node.names):
            return _defined_in(import_module(node.module), name)
    return module.__name__


def _entry_point(name: str) -> Any:
    module, _, attribute = str(gymnasium.spec(name).entry_point).partition(":")
    return getattr(import_module(module), attribute)


def _title(section: str) -> str:
    return section.split("\n", 1)[0].removeprefix("## ")


def _size(space: Any) -> str:
    return " x ".join(map(str, space.shape)) if space.shape else "text"


MAKERS = {"contract": contract, "spaces": spaces, "names": names}
