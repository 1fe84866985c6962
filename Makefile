# Two commands do everything on a fresh machine: `make demo` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

.PHONY: demo test packages lint types slow soak docs policies clean

demo: $(VENV)/.demo
	$(BIN)/semnav demo "go through the second door on the right" --map heidelberg_hallway \
	  --robot wheelchair --agent scripted --seed 3 --save out/demo.gif --picture out/demo.png

test: $(VENV)/.test lint types
	$(BIN)/python -m pytest -m "not slow" -n 2

packages: $(VENV)/.test
	$(BIN)/python -m tests.installed

COUNT ?= 2000
STRIKES ?= 10
SIGNALS ?= 170
STEPS ?= 5000000
soak: $(VENV)/.test
	$(BIN)/python -m tests.reliability.soak inputs $(COUNT)
	$(BIN)/python -m tests.reliability.soak strikes $(STRIKES)
	$(BIN)/python -m tests.reliability.soak signals $(SIGNALS)
	$(BIN)/python -m tests.reliability.soak steps $(STEPS)

slow: $(VENV)/.test
	$(BIN)/python -m pytest -m slow

lint: $(VENV)/.test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/.test
	$(BIN)/mypy

docs: $(VENV)/.docs
	$(BIN)/sphinx-build -W -b html docs docs/_build/html

$(VENV)/.demo: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install -q -c constraints.txt -e ".[render]"
	touch $@

$(VENV)/.docs: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install -q -c constraints.txt -e ".[docs]"
	touch $@

$(VENV)/.test: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install -q -c constraints.txt -e ".[render,rl,ros,dev]"
	touch $@

# On one core some 8 minutes of processor time for a seed of `drive`, 12 for one of `listener`: 100 in all.
SEEDS ?= 0 1 2 3 4
policies: $(VENV)/.test
	set -e; for seed in $(SEEDS); do for name in drive listener; do \
	  $(BIN)/semnav train $$name --seed $$seed --out out/policies/$$name-$$seed; done; done
	$(BIN)/python -m studies translator --out out/policies/translator

clean:
	rm -rf $(VENV) build dist *.egg-info .mypy_cache .ruff_cache .pytest_cache out
