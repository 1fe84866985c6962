"""Text in pictures: wrapped, cut and harmless."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.rendering.text import harmless, wrap


@given(st.text(max_size=300), st.floats(1.0, 60.0))
def test_wrapped_lines_fit_and_keep_every_character(text: str, width: float) -> None:
    lines = wrap(text, width, len, most=10_000)
    assert all(len(line) <= width for line in lines)
    assert "".join(lines).replace(" ", "") == harmless(text).replace(" ", "")


@given(st.text(alphabet="ab c", min_size=50, max_size=300))
def test_wrapping_stops_at_the_most_lines_with_an_ellipsis(text: str) -> None:
    full, cut = wrap(text, 9.0, len, most=10_000), wrap(text, 9.0, len, most=3)
    assert len(cut) == min(3, len(full))
    assert cut[-1].endswith("…") == (len(full) > 3)
    assert all(len(line) <= 9 for line in cut)


@given(st.text(max_size=600))
@settings(max_examples=50)
def test_harmless_text_prints_and_stays_harmless(text: str) -> None:
    assert harmless(text).isprintable()
    assert harmless(harmless(text)) == harmless(text)
