"""Translates a text into its likeliest commands, and says how likely each is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from semnav_agents.networks.layers import Array
from semnav_agents.translating.masking import MARK_SYMBOLS, MaskedText, masked
from semnav_agents.translating.network import TranslatorNetwork
from semnav_agents.translating.programs import (
    REFUSE,
    UnsayableError,
    command_of,
    symbols_of,
)
from semnav_env.language.command import Command
from semnav_env.language.errors import CommandError

MAX_TRANSLATED_WORDS = 60
"""The longest text that is translated, words; those of the training are shorter."""

CANDIDATES = 5
"""The commands that are looked for."""


@dataclass(frozen=True)
class Translation:
    """A command that a network takes a text for.

    Attributes:
        command: which.
        likeness: its probability as the network sees it, 0 to 1.
        unsaid: numbers, sides and rooms of the text that the command does not have.
    """

    command: Command
    likeness: float
    unsaid: tuple[str, ...]


@dataclass(frozen=True)
class TranslatedText:
    """What a network takes a text for.

    Attributes:
        translations: commands, the likeliest first.
        refusal: probability that it is none, 0 to 1.
        plain: the text with placeholders.
        encoded: its words as the network sees them.
        network: that translates.
    """

    translations: tuple[Translation, ...]
    refusal: float
    plain: MaskedText
    encoded: Array
    network: TranslatorNetwork

    @property
    def words(self) -> tuple[str, ...]:
        """The words without values, sides and rooms."""
        marked = zip(self.plain.words, self.plain.marks, strict=True)
        return tuple(word for word, mark in marked if not mark)

    def has_sides_of(self, command: Command) -> bool:
        """Whether the text has every side, left or right, that a command has."""
        said = {side.value for side in self.plain.sides}
        return {each for each in ("left", "right") if each in str(command).split()} <= said

    def likeness_of(self, command: Command) -> float | None:
        """Probability of a command; None if the network has no symbols for it."""
        try:
            symbols = symbols_of(command, self.plain)
        except UnsayableError:
            return None
        return math.exp(self.network.log_share_of(symbols, self.encoded))


def translate(text: str, rooms: Sequence[str], network: TranslatorNetwork) -> TranslatedText | None:
    """The likeliest commands of a text; None if it is too long.

    Args:
        text: in English, German or both.
        rooms: names of the rooms that there are.
        network: that translates.

    Raises:
        CommandError: it has characters that no command has, or is too long to be read at all.
    """
    plain = masked(text, rooms)
    if not plain.words or len(plain.words) > MAX_TRANSLATED_WORDS:
        return None
    encoded = network.encode(plain.words, plain.marks)
    found, refusal = [], 0.0
    for symbols, share in network.candidates(encoded, CANDIDATES):
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
