"""The page about reliability shows what the last soak measured, and the budgets of the code."""

import json

from tests.reliability.areas import AREAS
from tests.reliability.page import PAGE, RESULTS, page
from tests.reliability.steps import MOST_GROWTH
from tests.reliability.writers import WRITERS


def test_the_page_shows_the_last_soak() -> None:
    """If this fails: `make soak`."""
    results = json.loads(RESULTS.read_text())
    assert PAGE.read_text(encoding="utf-8") == page(results)
    assert list(results["inputs"]) == [area.name for area in AREAS]
    assert list(results["strikes"]) == [writer.name for writer in WRITERS]
    tried = [row for part in ("inputs", "strikes", "signals") for row in results[part].values()]
    assert all(count > 0 and not failed for count, failed in tried)
    assert results["steps"]["memory"] - results["steps"]["warm"] < MOST_GROWTH
