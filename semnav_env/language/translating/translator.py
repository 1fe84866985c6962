"""Translates a text into its likeliest commands, and says how likely each is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from semnav_env.language.command import Command
from semnav_env.language.corpora.meanings import key_of
from semnav_env.language.named_rooms import missing_room
from semnav_env.language.translating.masking import MaskedText, masked
from semnav_env.language.translating.network import TranslatorNetwork
from semnav_env.language.translating.programs import UnsayableError, command_of, sayable
from semnav_env.language.translating.support import TextSupport

MAX_TRANSLATED_WORDS = 90
"""The longest text that is translated, words; those of the training are shorter."""

CANDIDATES = 5
"""The commands that are looked for."""


@dataclass(frozen=True)
class Translation:
    """A command that may be the meaning of a text.

    Attributes:
        command: the command.
        likeness: its probability by the network, with that of others of the same meaning.
    """

    command: Command
    likeness: float


@dataclass(frozen=True)
class TranslatedText:
    """The likeliest commands of a text.

    Attributes:
        translations: commands that differ in meaning, the likeliest first.
        plain: the text with placeholders.
    """

    translations: tuple[Translation, ...]
    plain: MaskedText

    @cached_property
    def support(self) -> TextSupport:
        """The evidence in the words of the text."""
        return TextSupport.of(self.plain.words)


def translate(text: str, rooms: Sequence[str], network: TranslatorNetwork) -> TranslatedText | None:
    """The likeliest commands of a text; None if it has no words, or too many.

    Commands with a room that does not exist are left out.

    Args:
        text: in English, German or both.
        rooms: names of the rooms of the floor plan; none if they are not known.
        network: that translates.

    Raises:
        CommandError: the text has characters that no command has, or is too long to be read.
    """
    plain = masked(text, rooms)
    speaks = any(word[0].isalnum() or word[0] == '"' for word in plain.words)
    if not speaks or len(plain.words) > MAX_TRANSLATED_WORDS:
        return None
    encoded = network.encode(plain.words, plain.marks, plain.classes)
    found: dict[object, Translation] = {}
    for symbols, log_share in network.candidates(encoded, CANDIDATES, sayable(plain)):
        command = _command_of(symbols, plain)  # none if the network refuses the text
        if command and not missing_room(command, rooms):
            alike = found.get(key_of(command), Translation(command, 0.0))
            share = alike.likeness + math.exp(log_share)
            found[key_of(command)] = replace(alike, likeness=share)
    order = sorted(found.values(), key=lambda each: -each.likeness)
    return TranslatedText(tuple(order), plain)


def _command_of(symbols: Sequence[str], plain: MaskedText) -> Command | None:
    try:
        return command_of(symbols, plain)
    except UnsayableError:
        return None
