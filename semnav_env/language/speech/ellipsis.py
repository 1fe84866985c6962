"""Says in full what a speaker leaves out: a verb, a side, from where the next one is counted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from semnav_env.language.speech.items import JOINTS, Item, ItemKind, Noun


def in_full(items: Sequence[Item]) -> list[Item]:
    """The items with what was left out."""
    found = _keeping_sides(_without_broken_commas(_with_otherwise(items)))
    found = _without_repetition(_with_one_way_out(_with_doors(found)))
    found = _with_verbs(_passed_one_by_one(_straight_over(found)))
    found = _with_sides(_with_side_told_apart(found))
    return _counted_from_passed(_without_counting(found))


def _without_broken_commas(items: Sequence[Item]) -> list[Item]:
    """Of "Go, uh, two doors down": nothing is parted after a bare "go"."""
    found: list[Item] = []
    for item in items:
        bare = bool(found) and found[-1].kind is ItemKind.VERB and found[-1].value == "go"
        begins = len(found) < 2 or found[-2].kind in _PARTS or found[-2].value == "be"
        if item.value == "," and bare and begins:
            continue
        found.append(item)
    return found


def _with_otherwise(items: Sequence[Item]) -> list[Item]:
    """Of "If it is open, go in; if it is closed, go on": the other case of the condition."""
    found: list[Item] = []
    state = ""
    for item in items:
        if item.kind is ItemKind.IF:
            again = item.value.noun is None and state and item.value.state
            if again and item.value.state != state:
                item = Item(ItemKind.OTHERWISE, item.start, item.stop)
            else:
                state = item.value.state
        found.append(item)
    return found


def _keeping_sides(items: Sequence[Item]) -> list[Item]:
    """Of "Rechts halten": a verb that stops or keeps to a side turns behind a side."""
    found: list[Item] = []
    for item in items:
        keeps = item.kind is ItemKind.VERB and item.value == "stop keep"
        sided = bool(found) and found[-1].kind is ItemKind.SIDE
        found.append(replace(item, value="turn") if keeps and sided else item)
    return found


def _with_one_way_out(items: Sequence[Item]) -> list[Item]:
    """Of "Get out of here, out of this room": one goes out once."""
    found: list[Item] = []
    segment: list[Item] = []
    left = False
    for item in [*items, None]:
        if item is not None and item.kind is not ItemKind.SIGN:
            segment.append(item)
            continue
        again = left and bool(segment) and all(map(_only_leads_out, segment))
        left = any(each.kind is ItemKind.OUT or each.value in _LEAVING for each in segment)
        found += [] if again else segment
        found += [] if item is None else [item]
        segment = []
    return found


_LEAVING = ("leave", "exit")


def _only_leads_out(item: Item) -> bool:
    noun = _noun(item)
    hall = noun is not None and noun.kind == "hall" and bool(set(item.roles) & {"to", "into"})
    return item.kind is ItemKind.OUT or hall or (noun is not None and "out" in item.roles)


def _without_repetition(items: Sequence[Item]) -> list[Item]:
    """Of "To the third door, yeah, the third": the noun is said again."""
    found: list[Item] = []
    for item in items:
        before = found[-1] if found else None
        noun = _noun(item)
        again = noun is not None and noun.elliptic and not item.roles and before is not None
        if again and before is not None and noun is not None:
            same = _noun(before)
            if same is not None and same.ordinal == noun.ordinal and same.ordinal is not None:
                continue
        if (at := _said_before(found, item)) is not None:
            found = found[:at]
        found.append(item)
    return found


def _said_before(found: Sequence[Item], item: Item) -> int | None:
    """Where a room was named alone before it is named again: "past the lab, yes, past the lab"."""
    noun = _noun(item)
    at = len(found)
    while at and (found[at - 1].kind is ItemKind.SIGN or found[at - 1].value == "go"):
        at -= 1
    before = _noun(found[at - 1]) if at and at < len(found) else None
    if before is None or noun is None or noun.kind != "named" or before.name != noun.name:
        return None
    alone = at < 2 or found[at - 2].kind in _PARTS
    return at - 1 if alone and found[at - 1].roles in (item.roles, ()) else None


def _with_doors(items: Sequence[Item]) -> list[Item]:
    """Of "Left at the crossing, then it's the second on the right": a door, and no crossing."""
    found: list[Item] = []
    for item in items:
        noun = _noun(item)
        stated = bool(found) and found[-1].kind is ItemKind.VERB and found[-1].value == "be"
        if stated and noun is not None and noun.elliptic and noun.side is not None:
            item = replace(item, value=replace(noun, kind="door"))
        found.append(item)
    return found


_PARTS = (*JOINTS, ItemKind.BUT)


def _passed_one_by_one(items: Sequence[Item]) -> list[Item]:
    """Of "A crossing, then another crossing, and right at the third": the first ones are passed."""
    told = [
        index
        for index, item in enumerate(items)
        if (noun := _noun(item)) is not None
        and noun.kind in ("intersection", "door")
        and (not noun.definite or (noun.counted and noun.ordinal == 1))
        and not item.roles
        and _stands_alone(items, index)
    ]
    later = [n for item in items[told[-1] + 1 :] if (n := _noun(item))] if told else []
    same = [n for n in later if told and n.kind == items[told[0]].value.kind]
    if len(told) < 2 or not same:
        return list(items)
    return [
        replace(item, roles=("past",)) if index in told else item
        for index, item in enumerate(items)
    ]


def _straight_over(items: Sequence[Item]) -> list[Item]:
    """Of "A crossing, straight over it": past the crossing."""
    found: list[Item] = []
    for index, item in enumerate(items):
        place = next(
            (i for i in reversed(range(len(found))) if found[i].kind not in _BETWEEN), None
        )
        noun = _noun(found[place]) if place is not None else None
        over = item.kind is ItemKind.STRAIGHT and noun is not None and noun.kind == "intersection"
        ends = index + 1 < len(items) and items[index + 1].kind in (*_PARTS, ItemKind.PARTICLE)
        parted = place is not None and place < len(found) - 1
        if over and ends and parted and place is not None and not found[place].roles:
            found[place:] = [replace(found[place], roles=("past",))]
            continue
        found.append(item)
    return found


_BETWEEN = (ItemKind.SIGN, ItemKind.HERE)


def _stands_alone(items: Sequence[Item], index: int) -> bool:
    """Whether a noun stands between joints, without a verb."""
    before = index == 0 or items[index - 1].kind in _PARTS
    return before and (index + 1 == len(items) or items[index + 1].kind in _PARTS)


def _with_verbs(items: Sequence[Item]) -> list[Item]:
    """Of "Pass one door on the right, then one on the left": passed, too."""
    found: list[Item] = []
    passes = False
    for index, item in enumerate(items):
        if item.kind is ItemKind.VERB:
            passes = item.value == "pass"
        alone = index > 0 and items[index - 1].kind in _PARTS
        ends = index + 1 == len(items) or items[index + 1].kind in _PARTS
        noun = _noun(item)
        gapped = passes and alone and ends and noun is not None and not item.roles
        indefinite = noun is not None and (not noun.definite or noun.counted)
        found.append(replace(item, roles=("past",)) if gapped and indefinite else item)
    return found


def _with_side_told_apart(items: Sequence[Item]) -> list[Item]:
    """Of "Right side, last door" and "the third door, on the left side, ...": the door's side."""
    found = list(items)
    for at, item in enumerate(items):
        if item.kind is not ItemKind.SIDE or "on" not in item.roles:
            continue
        alone = at + 1 < len(items) and items[at + 1].value == "," and at in (0, 1)
        if alone and at + 2 < len(items) and _is_sideless_door(items[at + 2]):
            noun = replace(items[at + 2].value, side=item.value)
            return [*items[:at], replace(items[at + 2], value=noun), *items[at + 3 :]]
    return found


def _is_sideless_door(item: Item) -> bool:
    noun = _noun(item)
    return noun is not None and noun.kind in ("door", "room", "one") and noun.side is None


def _with_sides(items: Sequence[Item]) -> list[Item]:
    """Of "On the left there are three doors, take the second": on the left."""
    found: list[Item] = []
    side = None
    for index, item in enumerate(items):
        noun = _noun(item)
        beside = [each for each in items[max(0, index - 2) : index] if each.kind is ItemKind.SIDE]
        stated = any(
            each.kind is ItemKind.VERB and each.value == "be"
            for each in items[max(0, index - 2) : index]
        )
        if noun is not None and noun.counted and stated and noun.side is None and beside:
            side = beside[-1].value
        elif noun is not None and side is not None and noun.elliptic and noun.side is None:
            item = replace(item, value=replace(noun, side=side))
        found.append(item)
    return found


def _without_counting(items: Sequence[Item]) -> list[Item]:
    """Of "Count four doors and take the fourth": counting is no way to go."""
    for index, item in enumerate(items):
        noun = _noun(item)
        counts = index > 0 and items[index - 1].kind is ItemKind.VERB
        alone = index == 0 and len(items) > 1 and items[1].kind is ItemKind.SIGN
        told = counts and items[index - 1].value == "count"
        if noun is None or not noun.counted or not (told or (alone and not item.roles)):
            continue
        later = next((n for n in map(_noun, items[index + 1 :]) if n is not None), None)
        if later is not None and later.ordinal == noun.ordinal:
            return [*items[: max(0, index - 1)], *items[index + 1 :]]
    return list(items)


def _counted_from_passed(items: Sequence[Item]) -> list[Item]:
    """Of "Past the door, and then the one after it": counted from behind the door."""
    found: list[Item] = []
    passed: Noun | None = None
    verb = ""
    for item in items:
        noun = _noun(item)
        if item.kind is ItemKind.VERB:
            verb = item.value
        if noun is not None and noun.kind not in ("hall", "it"):
            same = passed is not None and passed.kind == noun.kind
            if noun.relative and same:
                noun = replace(noun, ordinal=1, relative=False)
                item = replace(item, value=noun)
            goes_by = verb == "pass" and not set(item.roles) & {"to", "into", "at"}
            past = set(item.roles) & {"past"} and "at" not in item.roles
            passed = noun if past or goes_by else None
        found.append(item)
    return found


def _noun(item: Item) -> Noun | None:
    return item.value if item.kind is ItemKind.REF and isinstance(item.value, Noun) else None
