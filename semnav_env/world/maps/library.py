"""The floor plans that come with the package, generated ones, and any other by its path."""

from __future__ import annotations

from functools import cache, lru_cache
from pathlib import Path

from semnav_env.world.maps.floor_plan import OFFICE_PREFIX, FloorPlan
from semnav_env.world.maps.reader import read_plan
from semnav_env.world.maps.rules import FloorPlanError, check_plan

MAX_PATH_LENGTH = 4096
"""Length of the longest path, characters, as on Linux."""

MAX_KEPT_OFFICES = 128
"""Number of generated offices that are kept in memory, those used last: those of a split."""

MAX_KEPT_FILES = 16
"""Number of plans read from files that are kept in memory, those used last."""

BUNDLED_FOLDER = Path(__file__).with_name("bundled")
"""Folder of the floor plans that come with the package."""


@cache
def bundled_names() -> tuple[str, ...]:
    """Names of the floor plans that come with the package, sorted."""
    return tuple(sorted(path.stem for path in BUNDLED_FOLDER.glob("*.geojson")))


def load_floor_plan(plan: str | Path | FloorPlan) -> FloorPlan:
    """The floor plan of that name or at that path; a `FloorPlan` is checked and returned.

    A name is a bundled one, or that of a generated office with its distribution and its seed, as
    "office:medium:17": the same plan everywhere, in other processes too.

    Raises:
        FloorPlanError: no such plan, which lists those there are; or a file or plan that breaks
            a rule of docs/guides/floor_plans.md, which says where and what would be right.
    """
    if isinstance(plan, FloorPlan):
        plan.derived(check_plan)
        return plan
    if isinstance(plan, str) and plan in bundled_names():
        return _bundled(plan)
    if isinstance(plan, str) and plan.split(":")[0] == OFFICE_PREFIX:
        return _office(plan)
    if not isinstance(plan, str | Path):
        raise FloorPlanError(f"a floor plan is a name, a path or a FloorPlan, not {plan!r:.80}")
    if isinstance(plan, Path) or _is_path(plan):
        return _at(Path(plan))
    raise FloorPlanError(_unknown(plan))


def _at(path: Path) -> FloorPlan:
    """The plan in a file, which is read again only after a change of the file."""
    try:
        told = path.stat()
    except OSError:
        return read_plan(path)  # says what is wrong
    return _unchanged(path, (told.st_dev, told.st_ino, told.st_size, told.st_mtime_ns))


@lru_cache(maxsize=MAX_KEPT_FILES)
def _unchanged(path: Path, state: tuple[int, ...]) -> FloorPlan:
    return read_plan(path)


@cache
def _bundled(name: str) -> FloorPlan:
    return read_plan(BUNDLED_FOLDER / f"{name}.geojson", follows_schema=True)  # a test tells


@lru_cache(maxsize=MAX_KEPT_OFFICES)
def _office(name: str) -> FloorPlan:
    from semnav_env.world.maps.generator.naming import (
        office_named,  # most environments need no office
    )

    try:
        return office_named(name)
    except ValueError as error:
        raise FloorPlanError(str(error)) from None


def _is_path(text: str) -> bool:
    """Whether a text is a path: it has a folder or a suffix, or names a file that is here."""
    if len(text) > MAX_PATH_LENGTH or not set(text).isdisjoint("\0\n\r"):
        return False
    return "/" in text or bool(Path(text).suffix) or text in map(str, Path().iterdir())


def _unknown(name: str) -> str:
    from rapidfuzz import process  # only an error needs it

    names = bundled_names()
    near = process.extractOne(name[:80], names, score_cutoff=60)
    hint = f"; did you mean {near[0]}?" if near else ""
    others = f"{OFFICE_PREFIX}:medium:17 (a generated one) or a path"
    return f"no floor plan named {name[:80]!r}; there are: {', '.join(names)}, {others}{hint}"
