"""Hears a call to stop: in every language at once, before anything else is read.

A robot must not ask back, or look for a language, while somebody calls. So this is a fixed list.
"""

from __future__ import annotations

import re

from semnav_env.language.phrase_table import PhraseTable, Words, plain_words

URGENT = (
    "emergency stop|emergency halt|emergency brake|e-stop|e stop|estop|stop stop|halt stop|whoa|"
    "notstopp|not-stopp|notstop|not-stop|nothalt|not-halt|notaus|not-aus|notbremse|notbremsung|"
    "stopp stopp|halt stopp|halt halt"
)
"""Calls that are no part of a route: a text that begins or ends with one is a stop."""

CANCELLING = (
    "never mind|nevermind|forget it|forget that|cancel that|cancel it|cancel|abort|"
    "vergiss es|vergiss das|vergessen sie es|vergessen sie das|abbrechen|abbruch|"
    "no stop|no halt|no stopp|nope stop|nein stop|nein stopp|nein halt"
)
"""What takes back all that was said before it: a text that ends with it is a stop."""

LONGEST_END = 3
"""The most words of a phrase of `URGENT` or `CANCELLING`."""

CALLS = (
    "stop|stop it|stop now|stop here|stop moving|stop right now|stop at once|stop immediately|halt|"
    "freeze|don't move|do not move|that's enough|that is enough|that'll do|that will do|whoa there|"
    "watch out|look out|stopp|halt an|halte an|halten sie an|anhalten|sofort anhalten|"
    "bleib stehen|bleiben sie stehen|stehen bleiben|stehenbleiben|hör auf|höre auf|hören sie auf|"
    "aufhören|das reicht|es reicht|das genügt|nicht bewegen|vorsicht|achtung"
)
"""Calls that may also begin or end a route: "stop, turn left". These are a stop where they stand
alone, and where the rest is not understood."""

BESIDE = (
    "please|now|no|nope|ok|okay|hey|oh|ah|uh|um|right|immediately|at once|robot|spot|wheelchair|"
    "bitte|jetzt|nein|sofort|mal|doch|ach|äh|ähm|roboter|rollstuhl|einfach|i said|ich sagte"
)
"""What may stand beside a call."""


_BREAK = re.compile(r"[,;:.!?\n\u2013\u2014\u2026]+")


_TABLE = PhraseTable(
    {
        "call": CALLS.split("|"),
        "urgent": URGENT.split("|"),
        "cancel": CANCELLING.split("|"),
        "beside": BESIDE.split("|"),
    }
)

_DENIALS = {("no",), ("nope",), ("nein",)}
"""What belongs to the call behind it: "no, stop"."""


def is_stop(text: str) -> bool:
    """Whether a text is a call to stop, however the rest of it reads.

    It is one if it says nothing else, begins or ends with an urgent call, or is cancelled at its
    end.
    """
    parts = _parts(text)
    if not parts:
        return False
    before = parts[-2] if len(parts) > 1 and parts[-2] in _DENIALS else ()
    said_last = (*before, *parts[-1])
    ends = (said_last[at:] for at in range(max(0, len(said_last) - LONGEST_END), len(said_last)))
    return (
        (all(map(_is_said_beside, parts)) and any(map(_is_call, parts)))
        or _begins_with(parts[0]) == "urgent"
        or any(_begins_with(end) in ("urgent", "cancel") and _is_call(end) for end in ends)
    )


def begins_or_ends_with_stop(text: str) -> bool:
    """Whether a text begins with a call to stop that a sign parts from the rest, or ends with one.

    At the end it is a call only with an exclamation mark: "..., stop" is the end of a route.
    """
    parts = _parts(text)
    shouts = text.rstrip().endswith("!")
    return bool(parts) and (_is_call(parts[0]) or (shouts and _is_call(parts[-1])))


def _parts(text: str) -> list[Words]:
    """The words between the signs of a text."""
    return [words for words in map(plain_words, _BREAK.split(text)) if words]


def _is_call(words: Words) -> bool:
    """Whether words are calls to stop, with what may stand beside them, and nothing else."""
    labels = _TABLE.labels(words) or []
    return any(label != "beside" for label in labels)


def _is_said_beside(words: Words) -> bool:
    return _TABLE.labels(words) is not None


def _begins_with(words: Words) -> str | None:
    """The kind of the phrase with which words begin; None if there is none."""
    found = _TABLE.longest(words, 0)
    return None if found is None else str(found[1])
