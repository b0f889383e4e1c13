"""The browser's pages: the built frontend, which routes itself, also below a path of a site.

A path without a file is a page only for who asks for one (a browser names text/html); a script that
asks for what is not there gets 404 and a problem, as everywhere.
"""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import HTMLResponse, Response
from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.web.safety import asks_for_a_page

NOT_BUILT = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Spindle</title>
<meta name="viewport" content="width=device-width">
<body style="font-family: system-ui; max-width: 40rem; margin: 4rem auto; padding: 0 1rem">
<h1>The pages are not built</h1>
<p>The server runs and its API answers at <a href="api/docs">/api/docs</a>, but the browser part
is missing. Run <code>make setup</code> in the checkout, then load this page again.</p>
"""


# First parts of paths that are no page, even to a browser.
NO_PAGES = frozenset({"api", "healthz", "readyz", "metrics"})


# Of the built entry page: what all its addresses are relative to.
BASE = '<base href="/" />'


class Pages(StaticFiles):
    """Files of the built frontend; a page that is no file gets the entry page.

    Paths below `api/`, those that machines ask for and those that look like files stay 404: a
    script that is asked for and missing must not arrive as HTML. root_path: told to the entry page.
    """

    def __init__(self, folder: Path, root_path: str = "") -> None:
        super().__init__(directory=folder, html=True)
        self.entry = folder / "index.html"
        self.root_path = root_path

    async def get_response(self, path: str, scope: Scope) -> Response:
        """The file at `path`, or the entry page with no caching."""
        first, last = path.split("/", 1)[0], path.rsplit("/", 1)[-1]
        is_page = (
            first not in NO_PAGES and "." not in last and asks_for_a_page(Headers(scope=scope))
        )
        try:
            response = await self._file(path, scope)
        except HTTPException as error:
            if error.status_code != 404 or not is_page:
                raise
            response = await self._file("index.html", scope)
            is_page = True
        # Names under assets/ carry a hash of their content; everything else may change any time.
        is_hashed = path.startswith("assets/")
        cache = "public, max-age=31536000, immutable" if is_hashed else "no-cache"
        response.headers["cache-control"] = cache
        return response

    async def _file(self, path: str, scope: Scope) -> Response:
        """A file as it is, but for an entry page that has to know the root path."""
        if self.root_path == "" or path not in (".", "index.html"):
            return await super().get_response(path, scope)
        base = BASE.replace('"/"', f'"{self.root_path}/"')
        page = await run_in_threadpool(self.entry.read_text, encoding="utf-8")
        return HTMLResponse(page.replace(BASE, base))


def install(app: FastAPI, folder: Path | None, root_path: str = "") -> None:
    """Serves the frontend at `/`, or a page that says how to build it.

    root_path: below which a proxy has it.
    """
    if folder is not None and (folder / "index.html").is_file():
        app.mount("/", Pages(folder, root_path), name="pages")
        return

    @app.get("/", operation_id="get_not_built", include_in_schema=False)
    async def not_built() -> HTMLResponse:
        return HTMLResponse(NOT_BUILT)


class RootPath:
    """Takes the path off requests, and puts it before the addresses that answers tell.

    A proxy takes the path off or passes it on; both are served, since no path of Spindle's own
    begins like the site's (settings refuse one that does). Inside, paths are as they are at the
    root. Cookies are for the whole site: a name with `__Host-` has to be, and no page of the site
    is kept apart from another by a path anyway.

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

        # Of links that answers make; routes do not look at it.
        inside = {**scope, "path": self._inside(scope["path"]), "app_root_path": self.root_path}
        if scope.get("raw_path") is not None:
            inside["raw_path"] = self._inside(scope["raw_path"].decode("latin-1")).encode("latin-1")
        await self.app(inside, receive, send_with_address)

    def _inside(self, path: str) -> str:
        if f"{path}/".startswith(f"{self.root_path}/"):
            return path[len(self.root_path) :] or "/"
        return path
