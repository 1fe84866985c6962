"""Translates a text into the likeliest command, and says how likely that is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from semnav_env.agents.translating.masking import MARK_SYMBOLS, masked
from semnav_env.agents.translating.network import TranslatorNetwork
from semnav_env.agents.translating.programs import UnsayableError, command_of
from semnav_env.commands.command import Command

MAX_TRANSLATED_WORDS = 60
"""The longest text that is translated, words; those of the training are shorter."""


@dataclass(frozen=True)
class Translation:
    """What a network takes a text for.

    Attributes:
        command: the likeliest one.
        likeness: its probability as the network sees it, 0 to 1.
        words: of the text, without its values, sides and rooms.
        unsaid: its values, sides and rooms that the command does not have.
    """

    command: Command
    likeness: float
    words: tuple[str, ...]
    unsaid: tuple[str, ...]


def translate(text: str, rooms: Sequence[str], network: TranslatorNetwork) -> Translation | None:
    """The likeliest command of a text; None if the network takes it for none.

    Args:
        text: in English, German or both.
        rooms: names of the rooms that there are.
        network: that translates.

    Raises:
        CommandError: it has characters that no command has, or is too long.
    """
    plain = masked(text, rooms)
    if len(plain.words) > MAX_TRANSLATED_WORDS:
        return None
    symbols, likeness = network.translate(plain.words, plain.marks)
    try:
        command = command_of(symbols, plain)
    except UnsayableError:
        return None
    marked = list(zip(plain.words, plain.marks, strict=True))
    words = tuple(word for word, mark in marked if not mark)
    unsaid = tuple(word for word, mark in marked if mark and MARK_SYMBOLS[mark] not in symbols)
    return Translation(command, likeness, words, unsaid)
