"""The colours of the picture, (red, green, blue)."""

from __future__ import annotations

from typing import Final, TypeAlias

Colour: TypeAlias = tuple[int, int, int]
"""Red, green and blue, 0 to 255."""


WHITE: Final[Colour] = (255, 255, 255)
INK: Final[Colour] = (33, 42, 54)
MUTED: Final[Colour] = (112, 122, 135)
HAIRLINE: Final[Colour] = (214, 219, 226)

# The floor plan: quiet, so that what is perceived stands out.
OUTSIDE: Final[Colour] = (238, 240, 243)
FLOOR: Final[Colour] = (250, 250, 249)
ROOM: Final[Colour] = (247, 243, 235)
CORRIDOR: Final[Colour] = (241, 245, 250)
INTERSECTION: Final[Colour] = (234, 241, 250)
WALL: Final[Colour] = (52, 60, 72)
ASSUMED: Final[Colour] = (150, 158, 168)
GLASS: Final[Colour] = (104, 186, 234)
LEAF: Final[Colour] = (150, 100, 56)
FURNITURE: Final[Colour] = (178, 184, 192)
THRESHOLD: Final[Colour] = (184, 190, 198)
NAME: Final[Colour] = (160, 166, 174)

# What the lidar sees. Highlighter colours darken what lies beneath them.
FAN: Final[Colour] = (255, 246, 212)
BEAM: Final[Colour] = (252, 234, 184)
HIT: Final[Colour] = (214, 69, 48)

CLOUD: Final[Colour] = (96, 92, 190)

# Features.
JAMB: Final[Colour] = (222, 30, 140)
WALL_SEEN: Final[Colour] = (255, 184, 92)
WALL_REMEMBERED: Final[Colour] = (240, 166, 70)
DOOR: Final[Colour] = (22, 138, 84)
OUTER_CORNER: Final[Colour] = (120, 60, 170)
INNER_CORNER: Final[Colour] = (0, 120, 190)
POTENTIAL_CORNER: Final[Colour] = (92, 100, 112)
CORRIDOR_MARK: Final[Colour] = (0, 140, 150)

# The task.
GOAL: Final[Colour] = (200, 24, 104)
GOAL_DOORWAY: Final[Colour] = (255, 176, 208)
TRAIL: Final[Colour] = (52, 108, 196)
ROUTE: Final[Colour] = (140, 146, 160)

# The body.
CHAIR: Final[Colour] = (66, 118, 196)
CHAIR_SEAT: Final[Colour] = (112, 158, 222)
SPOT: Final[Colour] = (246, 198, 46)
SPOT_BACK: Final[Colour] = (252, 220, 112)
TYRE: Final[Colour] = (30, 36, 46)
CONTACT: Final[Colour] = (216, 32, 40)

# Other people.
LOOKED: Final[Colour] = (222, 240, 222)
PERSON: Final[Colour] = (122, 92, 158)
PERSON_HEAD: Final[Colour] = (226, 206, 186)

# The panel.
PANEL: Final[Colour] = (255, 255, 255)
ACTIVE: Final[Colour] = (255, 240, 204)
ACTIVE_EDGE: Final[Colour] = (238, 160, 40)
DONE: Final[Colour] = (22, 138, 84)
