"""The loop of `semnav play`: events, a step, a picture."""

from __future__ import annotations

from semnav_env.rendering.viewer import Viewer
from semnav_scripts.page.understanding import Asked, Refused, understand, understand_answer
from semnav_scripts.playing.controls import Controls
from semnav_scripts.playing.played_drive import PlayedDrive, PlayedRun

HELP = "Arrows or W A S D drive · Enter: type a command · Tab: assistance · Esc: end"
"""What a person is told before the robot moves."""


class Game:
    """Lets a person drive in a window.

    Nothing moves before the first key is pressed, so that there is time to look.

    Args:
        drive: what is driven; its first episode has begun.
        language: of typed commands; recognised if not given.

    Raises:
        RuntimeError: there is no display.
        ImportError: pygame-ce is missing.
    """

    def __init__(self, drive: PlayedDrive, language: str | None = None) -> None:
        self._drive, self._language = drive, language
        self._viewer = Viewer(drive.env.floor_plan, fps=drive.env.metadata["render_fps"])
        self._window = self._viewer.window
        self._controls = Controls()
        self._asked: Asked | None = None
        self._told = HELP
        self._begun = False

    def play(self, seconds: float) -> None:
        """Drive until the window is closed or Escape is pressed.

        Args:
            seconds: simulated time after which it ends as well.
        """
        period = 1.0 / self._drive.env.setup.control_hz
        left = round(seconds / period)
        try:
            while left > 0 and self._window.is_open:
                if any([self._takes(event) == "end" for event in self._window.events()]):
                    break
                self._step()
                left -= 1
                self._viewer.show(self._drive.frame(self._prompt))
        finally:
            self._viewer.close()

    def _takes(self, event: object) -> str:
        """Do what an event asks for, and return what that is."""
        asked = self._controls.take(event)
        if asked == "assist":
            self._drive.agent.active = not self._drive.agent.active
        elif asked == "command":
            self._give(self._controls.take_typed())
        return asked

    def _step(self) -> None:
        action = self._controls.action(self._drive.env.robot.action_size)
        self._begun = self._begun or bool(action.any())
        if not self._begun:
            return
        was_over = self._drive.over
        self._drive.step(action)
        if self._told == HELP and self._drive.env.seconds > 3.0:
            self._told = ""
        if self._drive.over and not was_over:
            self._told = f"{self._drive.verdict} · Enter: the next command"

    def _give(self, text: str) -> None:
        """Begin what was typed, or ask, or say why not."""
        asked, self._asked = self._asked, None
        rooms = self._drive.env.floor_plan.room_names
        heard = understand_answer(asked, text) if asked else understand(text, self._language, rooms)
        if isinstance(heard, Asked):
            self._asked, self._told = heard, f"{heard.question.text} (Enter: answer)"
        elif isinstance(heard, Refused):
            self._told = heard.why
        else:
            said = heard.text, heard.language.code, heard.command
            try:
                self._drive.begin(said, self._drive.env.world.pose)
                self._told = "; ".join(heard.corrections)
            except ValueError as error:
                self._told = str(error)

    @property
    def _prompt(self) -> str:
        typed = self._controls.typed
        return self._told if typed is None else f"> {typed}_"


def described(run: PlayedRun) -> str:
    """A run in one line."""
    told = run.outcome
    verdict = "done" if run.success else " / ".join(run.verdicts)
    return (
        f'"{told["command"]}": {verdict} after {told["seconds"]:.1f} s, '
        f"{told['collisions']} collisions"
    )
