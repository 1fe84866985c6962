"""Loads the languages of commands, each from a file beside this one."""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files

from semnav_env.language.language import Language
from semnav_env.language.words import fold, pieces


def load(name: str) -> Language:
    """The language in `name.json` beside this file."""
    folder = files("semnav_env.language")
    table = json.loads((folder / f"{name}.json").read_text("utf-8"))
    same_as = table["same_as"]
    ordinals, from_end = (tuple(map(tuple, table[key])) for key in ("ordinals", "from_end"))
    numbers = {_plain(words, same_as): value for words, value in table["numbers"].items()}
    return Language(
        name=name,
        code=table["code"],
        ordinals=ordinals,
        from_end=from_end,
        other=table["other"],
        numbers=numbers,
        decimal=table["decimal"],
        punctuation=table["punctuation"],
        same_as=same_as,
        phrases=table["phrases"],
        answers={key: tuple(words) for key, words in table["answers"].items()},
        wordings={key: tuple(words) for key, words in table["wordings"].items()},
        told=table.get("told", {}),
    )


def _plain(words: str, same_as: dict[str, str]) -> str:
    return " ".join(piece.text for piece in pieces(fold(words.casefold(), same_as)))


@cache
def english() -> Language:
    """English, read at the first call."""
    return languages()["en"]


@cache
def languages() -> dict[str, Language]:
    """All languages by their code."""
    folder = files("semnav_env.language")
    stems = sorted(file.name[:-5] for file in folder.iterdir() if file.name.endswith(".json"))
    loaded = [load(stem) for stem in stems]
    return {language.code: language for language in loaded}


def language_of(language: str | Language) -> Language:
    """The language with a code or a name, such as "de" or "german".

    Raises:
        ValueError: there is no such language; the message lists the languages.
    """
    if isinstance(language, Language):
        return language
    for known in languages().values():
        if language in (known.code, known.name):
            return known
    there = ", ".join(f"{known.code} ({known.name})" for known in languages().values())
    raise ValueError(f"no language {language!r}; there are: {there}")
