"""`python -m studies translator`: train the translator.

Three teachers learn first, each without a quarter of the authors. The translator learns from all
authors and from what the teachers say together. What a teacher makes of the authors whom it does
not know is shown by `python -m studies limits`.

`python -m studies refine` lets it go on learning when there are new authors.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import groupby, islice
from pathlib import Path
from typing import Any

import numpy as np

from semnav_env.language.translating.network import (
    TRAINED_FOLDER,
    TranslatorNetwork,
    load_translator,
)
from semnav_env.networks.card import CARD_FILE, Card
from semnav_env.networks.weights import save_weights
from studies.corpora import author_of, learned_corpora
from studies.translating.arrays import TextArrays
from studies.translating.texts import TrainingText, authored, disturbed, generated, of_episodes
from studies.translating.training import TranslatorTraining, encoded_texts, trained

TEACHERS = 3

TEACHING = TranslatorTraining(steps=3700, dropout=0.12)
"""How a teacher is trained; the device is that of the translator's training."""

TEACHERS_FOLDER = Path("out/teachers")

FIRST_STRANGER = 11
"""The first author with whose texts the lexicon was not written; all teachers know those before."""


CORPORA = "corpora"
"""What the card calls the files from which a translator has learned."""


def names_of(corpora: Sequence[Path]) -> list[str]:
    """The names of files, as a card has them."""
    return [path.name for path in corpora]


def write_translator(
    out: Path, network: TranslatorNetwork, preset: dict[str, Any], seed: int
) -> None:
    """Write the files of a translator to a folder, the weights in half precision."""
    halves = {name: array.astype(np.float16) for name, array in network.tensors.items()}
    save_weights(out, halves)
    Card(network.shape, preset, seed).write(out)


@dataclass(frozen=True)
class Recipe:
    """What a translator learns from, beside the commands of the split for training.

    Attributes:
        variants: of each text of an author.
        generated: paraphrases of the generator for each author, half of them of the commands that
            the author wrote.
        seed: of the weights and the order. The texts are the same for every seed, so that teachers
            and translator learn from the same ones.
        training: of the network.
    """

    variants: int = 12
    generated: int = 1200
    seed: int = 0
    training: TranslatorTraining = field(default_factory=TranslatorTraining)

    def train(
        self, corpora: Sequence[Path], out: Path, teachers: Sequence[TranslatorNetwork] = ()
    ) -> None:
        """Train a translator on the texts of corpora, and write its files to a folder."""
        texts = TextArrays.of(encoded_texts(self.texts(corpora)), self.training.shape)
        network = trained(texts, self.training, self.seed, teachers)
        write_translator(out, network, asdict(self) | {CORPORA: names_of(corpora)}, self.seed)

    def texts(self, corpora: Sequence[Path]) -> Iterator[TrainingText]:
        """All texts from which the network learns."""
        yield from of_episodes("train")
        yield from self.of_authors(corpora)

    def of_authors(self, corpora: Sequence[Path]) -> Iterator[TrainingText]:
        """Those that are made of the texts of authors."""
        for author, paths in groupby(sorted(corpora), key=author_of):
            yield from self.of_author(author, [text for path in paths for text in authored(path)])

    def of_author(self, author: int, known: Sequence[TrainingText]) -> Iterator[TrainingText]:
        """Variants of the texts of an author, and the generator's."""
        varied, written = (np.random.default_rng([0, author, k]) for k in range(2))
        yield from disturbed(known, self.variants * len(known), varied)
        yield from islice(generated(known, self.generated, written), self.generated)


def strangers(teacher: int) -> tuple[Path, ...]:
    """The files of the authors whom a teacher does not know: every fourth of the strangers."""
    return tuple(
        each
        for each in learned_corpora()
        if author_of(each) >= FIRST_STRANGER and author_of(each) % 4 == teacher
    )


def teachers_in(folder: Path, recipe: Recipe) -> list[Path]:
    """The folders of the teachers; those that are not there are trained first."""
    folders = [folder / str(teacher) for teacher in range(TEACHERS)]
    training = replace(TEACHING, device=recipe.training.device)
    for teacher, each in enumerate(folders):
        if not (each / CARD_FILE).exists():
            known = [path for path in learned_corpora() if path not in strangers(teacher)]
            replace(recipe, seed=recipe.seed + 1 + teacher, training=training).train(known, each)
    return folders


@dataclass(frozen=True)
class Arguments:
    """Train the translator on the texts of all authors who are not held out.

    Attributes:
        out: folder to which the files are written; by default that of the package.
        teachers: folder of the teachers; those that are not there are trained first.
        recipe: what teachers and translator learn from.
    """

    out: Path = TRAINED_FOLDER
    teachers: Path = TEACHERS_FOLDER
    recipe: Recipe = field(default_factory=Recipe)

    def run(self) -> int:
        """Train it."""
        teachers = [load_translator(each) for each in teachers_in(self.teachers, self.recipe)]
        self.recipe.train(learned_corpora(), self.out, teachers)
        print(f"wrote {self.out / CARD_FILE}")
        return 0
