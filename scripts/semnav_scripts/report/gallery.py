"""The failures that a report shows, and their drives as its page draws them."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, zip_longest
from typing import Any

import numpy as np

from semnav_agents.evaluation import Result
from semnav_agents.evaluation.kept_drive import KeptDrive
from semnav_agents.evaluation.results import short_cause
from semnav_features.frames import FloatArray
from semnav_scripts.page.plan_message import body_message, plan_message

MAX_SHOWN = 24
"""The most failures that are shown: the page stays small, and can be looked through."""

MARGIN = 2.5
"""Margin around path, route and goals that is drawn, metres."""


def without_excess(results: Iterator[Result]) -> Iterator[Result]:
    """The results, with the drives of at most `MAX_SHOWN` failures of each cause.

    Of a long evaluation that fails often all drives would take a gigabyte.
    """
    kept = Counter[str]()
    for result in results:
        cause = short_cause(result)
        kept[cause] += result.kept is not None
        yield replace(result, kept=None) if kept[cause] > MAX_SHOWN else result


def chosen(results: Sequence[Result]) -> list[Result]:
    """At most `MAX_SHOWN` failures whose drives were kept: of each cause in turn the next."""
    by_cause = defaultdict[str, list[Result]](list)
    for result in results:
        if result.kept is not None:
            by_cause[short_cause(result)].append(result)
    in_turn = chain.from_iterable(zip_longest(*by_cause.values()))
    return [result for result in in_turn if result is not None][:MAX_SHOWN]


def drives_message(drives: Sequence[KeptDrive]) -> dict[str, Any]:
    """Drives as the page draws them; plans and bodies that several share are there once."""
    plans, bodies = dict[str, int](), dict[str, int]()
    drawn_plans, drawn_bodies = list[dict[str, Any]](), list[dict[str, Any]]()
    rows: list[dict[str, Any]] = []
    for drive in drives:
        plan, body = plan_message(drive.floor_plan), body_message(drive.robot)
        row = {"plan": _index(plans, drawn_plans, plan), "body": _index(bodies, drawn_bodies, body)}
        rows.append(row | _drive_message(drive))
    return {"plans": drawn_plans, "bodies": drawn_bodies, "drives": rows}


def _index(known: dict[str, int], drawn: list[dict[str, Any]], it: dict[str, Any]) -> int:
    """The place of something in a list, to which it is added if it is not there."""
    index = known.setdefault(repr(it), len(drawn))
    if index == len(drawn):
        drawn.append(it)
    return index


def _drive_message(drive: KeptDrive) -> dict[str, Any]:
    """A drive: lengths in whole centimetres, headings in thousandths of a radian."""
    belief = drive.belief
    return {
        "seconds": round(drive.seconds, 1),
        "bounds": _bounds(drive),
        "x": _whole(100.0 * drive.poses[:, 0]),
        "y": _whole(100.0 * drive.poses[:, 1]),
        "heading": _whole(1000.0 * drive.poses[:, 2]),
        "touched": np.flatnonzero(drive.touched).tolist(),
        "people": [_whole(100.0 * moment) for moment in drive.people],
        "leaves": _whole(100.0 * drive.leaves),
        "route": np.round(drive.route, 2).tolist(),
        "goals": np.round(np.array(drive.goals), 2).tolist(),
        "doors": [_whole(100.0 * np.array((*d.start, *d.end))) for d in belief.doors]
        if belief
        else [],
        "aim": np.round(belief.goal, 2).tolist() if belief else None,
    }


def _bounds(drive: KeptDrive) -> list[float]:
    """The part of the plan to draw: west, south, east, north, metres."""
    points = np.vstack((drive.poses[:, :2], drive.route, np.array(drive.goals).reshape(-1, 2)))
    west, south, east, north = drive.floor_plan.boundary.bounds
    low = np.maximum(points.min(axis=0) - MARGIN, (west, south))
    high = np.minimum(points.max(axis=0) + MARGIN, (east, north))
    return [round(float(value), 2) for value in (*low, *high)]


def _whole(values: FloatArray) -> list[int]:
    numbers: list[int] = np.rint(values).astype(np.int64).ravel().tolist()
    return numbers
