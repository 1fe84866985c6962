"""Names, contrast and width: the page for a screen reader, in the dark and on a phone."""

from __future__ import annotations

import pytest

from tests.support.asked import asked_about
from tests.support.chromium import new_page, serious_findings
from tests.support.page_in_browser import expect, say, visit

PHONE = {"width": 360, "height": 740}


CONTRASTS = """() => {
  const style = getComputedStyle(document.documentElement);
  const light = (name) => {
    const hex = style.getPropertyValue(`--${name}`).trim();
    const [r, g, b] = [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255)
      .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const pairs = [["ink", "card"], ["muted", "card"], ["muted", "page"], ["accent", "card"],
    ["on-accent", "accent"], ["bad", "card"], ["good", "card"], ["ink", "active"]];
  return Object.fromEntries(pairs.map(([a, b]) => {
    const [x, y] = [light(a), light(b)].sort((p, q) => q - p);
    return [`${a} on ${b}`, (x + 0.05) / (y + 0.05)];
  }));
}"""


def test_everything_that_can_be_used_has_a_name(page):
    """What a screen reader says of buttons, fields and lists."""
    labels = "[...(e.labels ?? [])].map(label => label.textContent).join()"
    for element in page.locator("button:visible, input:visible, select:visible, canvas").all():
        name = element.evaluate(f"e => e.ariaLabel || e.textContent.trim() || {labels}")
        assert name.strip(), element.evaluate("e => e.outerHTML")
    assert page.locator("#verdict").get_attribute("role") == "status"
    assert page.locator("#heard").get_attribute("aria-live") == "polite"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_all_can_be_used_and_read_also_on_a_phone(browser, address, scheme):
    """Deque's checker of accessibility: the scene, a question, and the drawing board."""
    page, _ = new_page(browser, color_scheme=scheme)
    visit(page, address)
    ratios = page.evaluate(CONTRASTS)
    assert min(ratios.values()) >= 4.5, ratios
    wide = page.viewport_size
    for state in ("scene", "question", "board"):
        if state == "question":
            say(page, asked_about()[0])
            expect(page.locator("#heard button")).to_have_count(2)
        if state == "board":
            page.click("#open-board")
            expect(page.locator("#draw")).to_be_visible()
        assert serious_findings(page) == []
        page.set_viewport_size(PHONE)
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        page.set_viewport_size(wide)
    page.close()
