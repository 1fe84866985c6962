"""Reads nouns with what stands around them: "the second door on the left-hand side"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from semnav_env.language.references import LAST, OTHER, Side
from semnav_env.language.speech.items import Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.noun_memory import NounMemory
from semnav_env.language.speech.noun_words import NounWords
from semnav_env.language.speech.numerals import read_number
from semnav_env.language.speech.room_words import kinds_of_rooms

DOORLIKE = ("door", "room", "one")
"""Kinds of nouns that have a side."""

CHOOSING = ("open", "closed", "nearest", "any", "other", "next", "after next", "last", "middle")
"""Adjectives that say which one is meant."""


LONGEST_NOUN = 24
"""The most words of a noun with all that stands before it."""


@dataclass
class NounReader(NounWords):
    """Reads nouns of a text, and remembers what was named last.

    Attributes:
        words: of the text.
        lexicon: of its language.
        names: the spoken words of each room's name, and the name.
        memory: what was named before.
    """

    words: Sequence[str]
    lexicon: SpeechLexicon
    names: Mapping[tuple[str, ...], str]
    memory: NounMemory = field(default_factory=NounMemory)

    def read(self, at: int, determined: bool = False) -> tuple[Noun, int] | None:
        """The noun that begins at a word and the word behind it; None if none does.

        Args:
            at: number of its first word.
            determined: its article stands before it ("zur nächsten").
        """
        if self.find(at, "some"):
            return None  # "a little way down the hallway"
        noun, here = Noun(""), at
        said_which = is_article = False
        while here < min(len(self.words), at + LONGEST_NOUN):
            rank, name = self.find(here, "ordinal"), self._name(here)
            plain = rank is None or (name is not None and name[1] > rank[1])
            if here > at and self.find(here, "clause start"):
                break
            if said_which and self.find(here, "of several"):
                break  # "die rechte der beiden Türen"
            if plain and (head := self._head(here, noun)):
                bare = not determined and name is None
                if bare and self._is_no_noun(here, noun.ordinal is not None):
                    return None  # "turn left" is no turning on the left
                if self._is_elliptic_turn(here, noun):
                    break  # "at the second turn left", of intersections
                noun, here = head
                if noun.side is Side.OPPOSITE and noun.kind not in DOORLIKE:
                    return None  # "across the crossing" is no crossing opposite
                behind = self._side_behind(replace(noun, side=None), here)
                if self._plain_side(at) and (behind or self._plain_side(here)):
                    return None  # "right, second door left": a turn before it
                return self._of_a_kind(*self._behind(noun, here), self.words[here - 1])
            adjective = self.find(here, "adj")
            longest = adjective[1] if adjective else 0
            was_article, is_article = is_article, False
            if (found := self.find(here, "det")) and found[1] >= longest:
                again = was_article and self.words[here] == self.words[here - 1]
                if (was_article and not again) or (noun.side is not None and not determined):
                    return None  # "that its the first door", "links den Gang hinunter"
                determined = is_article = True
            elif (found := self.find(here, "a")) and found[1] >= longest:
                noun, determined = replace(noun, definite=False), True
            elif modified := self._modifier(here, noun):
                noun, here = modified
                said_which = True
                continue
            elif found := self.find(here, "adj"):
                if self.find(found[1], "det"):
                    return None  # "open the door" is no open door
                if found[0] in CHOOSING:
                    said_which = True
                    ordinal = self.memory.chosen(found[0]) or _adjective_ordinal(found[0], noun)
                    noun = replace(noun, ordinal=ordinal, closed=found[0] == "closed")
            elif not (determined and here > at and (found := self.find(here, "filler"))):
                break
            here = found[1]
        told = self._without_head(noun, here) if said_which else None
        bare = told is not None and not determined and told[0].side is None
        return None if bare else told

    def _of_a_kind(self, noun: Noun, stop: int, word: str) -> tuple[Noun, int]:
        """Of "the office" where there are "office 1" and "office 2": a room, though not which."""
        bare = noun.ordinal is None and noun.side is None and not noun.at_end and noun.definite
        if noun.kind == "room" and bare and word in kinds_of_rooms(self.names):
            return replace(noun, kind="named", name=word), stop
        return noun, stop

    def _is_elliptic_turn(self, at: int, noun: Noun) -> bool:
        places = ("intersection", "corner", "t_junction")
        last = self.memory.last
        named = last is not None and last.kind in places
        return (
            named
            and noun.ordinal is not None
            and self.words[at] == "turn"
            and self._plain_side(at + 1) is not None
        )

    def _modifier(self, at: int, noun: Noun) -> tuple[Noun, int] | None:
        """An ordinal, a number or a side before a noun."""
        if noun.ordinal is None and (found := self.find(at, "ordinal")):
            is_next = self.words[at].startswith(("next", "naechst"))
            return replace(noun, ordinal=int(found[0]), is_next=is_next), found[1]
        if noun.ordinal is not None and noun.ordinal < 0 and (found := self.find(at, "from end")):
            return noun, found[1]
        number = read_number(self.words, at, self.lexicon)
        if number and number[0] == int(number[0]) and number[0] > 0 and noun.ordinal in (None, 1):
            return replace(noun, ordinal=int(number[0]), counted=True), number[1]
        if noun.side is None and (found := self._plain_side(at)):
            return replace(noun, side=found[0]), found[1]
        if noun.side is None and (where := self.find(at, "where")) and where[0] == "opposite":
            return replace(noun, side=Side.OPPOSITE), where[1]
        return None

    def _head(self, at: int, noun: Noun) -> tuple[Noun, int] | None:
        """The noun itself."""
        found = self.find(at, "noun")
        counted = found is not None and found[0] == "room" and noun.ordinal is not None
        if (named := self._name(at)) and not (counted and found and named[1] == found[1]):
            return replace(noun, kind="named", name=named[0]), named[1]
        if found:
            kind, stop = found
            numbered = None if noun.counted else self._numbered(stop)
            if kind == "room" and (named := self._name(stop) or numbered):
                return replace(noun, kind="named", name=named[0]), named[1]
            if kind == "doorway":
                return replace(noun, kind="door", doorway=True), stop
            return replace(noun, kind=kind), stop
        another = self.find(at, "another") if noun == Noun("") and self.memory.last else None
        if another and self.memory.last and not self.find(another[1], "noun"):
            found = another
            return Noun(self.memory.last.kind, 1, self.memory.last.side, definite=False), found[1]
        if (found := self.find(at, "one")) and found[1] <= len(self.words):
            plain = noun.ordinal is None and noun.side is None and not self._is_after_article(at)
            german = self.lexicon.language.code == "de"
            if plain and (german or not self._side_behind(replace(noun, kind="one"), found[1])):
                return None
            after = self.find(at, "after that") is not None
            return replace(noun, kind="one", relative=after), found[1]
        return None

    def _behind(self, noun: Noun, at: int) -> tuple[Noun, int]:
        """What stands behind a noun and belongs to it."""
        while at < len(self.words):
            if numbered := self._numeral(noun, at):
                noun, at = numbered
            elif (
                noun.kind in (*DOORLIKE, "hall", "turning")
                and noun.side is None
                and (side := self._side_behind(noun, at))
            ):
                noun, at = replace(noun, side=side[0]), side[1]
            elif noun.ordinal and noun.ordinal > 0 and (found := self.find(at, "from end")):
                noun, at = replace(noun, ordinal=-noun.ordinal), found[1]
            elif noun.kind == "one" and (found := self.find(at, "after that")):
                noun, at = replace(noun, relative=True), found[1]
            elif is_doorlike(noun) and (end := self.find(at, "at end")):
                noun, at = replace(noun, at_end=True), end[1]
            elif is_doorlike(noun) and (state := self._state(at)):
                at = state
            elif is_doorlike(noun) and (came := self.find(at, "came by")):
                noun, at = replace(noun, kind="entry"), came[1]
            elif noun.counted and noun.kind == "door" and (on := self.find(at, "further")):
                noun, at = replace(noun, counted=False), on[1]
            elif noun.kind == "door" and (room := self._of_room(noun, at)):
                noun, at = room
            elif noun.doorway and (door := self._of_door(at)):
                noun, at = replace(door[0], doorway=True, kind="door"), door[1]
            elif (noun.side or noun.ordinal) and (several := self.find(at, "of several")):
                kind = "door" if noun.kind == "one" else noun.kind
                noun, at = replace(noun, kind=kind, elliptic=False), several[1]
            elif noun.side is None and (spot := self._spot_before_side(noun, at)):
                at = spot
            elif hall := self._of_hall(at):
                at = hall
            else:
                break
        return self.memory.resolved(noun), at

    def _of_door(self, at: int) -> tuple[Noun, int] | None:
        """The door of a doorway: "of the second room", "der zweiten Tür"."""
        start = self._preposition(at, "of") or at
        noun = self.read(start) if start < len(self.words) else None
        return noun if noun is not None and noun[0].kind in ("door", "room") else None

    def _spot_before_side(self, noun: Noun, at: int) -> int | None:
        """The word behind "down there" before a side: "the door down there on the right"."""
        spot = self.find(at, "here") if noun.kind in DOORLIKE else None
        sided = spot is not None and self._side_at(noun, spot[1]) is not None
        return spot[1] if sided and spot is not None else None

    def _side_behind(self, noun: Noun, at: int) -> tuple[Side, int] | None:
        """A side behind a noun: "on your left", "left", "in front of you"."""
        if (same := self.find(at, "same side")) and self.memory.last and self.memory.last.side:
            return self.memory.last.side, same[1]
        relative = self.find(at, "relative")
        for start in (at, relative[1] if relative else at):
            where = self.find(start, "where") if noun.kind in DOORLIKE else None
            if where and not self._names_more(start, where[1]):
                return Side(where[0]), where[1]
        if relative and noun.kind not in DOORLIKE:
            found = self._side_at(noun, relative[1])
            link = self.find(found[1], "link") if found else None
            return (found[0], link[1] if link else found[1]) if found else None
        return self._side_at(noun, at)

    def _side_at(self, noun: Noun, at: int) -> tuple[Side, int] | None:
        """A side with or without a preposition: "on your left", "left"."""
        here = at
        for kind in ("prep", "det", "det"):
            if kind == "prep" and (preposition := self._preposition(at, "on")):
                here = preposition
            elif kind == "det" and (found := self.find(here, "det")):
                here = found[1]
        if here == at and (noun.kind not in DOORLIKE or self._is_exactly(at)):
            return None
        return self._plain_side(here)

    def _names_more(self, start: int, stop: int) -> bool:
        """Whether "opposite" and the like go on: "opposite the kitchen"."""
        preps = [
            end
            for kind, value, end in self.lexicon.matches(self.words, start)
            if kind == "prep" and value in ("opposite", "after")
        ]
        return any(end >= stop and self._is_noun(end) for end in preps)

    def _is_noun(self, at: int) -> bool:
        noun = self.read(at) if at < len(self.words) else None
        return noun is not None and noun[0].kind not in ("it", "one", "hall")

    def _without_head(self, noun: Noun, at: int) -> tuple[Noun, int] | None:
        """A noun that is left out: "the second on the left", "die rechte"."""
        if noun.ordinal == OTHER and noun.side is not None:
            return None  # "my other left"
        if noun.ordinal is not None and not noun.counted:
            if noun.side is not None and self.lexicon.language.code == "en":
                return replace(noun, kind="turning"), at
            return self._behind(replace(noun, kind="one", elliptic=True), at)
        adjectives = [w for w in self.words[at - 1 : at] if w[:4] in ("link", "rech")]
        if noun.side is not None and adjectives and adjectives[-1] not in ("links", "rechts"):
            german = self.lexicon.language.code == "de"
            if german and len(adjectives[-1]) < 8:
                return self._behind(replace(noun, kind="one", elliptic=True), at)
        return None


def is_doorlike(noun: Noun) -> bool:
    """Whether a noun names a door, or a room by its door."""
    return noun.kind in DOORLIKE


_ADJECTIVE_ORDINALS = {"other": OTHER, "after next": 2, "last": LAST}


def _adjective_ordinal(adjective: str, noun: Noun) -> int | None:
    if adjective in _ADJECTIVE_ORDINALS:
        return _ADJECTIVE_ORDINALS[adjective]
    return noun.ordinal or 1 if adjective in ("any", "nearest", "next") else noun.ordinal
