"""Says which words of a text were corrected into others."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.language.languages import english
from semnav_env.language.normalise import normalise
from semnav_env.language.rooms import plain_name
from semnav_env.language.told import Told
from semnav_env.language.translating.masking import masked
from semnav_env.language.words import pieces


def corrections(text: str, rooms: Sequence[str] = ()) -> tuple[Told, ...]:
    """One line for each misspelt word or name of a text: '"Kühe" taken as "Küche"'.

    Args:
        text: that was understood.
        rooms: names of the rooms that there are.

    Raises:
        CommandError: the text has characters that no command has, or is too long to be read.
    """
    written = {plain_name(room): room for room in rooms}
    found = dict.fromkeys(masked(text, rooms).corrections)
    return tuple(
        Told(
            '"{said}" taken as "{taken}"',
            said=_as_written(said, text),
            taken=written.get(taken, taken),
        )
        for said, taken in found
    )


def _as_written(words: str, text: str) -> str:
    """Words of a text as they stand in it."""
    plain = normalise(text, english())
    found = pieces(plain.text)
    count = len(words.split())
    for at in range(len(found)):
        stretch = found[at : at + count]
        if " ".join(piece.text for piece in stretch) == words:
            start, length = plain.span(stretch[0].start, stretch[-1].stop)
            return text[start : start + length]
    return words
