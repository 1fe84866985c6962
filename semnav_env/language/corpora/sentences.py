"""Corpora of commands: texts with their meanings, or plain sentences."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from semnav_env.language.corpora.notation import Steps, read_meaning

KINDS = ("feasible", "ambiguous", "infeasible", "plain")
"""What a sentence is: "plain" is one without a meaning beside it."""


@dataclass(frozen=True)
class Sentence:
    """A command as somebody worded it.

    Attributes:
        id: its name in the corpus.
        text: the words.
        kind: one of `KINDS`.
        meanings: readings that count as right; none for infeasible and plain sentences.
        topic: what makes it interesting, in a word.
        corpus: the file's name without its suffix.
    """

    id: str
    text: str
    kind: str
    meanings: tuple[Steps, ...]
    topic: str
    corpus: str


def load_sentences(path: Path) -> list[Sentence]:
    """The sentences of a corpus: `.jsonl` with meanings, or one plain sentence a line.

    Raises:
        ValueError: a line is not as docs/guides/meanings.md says; the message names the line.
    """
    lines = path.read_text("utf-8").splitlines()
    read = _with_meaning if path.suffix == ".jsonl" else _plain
    found = []
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            found.append(read(line.strip(), f"{path.stem}-{number}", path.stem))
        except (ValueError, KeyError, TypeError) as error:
            raise ValueError(f"{path.name}, line {number}: {error}") from None
    return found


def _with_meaning(line: str, name: str, corpus: str) -> Sentence:
    row = json.loads(line)
    if row["kind"] not in KINDS:
        raise ValueError(f"kind is one of {', '.join(KINDS)}, not {row['kind']!r}")
    meanings = tuple(map(read_meaning, row["meaning"]))
    return Sentence(
        str(row.get("id", name)), row["text"], row["kind"], meanings, row.get("topic", ""), corpus
    )


def _plain(line: str, name: str, corpus: str) -> Sentence:
    return Sentence(name, line, "plain", (), "", corpus)
