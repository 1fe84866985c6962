"""Writes docs/guides/observations.md: every entry of the observation as the layout declares it."""

from __future__ import annotations

from semnav_env.mind.observations.layout import (
    CLAUSE,
    GOAL,
    HALLWAY,
    MEMORY_TABLES,
    MODES,
    ODOMETRY,
    START,
    TABLES,
    Entry,
    command_space,
    scan_space,
)
from semnav_features.lidars import TIM561
from studies.figures import IMAGES

PAGE = IMAGES.parent / "guides" / "observations.md"

TITLE = """# Entries of the observation

Each entry is one flat array. Features, bumps and the goal are in the robot frame: x forward, y
left, origin at the centre of the footprint. An entry with a mask has `NAME_mask` beside it,
with 1 for each row that counts; `semnav_env.mind.observations.table(observation, "walls")` gives
these rows. The numbers come from `semnav_env.mind.observations.layout`, which also makes the spaces
and the kernels' offsets.

| entry | size | columns | bounds | unit | meaning |
|---|---|---|---|---|---|
"""

MODES_TITLE = """## Entries of each mode

`observation="semantic"` is the default. `"truth"` has the entries of `"semantic"` without errors.
`"command"` is for a policy that hears the command: see [below](#hearing-the-command).
"""

TEXT = """## Hearing the command

In the other modes the environment has grounded the command already: `goal` is the referent of
the words, and `clause` the active clause. `observation="command"` has neither of the two, nor any
entry that depends on them. Two robots that drove the same path observe the same, whatever their
commands, except for the tokens in `command` and for `told_ways` (a test checks this). Instead it
has entries that a learner would otherwise have to build from many scans: remembered walls, the
axis of the corridor, and the arms that leave it. The pose at which a *clause* began is not an
entry, because it would show when the grounding takes the clause before for done; `start` is the
pose at which the command began.

A named room is out of sight. The robot gets the way there before it drives, as places 1.5 m apart
and the door at the end: `told_ways` and `told_doors`. They are given at the start and do not
change; on a robot they are the `ways=` of `BeliefTracker.begin`.

`command` holds tokens, a `MultiDiscrete` of 16-bit integers: Gymnasium flattens it to one-hot,
and stable-baselines3 does the same. The words themselves are in `info["instruction"]` of `reset`,
as they were said; `info["command"]` is the same in canonical English. They can be an entry as
well, like `mission` in MiniGrid:

```python
from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import EntryObservation, InstructionEntry

env = SemNavEnv(observation=EntryObservation("command", [InstructionEntry()]))
observation, info = env.reset(seed=0)
assert observation["instruction"] == info["instruction"]
```

The corridor is surveyed again for each observation, which costs more than all other entries
together: see the measurement in [speed](speed.md#in-training).
"""


def page() -> str:
    """The page, made of the declared entries."""
    entries = (*TABLES, CLAUSE, ODOMETRY, GOAL, *MEMORY_TABLES, HALLWAY, START)
    scan, tokens = scan_space(TIM561), command_space()
    rows = [
        *map(_row, entries),
        f"| `scan` | beams (TiM561: {scan.shape[0]}) | range | 0 to the lidar's range | m | "
        "one range for each beam; a missing return reads as the lidar's range |",
        f"| `command` | {tokens.shape[0]} | 8 clauses of 5 tokens | "
        f"0 to {tokens.nvec.max() - 1} | | the command, see "
        "[as numbers](language_reference.md#as-numbers) |",
    ]
    return TITLE + "\n".join([*rows, "", MODES_TITLE, *_mode_rows(), "", TEXT])


def _mode_rows() -> list[str]:
    """A table of entries and modes."""
    names = dict.fromkeys(name for mode in MODES for name in _plain(mode))
    rows = [f"| entry | {' | '.join(f'`{mode}`' for mode in MODES)} |", "|---" * 6 + "|"]
    for name in names:
        marks = ("x" if name in MODES[mode] else "" for mode in MODES)
        rows.append(f"| `{name}` | {' | '.join(marks)} |")
    return rows


def _row(entry: Entry) -> str:
    size = f"{entry.rows} x {len(entry.columns)}" if entry.masked else str(entry.size)
    columns = entry.columns if entry is not CLAUSE else ("one for each clause",)
    name = f"`{entry.name}`" + (", mask" if entry.masked else "")
    bounds = f"{entry.low:g} to {entry.high:g}"
    return f"| {name} | {size} | {', '.join(columns)} | {bounds} | {entry.unit} | {entry.meaning} |"


def _plain(mode: str) -> list[str]:
    """The entries of a mode without their masks."""
    return [name for name in MODES[mode] if not name.endswith("_mask")]


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
