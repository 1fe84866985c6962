"""Reads a text as commands: recognises its language, and asks about slips of the pen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from semnav_env.language.clauses import Stop
from semnav_env.language.command import Command
from semnav_env.language.defaults import decided
from semnav_env.language.language import Language
from semnav_env.language.languages import english
from semnav_env.language.normalise import empty_command, normalise
from semnav_env.language.question import AmbiguousCommandError, Question
from semnav_env.language.repeats import told_once
from semnav_env.language.speech.items import ItemKind
from semnav_env.language.speech.lexicon import (
    SpeechLexicon,
    lexicon_of,
    spoken_pieces,
    with_room_names,
    without,
)
from semnav_env.language.speech.recognition import lexicon_for, recognised
from semnav_env.language.speech.room_words import name_phrases
from semnav_env.language.speech.understanding import Understanding, understand
from semnav_env.language.words import TextPiece, pieces


def readings_of_text(
    text: str, language: Language | None, rooms: Sequence[str]
) -> tuple[Command, ...]:
    """Every command that a text can mean.

    Args:
        text: as it was given.
        language: of the text; None to recognise it.
        rooms: names of the rooms that there are.

    Raises:
        CommandError: it means nothing, or its words are misspelt.
    """
    normalised = normalise(text, language or english())
    found = pieces(normalised.text)
    words = [piece.text for piece in found]
    spoken = language or recognised(words)
    lexicon = lexicon_of(spoken) if language else lexicon_for(words, spoken)
    names = name_phrases(rooms)
    said = with_room_names(spoken_pieces(found, lexicon, names), lexicon, names)
    if not said:
        raise empty_command(lexicon.language)
    understood = _understood(said, lexicon, names)
    if not understood.commands:
        from semnav_env.language.refusal import refusal  # here, as most texts are understood

        understood = _without_slips(said, lexicon, names, text) or understood
        _ask_without_unread(said, lexicon, names, text, understood)
        raise refusal(understood, said, normalised, lexicon, rooms, forced=language is not None)
    return _as_said(understood.commands, said, lexicon.language)


def _as_said(
    commands: Sequence[Command], said: Sequence[TextPiece], language: Language
) -> tuple[Command, ...]:
    """The command that is said in its canonical words, or what is said, each thing once."""
    words = [piece.text for piece in said]
    for command in commands:
        canonical = pieces(normalise(command.say(language), language).text)
        if [piece.text for piece in canonical] == words:
            return (command,)
    return tuple(dict.fromkeys(map(told_once, commands)))


def _understood(
    said: Sequence[TextPiece], lexicon: SpeechLexicon, names: Mapping[tuple[str, ...], str]
) -> Understanding:
    """What words mean without "just", "mal" and the like; if nothing, what they mean with them."""
    plain = without(said, lexicon, "softener")
    texts = [without(plain, lexicon, "softening verb"), plain, said]
    tried = dict.fromkeys(tuple(piece.text for piece in text) for text in texts)
    found = [understand(text, lexicon, names) for text in tried]
    right = [each for each in found[:-1] if each.commands] or found[-1:]
    return min(right, key=lambda each: each.cost)


def _without_slips(
    said: Sequence[TextPiece],
    lexicon: SpeechLexicon,
    names: Mapping[tuple[str, ...], str],
    text: str,
) -> Understanding | None:
    """Ask whether a text means what it would mean without its slips of the pen.

    Raises:
        AmbiguousCommandError: it would mean something.
    """
    from semnav_env.language.speech.typos import corrected_words

    words = [piece.text for piece in said]
    if any(word in lexicon.of_class("beyond") - lexicon.words for word in words):
        return None
    corrected = corrected_words(words, lexicon.words.union(*names))
    if corrected is None:
        return None
    meant = decided(understand(corrected[0], lexicon, names).commands)
    if all(isinstance(clause, Stop) for command in meant for clause in command.clauses):
        return None
    right = ", ".join(dict.fromkeys(corrected[1].values()))
    raise AmbiguousCommandError(text, Question(meant, lexicon.language, misspelt=right))


def _ask_without_unread(
    said: Sequence[TextPiece],
    lexicon: SpeechLexicon,
    names: Mapping[tuple[str, ...], str],
    text: str,
    understood: Understanding,
) -> None:
    """Ask whether a text means what it would mean without words that are not understood.

    Raises:
        AmbiguousCommandError: it would mean something.
    """
    words = [piece.text for piece in said]
    meant = decided(understand(words, lexicon, names, leave_out=True).commands)
    if all(isinstance(clause, Stop) for command in meant for clause in command.clauses):
        return
    unread = next((i for i in understood.items if i.kind is ItemKind.UNKNOWN), None)
    if unread is None:
        unread = understood.items[min(understood.reached, len(understood.items) - 1)]
    unread_words = " ".join(words[unread.start : unread.stop])
    raise AmbiguousCommandError(text, Question(meant, lexicon.language, unread=unread_words))
