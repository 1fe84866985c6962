"""Programs: the commands that bags of slots make, with what they were made of."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple, cast

from semnav_env.language.clauses import (
    Approach,
    Clause,
    Follow,
    GoToDoor,
    GoToRoom,
    IfThere,
    Turn,
)
from semnav_env.language.command import MAX_CLAUSES
from semnav_env.language.references import DoorReference, PlaceReference, RoomReference
from studies.chart_reader.beam import Entry
from studies.chart_reader.edits import Edited
from studies.chart_reader.features import Features, features
from studies.chart_reader.frames import Frame, fitting
from studies.chart_reader.templates import (
    NoClauseError,
    UnsayableError,
    clause_of,
    degrees_of,
    distance_of,
    reference_of,
    seconds_of,
)

MOST_DRAFTS = 10
"""The most programs of one way to part a text that are followed."""

MOST_FRAMES = 4
"""The most frames of a bag that are tried."""

FRAME_RANGE = 2.5
"""A frame may cost so much more than the cheapest one."""

END: Features = (("kind", "place"), ("place", "end"))
FIRST: Features = (("kind", "door"),)
HALLWAY_ENDS = ("corner", "end", "t_junction")


class Draft(NamedTuple):
    """The beginning of a program.

    Attributes:
        cost: of its frames.
        clauses: so far.
        last: the door, place or room that was spoken of last, as a noun phrase.
        leads: whether the last clause leads to it.
        tags: of its frames.
        unsayable: whether some part of it is no clause.
        anew: whether counting begins anew behind it ("from there").
    """

    cost: float
    clauses: tuple[Clause, ...]
    last: Features
    leads: bool
    tags: tuple[str, ...]
    unsayable: bool
    anew: bool = False

    def tagged(self, *tags: str, cost: float = 0.0, **changes: Any) -> Draft:
        """The same with more tags, a higher cost and other changes."""
        return self._replace(cost=self.cost + cost, tags=(*self.tags, *tags), **changes)


def programs(way: Edited) -> list[Draft]:
    """The programs of bags, the cheapest first."""
    drafts = [Draft(way.cost, (), (), False, way.tags, way.unsayable)]
    bags = list(way.bags)
    while bags:
        bag = bags.pop(0)
        if bag == "else":
            otherwise = _next_bag(bags)
            grown = [each for d in drafts for each in _else_without_if(d, otherwise)]
        elif isinstance(bag, str):
            drafts = [each._replace(anew=bag == "from there") for each in drafts]
            continue
        elif asked := _asked(bag):
            then = _next_bag(bags)
            otherwise = None
            if bags[:1] == ["else"]:
                bags.pop(0)
                otherwise = _next_bag(bags)
            grown = [each for d in drafts for each in _conditional(d, *asked, then, otherwise)]
        else:
            grown = [each for draft in drafts for each in _extended(draft, bag)]
        drafts = sorted(grown, key=lambda draft: draft.cost)[:MOST_DRAFTS]
    once = [_without_repeats(each) for each in drafts]
    drafts += [each for each in once if each is not None]
    drafts += [each for draft in drafts for each in _destination_first(draft)]
    return [d for d in drafts if d.unsayable or 0 < len(d.clauses) <= MAX_CLAUSES]


def _destination_first(draft: Draft) -> Iterator[Draft]:
    """A draft without the destination that is told before the way to it."""
    if len(draft.clauses) > 2 and isinstance(draft.clauses[0], GoToRoom):
        yield draft.tagged("destination first", cost=0.8, clauses=draft.clauses[1:])


def _without_repeats(draft: Draft) -> Draft | None:
    """A draft in which nothing is said twice in a row; None if nothing is."""
    kept = [
        clause
        for index, clause in enumerate(draft.clauses)
        if index == 0 or clause != draft.clauses[index - 1] or isinstance(clause, Turn)
    ]
    if len(kept) == len(draft.clauses):
        return None
    return draft.tagged("repeated", cost=0.2, clauses=tuple(kept))


def _next_bag(bags: list[Entry]) -> Features | None:
    """Take the bag that comes next, if one does."""
    if bags and not isinstance(bags[0], str) and not _asked(bags[0]):
        return cast(Features, bags.pop(0))
    return None


def _asked(bag: Entry) -> tuple[str, Any] | None:
    """The kind of a condition and what it is on; None if a bag is none."""
    name = bag[0][0].partition(".")[0]
    return (name, bag[0][1]) if name in ("cond", "nocond", "condit", "nocondit") else None


# --- Conditions ---------------------------------------------------------------------------------


def _conditional(
    draft: Draft, kind: str, noun: Any, then: Features | None, otherwise: Features | None
) -> Iterator[Draft]:
    """A condition with what depends on it, which may stand before it."""
    tags = (f"if:{kind}", "if:else" if otherwise else "if:then")
    draft = draft.tagged(*tags)
    said = noun if isinstance(noun, tuple) else draft.last
    try:
        base, what = _condition_on(draft, said)
    except NoClauseError:
        yield draft.tagged("if:unsayable", unsayable=True)
        return
    absent = kind.startswith("no")
    before = draft.clauses[-1] if draft.clauses else None
    is_same = draft.leads and (kind.endswith("it") or said == draft.last)
    if before is not None and (then is None or is_same):
        start = draft._replace(clauses=draft.clauses[:-1])
        other = then if then is not None else otherwise
        for second in _extended(draft, other) if other else [None]:
            if second is not None and len(second.clauses) != len(draft.clauses) + 1:
                continue
            last = second.clauses[-1:] if second is not None else ()
            if then is not None and not absent:
                continue
            if absent and second is None:
                continue
            if absent and _is_next(before, last[0]):
                clauses: tuple[Clause, ...] = draft.clauses
            else:
                last = tuple(_following(before, each) for each in last)
                head = IfThere(what, False, second is not None)
                lead = base[len(start.clauses) :] if isinstance(before, GoToRoom) else ()
                clauses = (*start.clauses, *lead, head, _at_the_door(before, said), *last)
            grown = second or draft
            yield grown.tagged("if:behind", cost=0.2, clauses=clauses)
    if then is None:
        yield draft.tagged("if:unsayable", cost=0.5, unsayable=True)
        return
    start = Draft(draft.cost, (), said, False, draft.tags, draft.unsayable)
    for first in _extended(start, then):
        for second in (
            _extended(first._replace(clauses=(), last=said, leads=False), otherwise)
            if otherwise
            else [None]
        ):
            whole = second or first
            parts = (first.clauses, second.clauses if second else ())
            if any(len(part) > 1 for part in parts) or not parts[0] or (second and not parts[1]):
                yield whole.tagged("if:unsayable", unsayable=True)
                continue
            head = IfThere(what, absent, second is not None)
            own = tuple(_at_the_door(each, said) for part in parts for each in part)
            yield whole.tagged(clauses=(*base, head, *own), leads=False)


def _condition_on(
    draft: Draft, said: Features
) -> tuple[tuple[Clause, ...], DoorReference | PlaceReference]:
    """What leads to a condition, and what it asks for."""
    if not said:
        raise UnsayableError
    room = draft.clauses[-1] if draft.clauses else None
    if said == FIRST and isinstance(room, GoToRoom):  # "to the kitchen, and if the door is closed"
        said = features({"kind": "room", "name": room.name})
    before, what = placed(said, draft)
    base = (*draft.clauses, *before)
    if isinstance(what, RoomReference):
        lead = GoToRoom(what.name, Approach.TO)
        last = base[-1] if base else None
        same = isinstance(last, GoToRoom) and last.name == what.name
        return (*(base[:-1] if same else base), lead), DoorReference()
    return base, what


def _at_the_door(clause: Clause, said: Features) -> Clause:
    """A clause in front of a room on whose door a condition was."""
    if isinstance(clause, GoToRoom) and dict(said).get("name") == clause.name:
        return GoToDoor(DoorReference(), clause.approach)
    return clause


def _is_next(door: Clause, following: Clause) -> bool:
    """Whether a door is the next one: closed doors do not count, so it is the first open one."""
    if not isinstance(door, GoToDoor) or not isinstance(following, GoToDoor):
        return False
    return door.door.ordinal == 1 and following.door.ordinal in (1, 2)


def _following(door: Clause, clause: Clause) -> Clause:
    """The clause for "the next" if a door is closed: behind the second door it is the third."""
    if not isinstance(door, GoToDoor) or not isinstance(clause, GoToDoor):
        return clause
    second, following = door.door, clause.door
    if following.ordinal == 1 and second.ordinal > 1 and following.side in (None, second.side):
        return replace(clause, door=DoorReference(second.ordinal + 1, second.side))
    return clause


def _else_without_if(draft: Draft, otherwise: Features | None) -> Iterator[Draft]:
    """What is done otherwise, if what was said before is not there."""
    before = draft.clauses[-1] if draft.clauses else None
    what = before.door if isinstance(before, GoToDoor) else getattr(before, "at", None)
    if otherwise is None or not isinstance(what, DoorReference | PlaceReference):
        yield draft.tagged("if:unsayable", unsayable=True)
        return
    for second in _extended(draft, otherwise):
        if len(second.clauses) == len(draft.clauses) + 1:
            clauses = (*draft.clauses[:-1], IfThere(what, False, True), before, second.clauses[-1])
            yield second.tagged("if:else alone", clauses=cast(Any, clauses))


# --- Frames -------------------------------------------------------------------------------------


def _extended(draft: Draft, bag: Features) -> Iterator[Draft]:
    """A draft with one more bag."""
    for cost, tags, variant in _variants(draft, bag):
        found = fitting(variant)
        for more, frame in found[:MOST_FRAMES]:
            if more <= found[0][0] + FRAME_RANGE:
                yield from _framed(draft.tagged(*tags, cost=cost + more), frame, variant)


def _variants(draft: Draft, bag: Features) -> Iterator[tuple[float, tuple[str, ...], Features]]:
    """A bag, and with what it leaves out taken from what was said before."""
    yield (0.3 if _may_share_side(draft, bag) else 0.0), (), bag
    angle = dict(bag).get("angle")
    if isinstance(angle, tuple) and dict(angle).get("n") == 180 and "side" not in dict(bag):
        turned = {name: value for name, value in bag if name != "angle"}
        yield -1.5, ("half turn",), features(turned | {"uturn": 1})
    passing = draft.clauses[-1:] and getattr(draft.clauses[-1], "past", False)
    if passing and len(bag) == 1 and bag[0][0].startswith("obj."):
        yield 0.4, ("ellipsis:pass",), features(dict(bag) | {"V": "pass"})
    last = dict(draft.last)
    for slot, value in bag:
        own = dict(value) if isinstance(value, tuple) else {}
        rest = {name: each for name, each in bag if name != slot}
        base = slot.partition(".")[0]
        if "sameside" in own and last.get("side"):
            own.pop("sameside")
            yield (
                0.0,
                ("same side",),
                features(rest | {slot: features(own | {"side": last["side"]})}),
            )
            continue
        if "ell" in own and last.get("kind") in ("place", "turn") and "name" not in last:
            taken = own | {"kind": last["kind"], "place": last["place"]}
            taken.pop("ell")
            if last["kind"] == "turn":
                taken.setdefault("side", last.get("side"))
            elif "side" in own:
                rest.setdefault("side", taken.pop("side"))
            rest[f"{base}.{last['kind']}"] = features(taken)
            yield 0.2, ("ellipsis:place",), features(rest)
        is_door = own.get("kind") == "door" and last.get("kind") == "door"
        sided = "side" in own or "side" in dict(bag)
        if is_door and not sided and last.get("side") in ("left", "right"):
            rest[slot] = features(own | {"side": last["side"]})
            yield (0.0 if "ell" in own else 0.6), ("ellipsis:side",), features(rest)


def _may_share_side(draft: Draft, bag: Features) -> bool:
    """Whether "the second" may be on the side of the door that was spoken of last."""
    if dict(draft.last).get("side") not in ("left", "right") or "side" in dict(bag):
        return False
    nouns = [dict(value) for _, value in bag if isinstance(value, tuple)]
    return any("ell" in own and "side" not in own for own in nouns)


def _framed(draft: Draft, frame: Frame, bag: Features) -> Iterator[Draft]:
    """A draft with the steps of a frame."""
    verb = dict(bag).get("V", "-")
    names = frame.parts or (frame.name,)
    draft = draft.tagged(*(f"F:{name}" for name in names), f"FV:{verb}:{names[-1]}")
    if "unsayable" in frame.steps:
        yield draft._replace(unsayable=True)
        return
    times = 2 if "twice" in dict(bag) and frame.steps[0].startswith("turn") else 1
    done = draft
    try:
        for step in frame.steps * times:
            done = _with_step(done, step, bag, frame.steps[0] == "turn around")
    except UnsayableError:
        yield draft.tagged("unsayable", unsayable=True)
        return
    except NoClauseError:
        return
    yield done
    if frame.steps[0] == "turn around" and len(frame.steps) > 1:
        yield from _turned_already(draft, done)
    yield from _counted_on(draft, done)
    yield from _named_twice(draft, done)


def _turned_already(before: Draft, done: Draft) -> Iterator[Draft]:
    """A way back behind a turn: "turn around and go back to the corner" has one turn."""
    at = len(before.clauses)
    if at and before.clauses[-1] == done.clauses[at]:
        yield done.tagged("turned already", clauses=(*before.clauses, *done.clauses[at + 1 :]))


def _with_step(draft: Draft, step: str, bag: Features, returning: bool) -> Draft:
    """A draft with the clauses of a step.

    Raises:
        UnsayableError: no clause says it.
    """
    values: dict[str, Any] = {}
    before: list[Clause] = []
    noun: Features = ()
    for word in step.replace("(", " ").replace(")", " ").split():
        if word[0] != "$":
            continue
        value = _value(word, draft, bag)
        name = word[1:].partition("/")[0]
        if name in MEASURES:
            values[word] = MEASURES[name](value)
        elif isinstance(value, tuple):
            if returning and dict(value).get("ord") == -1:
                value = features(dict(value) | {"ord": 1})  # "back to the last door"
            more, values[word] = placed(value, draft)
            before += more
            noun = value
        else:
            values[word] = value
    if step.startswith("note "):
        return draft._replace(last=noun, leads=False)
    clause = clause_of(step, values)
    if isinstance(clause, Follow) and getattr(clause.until, "side", None) in BEHIND:
        raise NoClauseError
    clauses = draft.clauses
    if "$last" in step:
        if not draft.last:
            if step.startswith("hallway"):
                raise NoClauseError
            draft = draft.tagged("no last")
        elif draft.leads and clauses and isinstance(clauses[-1], GoToDoor | GoToRoom):
            clauses = clauses[:-1]  # said again, and more exactly
    return draft._replace(
        clauses=(*clauses, *before, clause),
        last=_seen_from_there(noun) if noun else draft.last,
        leads=bool(noun),
        anew=False,
    )


BEHIND = ("behind", "opposite")
"""Sides of doors to which nobody follows a hallway."""

RELATIONS = frozenset(("after", "afterit", "before", "near", "opposite", "atend", "fromend"))


def _seen_from_there(noun: Features) -> Features:
    """A noun phrase without what led to it."""
    return tuple(pair for pair in noun if pair[0].partition(".")[0] not in RELATIONS)


MEASURES = {"dist": distance_of, "angle": degrees_of, "secs": seconds_of}
"""What makes a value of the slots that are no noun phrases."""


def _value(word: str, draft: Draft, bag: Features) -> Any:
    """What stands in a step: "$slot", "$slot.side" or "$slot/side"."""
    name, _, with_side = word[1:].partition("/")
    name, _, feature = name.partition(".")
    constants = {"end": END, "first": FIRST, "last": draft.last or FIRST}
    value = constants.get(name) or next(v for slot, v in bag if slot.partition(".")[0] == name)
    if feature:
        if feature not in dict(value):
            raise NoClauseError
        return dict(value)[feature]
    if with_side:
        if "side" in dict(value):
            raise NoClauseError
        return features(dict(value) | {"side": dict(bag)["side"]})
    return value


def placed(
    noun: Features, draft: Draft
) -> tuple[list[Clause], DoorReference | PlaceReference | RoomReference]:
    """The clauses that lead to where a noun phrase is counted from, and its reference there.

    Raises:
        UnsayableError: no clause says where it is.
    """
    own = dict(noun)
    before: list[Clause] = []
    if {"came", "sameside"} & own.keys():
        raise UnsayableError
    for name, value in noun:
        relation = name.partition(".")[0]
        if relation == "after":
            more, reference = placed(value, draft)
            before += [*more, _past(reference)]
        elif relation == "afterit":
            if not draft.last:
                raise NoClauseError
            before.append(_past(reference_of(draft.last)))
        elif relation == "opposite":
            more, reference = placed(value, draft)
            before += [*more, Follow(reference)]
            own["side"] = "opposite"
        elif relation == "before":
            if dict(value).get("place") not in HALLWAY_ENDS:
                raise UnsayableError
            own.setdefault("ord", -1)
        elif relation == "near":
            if dict(value).get("place") != "end":
                raise UnsayableError
            own["atend"] = 1
        elif relation == "fromend":
            own["ord"] = -own.get("ord", 1)
    if "atend" in own and own["kind"] == "door" and own.get("ord", 1) > 0:
        if "side" not in own:
            own["side"] = "ahead"
        elif own["side"] in ("left", "right"):
            own["ord"] = -1
    if before and before[-1:] == list(draft.clauses[-1:]):
        before.pop()  # "past the kitchen, then the door after it"
    return before, reference_of(features(own))


def _past(reference: DoorReference | PlaceReference | RoomReference) -> Follow:
    try:
        return Follow(reference, past=True)
    except ValueError:
        raise NoClauseError from None


def _counted_on(before: Draft, done: Draft) -> Iterator[Draft]:
    """A door or place that is counted from where the way to the one before it began."""
    if before.anew or not before.clauses or len(done.clauses) != len(before.clauses) + 1:
        return
    passed, clause = before.clauses[-1], done.clauses[-1]
    first = passed.until if isinstance(passed, Follow) else getattr(passed, "at", None)
    if not isinstance(first, DoorReference | PlaceReference) or isinstance(clause, IfThere):
        return
    for name in ("door", "until", "at"):
        second = getattr(clause, name, None)
        if not isinstance(second, type(first)) or not 0 < first.ordinal < second.ordinal:
            continue
        changes: dict[str, Any] = {"ordinal": second.ordinal - first.ordinal}
        if isinstance(first, DoorReference):
            if getattr(second, "side", None) not in (None, first.side):
                continue
            changes["side"] = first.side
        elif first.place != getattr(second, "place", None):
            continue
        counted = replace(cast(Any, clause), **{name: replace(cast(Any, second), **changes)})
        clauses = (*done.clauses[:-1], counted)
        yield done.tagged(
            "counted on",
            "counted on:turn" if isinstance(passed, Turn) else "counted on:way",
            cost=0.3,
            clauses=clauses,
        )


def _named_twice(before: Draft, done: Draft) -> Iterator[Draft]:
    """Of a destination that is named twice ("the kitchen, that's the third door") only the door."""
    if before.clauses and isinstance(before.clauses[-1], GoToRoom):
        added = done.clauses[len(before.clauses) :]
        if added and isinstance(added[-1], GoToDoor) and added[-1].approach is Approach.THROUGH:
            kept = before.clauses[-1].approach
            door = replace(added[-1], approach=kept)
            clauses = (*before.clauses[:-1], *added[:-1], door)
            yield done.tagged("named twice", cost=0.5, clauses=clauses)
