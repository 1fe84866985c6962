"""Programs: the commands that bags of slots make, with what they were made of."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple, cast

from semnav_env.language.chart.beam import Entry
from semnav_env.language.chart.edits import Edited
from semnav_env.language.chart.features import Features, features
from semnav_env.language.chart.frames import Frame, fitting
from semnav_env.language.chart.templates import (
    CannotSay,
    clause_of,
    degrees_of,
    distance_of,
    reference_of,
    seconds_of,
)
from semnav_env.language.clauses import Clause, Follow, GoToDoor, IfThere
from semnav_env.language.command import MAX_CLAUSES
from semnav_env.language.references import DoorReference, Place, PlaceReference, RoomReference

MOST_DRAFTS = 10
"""The most programs of one way to part a text that are followed."""

MOST_FRAMES = 4
"""The most frames of a bag that are tried."""

FRAME_RANGE = 2.5
"""A frame may cost so much more than the cheapest one."""

END = PlaceReference(Place.END)
FIRST = DoorReference()
HALLWAY_ENDS = ("corner", "end", "t_junction")


class Draft(NamedTuple):
    """The beginning of a program.

    Attributes:
        cost: of its frames.
        clauses: so far.
        last: the door or room that was spoken of last, as a noun phrase.
        tags: of its frames.
        unsayable: whether some part of it is no clause.
    """

    cost: float
    clauses: tuple[Clause, ...]
    last: Features
    tags: tuple[str, ...]
    unsayable: bool


def programs(way: Edited) -> list[Draft]:
    """The programs of bags, the cheapest first."""
    drafts = [Draft(way.cost, (), (), way.tags, way.unsayable)]
    bags = list(way.bags)
    while bags:
        bag = bags.pop(0)
        if isinstance(bag, str):
            continue
        if condition := _condition(bag):
            then = bags.pop(0) if bags and not isinstance(bags[0], str) else None
            otherwise = None
            if bags[:1] == ["else"]:
                bags.pop(0)
                otherwise = bags.pop(0) if bags and not isinstance(bags[0], str) else None
            grown = [
                each for d in drafts for each in _conditional(d, *condition, then, otherwise)
            ]
        else:
            grown = [each for draft in drafts for each in _extended(draft, bag)]
        drafts = sorted(grown, key=lambda draft: draft.cost)[:MOST_DRAFTS]
    return [d for d in drafts if d.unsayable or 0 < len(d.clauses) <= MAX_CLAUSES]


def _condition(bag: Features) -> tuple[str, Any] | None:
    name = bag[0][0]
    found = name.partition(".")[0] in ("cond", "nocond", "condit", "nocondit")
    return (name.partition(".")[0], bag[0][1]) if found else None


def _conditional(
    draft: Draft, kind: str, noun: Any, then: Entry | None, otherwise: Entry | None
) -> Iterator[Draft]:
    """A condition with what depends on it."""
    absent = kind.startswith("no")
    said = noun if isinstance(noun, tuple) else draft.last
    tags = (*draft.tags, f"if:{kind}", "if:else" if otherwise else "if:then")
    cannot = draft._replace(unsayable=True, tags=(*tags, "if:unsayable"))
    own = dict(said)
    if not isinstance(then, tuple) or own.get("kind") not in ("door", "place"):
        yield cannot
        return
    if kind == "nocondit" and own.get("ord", 1) != 1:
        yield cannot
        return
    try:
        before, what = placed(said, draft.last)
        if before or isinstance(what, RoomReference):
            raise CannotSay
        head = IfThere(what, absent, otherwise is not None)
    except (CannotSay, ValueError):
        yield cannot
        return
    start = draft._replace(clauses=(), last=said)
    for first in _extended(start, then):
        seconds = _extended(start, otherwise) if isinstance(otherwise, tuple) else [None]
        for second in seconds:
            parts = first.clauses + (second.clauses if second else ())
            cost = first.cost + (second.cost - draft.cost if second else 0.0)
            single = len(first.clauses) == 1 and (not second or len(second.clauses) == 1)
            if first.unsayable or (second and second.unsayable) or not single:
                yield cannot._replace(cost=cost)
            else:
                more = first.tags[len(draft.tags) :] + (
                    second.tags[len(draft.tags) :] if second else ()
                )
                clauses = (*draft.clauses, head, *parts)
                if kind == "nocondit" and draft.clauses:
                    clauses = _first_open(draft, first)
                    if clauses is None:
                        yield cannot._replace(cost=cost)
                        continue
                yield Draft(cost, clauses, first.last, (*tags, *more), draft.unsayable)


def _first_open(draft: Draft, then: Draft) -> tuple[Clause, ...] | None:
    """ "If it is closed, take the next": closed doors do not count, so it is the first open one."""
    door, following = draft.clauses[-1], then.clauses[0]
    if isinstance(door, GoToDoor) and isinstance(following, GoToDoor) and door.door.ordinal == 1:
        if following.door.ordinal in (1, 2):
            return draft.clauses
    return None


def _extended(draft: Draft, bag: Entry) -> Iterator[Draft]:
    """A draft with one more bag."""
    assert isinstance(bag, tuple)
    for cost, tags, variant in _variants(draft, bag):
        found = fitting(variant)
        for more, frame in found[:MOST_FRAMES]:
            if more <= found[0][0] + FRAME_RANGE:
                grown = draft._replace(cost=draft.cost + cost + more, tags=(*draft.tags, *tags))
                yield from _framed(grown, frame, variant)


def _variants(draft: Draft, bag: Features) -> Iterator[tuple[float, tuple[str, ...], Features]]:
    """A bag, and with what it leaves out taken from what was said before."""
    yield 0.0, (), bag
    kind = dict(draft.last).get("kind")
    for slot, value in bag:
        if isinstance(value, tuple) and "ell" in dict(value) and kind in ("place", "turn"):
            own = dict(value)
            if own["kind"] != "door" and "place" in own:
                continue
            taken = {**own, "kind": "place", "place": dict(draft.last)["place"]}
            taken.pop("side", None)
            taken.pop("ell")
            rest = {k: v for k, v in bag if k != slot}
            if "side" in own:
                rest.setdefault("side", own["side"])
            rest[f"{slot.partition('.')[0]}.place"] = features(taken)
            yield 0.2, ("ellipsis:place",), features(rest)


def _framed(draft: Draft, frame: Frame, bag: Features) -> Iterator[Draft]:
    """A draft with the steps of a frame."""
    verb = dict(bag).get("V", "-")
    tags = (*draft.tags, f"F:{frame.name}", f"FV:{verb}:{frame.name}")
    times = 2 if "twice" in dict(bag) and frame.steps[0].startswith("turn") else 1
    if frame.steps == ("unsayable",):
        yield draft._replace(unsayable=True, tags=tags)
        return
    clauses, last = list(draft.clauses), draft.last
    try:
        for step in frame.steps * times:
            before, clause, noun = _step(step, bag, last)
            clauses += [*before, clause]
            last = noun if noun else last
    except CannotSay:
        yield draft._replace(unsayable=True, tags=(*tags, "unsayable"))
        return
    if "$last" in " ".join(frame.steps) and not draft.last:
        tags = (*tags, "no last")
    done = Draft(draft.cost, tuple(clauses), last, tags, draft.unsayable)
    yield done
    yield from _counted_on(draft, done)


def _step(step: str, bag: Features, last: Features) -> tuple[list[Clause], Clause, Features]:
    """The clauses before a step, its clause, and the noun phrase that it speaks of."""
    values: dict[str, Any] = {}
    before: list[Clause] = []
    noun: Features = ()
    for word in step.replace("(", " ").replace(")", " ").split():
        if word[0] != "$":
            continue
        name, _, side_from = word[1:].partition("/")
        name, _, feature = name.partition(".")
        if name in ("end", "first", "last") and name not in dict(bag):
            value = {"end": (("kind", "place"), ("place", "end")), "first": (("kind", "door"),)}.get(
                name, last or (("kind", "door"),)
            )
        elif name == "end":
            value = (("kind", "place"), ("place", "end"))
        else:
            value = next(v for slot, v in bag if slot.partition(".")[0] == name)
        if not isinstance(value, tuple):
            values[word] = value
            continue
        if feature:
            if feature not in dict(value):
                raise CannotSay
            values[word] = dict(value)[feature]
            continue
        if side_from:
            if "side" in dict(value):
                raise CannotSay
            value = features(dict(value) | {"side": dict(bag)["side"]})
        if name == "dist":
            values[word] = distance_of(value)
        elif name == "angle":
            values[word] = degrees_of(value)
        elif name == "secs":
            values[word] = seconds_of(value)
        else:
            more, values[word] = placed(value, last)
            before += more
            noun = value
    return before, clause_of(step, values), noun


def placed(
    noun: Features, last: Features
) -> tuple[list[Clause], DoorReference | PlaceReference | RoomReference]:
    """The clauses that lead to where a noun phrase is counted from, and its reference there.

    Raises:
        CannotSay: no clause says where it is.
    """
    own = dict(noun)
    before: list[Clause] = []
    if {"came", "sameside", "backwards"} & own.keys():
        raise CannotSay
    for name, value in noun:
        relation = name.partition(".")[0]
        if relation == "after":
            more, reference = placed(value, last)
            before += [*more, _past(reference)]
        elif relation == "afterit":
            if not last:
                raise CannotSay
            before.append(_past(reference_of(last)))
        elif relation == "opposite":
            more, reference = placed(value, last)
            before += [*more, Follow(reference)]
            own["side"] = "opposite"
        elif relation == "before":
            if dict(value).get("place") not in HALLWAY_ENDS:
                raise CannotSay
        elif relation == "near":
            if dict(value).get("place") not in ("end",):
                raise CannotSay
            own["atend"] = 1
        elif relation == "fromend":
            own["ord"] = -own.get("ord", 1)
    if "atend" in own and own["kind"] == "door":
        if "side" not in own:
            own["side"] = "ahead"
        elif own["side"] in ("left", "right"):
            own["ord"] = -1
    return before, reference_of(features(own))


def _past(reference: DoorReference | PlaceReference | RoomReference) -> Follow:
    try:
        return Follow(reference, past=True)
    except ValueError:
        raise CannotSay from None


def _counted_on(before: Draft, done: Draft) -> Iterator[Draft]:
    """A door or place that is counted from where the way to the one before it began."""
    if not before.clauses or len(done.clauses) != len(before.clauses) + 1:
        return
    passed, clause = before.clauses[-1], done.clauses[-1]
    if not isinstance(passed, Follow) or passed.until is None:
        return
    first = passed.until
    for name in ("door", "until", "at"):
        second = getattr(clause, name, None)
        if type(second) is type(first) and isinstance(second, DoorReference | PlaceReference):
            assert isinstance(first, DoorReference | PlaceReference)
            same = (getattr(first, "side", None) in (getattr(second, "side", None), None)) and (
                getattr(first, "place", None) == getattr(second, "place", None)
            )
            if same and 0 < first.ordinal < second.ordinal:
                anew = replace(second, ordinal=second.ordinal - first.ordinal)
                counted = replace(cast(Any, clause), **{name: anew})
                tags = (*done.tags, "counted on")
                yield done._replace(
                    cost=done.cost + 0.3, clauses=(*done.clauses[:-1], counted), tags=tags
                )
