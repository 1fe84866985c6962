"""Settings of the documentation: `sphinx-build -W -b html docs docs/_build/html`."""

import re
import sys
from importlib.metadata import version as _version
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))
from generated import filled  # the file beside this one

project = "semnav-env"
author = "The semnav-env developers"
copyright = author
release = version = _version("semnav-env")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["colon_fence", "dollarmath", "deflist"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the signature is long enough without them; docstrings say the kinds
autodoc_preserve_defaults = True
napoleon_use_ivar = True
default_role = "code"  # `names` of docstrings are code

html_theme = "furo"
html_title = "semnav-env"
html_static_path = ["_static"]
html_css_files = ["pictures.css"]


def _as_rest(_app: Any, _what: str, _name: str, _it: Any, _options: Any, lines: list[str]) -> None:
    """Turn the Markdown of a docstring into reStructuredText: headings and indented code."""
    rest: list[str] = []
    for k, line in enumerate(lines):
        code = line.startswith("    ") and not lines[k - 1].strip() and not _in_section(lines[:k])
        if k and code and not any(each.startswith("   ") for each in rest[-2:]):
            rest += ["::", ""]
        if "`" not in line and not line.startswith("    "):
            line = line.replace("|", "\\|")  # magnitudes, not substitutions
        heading = re.fullmatch(r"## (.*)", line)
        line = re.sub(r"`([^`]+)`(?=\w)", r"`\1`\\ ", line)  # "`Command`s" in Markdown
        rest += [f".. rubric:: {heading[1]}", ""] if heading else [line]
    lines[:] = rest


def _in_section(lines: list[str]) -> bool:
    """Whether the last line that is not indented is the title of a section, or of a field."""
    last = next((line for line in reversed(lines) if line and not line[0].isspace()), "")
    return (last.endswith(":") and last[:-1].isalpha()) or last.startswith((":", "..", "- "))


def _fill(_app: Any, _page: str, source: list[str]) -> None:
    """Put into a page what it takes from the code."""
    source[0] = filled(source[0])


def setup(app: Any) -> None:
    """Let docstrings be read as Markdown before they are read as reStructuredText."""
    app.connect("source-read", _fill)
    app.connect("autodoc-process-docstring", _as_rest, priority=400)
