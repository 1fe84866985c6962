"""The texts from which the translator learns: people's, disturbed, and the generator's.

A text has a command, or None if it is to be refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from semnav_env.judge.episodes import load_episodes
from semnav_env.language.clauses import IfThere, Turning
from semnav_env.language.command import MAX_CLAUSES, Command, room_of
from semnav_env.language.corpora import Sentence, load_sentences
from semnav_env.language.corpora.measure import rooms_in
from semnav_env.language.declarations import Spoken, field_names
from semnav_env.language.errors import CommandError
from semnav_env.language.languages import english
from semnav_env.language.normalise import normalise
from semnav_env.language.references import (
    ENTRY,
    OTHER,
    DoorReference,
    DoorRelation,
    PlaceReference,
    Side,
)
from semnav_env.language.rewording import paraphrases
from semnav_env.language.rooms import plain_name
from semnav_env.language.sampling import sample_command
from studies.speech.robustness import FILLERS, PUNCTUATION
from studies.translating.corrections import with_correction
from studies.translating.infeasible import infeasible
from studies.translating.programs import command_of_meaning
from studies.translating.synonyms import with_synonyms

JOINTS = {
    "en": (", then ", " and then ", " and ", ". ", ", ", ", after that ", " then "),
    "de": (", dann ", " und dann ", " und ", ". ", ", ", ", danach ", " dann "),
}
"""Words between two texts that are said one after the other."""


SUPERSEDED = {
    *(("04_german", "d-de-159"), ("23_english", "twenty-third-en-195")),
    *(("23_german", "twenty-third-de-195"), ("42_english", "fortysecond-en-279")),
    *(("46_german", "fortysixth-de-207"), ("56_english", "en-080"), ("56_german", "de-079")),
    ("56_english", "en-141"),
}
"""Files and names of texts that were infeasible before a robot could look for people."""

JOINED = 0.35
"""Probability that another text follows, behind each text."""


@dataclass(frozen=True)
class TrainingText:
    """A text with what it means.

    Attributes:
        text: the words.
        language: its code.
        rooms: the names of the rooms that there are.
        commands: the commands that count as right; none if the text is to be refused.
        topic: as in the corpus.
    """

    text: str
    language: str
    rooms: tuple[str, ...]
    commands: tuple[Command, ...]
    topic: str = ""


def authored(path: Path) -> list[TrainingText]:
    """The texts of a corpus, without those that are too long to be read.

    Of a feasible one the first meaning that is a command counts.
    """
    sentences = [each for each in load_sentences(path) if (each.corpus, each.id) not in SUPERSEDED]
    rooms = tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))
    return [_authored(each, rooms) for each in sentences if _is_readable(each.text)]


def _is_readable(text: str) -> bool:
    try:
        normalise(text, english())
    except CommandError:
        return False
    return True


def _authored(sentence: Sentence, rooms: tuple[str, ...]) -> TrainingText:
    meant = [command_of_meaning(meaning) for meaning in sentence.meanings]
    commands = tuple(command for command in meant if command is not None)
    if sentence.kind == "feasible":
        commands = commands[:1]
    language = "de" if "german" in sentence.corpus else "en"
    return TrainingText(sentence.text, language, rooms, commands, sentence.topic)


def of_episodes(split: str) -> Iterator[TrainingText]:
    """The texts of frozen episodes."""
    for episode in load_episodes(split):
        rooms = episode.plan().room_names if room_of_any(episode.programs[0]) else ()
        yield TrainingText(episode.command, episode.language, rooms, episode.programs[:1])


def room_of_any(command: Command) -> str | None:
    """The first room that a command names."""
    return next(filter(None, map(room_of, command.clauses)), None)


def generated(
    known: Sequence[TrainingText], count: int, rng: np.random.Generator
) -> Iterator[TrainingText]:
    """The generator's paraphrases, half of sampled commands, half of people's with other values."""
    commands = [command for each in known for command in each.commands]
    made = 0
    while made < count:
        if made % 8 < 4:
            command = sample_command(rng, int(rng.integers(1, 7)), 5)
        else:
            command = _revalued(commands[int(rng.integers(len(commands)))], rng)
        language = ("en", "de")[int(rng.integers(2))]
        rooms = tuple(filter(None, map(room_of, command.clauses)))
        texts = (command.say(language), *paraphrases(command, rng, 3, language))
        for text in texts:
            yield TrainingText(text.replace('"', ""), language, rooms, (command,))
        made += len(texts)


def _revalued(command: Command, rng: np.random.Generator) -> Command:
    """The same command with other ordinals, and perhaps with left for right."""
    command = _mirrored_command(command) if rng.integers(2) else command
    return Command(tuple(_recounted(each, rng) for each in command.clauses))


def _recounted(value: Any, rng: np.random.Generator) -> Any:
    """A clause or a part of one with other ordinals than the first, from the end or not."""
    counted = isinstance(value, DoorReference | PlaceReference)
    if counted and value.ordinal not in (1, OTHER, ENTRY):
        ordinal = (2, 3, 4, 5, -1, -2)[int(rng.integers(6))]
        beside = isinstance(value, DoorReference) and value.relation is DoorRelation.AT
        return value if beside and ordinal < 0 else replace(value, ordinal=ordinal)
    return _changed(value, lambda part: _recounted(part, rng))


def _changed(value: Any, change: Callable[[Any], Any]) -> Any:
    """A clause or a part of one with each of its fields changed; other values as they are."""
    return _with_parts(value, change) if isinstance(value, Spoken) else value


def _with_parts(value: Any, change: Callable[[Any], Any]) -> Any:
    parts = {name: change(getattr(value, name)) for name in field_names(type(value))}
    return replace(value, **parts)


def disturbed(
    known: Sequence[TrainingText], count: int, rng: np.random.Generator
) -> Iterator[TrainingText]:
    """Variants of texts: each with one of its meanings, perhaps joined to others, and changed."""
    by_language = {code: [t for t in known if t.language == code] for code in FILLERS}
    for number in range(count):
        base = _with_one_meaning(known[number % len(known)], rng)
        others = by_language[base.language]
        while rng.random() < JOINED:
            base = joined(base, others[int(rng.integers(len(others)))], rng) or base
        for share, change in CHANGES:
            if rng.random() < share and _is_readable(base.text):
                base = change(base, rng)
        yield base


def _with_one_meaning(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    """The text with one of the commands that it may mean, each as often as the others."""
    if len(text.commands) < 2:
        return text
    return replace(text, commands=(text.commands[int(rng.integers(len(text.commands)))],))


def joined(
    first: TrainingText, second: TrainingText, rng: np.random.Generator
) -> TrainingText | None:
    """Both texts, one after the other; None if that means something else than both."""
    joint = JOINTS[first.language][int(rng.integers(len(JOINTS[first.language])))]
    text = first.text.rstrip(PUNCTUATION + " ") + joint + second.text[:1].lower() + second.text[1:]
    rooms = tuple(dict.fromkeys((*first.rooms, *second.rooms)))
    if not first.commands or not second.commands:
        return replace(first, text=text, rooms=rooms, commands=())
    clauses = (*first.commands[0].clauses, *second.commands[0].clauses)
    conditional = any(isinstance(each, IfThere) for each in clauses)
    if conditional or len(clauses) > MAX_CLAUSES or second.topic in ("correction", "ellipsis"):
        return None
    return replace(first, text=text, rooms=rooms, commands=(Command(clauses),))


def _with_filler(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    words = text.text.split()
    fillers = FILLERS[text.language]
    words.insert(int(rng.integers(len(words) + 1)), fillers[int(rng.integers(len(fillers)))])
    return replace(text, text=" ".join(words))


def _with_synonyms(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    return replace(text, text=with_synonyms(text.text, text.language, rng))


def _with_correction(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    changed = with_correction(text.text, text.language, rng)
    return text if changed is None else replace(text, text=changed)


def _infeasible(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    changed = infeasible(text.text, text.language, rng)
    return text if changed is None else replace(text, text=changed, commands=())


def _without_punctuation(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    del rng
    plain = text.text.translate(str.maketrans("", "", PUNCTUATION)).lower()
    return replace(text, text=plain or text.text)


def _with_slip(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    """A letter of a long word is left out, or changes places with the next one."""
    words = text.text.split()
    at = int(rng.integers(len(words)))
    word = words[at]
    if len(word) > 4 and word.isalpha():
        k = int(rng.integers(1, len(word) - 1))
        words[at] = (
            word[:k]
            + (word[k + 1] + word[k] if rng.random() < 0.5 else "")
            + (word[k + 2 :] if rng.random() < 0.5 else word[k + 1 :])
        )
    return replace(text, text=" ".join(words))


_SIDE = re.compile(r"\b(left|right|links|rechts|linke|rechte)(?=\b|[nrsm]\b)", re.IGNORECASE)
_SWAPPED = {"left": "right", "right": "left"}

_MIRROR = {
    **{"left": "right", "right": "left", "links": "rechts", "rechts": "links"},
    **{"linke": "rechte", "rechte": "linke"},
}


def _mirrored(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    """Left for right in words and commands, unless "right" may mean something else."""
    del rng
    if text.topic == "right" or ("right" in text.text.lower() and not text.commands):
        return text
    said = _SIDE.sub(lambda found: _MIRROR[found[0].lower()], text.text)
    return replace(text, text=said, commands=tuple(map(_mirrored_command, text.commands)))


def _mirrored_command(command: Command) -> Command:
    return Command(tuple(map(_swapped, command.clauses)))


def _swapped(value: Any) -> Any:
    """A clause or a part of one with left for right."""
    if isinstance(value, Side | Turning):
        return type(value)(_SWAPPED.get(value, value))
    return _changed(value, _swapped)


def _without_room(text: TrainingText, rng: np.random.Generator) -> TrainingText:
    """One of its rooms is none of the building, so the text is to be refused."""
    named = [name for command in text.commands for c in command.clauses if (name := room_of(c))]
    if not named:
        return text
    missing = named[int(rng.integers(len(named)))]
    others = tuple(each for each in text.rooms if plain_name(each) != missing)
    return replace(text, rooms=others, commands=())


CHANGES: tuple[tuple[float, Callable[[TrainingText, np.random.Generator], TrainingText]], ...] = (
    (0.3, _mirrored),
    (0.5, _with_synonyms),
    (0.06, _with_correction),
    (0.04, _infeasible),
    (0.06, _without_room),
    (0.3, _with_filler),
    (0.15, _with_filler),
    (0.4, _without_punctuation),
    (0.15, _with_slip),
)
"""The share of the variants that are changed, and how."""
