"""The page about reliability shows what the last soak measured, and the budgets of the code."""

import json

from tests.reliability.areas import AREAS
from tests.reliability.soak import PAGE, RESULTS, page


def test_the_page_shows_the_last_soak() -> None:
    """If this fails: `make soak`."""
    results = json.loads(RESULTS.read_text())
    assert PAGE.read_text(encoding="utf-8") == page(results)
    assert list(results) == [area.name for area in AREAS]
    assert all(tried > 0 and not failed for tried, failed in results.values())
