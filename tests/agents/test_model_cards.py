"""The model cards of the bundled agents."""

import pytest

pytest.importorskip("safetensors", reason='needs the extra "rl"')

from semnav_agents.hearing.card import ModelCard
from studies.figures.cards import LISTENER, drive_card, results_of

TOLD = {"what", "data", "hours", "made", "chosen_on", "results", "limits"}


@pytest.mark.parametrize("name", ["drive", "listener"])
def test_a_card_says_what_the_kept_results_say(name: str) -> None:
    """If this fails: `python -m studies.figures cards`."""
    card = drive_card() if name == "drive" else ModelCard.read(LISTENER).notes
    assert card.keys() >= TOLD
    assert all(card[key] for key in TOLD)
    assert card["results"] == results_of(name)
