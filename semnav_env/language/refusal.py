"""Says why a text is refused: what was understood, what was not, and what can be said instead."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import dropwhile, takewhile

from semnav_env.language.errors import CommandError, listed
from semnav_env.language.languages import languages
from semnav_env.language.normalise import NormalisedText
from semnav_env.language.speech.items import JOINTS, Item, ItemKind, Noun
from semnav_env.language.speech.lexicon import SpeechLexicon, lexicon_of
from semnav_env.language.speech.recognition import votes
from semnav_env.language.speech.typos import nearest_word
from semnav_env.language.speech.understanding import Understanding
from semnav_env.language.words import TextPiece, pieces


def refusal(
    found: Understanding,
    said: Sequence[TextPiece],
    normalised: NormalisedText,
    lexicon: SpeechLexicon,
    rooms: Sequence[str],
    *,
    forced: bool,
) -> CommandError:
    """The error for a text that has no meaning.

    Args:
        found: how far it was understood.
        said: its words.
        normalised: the text.
        lexicon: of its language.
        rooms: names of the rooms that there are.
        forced: whether the language was given and not recognised.
    """
    start, stop = _unknown_room(found, said, lexicon) or _fault(found, len(said))
    place = normalised.span(said[start].start, said[max(start, stop - 1)].stop)
    words = normalised.text[said[start].start : said[max(start, stop - 1)].stop]
    foreign = _other_language([piece.text for piece in said], lexicon) if forced else None
    is_room = _unknown_room(found, said, lexicon) is not None
    hint = foreign or (_rooms(rooms) if is_room else _hint(found, words, lexicon, rooms))
    nearest = nearest_word(words, lexicon.words)
    suggestion = None if hint or nearest == words else nearest
    as_written = normalised.original[place[0] : place[0] + place[1]]
    no_room = f'there is no room "{as_written}"'
    problem = no_room if is_room and rooms else _problem(found, as_written)
    return CommandError(problem, normalised.original, *place, (), suggestion, hint)


def _unknown_room(
    found: Understanding, said: Sequence[TextPiece], lexicon: SpeechLexicon
) -> tuple[int, int] | None:
    """The words' numbers of "toilet" in "go to the toilet": a kind of room that is no room here."""
    if found.problem is not None or any(item.kind is ItemKind.UNKNOWN for item in found.items):
        return None
    words = [piece.text for piece in said]
    rest = list(dropwhile(lambda item: item.kind in JOINTS, found.items[found.reached :]))
    for item in takewhile(lambda item: item.kind not in JOINTS, rest):
        if isinstance(item.value, Noun) and item.value.kind == "area":
            for at in range(item.start, item.stop):
                if (noun := lexicon.find(words, at, "noun")) and noun[0] == "area":
                    return at, noun[1]
    return None


def _rooms(rooms: Sequence[str]) -> str:
    if not rooms:
        return "no room is known by its name without a floor plan: say which door"
    return f"the rooms here are: {listed(tuple(rooms))}"


def _problem(found: Understanding, words: str) -> str:
    if found.problem is not None:
        return found.problem[0]
    first = next((item for item in found.items if item.kind is ItemKind.UNKNOWN), None)
    if first is not None and isinstance(first.value, ValueError):
        return str(first.value)
    return f'"{words}" is not understood'


def _hint(
    found: Understanding, words: str, lexicon: SpeechLexicon, rooms: Sequence[str]
) -> str | None:
    """Advice for what was not understood, after what was."""
    language = lexicon.language
    said = "; ".join(command.say(language) for command in found.part)
    understood = f'understood: "{said}"' if said else ""
    outside = any(isinstance(item.value, ValueError) for item in found.items)
    if found.problem is not None or outside:
        return understood or None
    advice = language.hint(words) or language.hint(words.split(" ")[0])
    kinds = [item.kind for item in found.items]
    if advice is None and ItemKind.NOT in kinds:
        advice = language.hint("not") or language.hint("nicht")
    elif advice is None and ItemKind.OR in kinds:
        advice = language.hint("or") or language.hint("oder")
    if (
        advice is None
        and rooms
        and _may_be_room(words, lexicon)
        and nearest_word(words, lexicon.words) is None
    ):
        advice = f"the rooms here are: {listed(tuple(rooms))}"
    return "; ".join(part for part in (understood, advice) if part) or None


def _may_be_room(words: str, lexicon: SpeechLexicon) -> bool:
    """Whether words can name a room: "to the archive", but not "dock" or "the person"."""
    each = [piece.text for piece in pieces(words)]
    begins = any(lexicon.find(each, 0, kind) for kind in ("prep", "det", "noun"))
    return begins and not lexicon.of_class("beyond").intersection(each)


def _fault(found: Understanding, count: int) -> tuple[int, int]:
    """Numbers of the first word that was not understood and of the one behind the last such."""
    if found.problem is not None:
        return min(found.problem[1], count - 1), found.problem[2]
    unread = [item for item in found.items if item.kind is ItemKind.UNKNOWN]
    if unread:
        last = unread[0]
        for item in unread[1:]:
            last = item if item.start == last.stop else last
        return unread[0].start, last.stop
    at: Item | None = found.items[found.reached] if found.reached < len(found.items) else None
    return (at.start, at.stop) if at is not None else (max(0, count - 1), count)


def _other_language(words: Sequence[str], lexicon: SpeechLexicon) -> str | None:
    """A hint to the language to which most words of a text belong."""
    mine = votes(words, lexicon.language)
    for language in languages().values():
        theirs = votes(words, language)
        if language.code == lexicon.language.code:
            continue
        if theirs > mine or theirs == len(words):
            name = language.name
            return f'this is {name.capitalize()}: say language="{name}", or --language {name}'
    return None


__all__ = ["lexicon_of", "refusal"]
