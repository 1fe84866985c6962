"""`python -m studies assistance`: contacts and doorways with shared control and without it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

from studies.assistance.clumsy import Clumsiness
from studies.assistance.drives import (
    ASSISTANCE,
    Assistance,
    assisted_drives,
    episodes_through_doors,
)

HANDS = {
    "steady": Clumsiness(0.0, 0.0),
    "late": Clumsiness(0.4, 0.0),
    "trembling": Clumsiness(0.0, 0.25),
    "clumsy": Clumsiness(0.4, 0.15),
}
"""How drivers carry out what they decide."""

COLUMNS = (
    *("robot", "driver", "hand", "assistance", "drives", "done", "contacts", "contact-free"),
    *("time, s", "passages", "angle", "offset, cm", "speed, m/s", "corrections"),
)


@dataclass(frozen=True)
class Arguments:
    """Let good and clumsy drivers carry out commands that speak of doors, assisted and not.

    Attributes:
        split: of the episodes.
        episodes: how many, evenly spaced.
        seeds: drives of each, with other noise of the driver's hand.
        robots: bodies.
        drivers: who decides: "scripted", or "bee line", which steers straight to the goal.
        hands: how it is carried out: "steady", "late", "trembling" or "clumsy".
        assistance: "none", "contacts" (prevented) or "doors" (helped through, as well).
    """

    split: str = "train"
    episodes: int = 10
    seeds: int = 2
    robots: tuple[str, ...] = ("wheelchair", "spot")
    drivers: tuple[str, ...] = ("scripted", "bee line")
    hands: tuple[str, ...] = ("steady", "clumsy")
    assistance: tuple[str, ...] = ASSISTANCE

    def run(self) -> int:
        """Drive, and print a row for each body, driver, hand and assistance."""
        episodes = episodes_through_doors(self.split, self.episodes)
        print(f"| {' | '.join(COLUMNS)} |")
        print("|---" * len(COLUMNS) + "|")
        for case in product(self.robots, self.drivers, self.hands, self.assistance):
            robot, driver, hand, assistance = case
            seeds = 1 if hand == "steady" else self.seeds
            told = assisted_drives(robot, episodes, driver, HANDS[hand], assistance, seeds)
            print(f"| {' | '.join((*case, *_cells(told)))} |", flush=True)
        return 0


def _cells(told: Assistance) -> tuple[str, ...]:
    habits = told.habits
    return (
        str(told.drives),
        f"{100 * told.success:.0f} %",
        f"{told.contacts:.2f}",
        f"{100 * told.contact_free:.0f} %",
        f"{told.seconds:.1f}",
        str(habits.passages),
        f"{math.degrees(habits.angle):.1f}, {math.degrees(habits.angle_90):.1f}",
        f"{100 * habits.offset:.1f}, {100 * habits.offset_90:.1f}",
        f"{habits.speed:.2f}",
        f"{habits.corrections:.2f}",
    )
