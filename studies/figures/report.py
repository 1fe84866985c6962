"""Draw docs/images/report.png: the report of an evaluation in Chromium."""

from __future__ import annotations

import tempfile
from pathlib import Path

from semnav_scripts.main import main as semnav
from studies.figures.page import CHROMIUM, FLAGS, keep

EVALUATION = ("evaluate", "val_unseen", "--agent", "blind", "--episodes", "8")
"""An agent that does not hear the command, so that there are failures of several kinds."""

SIZE = {"width": 1180, "height": 1200}


def main() -> None:
    """Evaluate, open the report, and keep what is seen (`make browser` installs Chromium)."""
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        report = Path(folder) / "report.html"
        semnav([*EVALUATION, "--html", str(report)])
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        page = browser.new_page(viewport=SIZE, color_scheme="light")
        page.goto(report.as_uri())
        keep(page, "report.png")
        browser.close()
