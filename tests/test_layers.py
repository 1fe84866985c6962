"""What the folders may know of each other."""

import ast
import subprocess
import sys
import tomllib
from collections import defaultdict
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

from tests.support.paths import ROOT, ROOTS

LAYERS = tuple(ROOTS)
"""A package may import those before it."""
MAY_NEED = {
    "semnav_features/clouds": {"scipy"},
    "semnav_features/clouds/picture.py": {"matplotlib"},
    "semnav_features/kernels/cache_key.py": {"llvmlite"},  # its version
    "semnav_features/kernels/lanes.py": {"llvmlite"},  # numba's own compiler
    "semnav_features/mapping": {"scipy"},
    "semnav_features/plot.py": {"matplotlib"},
    "semnav_features/plot_passages.py": {"matplotlib"},
    "semnav_features/readers": {"rosbags", "lz4"},  # lz4 comes with rosbags
}


@dataclass(frozen=True)
class Module:
    name: str
    layer: str
    path: Path
    tree: ast.Module

    @property
    def place(self):
        """Its path in the folder that holds its package."""
        return self.path.relative_to(ROOTS[self.layer]).as_posix()


def source_files(layer):
    return sorted((ROOTS[layer] / layer).rglob("*.py"))


def module_name(layer, path):
    parts = path.relative_to(ROOTS[layer]).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__")


MODULES = {
    module.name: module
    for layer in LAYERS
    for path in source_files(layer)
    for module in [Module(module_name(layer, path), layer, path, ast.parse(path.read_text()))]
}


def imported(module):
    """Names of all that a module imports, wherever in it: (module, name in it or None)."""
    for node in ast.walk(module.tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name, None) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module.place}:{node.lineno}: a relative import"
            yield from ((node.module, alias.name) for alias in node.names)


def dependencies(module):
    """Our own modules that a module imports."""
    for name, member in imported(module):
        inner = f"{name}.{member}"
        if inner in MODULES or name in MODULES:
            yield MODULES[inner if inner in MODULES else name]


def importers(package):
    return {
        m.place for m in MODULES.values() if package in {n.split(".")[0] for n, _ in imported(m)}
    }


HEAVY = {"PIL", "lark", "matplotlib", "pygame", "rich", "scipy.linalg", "scipy.sparse", "torch"}
"""Modules that take long to load, and that making an environment has no use for."""

MAKE_AN_ENVIRONMENT = """
import sys, gymnasium
gymnasium.make("semnav_env:SemNav-v0")
print(*sys.modules)
"""


def test_making_an_environment_loads_nothing_heavy():
    command = [sys.executable, "-c", MAKE_AN_ENVIRONMENT]
    for _ in range(2):  # the first may compile
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert not HEAVY & set(done.stdout.split())


def test_no_two_classes_have_one_name():
    """`Arguments` is excepted, because each command finds its own by this name."""
    places = defaultdict(list)
    for module in MODULES.values():
        for node in ast.walk(module.tree):
            if isinstance(node, ast.ClassDef) and node.name != "Arguments":
                places[node.name].append(module.place)
    assert {name: where for name, where in places.items() if len(where) > 1} == {}


@pytest.mark.parametrize("package", ["semnav_features", "semnav_env", "semnav_agents"])
def test_every_exported_name_is_there(package):
    """They are loaded when they are asked for, so that nobody misses one before."""
    module = import_module(package)
    assert all(hasattr(module, name) for name in module.__all__)


def test_there_is_something_to_look_at():
    assert {module.layer for module in MODULES.values()} == set(LAYERS)
    assert "semnav_features.scan" in {d.name for m in MODULES.values() for d in dependencies(m)}


def test_imports_only_point_down():
    upwards = [
        f"{module.place} imports {other.place}"
        for module in MODULES.values()
        for other in dependencies(module)
        if LAYERS.index(other.layer) > LAYERS.index(module.layer)
    ]
    assert upwards == []


@pytest.mark.parametrize("layer", LAYERS)
def test_a_folder_has_no_import_cycle(layer):
    inside = [module for module in MODULES.values() if module.layer == layer]
    graph = {m.name: {d.name for d in dependencies(m) if d.layer == layer} for m in inside}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" <- ".join(error.args[1]))


def test_features_need_numpy_and_numba_only():
    known = {"numpy", "numba", "semnav_features", *sys.stdlib_module_names}
    for module in MODULES.values():
        if module.layer == "semnav_features":
            others = {name.split(".")[0] for name, _ in imported(module)} - known
            folder = module.place.rpartition("/")[0]
            assert others <= MAY_NEED.get(module.place, MAY_NEED.get(folder, set())), module.place


def test_reading_bags_costs_nothing_until_one_is_opened():
    """`rosbags` is an extra: no module of the readers imports it, or what it brings, at once."""
    for module in MODULES.values():
        if module.place.startswith("semnav_features/readers/"):
            body = module.tree.body
            names = {alias.name for n in body if isinstance(n, ast.Import) for alias in n.names}
            names |= {node.module for node in body if isinstance(node, ast.ImportFrom)}
            assert not {name.split(".")[0] for name in names} & MAY_NEED["semnav_features/readers"]


def test_the_simulator_and_the_pictures_each_have_one_door():
    assert {place.rpartition("/")[0] for place in importers("pymunk")} == {
        "semnav_env/world/physics"
    }
    assert importers("pygame") == {"semnav_env/rendering/backend.py"}


def needed(name, seen):
    """All of our own modules that a module needs, itself included."""
    if name not in seen:
        seen.add(name)
        for other in dependencies(MODULES[name]):
            needed(other.name, seen)
    return seen


ROOMS = {
    "language": {"language", "networks"},
    "world": {"robots", "world"},
    "mind": {"language", "networks", "mind", "robots", "rules"},
    "judge": {"judge", "language", "mind", "networks", "robots", "rules", "world"},
}
"""The rooms of `semnav_env`, and what of it each of them may need, directly or not."""


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_needs_only_what_lies_below_it(room):
    for name in [name for name in MODULES if name.startswith(f"semnav_env.{room}.")]:
        parts = {o.split(".")[1] for o in needed(name, set()) if o.startswith("semnav_env.")}
        assert parts <= ROOMS[room], name


@pytest.mark.parametrize("package", ["semnav_env.world.grid", "semnav_env.networks"])
def test_grids_and_networks_know_nobody_above_features(package):
    for name in [name for name in MODULES if name.startswith(f"{package}.")]:
        others = {o for o in needed(name, set()) if not o.startswith("semnav_features.")}
        assert all(other.startswith(f"{package}.") for other in others), name


def test_only_agents_learn():
    for package in ("stable_baselines3", "sb3_contrib", "torch"):
        assert all(place.startswith("semnav_agents/") for place in importers(package)), package


def test_only_the_lidar_makes_a_scan_from_a_floor_plan():
    makers = {
        module.place
        for module in MODULES.values()
        for node in ast.walk(module.tree)
        if isinstance(node, ast.Call)
        and getattr(node.func, "attr", getattr(node.func, "id", "")) == "Scan"
    }
    assert {place for place in makers if not place.startswith("semnav_features/")} == {
        "semnav_env/world/lidar/lidar.py",
    }


def test_what_is_not_installed_is_never_imported():
    for package in ("studies", "examples", "tests"):
        assert importers(package) == set(), package


def test_the_oracle_and_the_truth_import_no_kernel():
    folders = (ROOT / "tests" / "numpy_oracle", ROOT / "studies" / "truth")
    kernels = ("semnav_features.kernels", "semnav_features.extraction", "numba")
    for path in (path for folder in folders for path in folder.glob("*.py")):
        module = Module(path.stem, "", path, ast.parse(path.read_text()))
        names = {f"{name}.{member}" for name, member in imported(module)}
        assert not [name for name in names if name.startswith(kernels)], path


def test_setuptools_finds_every_package_from_its_root():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
    where = settings["packages"]["find"]["where"]
    assert {ROOT / folder for folder in where} == set(ROOTS.values())
    for folder in {path.parent for layer in LAYERS for path in source_files(layer)}:
        assert (folder / "__init__.py").exists(), f"{folder.relative_to(ROOT)} lacks an __init__.py"


def test_no_file_of_the_tree_is_a_link():
    """Zip files and Windows break links."""
    if not (ROOT / ".git").exists():
        pytest.skip("only git knows what is of the tree")
    command = ["git", "ls-files", "-s"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert not [line for line in listed.stdout.splitlines() if line.startswith("120000")]


def test_no_module_is_a_drawer_for_odds_and_ends():
    drawers = {"utils", "util", "helpers", "helper", "misc", "common"}
    assert not [m.place for m in MODULES.values() if drawers & set(m.name.split("."))]


def test_kernels_use_neither_fastmath_nor_prange():
    """Either may change the last bits of a result from machine to machine.

    `larger` and its like are excepted: there is one larger number of two that are neither NaN nor
    both zero.
    """
    marks = ("fastmath=", "parallel=True", "prange")
    found = [m.place for m in MODULES.values() if any(k in m.path.read_text() for k in marks)]
    assert found == ["semnav_features/kernels/lanes.py"]
