"""Words of which items are made: amounts, fillers and words that break off."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import replace

from semnav_env.language.references import SOME, Distance, Unit
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.nouns import NounReader
from semnav_env.language.speech.numerals import read_number

UNITS = {"metres": 1.0, "half metres": 0.5, "cm": 0.01}
SIGNS = frozenset(",;.!?:")

SECONDS_OF = {"seconds": 1, "minutes": 60}


def _distance(amount: float, at: int, stop: int, unit: Unit) -> Item:
    try:
        return Item(ItemKind.DISTANCE, at, stop, Distance(round(amount, 6), unit))
    except ValueError as error:
        return Item(ItemKind.UNKNOWN, at, stop, error)


class ItemWords(ABC):
    """Finds the words of items in a text."""

    words: Sequence[str]
    lexicon: SpeechLexicon
    nouns: NounReader
    waits: bool

    def _skipped(self, at: int) -> int | None:
        """The word behind "to" before a verb, and behind words that break off before a comma."""
        words, behind = self.words, at + 1
        if words[at] in ("to", "zu") and self.lexicon.find(words, behind, "verb"):
            return behind
        if self.lexicon.find(words, at, "a") and self.lexicon.find(words, behind, "around alone"):
            return behind
        while behind < len(words) and self._is_small(behind):
            behind += 1
        broken = self._is_small(at) and behind + 1 < len(words) and words[behind] == ","
        again = broken and not self.lexicon.find(words, behind + 1, "and")
        return behind if again else None

    def _end_of_remark(self, at: int) -> int:
        """The sign behind a clause that says why: "so that we can see you"."""
        while at < len(self.words) and self.words[at] not in SIGNS:
            at += 1
        return at

    def _choice_among(self, at: int) -> int | None:
        """The word behind "of the doors on the left,", of which one is chosen then."""
        begins = at == 0 or self.words[at - 1] in SIGNS
        if begins and (end := self.lexicon.find(self.words, at, "from the end")):
            self.nouns.memory.backwards = True
            return end[1] + 1 if self.words[end[1] : end[1] + 1] in ([","], [":"]) else end[1]
        doors = self.lexicon.find(self.words, at, "among doors")
        side = self.nouns._side_at(Noun("door"), doors[1]) if doors else None
        if side is None:
            return None
        self.nouns.memory.among = side[0]
        return side[1] + 1 if self.words[side[1] : side[1] + 1] == [","] else side[1]

    def _place_of_speaker(self, at: int) -> int | None:
        """The word behind "you are in the kitchen.", which says only where one is."""
        begins = at == 0 or self.words[at - 1] in SIGNS
        told = self.lexicon.find(self.words, at, "you are") if begins else None
        noun = self.nouns.read(told[1]) if told else None
        if noun is None or noun[0].kind not in ("named", "room", "area", "hall"):
            return None
        ends = noun[1] < len(self.words) and self.words[noun[1]] in (".", ",", ";")
        return noun[1] + 1 if ends and noun[1] + 1 < len(self.words) else None

    def _is_small(self, at: int) -> bool:
        return any(
            kind in ("prep", "det", "a") for kind, _, _ in self.lexicon.matches(self.words, at)
        )

    def _is_corner(self, stop: int) -> bool:
        """Whether "turn around" goes on with "the corner"."""
        noun = self.nouns.read(stop) if self.words[stop - 1] in ("around", "round") else None
        return noun is not None and noun[0].kind == "corner"

    def _may_wait(self, at: int) -> bool:
        """Whether words of correction can be a command: "wait", "hold on", "Moment"."""
        return self.words[at] in ("wait", "hold", "hang", "warte", "moment", "stay", "einen")

    def _no_correction(self, at: int) -> int | None:
        """The word behind "wait" and the like where they correct nothing."""
        found = self.lexicon.find(self.words, at, "no")
        return found[1] if found and self._may_wait(at) else None

    def _is_no_correction(self, at: int, stop: int) -> bool:
        """Whether words such as "wait" stand where nothing can be corrected."""
        if not self._may_wait(at):
            return False
        if at == 0:
            return True
        behind = stop
        while behind < len(self.words) and (
            self.words[behind] == "," or self.lexicon.find(self.words, behind, "filler")
        ):
            behind += 1
        if behind >= len(self.words):
            return True
        matches = list(self.lexicon.matches(self.words, behind))
        verbs = [value for kind, value, _ in matches if kind == "verb"]
        corrects = (
            self.nouns._plain_side(behind) is not None
            or "turn" in verbs
            or any(kind == "no" for kind, _, _ in matches)
            or (not verbs and next(self._nouns(behind, ()), None) is not None)
        )
        return self.waits or not corrects

    @abstractmethod
    def _nouns(self, at: int, before: Sequence[Item]) -> Iterator[Item]:
        """The nouns that begin at a word, with and without a preposition."""

    def _has_phrase(self, at: int) -> bool:
        """Whether a phrase with a comma begins at a comma: ", die vor dir ist"."""
        return any(stop > at + 1 for _, _, stop in self.lexicon.matches(self.words, at))

    def _begins_clause(self, at: int, stop: int) -> bool:
        """Whether a conjunction begins a clause and no place: "before you turn left"."""
        other = any(
            kind in ("prep", "where", "then") and end >= stop
            for kind, _, end in self.lexicon.matches(self.words, at)
        )
        verbs = (v for kind, v, _ in self.lexicon.matches(self.words, stop) if kind == "verb")
        return not other or any(verb != "reach" for verb in verbs)

    def _begins_noun(self, stop: int) -> bool:
        """Whether the last word of a phrase is the article of a noun: "nimm die zweite Tür"."""
        noun = self.nouns.read(stop - 1)
        if noun is not None and noun[1] > stop:
            return True
        last = any(kind == "prep" for kind, _, _ in self.lexicon.matches(self.words, stop - 1))
        return (
            last
            and stop < len(self.words)
            and (self.nouns.read(stop) or self._it(stop)) is not None
        )

    def _filler(self, at: int) -> int | None:
        found = self.lexicon.find(self.words, at, "filler")
        return found[1] if found else None

    def _it(self, at: int) -> tuple[Noun, int] | None:
        it = self.lexicon.find(self.words, at, "it")
        return (Noun("it"), it[1]) if it else None

    def _its_door(self, at: int) -> tuple[Noun, int] | None:
        """Of "Up to its door": the door of the room that was named."""
        found = self.lexicon.find(self.words, at, "its door")
        return (Noun("it", at_end=True), found[1]) if found else None

    def _may_be_side(self, at: int) -> bool:
        """Whether "right" before a preposition may be a side: "turn right after the door"."""
        return self.words[at] == "right" and self.words[at + 1 : at + 2] not in (
            ["up"],
            ["next"],
            ["by"],
            ["in"],
            ["outside"],
            ["beside"],
        )

    def _ends_clause(self, at: int) -> bool:
        """Whether no side or place goes on with a clause: "where the kitchen is on the left"."""
        if at >= len(self.words):
            return True
        kinds = {kind for kind, _, _ in self.lexicon.matches(self.words, at)}
        return not kinds & {"where", "side", "particle", "is open", "is closed", "prep", "not"}

    def _has_verb(self, at: int) -> bool:
        return any(
            value == "reach" and stop == at
            for start in range(max(0, at - 3), at)
            for kind, value, stop in self.lexicon.matches(self.words, start)
            if kind == "verb"
        )

    def _amounts(self, at: int, before: Sequence[Item]) -> Iterator[Item]:
        """Degrees, distances and times, with "for" or "by" before them."""
        if angle := self.lexicon.find(self.words, at, "angle"):
            yield Item(ItemKind.DEGREES, at, angle[1], float(angle[0]))
        until = self.nouns._preposition(at, "until")
        some = self.lexicon.find(self.words, until or at, "some")
        if some or (until and (some := self.lexicon.find(self.words, until, "slight"))):
            yield Item(ItemKind.DISTANCE, at, some[1], SOME)
        prefix = self.nouns._preposition(at, "for") or until
        for start in dict.fromkeys((at, prefix or at)):
            here = start
            if second := self.nouns._preposition(here, "for"):
                here = second
            number = read_number(self.words, here, self.lexicon)
            if number is None:
                article = self.lexicon.find(self.words, here, "a")
                number = (1.0, article[1]) if article else None
            if number is not None and (unit := self._unit(*number)):
                yield replace(unit, start=at)

    def _unit(self, amount: float, at: int) -> Item | None:
        for kind, _, stop in self.lexicon.matches(self.words, at):
            if kind in UNITS:
                return _distance(amount * UNITS[kind], at, stop, Unit.METRES)
            if kind == "steps":
                return _distance(amount, at, stop, Unit.STEPS)
            if kind in SECONDS_OF:
                return Item(ItemKind.SECONDS, at, stop, amount * SECONDS_OF[kind])
            if kind == "degrees":
                return Item(ItemKind.DEGREES, at, stop, amount)
            if kind in ("feet", "yards"):
                metres = amount * {"feet": 0.3048, "yards": 0.9144}[kind]
                return _distance(round(2 * metres) / 2, at, stop, Unit.METRES)
        return None

    def _second(self, at: int) -> tuple[Noun, int] | None:
        """The second noun of "between P and Q", and the word behind it."""
        conjunction = self.lexicon.find(self.words, at, "and")
        return self.nouns.read(conjunction[1]) if conjunction else None

    def _inner_preposition(self, at: int, roles: list[str]) -> tuple[int, list[str]]:
        """Words between "when" or "until" and its noun: "bis du an die", "wenn du zur"."""
        while (filler := self._filler(at)) and not self.nouns.read(at):
            at = filler
        found = [
            (v, stop) for kind, v, stop in self.lexicon.matches(self.words, at) if kind == "prep"
        ]
        stops = [stop for _, stop in found]
        if any(value == "out" for value, _ in found):
            return len(self.words), roles  # "wenn du aus der Tür kommst" is no place
        if stops and self.nouns.read(stops[0]):
            return stops[0], roles
        return at, roles

    def _behind_clause(self, at: int, roles: list[str]) -> tuple[int, bool] | None:
        """The word behind the verb of a clause with "when" or "until", and whether it is "past"."""
        if "when" not in roles and "until" not in roles:
            return at, False
        past = False
        here = at
        while here < len(self.words):
            matches = list(self.lexicon.matches(self.words, here))
            behind = [
                stop
                for kind, value, stop in matches
                if (kind, value) in (("particle", "past"), ("where", "behind"))
            ]
            verb = [stop for kind, value, stop in matches if (kind, value) == ("verb", "reach")]
            if behind:
                past, here = True, behind[0]
                at = here if "until" in roles else at
            elif any(kind == "is open" for kind, _, _ in matches) and "until" in roles:
                here = at = max(stop for kind, _, stop in matches if kind == "is open")
            elif any(kind == "link" for kind, _, _ in matches) and not verb:
                here = next(stop for kind, _, stop in matches if kind == "link")
                if "when" in roles and self._ends_clause(here):
                    return here, past  # "where the kitchen is"
            elif verb:
                here = verb[0]
                at = here
                break
            else:
                break
        if "when" in roles and at != here:
            return None
        if "when" in roles and not self._has_verb(at):
            return None
        return at, past
