"""Each control of the page is used by a test in the browser."""

import re

from tests.support.paths import ROOT, source

CONTROL = re.compile(r'<(?:button|input|select|canvas|summary)\b[^>]*\bid="([^"]+)"')
TOOL = re.compile(r'name="(?:board-)?tool" value="([^"]+)"')


def test_each_control_and_each_tool_is_used_in_the_browser():
    page = source("semnav_scripts/page/web/index.html").read_text("utf-8")
    files = [
        *(ROOT / "tests/scripts/browser").glob("*.py"),
        ROOT / "tests/support/page_in_browser.py",
    ]
    tests = "".join(path.read_text("utf-8") for path in files)
    controls, tools = set(CONTROL.findall(page)), set(TOOL.findall(page))
    assert len(controls) > 40
    assert len(tools) == 10
    assert {name for name in controls if f'"#{name}"' not in tests} == set()
    assert {
        name for name in tools if f"value={name}]" not in tests and f'"{name}"' not in tests
    } == set()
