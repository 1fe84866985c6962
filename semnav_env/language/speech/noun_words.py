"""Words of which nouns are made: sides, names and numbers of rooms, prepositions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from semnav_env.language.references import Side
from semnav_env.language.speech.items import Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.numerals import read_number

_UNITS = ("metres", "steps", "feet", "yards", "cm", "degrees", "seconds", "minutes", "half metres")


class NounWords:
    """Finds the words of nouns in a text."""

    words: Sequence[str]
    lexicon: SpeechLexicon
    names: Mapping[tuple[str, ...], str]

    def find(self, at: int, kind: str) -> tuple[str, int] | None:
        """The longest phrase of a class at a word."""
        return self.lexicon.find(self.words, at, kind)

    def _is_lone_letter(self, at: int) -> bool:
        """Whether a noun is only "t" without its article: rather a slip of the pen."""
        noun = self.find(at, "noun")
        english = self.lexicon.language.code == "en"
        return english and noun is not None and noun[1] == at + 1 and len(self.words[at]) == 1

    def _is_no_noun(self, at: int, counted: bool) -> bool:
        """Whether a noun without an article is a verb or a slip: "turn left", "first turn left"."""
        noun = self.find(at, "noun")
        sided = noun is not None and self._plain_side(noun[1]) is not None
        return (sided or not counted) and (self._is_verb(at) or self._is_lone_letter(at))

    def _is_verb(self, at: int) -> bool:
        verb, noun = self.find(at, "verb"), self.find(at, "noun")
        return verb is not None and noun is not None and verb[1] >= noun[1]

    def _plain_side(self, at: int) -> tuple[Side, int] | None:
        if not (found := self.find(at, "side")) or found[0] not in ("left", "right"):
            return None
        word = self.find(found[1], "sideword")
        return Side(found[0]), word[1] if word else found[1]

    def _is_after_article(self, at: int) -> bool:
        found = [self.find(at - 1, "det"), self.find(at - 1, "a")] if at > 0 else []
        return any(stop == at for _, stop in filter(None, found))

    def _name(self, at: int) -> tuple[str, int] | None:
        """The longest name of a room at a word."""
        if at >= len(self.words):
            return None
        if at > 0 and self.words[at][0] == '"' and len(self.words[at]) > 2:
            return self.words[at][1:-1].strip(), at + 1
        best: tuple[str, int] | None = None
        for phrase, name in self.names.items():
            if len(phrase) == 1 and phrase[0][0].isdigit() and not self._is_number_of_room(at):
                continue
            stop = self._matches_name(phrase, at)
            if stop and (best is None or stop > best[1]):
                best = name, stop
        return best

    def _is_number_of_room(self, at: int) -> bool:
        """Whether digits can be the number of a room, and not of something behind them."""
        return self.words[at][0].isdigit() and (
            at + 1 == len(self.words)
            or not self.words[at + 1][0].isalpha()
            or not any(True for _ in self.lexicon.matches(self.words, at + 1))
            or (
                self.find(at + 1, "noun") is None
                and not any(k in _UNITS for k, _, _ in self.lexicon.matches(self.words, at + 1))
            )
        )

    def _matches_name(self, phrase: tuple[str, ...], at: int) -> int:
        for part in phrase:
            if at >= len(self.words):
                return 0
            if self.words[at] == part:
                at += 1
            elif part.isdigit() and (number := read_number(self.words, at, self.lexicon)):
                if number[0] != int(part):
                    return 0
                at = number[1]
            else:
                return 0
        return at

    def _numbered(self, at: int) -> tuple[str, int] | None:
        """A room's number, where the names of the rooms are not known."""
        if at < len(self.words) and self.words[at][0] == '"' and len(self.words[at]) > 2:
            return self.words[at][1:-1].strip(), at + 1
        if at >= len(self.words) or not self.words[at][0].isdigit():
            return None
        letter = self.words[at + 1 : at + 2]
        if letter and len(letter[0]) == 1 and letter[0].isalpha():
            return self.words[at] + letter[0], at + 2
        return self.words[at], at + 1

    def _is_exactly(self, at: int) -> bool:
        """Whether "right" stands before a preposition and means exactly."""
        if at + 1 >= len(self.words):
            return False
        return (
            self.words[at] == "right"
            and any(
                kind == "prep"
                for kind, _, _ in self.lexicon.matches(self.words, min(at + 1, len(self.words) - 1))
            )
            and at + 1 < len(self.words)
        )

    def _preposition(self, at: int, value: str) -> int | None:
        """The word behind a preposition of a value at a word."""
        stops = [
            stop
            for kind, found, stop in self.lexicon.matches(self.words, at)
            if kind == "prep" and found == value
        ]
        return stops[0] if stops else None

    def _state(self, at: int) -> int | None:
        """The word behind "that is open": only open doors count."""
        relative = self.find(at, "relative")
        state = self.find(relative[1], "is open") if relative else None
        return state[1] if state else None

    def _numeral(self, noun: Noun, at: int) -> tuple[Noun, int] | None:
        if noun.ordinal is None and (found := self.find(at, "numeral word")):
            number = read_number(self.words, found[1], self.lexicon)
            if number:
                return replace(noun, ordinal=int(number[0])), number[1]
        return None

    def _of_hall(self, at: int) -> int | None:
        """The word behind "of the hallway"."""
        here = self._preposition(at, "of")
        if here is None:
            return None
        while here < len(self.words) and (
            found := self.find(here, "det") or self.find(here, "adj")
        ):
            here = found[1]
        noun = self.find(here, "noun")
        return (
            noun[1]
            if noun and noun[0] in ("hall", "room") and not self._numbered(noun[1])
            else None
        )

    def _of_room(self, noun: Noun, at: int) -> tuple[Noun, int] | None:
        """The room of a door: "of the kitchen", "vom Archiv"; its doorway is told apart."""
        start = self._preposition(at, "of")
        plain = noun.ordinal is None and noun.side is None and not noun.at_end
        while start is not None and (found := self.find(start, "det")):
            start = found[1]
        named = self._name(start) if start is not None and plain else None
        if named is None:
            return None
        return Noun("named", name=named[0], at_end=True, doorway=noun.doorway), named[1]
