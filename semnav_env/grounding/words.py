"""How grounding speaks of counts and places."""

from __future__ import annotations

from semnav_env.commands.clauses import LAST, Side

_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth")


def ordinal_word(ordinal: int) -> str:
    """ "third" for 3, "last" for `LAST`, "12th" for 12."""
    if ordinal == LAST:
        return "last"
    return _ORDINALS[ordinal - 1] if ordinal <= len(_ORDINALS) else f"{ordinal}th"


def where(side: Side | None) -> str:
    """ " on the right", " ahead" or nothing."""
    if side is None:
        return ""
    return " ahead" if side is Side.AHEAD else f" on the {side}"
