"""The model cards of the bundled agents."""

import pytest

from studies.figures.cards import AGENTS, bundled_card, results_of

TOLD = {"what", "data", "hours", "made", "chosen_on", "results", "limits"}


@pytest.mark.parametrize("name", AGENTS)
def test_a_card_says_what_the_kept_results_say(name: str) -> None:
    """If this fails: `python -m studies.figures cards`."""
    card = bundled_card(name).notes
    assert card.keys() >= TOLD
    assert all(card[key] for key in TOLD)
    assert card["results"] == results_of(name)
