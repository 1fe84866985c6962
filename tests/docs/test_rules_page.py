"""docs/concepts/rules.md lists every rule, and says of it what the code says."""

from __future__ import annotations

from studies.figures.rules_table import PAGE, page


def test_the_page_lists_every_rule_as_the_code_has_it() -> None:
    """If this fails: `python -m studies.figures rules_table`."""
    assert PAGE.read_text(encoding="utf-8") == page()
