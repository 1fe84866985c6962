"""`python -m studies speech`: disturb sentences that are understood, and print what is left."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from semnav_env.language.corpora import ParseOutcome, load_sentences
from studies.corpora import learned_corpora
from studies.speech.robustness import (
    changed_commands,
    outcomes,
    slowest_parse,
    understood,
    with_fillers,
    without_punctuation,
)


@dataclass(frozen=True)
class Arguments:
    """Disturb the development sets, and parse canonical words and long texts.

    Attributes:
        programs: how many sampled programs are said and parsed in each language.
        seed: of the fillers and the programs.
    """

    programs: int = 1000
    seed: int = 0

    def run(self) -> int:
        """Print a table of what stays understood, and the other figures."""
        rng = np.random.default_rng(self.seed)
        print("| | sentences | understood | asked | wrong |\n|---|---|---|---|---|")
        for path in learned_corpora():
            corpus = load_sentences(path)
            right = understood(corpus)
            for name, disturbed in (
                ("one filler", with_fillers(right, rng)),
                ("no punctuation", without_punctuation(right)),
            ):
                _print(f"{path.stem}, {name}", outcomes(corpus, disturbed))
        print(f"slowest parse of a long text: {slowest_parse():.3f} s")
        changed = list(changed_commands(self.programs, rng))
        print(f"{len(changed)} of {2 * self.programs} canonical texts mean something else")
        for command, language in changed[:5]:
            print(f"  {command.say(language)}")
        return 0


def _print(name: str, found: dict[ParseOutcome, int]) -> None:
    total = max(sum(found.values()), 1)
    wrong = found[ParseOutcome.MISREAD] + found[ParseOutcome.ASKED_WRONGLY]
    kept, asked = found[ParseOutcome.UNDERSTOOD] / total, found[ParseOutcome.ASKED] / total
    print(f"| {name} | {total} | {kept:.3f} | {asked:.3f} | {wrong / total:.3f} |")
