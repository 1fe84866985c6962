"""`python -m studies translator`: train the translator, and measure it on another author."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import islice
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from semnav_agents.networks.card import Card
from semnav_agents.networks.weights import save_weights
from semnav_env.language.corpora import ParseOutcome, load_sentences
from studies.corpora import development_corpora
from studies.translating.measure import counted, interpreters
from studies.translating.texts import authored, disturbed, generated
from studies.translating.training import TranslatorTraining, trained

Author = Literal["first", "second", "third", "fourth", "fifth", "sixth"]


@dataclass(frozen=True)
class Arguments:
    """Train the translator on all authors' sets or all but one, and measure it on the others'.

    Attributes:
        author: the only one who is learned from; by default all are, as for the bundled translator.
        without: an author who is not learned from, but measured.
        out: folder to which the files are written.
        trained: folder of a trained translator to measure, in place of training one.
        steps: of the training.
        generated: paraphrases of the generator to learn from.
        disturbed: variants of people's texts to learn from.
        sure: least probability at which the translator alone acts.
        seed: of the texts, the weights and the order.
    """

    author: Author | None = None
    without: Author | None = None
    out: Path = Path("out/translator")
    trained: Path | None = None
    steps: int = 10000
    generated: int = 8000
    disturbed: int = 48000
    sure: float = 0.9
    seed: int = 0

    def run(self) -> int:
        """Train, write the files, and print what becomes of the other authors' sentences."""
        folder = self.trained or self._train()
        print("| | kind | n |" + "".join(f" {each} |" for each in ParseOutcome))
        print("|---|---|---|" + "---|" * len(ParseOutcome))
        for path in development_corpora():
            if not self._learns(author_of(path)):
                self._measure(path, folder)
        return 0

    def _learns(self, author: Author) -> bool:
        """Whether the network learns from an author."""
        return author != self.without and self.author in (None, author)

    def _train(self) -> Path:
        corpora = [path for path in development_corpora() if self._learns(author_of(path))]
        known = [text for path in corpora for text in authored(path)]
        written = generated(known, self.generated, np.random.default_rng(self.seed))
        varied = disturbed(known, self.disturbed, np.random.default_rng(self.seed))
        settings = TranslatorTraining(steps=self.steps)
        network = trained([*islice(written, self.generated), *varied], settings, self.seed)
        preset = {
            "generated": self.generated,
            "disturbed": self.disturbed,
            "corpora": [path.name for path in corpora],
            "training": asdict(settings),
        }
        halves = {name: array.astype(np.float16) for name, array in network.tensors.items()}
        save_weights(self.out, halves)
        Card(network.shape, preset, self.seed).write(self.out)
        return self.out

    def _measure(self, path: Path, folder: Path) -> None:
        sentences = load_sentences(path)
        for name, interpreter in interpreters(sentences, folder, self.sure).items():
            for kind, counts in counted(sentences, interpreter).items():
                cells = "".join(f" {counts[outcome]} |" for outcome in ParseOutcome)
                print(f"| {path.stem}, {name} | {kind} | {counts.total()} |{cells}", flush=True)


def author_of(corpus: Path) -> Author:
    """Who wrote a development set."""
    known = (author for author in get_args(Author) if corpus.stem.startswith(f"{author}_"))
    return next(known, "first")
