"""What keyboard and gamepad ask for."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.gym_env import PLAYED_SPEED, PLAYED_YAW_RATE
from semnav_env.rendering.backend import load_pygame

DEAD_ZONE = 0.15
"""Deflection up to which a stick is taken to be at rest."""

MAX_TYPED = 200
"""The most characters of a command."""

FAST = 2.0
"""Factor on the speeds while shift is held."""

FORWARD, LEFT, TURN = 0, 1, 2
"""Parts of a motion; a body that cannot move sideways ignores the second."""

_LETTERS = {"K_w": (FORWARD, 1), "K_s": (FORWARD, -1), "K_a": (TURN, 1), "K_d": (TURN, -1)}
_LETTERS |= {"K_q": (LEFT, 1), "K_e": (LEFT, -1)}
_ARROWS = {
    "K_UP": (FORWARD, 1),
    "K_DOWN": (FORWARD, -1),
    "K_LEFT": (TURN, 1),
    "K_RIGHT": (TURN, -1),
}
"""Keys by their names in pygame: the part of a motion that each sets, and its sign."""

_AXES = {0: TURN, 1: FORWARD, 2: LEFT}
"""Axes of a gamepad: the left stick drives, the right one moves sideways; pushed to the right or
back they read 1."""


class Controls:
    """Keeps which keys are held, where the sticks are, and what is being typed.

    Attributes:
        typed: the text so far; None if nobody types.
    """

    def __init__(self) -> None:
        self._pygame = load_pygame()
        self._pygame.joystick.init()
        self._pads: list[Any] = []  # a gamepad speaks as long as it is kept
        self._arrows = {getattr(self._pygame, name): to for name, to in _ARROWS.items()}
        self._letters = {getattr(self._pygame, name): to for name, to in _LETTERS.items()}
        self._held: set[int] = set()
        self._stick = np.zeros(3)
        self.typed: str | None = None

    def take(self, event: Any) -> str:
        """Take an event of the window.

        Returns:
            What it asks for: "command" (that `typed` holds), "assist" (or not), "end", or "".
        """
        pygame = self._pygame
        if event.type == pygame.KEYDOWN:
            return self._pressed(event)
        if event.type == pygame.KEYUP:
            self._held.discard(event.key)
        elif event.type == pygame.WINDOWFOCUSLOST:
            self._held.clear()
        elif event.type == pygame.JOYDEVICEADDED:
            self._pads.append(pygame.joystick.Joystick(event.device_index))
        elif event.type == pygame.JOYAXISMOTION and event.axis in _AXES:
            at_rest = abs(event.value) < DEAD_ZONE
            self._stick[_AXES[event.axis]] = 0.0 if at_rest else -event.value
        elif event.type == pygame.JOYBUTTONDOWN and event.button == 0:
            return "assist"
        elif event.type == pygame.QUIT:
            return "end"
        return ""

    def take_typed(self) -> str:
        """The text that was typed, and type no more."""
        text, self.typed = self.typed or "", None
        return text.strip()

    def action(self, size: int) -> NDArray[np.float32]:
        """The action for a body of so many parts: shares of its largest speeds."""
        motion, shifts = self._stick.copy(), {self._pygame.K_LSHIFT, self._pygame.K_RSHIFT}
        factor = FAST if self._held & shifts else 1.0
        keys = self._arrows if self.typed is not None else self._letters | self._arrows
        for key in self._held & keys.keys():
            part, sign = keys[key]
            motion[part] += sign * factor * (PLAYED_YAW_RATE if part == TURN else PLAYED_SPEED)
        parts = motion if size == 3 else motion[[FORWARD, TURN]]
        return np.clip(parts, -1.0, 1.0).astype(np.float32)

    def _pressed(self, event: Any) -> str:
        pygame, key = self._pygame, event.key
        if key in (pygame.K_RETURN, pygame.K_KP_ENTER):
            if self.typed:
                return "command"
            self.typed = "" if self.typed is None else None
        elif key == pygame.K_ESCAPE:
            if self.typed is None:
                return "end"
            self.typed = None
        elif key == pygame.K_TAB:
            return "assist"
        elif self.typed is None or key in self._arrows:
            self._held.add(key)
        elif key == pygame.K_BACKSPACE:
            self.typed = self.typed[:-1]
        elif event.unicode.isprintable():
            self.typed = (self.typed + event.unicode)[:MAX_TYPED]
        return ""
