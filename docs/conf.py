"""Settings of the documentation: `sphinx-build -W -b html docs docs/_build/html`."""

from importlib.metadata import version as _version

project = "semnav-env"
author = "The semnav-env developers"
copyright = author
release = version = _version("semnav-env")

extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]

html_theme = "furo"
html_title = "semnav-env"
