"""Reads numbers in digits and in words."""

from __future__ import annotations

import re
from collections.abc import Sequence

from semnav_env.language.vocabulary.lexicon import Lexicon

_THOUSANDS = re.compile(r"\d{1,3}(?:[.,]\d{3})+")
_DIGITS = re.compile(r"\d+(?:[.,]\d+)?")


def read_number(words: Sequence[str], at: int, lexicon: Lexicon) -> tuple[float, int] | None:
    """The number that begins at a word, and the number of the word behind it; None if none does."""
    if at >= len(words):
        return None
    if _DIGITS.fullmatch(words[at]) or _THOUSANDS.fullmatch(words[at]):
        return _in_digits(words[at], lexicon.language.decimal), at + 1
    found = lexicon.find(words, at, "number")
    return _with_decimals(words, float(found[0]), found[1], lexicon) if found else None


def _with_decimals(
    words: Sequence[str], value: float, at: int, lexicon: Lexicon
) -> tuple[float, int]:
    """A number with what follows it: "one point five", "a hundred and twenty"."""
    if point := lexicon.find(words, at, "decimal point"):
        digit = lexicon.find(words, point[1], "number")
        if digit and float(digit[0]) < 10:
            return value + float(digit[0]) / 10, digit[1]
    if value == 100:
        conjunction = lexicon.find(words, at, "and")
        more = lexicon.find(words, conjunction[1] if conjunction else at, "number")
        if more and 1 < float(more[0]) < 100:
            return value + float(more[0]), more[1]
    return value, at


def _in_digits(text: str, decimal: str) -> float:
    """A number in digits; three digits behind the sign that is not the decimal one are thousands.

    So "1.000" is a thousand in German and one in English, and "1,5" is one and a half in both.
    """
    other = "," if decimal == "." else "."
    if re.fullmatch(rf"\d{{1,3}}(?:\{other}\d{{3}})+", text):
        return float(text.replace(other, ""))
    return float(text.replace(",", "."))
