"""`read`: a text to its ranked commands, with the probability that it is none of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from semnav_agents.translating.interpreter import DoubtLimits
from semnav_agents.translating.network import load_translator
from semnav_agents.translating.translator import translate
from semnav_env.language.command import Command
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.question import AmbiguousCommandError, Question
from semnav_env.language.speech.recognition import language_of_text
from studies.chart_reader.measuring import LIMITS, Limits
from studies.chart_reader.ranker import features_of, probabilities, text_features, weights
from studies.chart_reader.reader import candidates, chart_of

MAX_WORDS = 150
"""The most words and signs that are read; it bounds the time."""


@dataclass(frozen=True)
class RankedCommand:
    """A command that a text may mean, and its probability.

    Commands that lead to the same by the rules of docs/commands.md count together.
    """

    command: Command
    probability: float


@dataclass(frozen=True)
class Reading:
    """What a text may mean.

    Attributes:
        ranked: commands, the likeliest first.
        none: the probability that it is none of these.
    """

    ranked: tuple[RankedCommand, ...]
    none: float


def read(text: str, language: str | None = None, rooms: Sequence[str] = ()) -> Reading:
    """The commands that a text may mean.

    Args:
        text: the words.
        language: code or name; None to recognise it.
        rooms: the names of the rooms of the floor plan.

    Raises:
        CommandError: the text is empty or too long.
    """
    spoken: Language = language_of(language) if language else language_of_text(text, None)
    chart = chart_of(text, spoken.code, rooms)
    if not 0 < len(chart.at) <= MAX_WORDS:
        raise CommandError(f"a command has 1 to {MAX_WORDS} words and signs, not {len(chart.at)}")
    found = candidates(chart)
    rows = [*features_of(found), text_features(chart, text, found)]
    chances = probabilities(rows, weights(spoken.code))
    groups: dict[object, RankedCommand] = {}
    for candidate, chance in zip(found, map(float, chances), strict=False):
        if candidate.command is None:
            continue
        form = _form(candidate.command)
        known = groups.get(form, RankedCommand(candidate.command, 0.0))
        groups[form] = RankedCommand(known.command, known.probability + chance)
    ranked = sorted(groups.values(), key=lambda each: -each.probability)
    return Reading(tuple(ranked), 1.0 - sum(each.probability for each in ranked))


def _form(command: Command) -> object:
    """What is the same for commands that lead to the same."""
    try:
        return normal(meaning_of(command))
    except TypeError:  # a search has no step in the notation
        return command


def understand(
    text: str, language: str | None = None, rooms: Sequence[str] = (), limits: Limits = LIMITS
) -> Command:
    """The command that a text means, like `semnav_env.language.parse`.

    Raises:
        AmbiguousCommandError: two are likely, or one is not likely enough.
        CommandError: none is likely.
    """
    reading = read(text, language, rooms)
    first = reading.ranked[0] if reading.ranked else None
    if first is None or reading.none > limits.refuse or first.probability < limits.ask:
        raise CommandError("this is not understood as a command", text[:200])
    if first.probability >= limits.act:
        return first.command
    asked = tuple(each.command for each in reading.ranked[:2])
    spoken = language_of(language) if language else language_of_text(text, None)
    again = partial(understand, language=language, rooms=rooms, limits=limits)
    raise AmbiguousCommandError(text, Question(asked, spoken, again))


LEAST_CONFIRMED = 0.5
"""Probability from which on a reading is acted on if the translator takes it for likely."""


def understand_with_doubt(
    text: str, language: str | None = None, rooms: Sequence[str] = (), limits: Limits = LIMITS
) -> Command:
    """As `understand`, but a less likely reading is acted on if a learned translator agrees.

    Raises:
        AmbiguousCommandError: as `understand`, and the translator doubts the reading.
        CommandError: none is likely.
    """
    try:
        return understand(text, language, rooms, limits)
    except AmbiguousCommandError as error:
        first = read(text, language, rooms).ranked[0]
        if first.probability >= LEAST_CONFIRMED and _is_confirmed(text, rooms, first.command):
            return first.command
        raise error from None


def _is_confirmed(text: str, rooms: Sequence[str], command: Command) -> bool:
    """Whether the translator takes a command for as likely as `LearnedInterpreter` asks for."""
    translated = translate(text, rooms, load_translator())
    likeness = translated.likeness_of(command) if translated else None
    return likeness is not None and likeness >= DoubtLimits().acting
