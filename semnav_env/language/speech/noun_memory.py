"""Remembers what was named, and says what "the next one" and "the one after that" stand for."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from semnav_env.language.references import Side
from semnav_env.language.speech.items import Noun

COUNTABLE = ("door", "room", "intersection", "corner", "t_junction", "turning")
"""Kinds of nouns that "the second" can stand for."""


@dataclass
class NounMemory:
    """What was named before.

    Attributes:
        last: the noun that was named last; None at the beginning.
        counts_on: "at the first crossing, ..., at the second one" is the next one.
        went_on: some noun could be counted on.
        passed: counted doors on both sides before one on a side, which may count those there alone:
            "pass two doors, then the third on the left"; with that side.
        told: how many were told one by one: "one door, another door".
        backwards: the next door is counted from the end.
        among: side of the doors of which one is chosen: "of the doors on the left, the third".
    """

    last: Noun | None = None
    counts_on: bool = False
    went_on: bool = False
    passed: dict[Noun, Side] = field(default_factory=dict)
    among: Side | None = None
    told: int = 0
    backwards: bool = False

    def remember(self, noun: object) -> None:
        """Note what a later noun can stand for."""
        if isinstance(noun, Noun) and noun.kind in COUNTABLE:
            again = self.last is not None and noun.kind == self.last.kind and not noun.definite
            single = noun.ordinal in (None, 1) and (not noun.definite or noun.counted)
            self.told = self.told + 1 if again and single else int(single)
            self.last = noun

    def names_door(self) -> bool:
        """Whether a certain door was named last, which "the door" can stand for."""
        last = self.last
        certain = last is not None and (last.ordinal is not None or last.side is not None)
        return certain and last is not None and last.kind in ("door", "room")

    def chosen(self, adjective: str) -> int | None:
        """The ordinal of "the middle one" or "the last one" of several that were named."""
        if self.last is None or not self.last.counted or not self.last.ordinal:
            return None
        return {"last": self.last.ordinal, "middle": (self.last.ordinal + 1) // 2}.get(adjective)

    def resolved(self, noun: Noun) -> Noun:
        """The noun with the kind and the ordinal that it stands for."""
        if self.backwards and noun.ordinal is not None and noun.ordinal > 0:
            self.backwards = False
            return replace(noun, ordinal=-noun.ordinal)
        noun = self._counted_on(self._chosen_among(noun))
        if self._goes_on(noun):
            self.went_on = True
            noun = replace(noun, ordinal=1) if self.counts_on else noun
        if noun.kind == "one" and self.last is None and not noun.elliptic:
            noun = replace(noun, kind="door")
        if noun.kind == "one" and self.last is not None:
            kind = self.last.kind
            noun = replace(noun, kind=kind)
            if noun.relative:
                noun = self._following(noun)
            elif noun.side is None and kind in ("door", "room", "turning") and noun.ordinal:
                noun = replace(noun, side=self.last.side)
        return noun

    def _chosen_among(self, noun: Noun) -> Noun:
        """Of "Of the doors on the left, the third": on the left."""
        if self.among is None or noun.kind not in ("door", "room", "one") or noun.side is not None:
            return noun
        kind = "door" if noun.kind == "one" else noun.kind
        return replace(noun, kind=kind, side=self.among, elliptic=False)

    def _counted_on(self, noun: Noun) -> Noun:
        """Of "The fourth door" after "past three doors" is the next one."""
        last = self.last
        one_by_one = last is not None and self.told > 1 and noun.kind in ("one", last.kind)
        if one_by_one and noun.ordinal == self.told + 1 and not noun.counted:
            return replace(noun, ordinal=1)
        if last is None or not last.counted or last.ordinal is None or noun.counted:
            return noun
        same = (noun.kind in ("one", last.kind) and last.side in (None, noun.side)) or noun.elliptic
        if same and noun.ordinal == last.ordinal + 1:
            if last.side is None and noun.side is not None and last.kind in ("door", "room"):
                self.passed[last] = noun.side
            return replace(noun, ordinal=1, side=noun.side or last.side)
        return noun

    def _goes_on(self, noun: Noun) -> bool:
        """Whether a noun is the next of the places that are being counted: "the second one"."""
        last = self.last
        if last is None or not last.ordinal:
            return False
        if last.kind not in ("intersection", "corner") and (
            last.kind not in ("door", "room") or last.side is not None
        ):
            return False
        named = noun.kind == "one" or noun.elliptic
        return named and not last.counted and noun.ordinal == last.ordinal + 1 > 1

    def _following(self, noun: Noun) -> Noun:
        """The next one of the kind that was named last."""
        assert self.last is not None
        before = self.last.ordinal or 1
        return replace(
            noun, ordinal=before + 1 if before > 0 else None, side=noun.side or self.last.side
        )
