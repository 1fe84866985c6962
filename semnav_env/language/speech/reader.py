"""Reads the items of a text: at each word the longest that fits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from semnav_env.language.references import Side
from semnav_env.language.speech.conditions import read_condition
from semnav_env.language.speech.facing import read_facing
from semnav_env.language.speech.item_words import SIGNS, ItemWords
from semnav_env.language.speech.items import JOINTS, Item, ItemKind, Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.nouns import NounReader
from semnav_env.language.speech.numerals import read_number

PLAIN_CLASSES = (
    *(
        "otherwise",
        "in any case",
        "from there",
        "instead of",
        "but",
        "no",
        "not",
        "or",
        "could you",
    ),
    *("before that", "before doing", "after doing"),
    *(
        "then",
        "and",
        "around alone",
        "to end",
        "out",
        "in",
        "be",
        "verb",
        "straight",
        "back",
        "around",
    ),
    *("here", "twice", "particle", "too far", "before it", "slight"),
)
"""Classes whose phrases are items by themselves; of two that are equally long the earlier one."""

KIND_OF_CLASS = {"around alone": ItemKind.AROUND, "end until": ItemKind.TO_END}

MAX_FIRST_THEN = 2
"""The most words of "then" at the beginning of a text; "when you come out" is a clause there."""

WITH_ARTICLE = frozenset({"zur", "zum", "im", "am", "ins", "ans", "beim", "vom", "vors", "durchs"})
"""German prepositions that hold an article."""


class ItemReader(ItemWords):
    """Reads a text from left to right.

    Args:
        words: of the text.
        lexicon: of its language.
        names: the words of each room's name, and the name.
        exact: "right" before a preposition means exactly: "right after the door".
        waits: "wait" is a command and not a correction.
    """

    def __init__(
        self,
        words: Sequence[str],
        lexicon: SpeechLexicon,
        names: Mapping[tuple[str, ...], str],
        exact: bool = True,
        waits: bool = True,
    ) -> None:
        self.words, self.lexicon = words, lexicon
        self.nouns = NounReader(words, lexicon, names)
        self.exact, self.waits = exact, waits

    def items(self) -> list[Item]:
        """All items of the text."""
        found: list[Item] = []
        opens = self.exact and list(self.words[:2]) == ["right", ","]
        at = 2 if opens else 0  # "right, so ..." is no turn
        while at < len(self.words):
            if self.lexicon.find(self.words, at, "purpose"):
                at = self._end_of_remark(at)
                continue
            if (told := self._choice_among(at) or self._place_of_speaker(at)) is not None:
                at = told
                continue
            item = self._item(at, found)
            if item is None:
                stop = self._filler(at) or self._skipped(at) or self._no_correction(at)
                if stop is None:
                    found.append(Item(ItemKind.UNKNOWN, at, at + 1, self.words[at]))
                at = stop or at + 1
                while (
                    stop
                    and at < len(self.words)
                    and self.words[at] == ","
                    and self._filler(stop - 1) is None
                ):
                    at += 1
                continue
            found.append(item)
            at = item.stop
        return found

    def _item(self, at: int, before: Sequence[Item]) -> Item | None:
        if self.words[at] in SIGNS and not self._has_phrase(at):
            return Item(ItemKind.SIGN, at, at + 1, self.words[at])
        best: Item | None = None
        for item in self._candidates(at, before):
            if best is None or item.stop > best.stop:
                best = item
        filler = self._filler(at)
        if best is None and filler is None and self.words[at] in SIGNS:
            best = Item(ItemKind.SIGN, at, at + 1, self.words[at])
        if best is not None and filler is not None and filler > best.stop:
            best = None
        if best is not None:
            noun = best.value.noun if best.kind is ItemKind.IF else best.value
            self.nouns.memory.remember(noun)
        return best

    def _candidates(self, at: int, before: Sequence[Item]) -> Iterator[Item]:
        yield from self._amounts(at, before)
        yield from self._plain(at, before)
        condition = read_condition(self.words, at, self.lexicon, self.nouns)
        if condition is not None:
            yield condition
        if (faced := read_facing(self.words, at, self.lexicon, self.nouns)) is not None:
            yield faced
        yield from self._nouns(at, before)
        last = before[-1] if before else None
        after_door = last is not None and last.kind is ItemKind.REF and last.value.kind == "door"
        if not (after_door and self.nouns._is_exactly(at)):
            yield from self._sides(at)
        number = read_number(self.words, at, self.lexicon)
        if number and _corrects_number(before):
            yield Item(ItemKind.DISTANCE, at, number[1], number[0])

    def _plain(self, at: int, before: Sequence[Item]) -> Iterator[Item]:
        found = sorted(
            self.lexicon.matches(self.words, at), key=lambda m: (-m[2], m[1] in ("reach", "find"))
        )
        for kind in PLAIN_CLASSES:
            for name, value, stop in found:
                name = "to end" if name == "end until" else name
                if name != kind or (kind == "no" and self._is_no_correction(at, stop)):
                    continue
                if kind == "then" and not before and stop - at > MAX_FIRST_THEN:
                    continue
                first = self.lexicon.find(self.words, at, "after doing")
                ends = stop >= len(self.words) - 1
                if kind == "then" and ends and first is not None and first[1] > at + 1:
                    continue  # "turn right after you've left the room" says what is done first
                if kind in ("before doing", "after doing") and not self._begins_clause(at, stop):
                    continue
                if kind in ("in", "out", "before it") and self._begins_noun(stop):
                    continue
                stops = (
                    bool(before)
                    and before[-1].kind is ItemKind.VERB
                    and before[-1].value in ("stop", "wait", "stop keep")
                )
                if kind == "out" and stops:
                    continue
                if (
                    kind == "verb"
                    and "keep" in value
                    and not self.waits
                    and self._filler(at)
                    and before
                    and before[-1].kind not in (ItemKind.SIGN, ItemKind.AND, ItemKind.THEN)
                ):
                    continue
                turns = bool(before) and before[-1].value in ("turn", "make")
                if kind == "here" and self.words[at] == "right" and turns:
                    continue
                if kind == "here" and self.words[at] == "right" and not self.exact:
                    continue
                if kind == "around alone" and self._is_corner(stop):
                    continue
                if kind == "around alone":
                    yield Item(ItemKind.AROUND, at, stop, kind)
                elif kind == "be":
                    yield Item(ItemKind.VERB, at, stop, kind)
                elif kind == "then" and self.lexicon.find(self.words, at, "and"):
                    yield Item(ItemKind.THEN, at, stop, "and then")
                else:
                    yield Item(ItemKind(kind), at, stop, value)
                break
        once = self.lexicon.find(self.words, at, "once")
        if once and (not before or before[-1].kind in (*JOINTS, ItemKind.BUT)):
            yield Item(ItemKind.THEN, at, once[1], "once")
        if (where := self.lexicon.find(self.words, at, "start where")) is not None:
            yield Item(ItemKind.REF, at, where[1], Noun("start"))

    def _nouns(self, at: int, before: Sequence[Item]) -> Iterator[Item]:
        """Nouns with and without a preposition."""
        if noun := self.nouns.read(at):
            begins = ("at",) if self.lexicon.find(self.words, at, "clause start") else ()
            yield Item(ItemKind.REF, at, noun[1], noun[0], begins)
        elif it := self.lexicon.find(self.words, at, "it alone"):
            yield Item(ItemKind.REF, at, it[1], Noun("it"))
        for role in ("past", "after"):
            if it := self.lexicon.find(self.words, at, f"{role} it"):
                yield Item(ItemKind.REF, at, it[1], Noun("it"), (role,))
        stops: dict[int, list[str]] = {}
        for kind, value, stop in self.lexicon.matches(self.words, at):
            if kind == "prep" and self._is_preposition(at, value, before):
                stops.setdefault(stop, []).append(value)
            if kind == "when":
                stops.setdefault(stop, []).append("when")
        for stop, roles in stops.items():
            inner, more = stop, list(roles)
            if "when" in roles or "until" in roles:
                inner, more = self._inner_preposition(stop, roles)
            has_article = self.words[inner - 1] in WITH_ARTICLE
            noun = self._its_door(inner) or self.nouns.read(inner, has_article) or self._it(inner)
            if noun is None:
                continue
            behind = self._behind_clause(noun[1], roles)
            if behind is None:
                continue
            end, past = behind
            if "when" in roles and noun[0].counted and noun[0].side is Side.BEHIND:
                noun, past = (replace(noun[0], side=None), noun[1]), True
            if "when" in roles:
                more = ["after"] if past else ["at", "when"]
            elif past:
                more = ["past"]
            yield Item(ItemKind.REF, at, end, noun[0], tuple(more))
            if "between" in roles and (second := self._second(end)):
                first = noun[0]
                if first.elliptic:  # "between the first and second door"
                    first = replace(first, kind=second[0].kind, elliptic=False)
                yield Item(ItemKind.REF, at, second[1], first, ("between",))
            return

    def _is_preposition(self, at: int, value: str, before: Sequence[Item]) -> bool:
        """Whether a phrase that may begin with the side "right" is a preposition here."""
        if not self._may_be_side(at):
            return True
        last = before[-1] if before else None
        turns = last is not None and last.kind is ItemKind.VERB and last.value in ("turn", "make")
        if value == "at" and (
            last is None or (last.kind is not ItemKind.REF and last.value != "stop")
        ):
            return False
        return self.exact and not turns

    def _sides(self, at: int) -> Iterator[Item]:
        """A side by itself: "left", "to the left", "on your right-hand side"."""
        here = at
        stops = {here} | {
            stop
            for kind, value, stop in self.lexicon.matches(self.words, at)
            if kind == "prep" and value == "on"
        }
        for start in stops:
            here = start
            while found := (self.nouns.find(here, "det") or self.nouns.find(here, "a")):
                here = found[1]
            half = here
            if side := self.nouns._plain_side(half):
                named = self.nouns.find(half, "side")
                sided = named is not None and side[1] > named[1]  # "the left side"
                again = not self.lexicon.find(self.words[half : half + 1], 0, "side")
                on = self.words[at] in ("on", "auf") or sided or again  # "also on the left"
                article = self.nouns.find(at, "a") is not None and half == at + 1
                roles = ("on",) if on else ("a",) if article else ()
                yield Item(ItemKind.SIDE, at, side[1], side[0], roles)
        where = self.lexicon.find(self.words, at, "where")
        if where:
            yield (
                Item(
                    ItemKind.REF if where[0] == "opposite" else ItemKind.PARTICLE,
                    at,
                    where[1],
                    where[0],
                )
                if where[0] != "opposite"
                else _opposite(at, where[1])
            )


def _corrects_number(before: Sequence[Item]) -> bool:
    """Whether the items before a number say that it corrects another one."""
    kinds = [item.kind for item in before[-2:]]
    return bool(kinds) and (
        kinds[-1] is ItemKind.NO or (kinds[-1] is ItemKind.SIGN and ItemKind.NO in kinds)
    )


def _opposite(at: int, stop: int) -> Item:
    return Item(ItemKind.REF, at, stop, Noun("door", 1, Side.OPPOSITE), ())
