"""Edits between bags: corrections, denials, what comes before, and what depends on a condition."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from studies.chart_reader.beam import Entry
from studies.chart_reader.features import Features, features
from studies.chart_reader.frames import fitting


class Edited(NamedTuple):
    """Bags in the order in which they are carried out.

    Attributes:
        cost: of the edits.
        bags: those that are left, with marks that they need ("else", "any", "from there").
        tags: of the edits.
        unsayable: whether no command says it.
        held: what comes behind the next bag.
    """

    cost: float
    bags: tuple[Entry, ...]
    tags: tuple[str, ...]
    unsayable: bool = False
    held: Features = ()


MOST_EDITED = 6
"""The most ways to edit that are followed."""

Edit = Callable[[Edited, Features], Iterator[Edited]]


def edited(entries: tuple[Entry, ...]) -> list[Edited]:
    """The ways to apply the marks between bags, the cheapest first."""
    found = [Edited(0.0, (), ())]
    mark, denied = "", None
    for entry in entries:
        if isinstance(entry, str):
            if entry in ("else", "any", "from there"):
                found = [e._replace(bags=(*e.bags, entry)) for e in found]
            elif mark in ("", "but") or entry == "not":
                mark = entry
            continue
        if mark == "not":
            found = [each for e in found for each in _deny(e, entry)]
            mark, denied = "denied", entry
            continue
        edit = EDITS[mark]
        if mark == "denied" or (mark == "but" and denied is not None):
            found = [each for e in found for each in _after_denial(e, denied or (), entry)]
        else:
            found = [each for e in found for each in edit(e, entry)]
        if mark != "later":
            found = [e._replace(bags=(*e.bags, e.held), held=()) if e.held else e for e in found]
        mark, denied = "", None
        found = sorted(found, key=lambda e: e.cost)[:MOST_EDITED]
    return [e._replace(bags=(*e.bags, e.held)) if e.held else e for e in found]


def _add(so_far: Edited, bag: Features) -> Iterator[Edited]:
    yield so_far._replace(bags=(*so_far.bags, bag))


def _with(so_far: Edited, bags: tuple[Entry, ...], cost: float, tag: str) -> Edited:
    return so_far._replace(cost=so_far.cost + cost, bags=bags, tags=(*so_far.tags, f"edit:{tag}"))


def _correct(so_far: Edited, bag: Features) -> Iterator[Edited]:
    """What is said after "no" takes the place of the bag before it, or of a part of it."""
    if not so_far.bags or isinstance(so_far.bags[-1], str):
        yield _with(so_far, (*so_far.bags, bag), 0.2, "no at the beginning")
        return
    before = so_far.bags[-1]
    changed = replaced(before, bag)
    if changed is not None:
        yield _with(so_far, (*so_far.bags[:-1], changed), 0.0, "part corrected")
    if fitting(bag):
        cost = 0.3 if "V" in dict(bag) else 0.9
        kept = (*so_far.bags[:-1], *_topic_of(before), bag)
        tag = "corrected" if _topic_of(bag) else "corrected, same thing"
        yield _with(so_far, (*so_far.bags[:-1], bag) if _topic_of(bag) else kept, cost, tag)
        yield _with(so_far, (*so_far.bags, bag), 1.5, "no for nothing")
    if len(so_far.bags) > 1 and not isinstance(so_far.bags[-2], str):
        earlier = replaced(so_far.bags[-2], bag)
        if earlier is not None and changed is None:
            bags = (*so_far.bags[:-2], earlier, before)
            yield _with(so_far, bags, 1.2, "earlier part corrected")


def _deny(so_far: Edited, bag: Features) -> Iterator[Edited]:
    if so_far.bags and not isinstance(so_far.bags[-1], str):
        before = so_far._replace(bags=so_far.bags[:-1])
        for each in _after_denial(before, so_far.bags[-1], bag):
            yield each._replace(cost=each.cost + 0.5, tags=(*each.tags, "edit:denied before"))
    topic = _topic_of(bag)
    yield _with(so_far, (*so_far.bags, *topic), 0.1, "denied")
    if not topic:
        return
    noun = topic[0][0][1]
    passed = features({"V": "pass", f"obj.{dict(noun)['kind']}": noun})
    yield _with(so_far, (*so_far.bags, passed), 1.0, "denied and passed")


def _topic_of(bag: Features) -> tuple[Features, ...]:
    """A bag that only speaks of what another one is about, if it is about something."""
    noun = next((v for slot, v in bag if isinstance(v, tuple) and "kind" in dict(v)), None)
    return () if noun is None else (((f"topic.{dict(noun)['kind']}", noun),),)


def _after_denial(so_far: Edited, denied: Features, bag: Features) -> Iterator[Edited]:
    """What is said behind "not the first": instead of it, or anew."""
    bag = _counted_from(denied, bag)
    changed = replaced(denied, bag)
    if changed is not None and "V" not in dict(bag):
        yield _with(so_far, (*so_far.bags, changed), 0.0, "instead of it")
    earlier = [index for index, each in enumerate(so_far.bags) if each[0][0][:5] != "topic"]
    index = earlier[-1] if earlier else -1
    whole = so_far.bags[index] if earlier else ""
    if not isinstance(whole, str):
        before = replaced(whole, bag)
        if before is not None:
            bags = (*so_far.bags[:index], before, *so_far.bags[index + 1 :])
            yield _with(so_far, bags, 0.6, "instead of that")
    if fitting(bag):
        yield _with(so_far, (*so_far.bags, bag), 0.3, "anew")


def _counted_from(denied: Features, bag: Features) -> Features:
    """What is said behind "not the first" with "the next" or "the one after it" as the second."""
    old = next((dict(v) for _, v in denied if isinstance(v, tuple) and "kind" in dict(v)), None)
    found = dict(bag)
    for slot, value in bag if old else ():
        own = dict(value) if isinstance(value, tuple) else {}
        if old and {"nxt", "afterit"} & own.keys() and own.get("ord", 1) == 1:
            kept = {name: each for name, each in own.items() if name not in ("nxt", "afterit")}
            found[slot] = features(kept | {"ord": old.get("ord", 1) + 1})
    return features(found)


def _before(so_far: Edited, bag: Features) -> Iterator[Edited]:
    yield _with(so_far, (*so_far.bags[:-1], bag, *so_far.bags[-1:]), 0.0, "before")


def _later(so_far: Edited, bag: Features) -> Iterator[Edited]:
    """What is said behind "before you": at the beginning it waits for the next bag."""
    if so_far.bags:
        yield _with(so_far, (*so_far.bags, bag), 0.0, "later")
    else:
        yield _with(so_far, (), 0.0, "later first")._replace(held=bag)


def _choice(so_far: Edited, bag: Features) -> Iterator[Edited]:
    yield _with(so_far, (*so_far.bags, bag), 0.0, "choice")._replace(unsayable=True)
    for each in _correct(so_far, bag):
        yield each._replace(cost=each.cost + 2.0)


EDITS: dict[str, Edit] = {
    "": _add,
    "but": _add,
    "no": _correct,
    "denied": _add,
    "before": _before,
    "later": _later,
    "or": _choice,
}
"""What each mark does with the bag behind it."""


def replaced(old: Features, new: Features) -> Features | None:
    """A bag with what another one says in the place of what it said; None if nothing fits."""
    values: dict[str, Any] = dict(old)
    if "V" in dict(new) and dict(new)["V"] != values.get("V", dict(new)["V"]):
        return None
    changed = False
    for name, value in new:
        if name == "V":
            continue
        slot = _same_slot(values, name, value)
        if slot is None:
            if name == "side" and (noun := _noun_with(values, "side")):
                values[noun] = features(dict(values[noun]) | {"side": value})
            elif name == "num" and (number := _noun_with(values, "n")):
                values[number] = features(dict(values[number]) | {"n": dict(value)["n"]})
            elif isinstance(value, tuple) or name in ("side", "in", "here", "str", "frontit"):
                if name in ("side",) or isinstance(value, tuple):
                    return None
                values[name] = value
            else:
                return None
            changed = True
            continue
        old_value = values.pop(slot)
        if isinstance(value, tuple) and isinstance(old_value, tuple):
            own = dict(value)
            if "ell" in own:
                kept = {k: v for k, v in dict(old_value).items() if k not in ("nxt", "bare")}
                own = kept | {k: v for k, v in own.items() if k not in ("ell", "kind")}
                name = slot
            elif name.partition(".")[0] in ("obj", "be"):
                name = f"{slot.partition('.')[0]}.{own['kind']}" if "kind" in own else name
            value = features(own)
        values[name] = value
        changed = True
    return features(values) if changed else None


def _same_slot(values: dict[str, Any], name: str, value: Any) -> str | None:
    """The slot that another one takes the place of."""
    if name in values:
        return name
    base, _, kind = name.partition(".")
    same = [slot for slot in values if slot.partition(".")[0] == base]
    if same:
        return same[0]
    if not kind:
        return None
    nouns = [slot for slot, v in values.items() if isinstance(v, tuple) and "." in slot]
    if base in ("obj", "be"):
        of_kind = [slot for slot in nouns if slot.partition(".")[2] == kind]
        ell = isinstance(value, tuple) and "ell" in dict(value)
        fitting_nouns = of_kind or (nouns if ell or len(nouns) == 1 else [])
        return fitting_nouns[-1] if fitting_nouns else None
    return nouns[-1] if len(nouns) == 1 else None


def _noun_with(values: dict[str, Any], feature: str) -> str | None:
    found = [s for s, v in values.items() if isinstance(v, tuple) and feature in dict(v)]
    return found[-1] if found else None
