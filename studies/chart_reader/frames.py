"""Frames: which verbs and slots make which clauses, read from a table."""

from __future__ import annotations

import re
from collections import defaultdict
from dataclasses import dataclass, replace
from functools import cache, lru_cache

from studies.chart_reader.features import Features
from studies.chart_reader.lexicon import table_rows

LIGHT = frozenset(("str", "along", "here", "it", "sameside", "twice"))
"""Slots that a frame leaves unread if it must, at a cost."""

UNREAD_COST = 0.5


@dataclass(frozen=True)
class NeededSlot:
    """A slot that a frame needs.

    Attributes:
        name: the slot, with its kind or without.
        having: features that what fills it must have.
        lacking: those that it must not have.
    """

    name: str
    having: frozenset[str] = frozenset()
    lacking: frozenset[str] = frozenset()

    def filled_by(self, bag: Features) -> str | None:
        """The slot of a bag that fills it; None if there is none."""
        for slot, value in bag:
            if slot == self.name or slot.partition(".")[0] == self.name:
                found = {name for name, _ in value} if isinstance(value, tuple) else set()
                if self.having <= found and not self.lacking & found:
                    return slot
        return None


@dataclass(frozen=True, eq=False)
class Frame:
    """A row of the table; see its head.

    Attributes:
        needs: the slots that must be filled.
        may: those that may be.
        steps: what it says, in the notation of docs/meanings.md.
        cost: how unlikely it is.
        name: it in few words.
    """

    needs: tuple[NeededSlot, ...]
    may: frozenset[str]
    steps: tuple[str, ...]
    cost: float
    name: str
    parts: tuple[str, ...] = ()


@cache
def frames_by_verb() -> dict[str, tuple[Frame, ...]]:
    """The frames of the table by their verbs; "-" is no verb."""
    found: defaultdict[str, list[Frame]] = defaultdict(list)
    for line in table_rows("frames.txt"):
        verbs, needs, may, steps, cost = (part.strip() for part in line.split(" |"))
        slots = tuple(map(_needed, needs.split()))
        parts = tuple(step.strip() for step in steps.split(";"))
        frame = Frame(slots, frozenset(may.split()), parts, float(cost), f"{needs}>{steps}")
        for verb in verbs.split(","):
            found[verb].append(frame)
    return {verb: tuple(rows) for verb, rows in found.items()}


def _needed(text: str) -> NeededSlot:
    having, lacking = re.findall(r"\+(\w+)", text), re.findall(r"-(\w+)", text)
    return NeededSlot(re.split("[+-]", text)[0], frozenset(having), frozenset(lacking))


@lru_cache(maxsize=20_000)
def fitting(bag: Features) -> tuple[tuple[float, Frame], ...]:
    """The frames that take all slots of a bag, with their costs, the cheapest first."""
    found = list(_direct(bag))
    for prefix in frames_by_verb()["+"]:
        slot = prefix.needs[0].filled_by(bag)
        rest = tuple(pair for pair in bag if pair[0] != slot)
        if slot is not None and {name for name, _ in rest} - LIGHT - {"V"}:
            for cost, frame in _direct(rest):
                steps, name = prefix.steps + frame.steps, f"{prefix.name}+{frame.name}"
                both = replace(frame, steps=steps, name=name, parts=(prefix.name, frame.name))
                found.append((cost + prefix.cost, both))
    return tuple(sorted(found, key=lambda pair: pair[0]))


@lru_cache(maxsize=20_000)
def _direct(bag: Features) -> tuple[tuple[float, Frame], ...]:
    slots = {slot for slot, _ in bag if slot != "V"}
    verb = dict(bag).get("V", "-")
    found = []
    for frame in frames_by_verb().get(verb, ()):
        filled = [need.filled_by(bag) for need in frame.needs]
        if None in filled:
            continue
        rest = slots - set(filled)
        unread = rest - frame.may
        if unread <= LIGHT:
            found.append((frame.cost + UNREAD_COST * len(unread), frame))
    return tuple(found)
