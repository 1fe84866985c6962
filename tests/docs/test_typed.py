"""The public API is typed, all of it: type checkers of users need not infer anything.

mypy checks (`make types`) that annotations are right; here is checked that none is missing, which
mypy does not mind where it can infer a type by itself.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from importlib.resources import files
from typing import Any

import pytest

from tests.support.paths import ROOT
from tests.test_layers import MODULES

PACKAGES = ("semnav_features", "semnav_env", "semnav_agents", "semnav_ros")
"""Packages whose names users import; `semnav_scripts` is a command."""


def exported() -> Iterator[object]:
    """What the packages and the packages in them export, and what the reference describes."""
    for module in MODULES.values():
        if module.path.name == "__init__.py" and module.name.startswith(PACKAGES):
            package = import_module(module.name)
            yield from (getattr(package, each) for each in getattr(package, "__all__", ()))
    for page in sorted((ROOT / "docs" / "reference").glob("*.md")):
        for target in re.findall(r"auto(?:class|function):: ([\w.]+)", page.read_text()):
            module, name = target.rsplit(".", 1)
            yield getattr(import_module(module), name)


def own(kind: type) -> list[type]:
    """The class and its bases, as far as they belong to the project."""
    return [each for each in kind.__mro__ if each.__module__.startswith("semnav_")]


PUBLIC = {id(it): it for it in exported() if inspect.isclass(it) or inspect.isfunction(it)}
FUNCTIONS = sorted(filter(inspect.isfunction, PUBLIC.values()), key=lambda it: it.__qualname__)
CLASSES = sorted(
    {base for it in PUBLIC.values() if inspect.isclass(it) for base in own(it)},
    key=lambda it: it.__qualname__,
)


def parsed(it: Any) -> Any:
    """The definition of a class or function."""
    source = inspect.getsource(it)
    indent = len(source) - len(source.lstrip())
    lines = (line[indent:] if not line[:indent].strip() else line for line in source.split("\n"))
    return ast.parse("\n".join(lines)).body[0]


def untyped_arguments(function: ast.FunctionDef) -> list[str]:
    """Names of arguments without a type, and "return"."""
    told = function.args
    arguments = [*told.posonlyargs, *told.args, *told.kwonlyargs, told.vararg, told.kwarg]
    named = [each for each in arguments if each is not None and each.arg not in ("self", "cls")]
    missing = [each.arg for each in named if each.annotation is None]
    return missing if function.returns is not None else [*missing, "return"]


def assigned(tree: ast.ClassDef) -> set[str]:
    """Names of the public attributes that methods assign to `self` without a type."""
    found, typed = set[str](), set[str]()
    for node in ast.walk(tree):
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Attribute):
            typed.add(node.target.attr)
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            is_own = isinstance(node.value, ast.Name) and node.value.id == "self"
            found |= {node.attr} if is_own and not node.attr.startswith("_") else set()
    return found - typed


def inferred_constants(tree: ast.ClassDef) -> set[str]:
    """Names of class attributes without a type whose value is no plain constant."""
    return {
        target.id
        for node in tree.body
        if isinstance(node, ast.Assign) and not isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name) and not target.id.startswith("_")
    }


def declared(kind: type) -> set[str]:
    """Names of attributes that a class or a base of it gives a type, or computes."""
    names = set[str]()
    for base in kind.__mro__:
        names |= set(vars(base).get("__annotations__", ()))
        names |= {name for name, it in vars(base).items() if inspect.isdatadescriptor(it)}
    return names


def is_enum(kind: type) -> bool:
    return any(base.__module__ == "enum" for base in kind.__mro__)


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_says_that_it_is_typed(package: str) -> None:
    assert (files(package) / "py.typed").is_file()


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda it: it.__qualname__)
def test_a_public_function_is_typed(function: Any) -> None:
    assert untyped_arguments(parsed(inspect.unwrap(function))) == []


@pytest.mark.parametrize("kind", CLASSES, ids=lambda it: it.__qualname__)
def test_a_public_class_is_typed(kind: type) -> None:
    tree = parsed(kind)
    methods = {
        node.name: untyped_arguments(node)
        for node in tree.body
        if isinstance(node, ast.FunctionDef)
        and (not node.name.startswith("_") or node.name == "__init__")
    }
    assert {name: missing for name, missing in methods.items() if missing} == {}
    constants = set() if is_enum(kind) else inferred_constants(tree)
    assert assigned(tree) - declared(kind) == set()
    assert constants - declared(kind) == set()


def test_what_is_not_typed_is_found() -> None:
    source = "class A:\n b = C()\n def __init__(self, x):\n  self.y = x\n  self.z: int = 3\n"
    tree: Any = ast.parse(source).body[0]
    assert assigned(tree) == {"y"}
    assert inferred_constants(tree) == {"b"}
    assert untyped_arguments(tree.body[1]) == ["x", "return"]
