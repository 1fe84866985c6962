"""The web server of the page: its files, and one WebSocket for each visitor."""

from __future__ import annotations

import asyncio
import contextlib
import json
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.routing import Mount, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.websockets import WebSocket, WebSocketDisconnect

from semnav_env.world.maps import bundled_names
from semnav_scripts.page.drawing_board import SUFFIXES
from semnav_scripts.page.guard import LOCAL_NAMES, OwnOriginOnly
from semnav_scripts.page.outbox import Outbox
from semnav_scripts.page.requests import (
    AGENTS,
    MAX_BOXES,
    MAX_FILE,
    MAX_NAME,
    MAX_TEXT,
    OFFICES,
    read_file,
    read_request,
)
from semnav_scripts.page.session import PageSession

FILES = Path(__file__).with_name("web")
"""Folder of what the browser loads."""

TRY_LATER, TOO_SLOW = 1013, 1008
"""Codes with which a WebSocket is closed."""

LOOKS, SECONDS_BETWEEN_LOOKS = 20, 0.1
"""How often a visitor looks for a free place before it is refused, and how long in between."""

PATIENCE = 5.0
"""How long a session may take to end, seconds; then it is left to itself."""


class Visits:
    """The sessions that there are: as many as it is said, and no more.

    Args:
        most: number of sessions at the same time.
    """

    def __init__(self, most: int) -> None:
        self.most = most
        self.now: set[PageSession] = set()

    async def visit(self, websocket: WebSocket) -> None:
        """Serve one visitor until one of both leaves."""
        await websocket.accept()
        if not await self._has_place():
            told = f"all {self.most} places are taken; close another page, or try again later"
            await websocket.send_text(_error(told))
            await websocket.close(TRY_LATER)
            return
        outbox = Outbox(asyncio.get_running_loop())
        session = PageSession(outbox)
        self.now.add(session)
        outbox.put_news(json.dumps(_choices()))
        session.start()
        try:
            await _talk(websocket, session, outbox)
        finally:
            session.end()
            try:
                await asyncio.to_thread(session.join, PATIENCE)
            finally:  # also if the server ends meanwhile
                self.now.discard(session)

    async def _has_place(self) -> bool:
        """Whether there is a place, or one becomes free soon, as where a page is loaded again."""
        for _ in range(LOOKS):
            if len(self.now) < self.most:
                return True
            await asyncio.sleep(SECONDS_BETWEEN_LOOKS)
        return False


async def _talk(websocket: WebSocket, session: PageSession, outbox: Outbox) -> None:
    """Pass messages in both directions until one side ends."""
    ways = [
        asyncio.create_task(_listen(websocket, session, outbox)),
        asyncio.create_task(_send(websocket, outbox)),
        asyncio.create_task(asyncio.to_thread(session.join)),
    ]
    try:
        await asyncio.wait(ways, return_when=asyncio.FIRST_COMPLETED)
    finally:
        session.end()
        for way in ways[:2]:
            way.cancel()
        await asyncio.gather(*ways, return_exceptions=True)
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # it is closed already
        await websocket.close(TOO_SLOW)


async def _listen(websocket: WebSocket, session: PageSession, outbox: Outbox) -> None:
    while True:
        message = await websocket.receive()
        if message["type"] == "websocket.disconnect":
            return
        try:
            text = message.get("text")
            request = read_file(message["bytes"]) if text is None else read_request(text)
        except ValueError as error:
            outbox.put_news(_error(str(error)))
            continue
        if not session.ask(request):
            outbox.put_news(_error("too many requests wait; this one was dropped"))


async def _send(websocket: WebSocket, outbox: Outbox) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):
        while True:
            message = await outbox.next()
            if isinstance(message, bytes):
                await websocket.send_bytes(message)
            else:
                await websocket.send_text(message)


def _choices() -> dict[str, Any]:
    """What the page offers."""
    return {
        "type": "choices",
        "plans": list(bundled_names()),
        "offices": list(OFFICES),
        "agents": list(AGENTS),
        "robots": ["wheelchair", "spot"],
        "most_boxes": MAX_BOXES,
        "longest_text": MAX_TEXT,
        "longest_name": MAX_NAME,
        "largest_file": MAX_FILE,
        "files": list(SUFFIXES),
    }


def _error(text: str) -> str:
    return json.dumps({"type": "error", "text": text})


def page_app(sessions: int = 4, names: frozenset[str] = LOCAL_NAMES) -> Starlette:
    """The application that a server runs.

    Args:
        sessions: the most visitors at the same time.
        names: by which the server may be asked for, without a port.
    """
    visits = Visits(sessions)
    app = Starlette(
        routes=[
            WebSocketRoute("/session", visits.visit),
            Mount("/", StaticFiles(directory=FILES, html=True)),
        ],
        middleware=[Middleware(OwnOriginOnly, names=names)],
    )
    app.state.visits = visits
    return app
