"""Each numbered case that strangers found has a test that names it."""

from __future__ import annotations

import re

from tests.support.paths import ROOT

CASES = range(1, 18)
NAMED = re.compile(r"[Cc]ases? (\d+)(?: (to|and) (\d+))?")


def test_every_case_is_named_by_a_test() -> None:
    named: set[int] = set()
    for path in (ROOT / "tests").rglob("test_*.py"):
        for first, link, last in NAMED.findall(path.read_text(encoding="utf-8")):
            named |= set(range(int(first), int(last) + 1)) if link == "to" else {int(first)}
            named |= {int(last)} if link else set()
    assert named >= set(CASES)
