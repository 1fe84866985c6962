# Two commands do everything on a fresh machine: `make demo` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

.PHONY: demo test coverage packages versions lowest newest fallbacks lint types slow soak nightly docs policies browser ros clean

demo: $(VENV)/.demo
	$(BIN)/semnav demo "go through the second door on the right" --map heidelberg_hallway \
	  --robot wheelchair --agent scripted --seed 3 --save out/demo.gif --picture out/demo.png

test: $(VENV)/.test lint types
	$(BIN)/python -m pytest -m "not slow" -n 2

coverage: $(VENV)/.test
	mkdir -p build/coverage
	$(BIN)/python -m pytest -m "not slow" -n 2 --cov --cov-report=html:build/coverage/html
	@echo "lines covered: $$($(BIN)/coverage report --format=total) %; build/coverage/html says which"

packages: $(VENV)/.test
	$(BIN)/python -m tests.installed

# Some telling tests with the lowest and the newest versions that pyproject.toml allows, and without
# what a machine may lack: our own linking of kernels, calls of Chipmunk in compiled code, vectors.
TELLING := tests/test_determinism.py tests/env/test_env.py tests/scripts/test_cli.py \
  tests/features/test_reference.py tests/features/test_lanes.py tests/features/test_line_map.py \
  tests/language/test_command_errors.py tests/vector/test_vector_env.py \
  tests/world/maps/test_generator.py tests/world/maps/test_geojson_errors.py \
  tests/world/physics/test_world.py
LINKING := tests/features/test_compiling.py tests/world/physics/test_compiled_drive.py
TELL := -m pytest -q -m "not slow"
TOOLS := pytest hypothesis array-api-compat

versions: lowest newest fallbacks

lowest:
	mkdir -p build
	$(PYTHON) -m tests.lowest_versions > build/lowest.txt
	$(PYTHON) -m venv --clear build/lowest
	build/lowest/bin/pip install -q -c build/lowest.txt -e ".[render,import]" $(TOOLS)
	build/lowest/bin/python $(TELL) -W ignore::DeprecationWarning $(TELLING) $(LINKING)

newest:
	$(PYTHON) -m venv --clear build/newest
	build/newest/bin/pip install -q -U -e ".[render,import]" $(TOOLS)
	build/newest/bin/python $(TELL) $(TELLING) $(LINKING)

fallbacks: $(VENV)/.test
	SEMNAV_PLAIN_NUMBA=1 SEMNAV_PLAIN_PYMUNK=1 NUMBA_CPU_NAME=generic NUMBA_CPU_FEATURES= \
	  $(BIN)/python $(TELL) $(TELLING)

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

nightly: slow soak versions coverage

# The node of a robot and a simulated robot in two processes: with a ROS master of Debian's packages, by
# DDS, and by rclpy of ROS 2 Jazzy, which has an environment of its own, as its messages have the names
# of ROS 1's. Where the packages cannot be installed, the tests that need them skip, and say why.
RCLPY := $(foreach part,rclpy rmw-fastrtps-cpp sensor-msgs nav-msgs visualization-msgs,ros-jazzy-$(part))
WIRES ?=
ros: $(VENV)/.test
	.ci/debian python3-rospy python3-rosmaster python3-sensor-msgs python3-nav-msgs \
	  python3-visualization-msgs python3-tf2-msgs python3-move-base-msgs python3-roslaunch python3-rosbag
	$(PYTHON) -m venv build/ros2 && timeout -k 10 300 build/ros2/bin/pip install -q --retries 1 \
	  -c constraints.txt $(RCLPY) || rm -rf build/ros2
	$(BIN)/python -m pytest tests/ros/test_wires.py tests/ros/test_launch_files.py -k "$(WIRES)"

lint: $(VENV)/.test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/.test
	$(BIN)/mypy

docs: $(VENV)/.docs
	$(BIN)/sphinx-build -W -b html docs docs/_build/html

# Both pages in a real browser, Debian's. Where browser or driver cannot be installed, the tests skip, and
# say why; pytest's code 5 means that all of them did.
browser: $(VENV)/.test
	.ci/debian chromium
	timeout -k 10 300 $(BIN)/pip install -q --retries 1 -c constraints.txt playwright \
	  axe-playwright-python || echo "Playwright and axe cannot be installed"
	$(BIN)/python -m pytest tests/scripts/browser || test $$? -eq 5

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
	$(BIN)/pip install -q -c constraints.txt -e ".[render,play,rl,ros,serve,dds,rerun,mcap,dev]"
	touch $@

# On one core some 8 minutes of processor time for a seed of `drive`, 12 for one of `listener`: 100 in all.
SEEDS ?= 0 1 2 3 4
policies: $(VENV)/.test
	set -e; for seed in $(SEEDS); do for name in drive listener; do \
	  $(BIN)/semnav train $$name --seed $$seed --out out/policies/$$name-$$seed; done; done
	$(BIN)/python -m studies translator --out out/policies/translator

clean:
	rm -rf $(VENV) build dist *.egg-info .mypy_cache .ruff_cache .pytest_cache out
