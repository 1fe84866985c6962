"""`python -m studies said`: how many natural wordings of the suite `villa_find` are carried out."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from semnav_agents.evaluation.runner import run_suite
from semnav_agents.evaluation.suites import suite
from semnav_env.language import Command, LearnedInterpreter, parse
from semnav_env.language.corpora import ParseOutcome, Sentence, SentenceVerdict
from semnav_env.language.corpora.meanings import meaning_of
from semnav_env.language.corpora.measure import judge
from semnav_env.world.maps import load_floor_plan
from studies.sheets import Cell, ResultSheet

TEXTS = Path(__file__).parent / "finding.jsonl"
"""Six wordings of each command of the suite, half of them German. They were frozen before any was
read, and nothing was learned from them; names of rooms were added after they had been read."""

SUITE, AGENT = "villa_find", "finder"


class SaidCommand(NamedTuple):
    """A wording: of which command of the suite, in which language, and the words."""

    command: str
    language: str
    text: str


@dataclass(frozen=True)
class Arguments:
    """Read commands to find people in people's words, and drive those that are understood.

    A wording that is understood is the same command as in the suite, so it is driven like that:
    each command of the suite once.

    Attributes:
        drive: seeds with which to drive each command of the suite; 0 to read alone.
        first_seed: the first of them.
        robot: wheelchair or spot.
        show: also print the wordings that are not understood.
        json: print as JSON.
    """

    drive: int = 0
    first_seed: int = 5
    robot: str = "spot"
    show: bool = False
    json: bool = False

    def run(self) -> int:
        """Read, drive, and print the counts."""
        if self.drive < 0:
            raise ValueError(f"drive is {self.drive}; it must be 0 or more")
        said = said_commands()
        judged = list(verdicts(said))
        shares = self._driven() if self.drive else {}
        sheet = counts(said, judged, shares)
        print(json.dumps(sheet.records()) if self.json else sheet.markdown())
        for one, verdict in zip(said, judged, strict=True):
            if self.show and verdict.outcome is not ParseOutcome.UNDERSTOOD:
                print(f"{verdict.outcome}: {one.text!r} ({one.command}): {verdict.answer}")
        return 0

    def _driven(self) -> dict[str, float]:
        """Share of the drives of each command that succeeded."""
        seeds = range(self.first_seed, self.first_seed + self.drive)
        done: dict[str, list[bool]] = {}
        for result in run_suite(suite(SUITE), AGENT, self.robot, seeds):
            done.setdefault(result.command, []).append(result.metrics.success)
        return {command: sum(each) / len(each) for command, each in done.items()}


def said_commands() -> list[SaidCommand]:
    """All wordings."""
    lines = map(json.loads, TEXTS.read_text("utf-8").splitlines())
    return [SaidCommand(**line) for line in lines]


def verdicts(said: Sequence[SaidCommand]) -> Iterator[SentenceVerdict]:
    """What becomes of each wording, in the villa."""
    rooms = load_floor_plan(suite(SUITE)[0].floor_plan).room_names
    for number, one in enumerate(said):
        meaning = meaning_of(parse(one.command, rooms=rooms))
        sentence = Sentence(str(number), one.text, "feasible", (meaning,), "find", TEXTS.stem)
        yield judge(sentence, rooms, _understood)


def _understood(text: str, language: str | None, rooms: Sequence[str]) -> Command:
    return LearnedInterpreter(language, rooms).interpret(text).command


def counts(
    said: Sequence[SaidCommand], judged: Sequence[SentenceVerdict], driven: dict[str, float]
) -> ResultSheet:
    """The counts of each language.

    Args:
        said: the wordings.
        judged: what became of each.
        driven: share of the drives of a command that succeeded; empty if nothing was driven.
    """
    rows: list[tuple[Cell, ...]] = []
    for language, name in (("en", "English"), ("de", "German")):
        own = [(s, v.outcome) for s, v in zip(said, judged, strict=True) if s.language == language]
        numbers = [sum(outcome is each for _, outcome in own) for each in ParseOutcome]
        right = [s.command for s, outcome in own if outcome is ParseOutcome.UNDERSTOOD]
        done = sum(driven[c] for c in right) / len(own) if driven and own else float("nan")
        rows.append((name, len(own), *numbers, done))
    columns = ("language", "n", *(each.value for each in ParseOutcome), "done, share")
    return ResultSheet("Commands to find people in people's words", columns, rows)
