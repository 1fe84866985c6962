"""From a text to the commands that it can mean, by the speech parser."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise, product

from semnav_env.language.clause_readings import ClauseReadings
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.command_readings import commands_of
from semnav_env.language.one_reading import OutOfPlaceError
from semnav_env.language.references import Side
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.reader import ItemReader
from semnav_env.language.speech.rewriting import rewritten
from semnav_env.language.speech.segmentation import MAX_PARTS, ClauseSegmentation, Parting, close
from semnav_env.language.speech.told_distances import (
    problem_of_distance,
    with_amounts,
    with_backing_up,
    with_offsets,
)
from semnav_env.language.speech.unread import without_unread


@dataclass(frozen=True)
class Understanding:
    """What a text was taken for.

    Attributes:
        commands: every command that it can mean, the likeliest first; empty if it has no meaning.
        cost: of the best way to read it; 0 for nothing to do.
        items: what it was read as.
        reached: the item up to which it was understood.
        part: the command that its beginning means.
        problem: why it was refused, with the words' numbers; None if they do not fit together.
    """

    commands: tuple[Command, ...]
    cost: float
    items: tuple[Item, ...]
    reached: int = 0
    problem: tuple[str, int, int] | None = None
    part: tuple[Command, ...] = ()


def understand(
    words: Sequence[str],
    lexicon: SpeechLexicon,
    names: Mapping[tuple[str, ...], str],
    *,
    leave_out: bool = False,
) -> Understanding:
    """What the words of a text mean.

    Args:
        words: of a normalised text.
        lexicon: of its language.
        names: the words of each room's name, and the name.
        leave_out: leave out unknown words where they can say nothing of the way.
    """
    found = []
    for exact, waits in _variants(words):
        reader = ItemReader(words, lexicon, names, exact, waits)
        first = reader.items()
        texts: list[list[Item] | None] = [first]
        if reader.nouns.memory.went_on and not any(item.kind in _BACK for item in first):
            again = ItemReader(words, lexicon, names, exact, waits)
            again.nouns.memory.counts_on = True
            texts.append(again.items())
        if reader.nouns.memory.passed:
            texts.append(_passed_on_side(first, reader.nouns.memory.passed))
        if leave_out:
            texts = [without_unread(items or [], words, lexicon) for items in texts]
        read = (
            _understand(words, items, lexicon, loose=leave_out)
            for items in texts
            if items is not None
        )
        found += [replace(each, cost=each.cost + (0.0 if exact else SIDE_COST)) for each in read]
    if not found:
        return Understanding((), 0.0, ())
    right = [each for each in found if each.commands]
    if not right:
        return max(found, key=lambda each: each.reached)
    best = min(right, key=lambda each: each.cost)
    near = [each for each in right if each.cost <= best.cost + 0.4]
    commands = dict.fromkeys(command for each in [best, *near] for command in each.commands)
    return Understanding(tuple(commands), best.cost, best.items)


QUESTION = "a question is not a command"
"""Why a text that ends with a question mark is refused."""

SIDE_COST = 0.05
"""Cost of taking "right" before a preposition for a side: "right in the doorway"."""

_BACK = (ItemKind.NO, ItemKind.NOT)
"""Items that take something back, so that nothing is counted on."""


def _variants(words: Sequence[str]) -> list[tuple[bool, bool]]:
    """Which words are read in both ways: "right" as exactly, "wait" as a correction."""
    exact = (True, False) if "right" in words else (True,)
    waits = (
        (True, False)
        if {"wait", "warte", "halt", "stay", "hold", "hang", "moment"} & set(words)
        else (True,)
    )
    return list(product(exact, waits))


def _passed_on_side(items: Sequence[Item], passed: Mapping[Noun, Side]) -> list[Item]:
    """Of "Pass two doors, then the third on the left": only those on the left are counted."""
    return [
        replace(item, value=replace(item.value, side=passed[item.value]))
        if isinstance(item.value, Noun) and item.value in passed
        else item
        for item in items
    ]


def _understand(
    words: Sequence[str], found: Sequence[Item], lexicon: SpeechLexicon, loose: bool = False
) -> Understanding:
    asks = bool(found) and found[-1].value == "?"
    if asks and not any(item.kind is ItemKind.COULD_YOU for item in found):
        return Understanding(
            (),
            0.0,
            tuple(found),
            0,
            (QUESTION, found[-1].start, found[-1].stop),
        )
    items = with_amounts(with_offsets(rewritten(found), words), words, lexicon)
    items = with_backing_up(items, words, lexicon)
    if told := problem_of_distance(items, words):
        return Understanding((), 0.0, tuple(items), 0, told)
    while items and items[-1].kind in (ItemKind.NO, ItemKind.SIGN):
        items.pop()
    segmentation = ClauseSegmentation(items, loose)
    partings = segmentation.best()
    commands: dict[Command, None] = {}
    problem = segmentation.problem or _too_long(segmentation)
    for way in close(partings) if partings else ():
        try:
            commands |= dict.fromkeys(_commands(way, words))
        except OutOfPlaceError as error:
            at = way.clauses[error.index]
            problem = problem or (str(error), at.start, at.stop)
        except ValueError as error:
            problem = problem or (str(error), 0, len(words))
    cost = partings[0].cost if partings else 0.0
    part = () if commands else _beginning(segmentation, words)
    return Understanding(tuple(commands), cost, tuple(items), segmentation.reached, problem, part)


def _beginning(segmentation: ClauseSegmentation, words: Sequence[str]) -> tuple[Command, ...]:
    """The command of the longest beginning of a text that has a meaning."""
    for way in segmentation.beginnings():
        try:
            if found := _commands(way, words):
                return found[:1]
        except ValueError:
            continue
    return ()


def _too_long(segmentation: ClauseSegmentation) -> tuple[str, int, int] | None:
    """Why a text with too many clauses is refused, pointing at the first that is too many."""
    longest = next(segmentation.beginnings(), None)
    if longest is None:
        return None
    counted = list(accumulate(max(1, each.longest) for each in longest.clauses))
    if counted[-1] <= MAX_CLAUSES:
        return None
    more = "at least " if len(longest.clauses) == MAX_PARTS else ""
    problem = f"the command has {more}{counted[-1]} clauses; at most {MAX_CLAUSES} are carried out"
    ninth = next(n for n, count in enumerate(counted) if count > MAX_CLAUSES)
    return problem, longest.clauses[ninth].start, longest.clauses[ninth].stop


def _commands(way: Parting, words: Sequence[str]) -> tuple[Command, ...]:
    if not way.clauses:
        return ()
    return commands_of(_apart(way.clauses, words))


def _apart(found: Sequence[ClauseReadings], words: Sequence[str]) -> list[ClauseReadings]:
    """Decide what a bare "left" means: the side of a door that has none, or a turn."""
    apart = [found[0].without_sides()]
    for before, each in pairwise(found):
        apart.append(
            each
            if (before.wants_side or not each.without_sides().readings)
            and list(words[before.stop : each.start]) == [","]
            else each.without_sides()
        )
    return apart
