"""The words of the picture in the language in which the robot was spoken to."""

from __future__ import annotations

from functools import lru_cache

from semnav_env.judge import Verdict
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.vocabulary.recognition import language_of_text

GERMAN: dict[str, str] = {
    "wheelchair": "Rollstuhl",
    "COMMAND": "AUFTRAG",
    "before": "davor",
    "more": "weitere",
    "contact": "Kontakt",
    "collisions": "Kollisionen",
    "LEGEND": "LEGENDE",
    "wall": "Wand",
    "door": "Tür",
    "outer corner": "Außenecke",
    "inner corner": "Innenecke",
    "potential corner": "mögliche Ecke",
    "corridor": "Flur",
    "lidar hit": "Lidarpunkt",
    "wall in memory": "gemerkte Wand",
    "door in memory": "gemerkte Tür",
    "door number": "Türnummer",
    "goal": "Ziel",
    "path so far": "bisheriger Weg",
    "true route": "wahrer Weg",
    "assumed wall": "vermutete Wand",
    "glass": "Glas",
    "door leaf": "Türblatt",
    "furniture": "Möbel",
    "person": "Person",
    "depth points": "Tiefenpunkte",
    "jamb found": "Türpfosten",
    Verdict.PENDING: "steht aus",
    Verdict.ACTIVE: "läuft",
    Verdict.DONE: "erledigt",
    Verdict.SKIPPED: "entfällt",
    Verdict.WRONG_DOOR: "falsche Tür",
    Verdict.WRONG_TURN: "falsch abgebogen",
    Verdict.STOPPED_SHORT: "zu früh angehalten",
    Verdict.INCOMPLETE: "unvollständig",
    Verdict.OUT_OF_TIME: "Zeit abgelaufen",
}
"""German for the labels and verdicts of the picture."""

PICTURE_WORDS: dict[str, dict[str, str]] = {"de": GERMAN}
"""Labels by the code of a language; other languages have the English ones."""


def label(text: str, language: str) -> str:
    """A label of the picture in a language, which is English if its words are not known."""
    return PICTURE_WORDS.get(language, {}).get(text, str(text))


@lru_cache(maxsize=64)
def spoken_language(text: str, language: str | None = None) -> Language:
    """The language in which a command was given; English if that cannot be told.

    Args:
        text: what was said.
        language: its code or name, if it is known.
    """
    try:
        return language_of_text(text, language)
    except CommandError:
        return language_of("en")
