"""`python -m studies translator`: train the translator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from itertools import islice
from pathlib import Path

import numpy as np

from semnav_env.language.translating.network import TRAINED_FOLDER
from semnav_env.networks.card import CARD_FILE, Card
from semnav_env.networks.weights import save_weights
from studies.corpora import learned_corpora
from studies.translating.texts import authored, disturbed, generated, of_episodes
from studies.translating.training import TranslatorTraining, trained


@dataclass(frozen=True)
class Recipe:
    """What a translator learns from, beside the commands of the split for training.

    Attributes:
        generated: paraphrases of the generator.
        disturbed: variants of people's texts.
        seed: of the texts, the weights and the order.
        training: of the network.
    """

    generated: int = 16000
    disturbed: int = 96000
    seed: int = 0
    training: TranslatorTraining = field(default_factory=TranslatorTraining)

    def train(self, corpora: Sequence[Path], out: Path) -> None:
        """Train a translator on the texts of corpora, and write its files to a folder."""
        known = [text for path in corpora for text in authored(path)]
        written = generated(known, self.generated, np.random.default_rng(self.seed))
        varied = disturbed(known, self.disturbed, np.random.default_rng(self.seed))
        texts = [*islice(written, self.generated), *of_episodes("train"), *varied]
        network = trained(texts, self.training, self.seed)
        preset = asdict(self) | {"corpora": [path.name for path in corpora]}
        halves = {name: array.astype(np.float16) for name, array in network.tensors.items()}
        save_weights(out, halves)
        Card(network.shape, preset, self.seed).write(out)


@dataclass(frozen=True)
class Arguments:
    """Train the translator on the texts of all authors who are not held out.

    Attributes:
        out: folder to which the files are written; by default that of the package.
        recipe: what it learns from.
    """

    out: Path = TRAINED_FOLDER
    recipe: Recipe = field(default_factory=Recipe)

    def run(self) -> int:
        """Train it."""
        self.recipe.train(learned_corpora(), self.out)
        print(f"wrote {self.out / CARD_FILE}")
        return 0
