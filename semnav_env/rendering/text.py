"""Text that always fits: unprintable characters are replaced and long lines wrapped."""

from __future__ import annotations

from collections.abc import Callable

MAX_PARAGRAPH_LENGTH = 400
"""Number of characters of a paragraph that are looked at; the rest becomes an ellipsis."""


def harmless(text: str) -> str:
    """A text on one line without characters that do not print (control, bidirectional)."""
    clipped = text[:MAX_PARAGRAPH_LENGTH] + ("…" if len(text) > MAX_PARAGRAPH_LENGTH else "")
    spaced = "".join(" " if c.isspace() else c if c.isprintable() else "\ufffd" for c in clipped)
    return " ".join(spaced.split())


def wrap(
    text: str, width: float, measure: Callable[[str], float], most: int = 6
) -> tuple[str, ...]:
    """Lines no wider than `width`; words that are too wide are cut.

    Args:
        text: any string.
        width: as `measure` gives it.
        measure: width of a string.
        most: lines; where there are more, the last ends in an ellipsis.
    """
    lines: list[str] = []
    for word in harmless(text).split(" "):
        if lines and measure(joined := f"{lines[-1]} {word}") <= width:
            lines[-1] = joined
        else:
            lines.extend(_pieces(word, width, measure))
    if len(lines) > most:
        lines = [*lines[: most - 1], _shortened(lines[most - 1], width, measure)]
    return tuple(lines)


def _pieces(word: str, width: float, measure: Callable[[str], float]) -> list[str]:
    pieces = [""]
    for character in word:
        if pieces[-1] and measure(pieces[-1] + character) > width:
            pieces.append("")
        pieces[-1] += character
    return pieces


def _shortened(line: str, width: float, measure: Callable[[str], float]) -> str:
    while line and measure(line + "…") > width:
        line = line[:-1]
    return line + "…"
