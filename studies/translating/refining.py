"""`python -m studies refine`: let the translator go on learning when there are new authors.

It learns mostly from the authors who are new to it. What it says of the texts that it knows is its
own teacher, so that it forgets little (Li and Hoiem 2016).
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from pathlib import Path

from semnav_env.language.translating.network import (
    TRAINED_FOLDER,
    TranslatorShape,
    load_translator,
)
from semnav_env.networks.card import Card
from studies.corpora import learned_corpora
from studies.translating.arrays import TextArrays
from studies.translating.command import CORPORA, Recipe, names_of, write_translator
from studies.translating.training import TranslatorTraining, encoded_texts, trained

NEW, KNOWN = Recipe(), Recipe(variants=2, generated=200)
"""What is made of the texts of new authors, and of those from whom it has learned before."""

REFINED = "refined"
"""What the card calls the times when it has gone on, the first one first."""


def _refinement() -> TranslatorTraining:
    return TranslatorTraining(steps=5000, batch=64, rate=4e-4, warm_up=100)


@dataclass(frozen=True)
class Arguments:
    """Let a translator go on learning; most of the texts are of the authors who are new to it.

    Attributes:
        begin: folder of the translator that goes on.
        out: folder to which the files are written; by default that of the package.
        training: of the network.
    """

    begin: Path = TRAINED_FOLDER
    out: Path = TRAINED_FOLDER
    training: TranslatorTraining = field(default_factory=_refinement)

    def run(self) -> int:
        """Refine it."""
        begun, card = load_translator(self.begin), Card.read(self.begin, TranslatorShape)
        corpora = learned_corpora()
        known = [path for path in corpora if path.name in card.preset[CORPORA]]
        new = [path for path in corpora if path not in known]
        if not new:
            raise ValueError(f"the translator in {self.begin} knows all authors already")
        before, after = encoded_texts(KNOWN.texts(known)), encoded_texts(NEW.of_authors(new))
        texts = TextArrays.of([*before, *after], begun.shape)
        network = trained(texts, self.training, card.seed, [begun], begun, len(before))
        step = {"new": names_of(new), "training": asdict(self.training)}
        refined = [*card.preset.get(REFINED, ()), step]
        preset = card.preset | {CORPORA: names_of(corpora), REFINED: refined}
        write_translator(self.out, network, preset, card.seed)
        print(f"wrote {self.out}")
        return 0
