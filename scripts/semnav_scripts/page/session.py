"""One visitor of the page: a thread of its own that drives as the page asks."""

from __future__ import annotations

import contextlib
import json
import queue
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from semnav_env.language import Command, Stop
from semnav_env.language.languages import language_of
from semnav_env.language.told import in_words_of
from semnav_env.world.dynamics.social import for_json
from semnav_features.validation import clipped
from semnav_scripts.page.drawing_board import DrawingBoard
from semnav_scripts.page.drive import PageDrive
from semnav_scripts.page.freeing import free_memory
from semnav_scripts.page.kept_files import kept_file, plan_file
from semnav_scripts.page.outbox import ClientTooSlowError, Outbox
from semnav_scripts.page.requests import (
    OWN,
    AnswerRequest,
    CommandRequest,
    DoorRequest,
    DrawRequest,
    FileRequest,
    KeepRequest,
    PageRequest,
    PlaybackRequest,
    PutRequest,
    SceneRequest,
    SpeedRequest,
)
from semnav_scripts.page.understanding import (
    Asked,
    Refused,
    Understood,
    understand,
    understand_answer,
)

MAX_WAITING = 16
"""The most requests of a visitor that may wait."""

FRAMES_PER_SECOND = 20.0
"""The most pictures that are sent in a second; more of them would look the same."""

LATEST_LAG = 0.5
"""How late a step may be before the missed time is given up, seconds."""

STOP = Command((Stop(),))
"""The command that ends a run at once."""


class PageSession(threading.Thread):
    """Takes requests, drives in the time between them, and puts what happens into an outbox.

    Args:
        outbox: for messages to the visitor.
    """

    def __init__(self, outbox: Outbox) -> None:
        super().__init__(name="semnav page session", daemon=True)
        self._outbox = outbox
        self._waiting: queue.Queue[PageRequest | None] = queue.Queue(MAX_WAITING)
        self._ended, self._file_waits = threading.Event(), threading.Event()
        self._drive: PageDrive | None = None
        self._board: DrawingBoard | None = None
        self._asked: Asked | None = None
        self._paused, self._speed, self._due, self._shown = False, 1.0, 0.0, 0.0

    def ask(self, request: PageRequest) -> bool:
        """Let a request wait; False if too many wait already, or another file does."""
        is_file = isinstance(request, FileRequest)
        if is_file and self._file_waits.is_set():
            return False
        try:
            self._waiting.put_nowait(request)
        except queue.Full:
            return False
        if is_file:
            self._file_waits.set()
        return True

    def end(self) -> None:
        """Let the thread end after what it does now; it may be called from any thread."""
        self._ended.set()
        with contextlib.suppress(queue.Full):  # then the thread does not wait
            self._waiting.put_nowait(None)

    def run(self) -> None:
        """Serve the visitor until `end`."""
        try:
            while not self._ended.is_set():
                try:
                    request = self._waiting.get(timeout=self._patience())
                except queue.Empty:
                    self._attempt(self._step)
                    continue
                if request is not None:
                    self._attempt(partial(self._do, request))
        except ClientTooSlowError:
            self._ended.set()
        finally:
            self._drive = self._board = None
            free_memory()

    def _patience(self) -> float | None:
        """Time until the next step is due, seconds; None if none is."""
        if self._drive is None or self._drive.over or self._paused:
            return None
        return max(0.0, self._due - time.monotonic())

    def _attempt(self, work: Callable[[], None]) -> None:
        """Do something for the visitor; what goes wrong is told, and the session goes on."""
        try:
            work()
        except ClientTooSlowError:
            raise
        except (ValueError, OSError, ImportError) as error:
            self._tell_error(str(error))
        except Exception as error:
            if self._drive is not None:
                self._drive.stop()
            self._tell_error(f"this should not have happened: {type(error).__name__}: {error}")

    def _do(self, request: PageRequest) -> None:
        match request:
            case SceneRequest():
                own = None if self._board is None else self._board.plan
                self._drive, self._asked = PageDrive(request, own), None
                self._tell(self._drive.scene_message())
                self._show()
                free_memory()
            case CommandRequest(text=text, language=language):
                rooms = self._scene().env.floor_plan.room_names
                self._heed(understand(text, language, rooms))
            case AnswerRequest(text=text):
                if self._asked is None:
                    raise ValueError("nothing was asked; give a command")
                self._heed(understand_answer(self._asked, text))
            case PlaybackRequest(action=action):
                self._play(action)
            case SpeedRequest(factor=factor):
                self._speed = factor
            case DoorRequest(door=door, shut=shut):
                self._scene().shut(door, shut)
            case PutRequest(what=what, place=place, heading=heading):
                self._scene().put(what, place, heading)
                self._tell({"type": "put", "what": what})
                self._step()
            case KeepRequest(what="board"):
                self._outbox.put_news(plan_file(self._opened_board().plan))
            case KeepRequest(what=what):
                self._outbox.put_news(kept_file(what, self._scene()))
                free_memory()
            case FileRequest(name=name, content=content):
                self._file_waits.clear()
                self._board = DrawingBoard.from_file(name, content)
                self._tell(self._board.message())
            case DrawRequest():
                board = self._opened_board(anew=request.tool == "open")
                board.draw(request)
                self._tell(board.message(checked=request.tool == "check"))

    def _opened_board(self, anew: bool = False) -> DrawingBoard:
        """The drawing board; at first, and to begin anew, it has the plan of the scene."""
        is_of_scene = self._drive is not None and self._drive.scene.plan == OWN
        if self._board is None or (anew and not is_of_scene):
            self._board = DrawingBoard(self._scene().floor_plan)
        return self._board

    def _scene(self) -> PageDrive:
        if self._drive is None:
            raise ValueError("choose a scene first")
        return self._drive

    def _heed(self, heard: Understood | Asked | Refused) -> None:
        """Carry out what was understood, ask, or refuse."""
        self._asked = heard if isinstance(heard, Asked) else None
        if not isinstance(heard, Understood):
            self._tell(heard.message)
            return
        drive = self._scene()
        if heard.command == STOP and not drive.over:
            self._play("stop")
            return
        try:
            drive.begin(heard.text, heard.command, heard.language.code)
        except ValueError as error:
            self._tell(Refused(heard.text, str(error)).message)
            return
        self._paused, self._due = False, time.monotonic()
        self._tell(heard.message(drive.env.judge.mission.command))
        self._show()

    def _play(self, action: str) -> None:
        drive = self._scene()
        if drive.over:
            raise ValueError("nothing drives; give a command")
        match action:
            case "stop":
                drive.stop()
                self._tell_end("stopped by you")
            case "step":
                self._paused = True
                self._step()
            case _:
                self._paused, self._due = action == "pause", time.monotonic()

    def _step(self) -> None:
        drive = self._scene()
        drive.step()
        now = time.monotonic()
        self._due += 1.0 / (drive.control_hz * self._speed)
        if self._due < now - LATEST_LAG:
            self._due = now
        if drive.over or self._paused or now - self._shown >= 1.0 / FRAMES_PER_SECOND:
            self._show()
        if drive.over:
            self._tell_end("done" if drive.info["is_success"] else "failed")

    def _show(self) -> None:
        self._shown = time.monotonic()
        self._outbox.put_picture(_json(self._scene().frame()))

    def _tell_end(self, outcome: str) -> None:
        """Say how a run ended, in words too, for those who do not see the picture."""
        drive = self._scene()
        verdicts = [str(verdict) for verdict in drive.env.judge.verdicts]
        impossible = drive.info.get("impossible")
        if impossible and drive.said:
            impossible = in_words_of(language_of(drive.said[1]), impossible)
        self._tell(
            {
                "type": "ended",
                "outcome": outcome,
                "verdicts": verdicts,
                "impossible": impossible,
                "collisions": drive.info.get("collisions", 0),
                "seconds": round(drive.env.seconds, 1),
                "metres": round(drive.info.get("path_length", 0.0), 1),
                "social": for_json(drive.env.world.social()),
            }
        )

    def _tell_error(self, text: str) -> None:
        self._tell({"type": "error", "text": clipped(text.splitlines()[0] if text else "", 500)})

    def _tell(self, message: dict[str, Any]) -> None:
        self._outbox.put_news(_json(message))


def _json(message: dict[str, Any]) -> str:
    """In ASCII: a text may hold halves of letters, which cannot be sent as they are."""
    return json.dumps(message, separators=(",", ":"))
