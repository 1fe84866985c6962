"""The studies of natural wordings and of somebody found by voice."""

from __future__ import annotations

import math
from collections import Counter

import pytest

from semnav_agents.evaluation.suites import suite
from semnav_env.language.corpora import ParseOutcome, Sentence, SentenceVerdict
from studies.__main__ import STUDIES
from studies.said.command import SUITE, SaidCommand, counts, said_commands
from studies.voices.command import VoiceDrive, figures


def test_each_command_of_the_suite_has_three_wordings_in_each_language() -> None:
    told = Counter((each.command, each.language) for each in said_commands())
    commands = {trial.command for trial in suite(SUITE)}
    assert told == {(command, code): 3 for command in commands for code in ("en", "de")}


def test_a_wording_is_done_if_it_is_understood_and_its_drive_succeeds() -> None:
    said = [SaidCommand(command, "en", command) for command in ("a", "b", "c", "d")]
    outcomes = [ParseOutcome.UNDERSTOOD] * 2 + [ParseOutcome.ASKED, ParseOutcome.MISREAD]
    judged = [
        SentenceVerdict(Sentence("0", each.text, "feasible", (), "find", "x"), outcome, ())
        for each, outcome in zip(said, outcomes, strict=True)
    ]
    [english, _] = counts(said, judged, {"a": 1.0, "b": 0.5, "c": 1.0, "d": 1.0}).records()
    assert (english["n"], english["understood"], english["misread"]) == (4, 2, 1)
    assert english["done, share"] == pytest.approx(1.5 / 4)


def test_a_place_agrees_with_its_deviation_within_two_of_them() -> None:
    usual = VoiceDrive(0, True, 0.5, 0.3, True, True, 2, 0, 30.0)
    off = VoiceDrive(1, True, 1.5, 0.3, False, False, 4, 1, 90.0)
    silent = VoiceDrive(2, False, math.nan, math.nan, False, False, 1, 0, 20.0)
    [row] = figures({"by voice alone": [usual, off, silent]}).records()
    assert row["heard"] == "2 of 3"
    assert (row["placed by voice"], row["met"], row["contacts"]) == (2, 1, 1)
    assert row["error, m, median"] == pytest.approx(1.0)
    assert row["within 2 std"] == 0.5


@pytest.mark.parametrize("words", [["said", "--drive", "-1"], ["voices", "--houses", "0"]])
def test_counts_that_cannot_be_are_refused(words: list[str]) -> None:
    assert STUDIES.main(words) == 2
