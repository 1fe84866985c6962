"""The lowest versions that pyproject.toml allows, as constraints of pip: `make versions`."""

import re
import tomllib

from tests.support.paths import ROOT

if __name__ == "__main__":
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    for requirement in [*project["dependencies"], *extras["render"], *extras["import"]]:
        name, lowest = re.match(r"([\w.-]+)>=([\w.]+)", requirement).groups()
        print(f"{name}=={lowest}")
