"""Translates a text into its likeliest commands, and says how likely each is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from semnav_env.language.command import Command
from semnav_env.language.errors import CommandError
from semnav_env.language.translating.masking import MARK_SYMBOLS, MaskedText, masked
from semnav_env.language.translating.network import TranslatorNetwork
from semnav_env.language.translating.programs import (
    REFUSE,
    UnsayableError,
    command_of,
    sayable,
    symbols_of,
)
from semnav_env.networks.layers import Array

MAX_TRANSLATED_WORDS = 90
"""The longest text that is translated, words; those of the training are shorter."""

CANDIDATES = 5
"""The commands that are looked for."""


@dataclass(frozen=True)
class Translation:
    """A command that may be the meaning of a text.

    Attributes:
        command: the command.
        likeness: its probability by the network, 0 to 1.
        unsaid: numbers, sides and rooms of the text that the command does not have.
    """

    command: Command
    likeness: float
    unsaid: tuple[str, ...]


@dataclass(frozen=True)
class TranslatedText:
    """The likeliest commands of a text.

    Attributes:
        translations: commands, the likeliest first.
        refusal: probability that the text is no command, 0 to 1.
        plain: the text with placeholders.
        encoded: its words, encoded by the network.
        network: that translates.
    """

    translations: tuple[Translation, ...]
    refusal: float
    plain: MaskedText
    encoded: Array
    network: TranslatorNetwork

    def likeness_of(self, command: Command) -> float | None:
        """Probability of a command; None if the network has no symbols for it."""
        try:
            symbols = symbols_of(command, self.plain)
        except UnsayableError:
            return None
        return math.exp(self.network.log_share_of(symbols, self.encoded))


def translate(text: str, rooms: Sequence[str], network: TranslatorNetwork) -> TranslatedText | None:
    """The likeliest commands of a text; None if it has no words, or too many.

    Args:
        text: in English, German or both.
        rooms: names of the rooms of the floor plan.
        network: that translates.

    Raises:
        CommandError: the text has characters that no command has, or is too long to be read.
    """
    plain = masked(text, rooms)
    speaks = any(word[0].isalnum() or word[0] == '"' for word in plain.words)
    if not speaks or len(plain.words) > MAX_TRANSLATED_WORDS:
        return None
    encoded = network.encode(plain.words, plain.marks, plain.classes)
    found, refusal = [], 0.0
    for symbols, share in network.candidates(encoded, CANDIDATES, sayable(plain)):
        if symbols == (REFUSE,):
            refusal = math.exp(share)
        elif (command := _command_of(symbols, plain)) is not None:
            found.append(Translation(command, math.exp(share), _unsaid(symbols, plain)))
    return TranslatedText(tuple(found), refusal, plain, encoded, network)


def _command_of(symbols: Sequence[str], plain: MaskedText) -> Command | None:
    try:
        return command_of(symbols, plain)
    except (UnsayableError, CommandError):
        return None


def _unsaid(symbols: Sequence[str], plain: MaskedText) -> tuple[str, ...]:
    marked = zip(plain.words, plain.marks, strict=True)
    return tuple(word for word, mark in marked if mark and MARK_SYMBOLS[mark] not in symbols)
