"""Where a proxy has put the server: below a path of its site, as https://example.org/spindle/.

A proxy takes the path off or passes it on; both are served, since no path of Spindle's own begins
like the site's (settings refuse one that does). Inside, paths are as they are at the root. Cookies
are for the whole site: a name with `__Host-` has to be, and no page of the site is kept apart from
another by a path anyway.
"""

from __future__ import annotations

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send


class RootPath:
    """Takes the path off requests, and puts it before the addresses that answers tell.

    root_path: `/spindle`, without a slash at its end.
    """

    def __init__(self, app: ASGIApp, root_path: str) -> None:
        self.app = app
        self.root_path = root_path

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return

        async def send_with_address(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                address = headers.get("location", "")
                if address.startswith("/"):
                    headers["location"] = self.root_path + address
            await send(message)

        inside = {**scope, "path": self._inside(scope["path"])}
        if scope.get("raw_path") is not None:
            inside["raw_path"] = self._inside(scope["raw_path"].decode("latin-1")).encode("latin-1")
        await self.app(inside, receive, send_with_address)

    def _inside(self, path: str) -> str:
        if f"{path}/".startswith(f"{self.root_path}/"):
            return path[len(self.root_path) :] or "/"
        return path
