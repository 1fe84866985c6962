"""`semnav serve`: a page in the browser to try it in."""

from __future__ import annotations

from dataclasses import dataclass

from semnav_features.validation import require

INSTALL = 'the page needs Starlette and uvicorn: pip install "semnav-env[serve]"'
"""Said where the extra is missing."""

GETTING_READY = (
    "getting ready; kernels used for the first time are compiled: about a minute on an idle "
    "machine, several on a busy one"
)
"""Said before the page can be opened."""

EVERYWHERE = ("", "0.0.0.0", "::")
"""Addresses that stand for all of a machine: no browser names them as `Host`."""

SHUTDOWN_SECONDS = 3
"""How long visitors have to leave when the server ends, seconds."""

MAX_BYTES = 5_000_000
"""Size of a message at which a connection is closed unread, bytes; smaller ones are answered. A
dropped file may have 4,000,000."""


@dataclass(frozen=True)
class Arguments:
    """Open a page in the browser: choose a floor plan, type a command, watch the robot.

    It runs until Ctrl-C. Nobody but this machine reaches it, unless --host says otherwise; there
    is no password.

    Attributes:
        port: of the page; 0 for any that is free.
        host: address of this machine by which the page is asked for; 127.0.0.1, the default, is
            for this machine alone.
        sessions: the most pages that are open at the same time, each with a robot of its own.
    """

    port: int = 8321
    host: str = "127.0.0.1"
    sessions: int = 4

    def run(self) -> int:
        """Compile, say where the page is, and serve it."""
        require(0 <= self.port <= 65535, "--port", self.port, "from 0 to 65535")
        right = "one address of this machine, by which its pages are asked for"
        require(self.host not in EVERYWHERE, "--host", self.host, right)
        require(1 <= self.sessions <= 64, "--sessions", self.sessions, "from 1 to 64")
        try:
            import starlette
            import uvicorn
            import websockets
        except ImportError:
            raise ValueError(INSTALL) from None
        del starlette, websockets
        from semnav_scripts.page.app import page_app
        from semnav_scripts.page.guard import LOCAL_NAMES
        from semnav_scripts.page.listening import listening
        from semnav_scripts.page.warm_up import warm_up

        with listening(self.host, self.port) as place:
            print(GETTING_READY, flush=True)
            warm_up()
            port = place.getsockname()[1]
            name = f"[{self.host}]" if ":" in self.host else self.host
            print(f"open http://{name}:{port} (Ctrl-C ends it)", flush=True)
            settings = uvicorn.Config(
                page_app(self.sessions, LOCAL_NAMES | {self.host}),
                log_level="warning",
                ws_max_size=MAX_BYTES,
                ws_max_queue=2,
                server_header=False,
                timeout_graceful_shutdown=SHUTDOWN_SECONDS,
            )
            uvicorn.Server(settings).run(sockets=[place])
        return 0
