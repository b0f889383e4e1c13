"""What keeps other people's pages and oversized requests away from a server on a desk.

A browser on this machine can reach loopback, and so can every page it shows. Two attacks follow:
a page of another site sends us requests (its Origin gives it away), and a name of another site is
made to resolve to 127.0.0.1 (its Host gives it away: DNS rebinding). Both are refused here, on
WebSocket handshakes too, before any route sees them. An address given as numbers cannot be
rebound, so numeric hosts pass as long as the server may be reached by them.

A proxy on this machine calls from loopback too, with whatever the network sends it. What it adds to
a request gives it away; such a request is refused unless somebody said that the way is guarded.

The scripts of the pages are no exception, though they hold nothing of anybody. A proxy that puts a
Host of its own into requests hides that it is one; were they let past, a server that asks nobody
would be open, in a page that reads well, to whomever it serves. The entry page says why it is
empty.
"""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from ipaddress import ip_address
from urllib.parse import urlsplit

from fastapi.responses import HTMLResponse
from starlette.datastructures import Headers, MutableHeaders
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.web.problem import problem_response, refuse

CONTENT_SECURITY_POLICY = (
    "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self'; worker-src 'self'; "
    "object-src 'none'; base-uri 'self'; form-action 'self'; frame-ancestors 'none'"
)
# Python refuses to read numbers of thousands of digits with an exception of its own.
LENGTH_DIGITS_MAX = 18
# Put on by proxies: RFC 7239, RFC 9110 section 7.6.3, and what came before them.
PASSED_ON = ("forwarded", "via", "x-real-ip")
PASSED_ON_PREFIX = "x-forwarded-"
SECURITY_HEADERS = {
    "content-security-policy": CONTENT_SECURITY_POLICY,
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), microphone=(), geolocation=(), "
    "publickey-credentials-create=(self), publickey-credentials-get=(self)",
}


def host_name(netloc: str) -> str:
    """The name or address in `name:port`, lower case, without brackets; empty if malformed."""
    try:
        return (urlsplit(f"//{netloc}").hostname or "").rstrip(".")
    except ValueError:
        return ""


def origin_host(origin: str) -> str:
    """The `name:port` of an Origin header; empty for `null` and for what is no origin."""
    try:
        return urlsplit(origin).netloc.lower()
    except ValueError:
        return ""


@dataclass(frozen=True)
class AllowedHosts:
    """Which Host headers are ours.

    names: besides `localhost`. any_address: numeric hosts other than loopback pass too, because
    the server listens on more than loopback.
    """

    names: frozenset[str] = frozenset()
    any_address: bool = False

    def allows(self, netloc: str) -> bool:
        """Whether a Host header (`name[:port]`) names this server."""
        name = host_name(netloc)
        if name == "localhost" or name in self.names:
            return True
        try:
            address = ip_address(name)
        except ValueError:
            return False
        return self.any_address or address.is_loopback


def passed_on_by(headers: Headers) -> str | None:
    """The header by which a proxy shows; None for a request that comes straight from its client."""
    return next(
        (name for name in headers if name in PASSED_ON or name.startswith(PASSED_ON_PREFIX)), None
    )


def asks_for_a_page(headers: Headers) -> bool:
    """Whether a request is a browser's for something to show."""
    return "text/html" in headers.get("accept", "").lower()


class SameOriginOnly:
    """Refuses foreign Host and Origin headers with 403, on HTTP and on WebSocket handshakes.

    A browser that opens a page is answered with one in words.

    guarded: whether proxies may pass requests on, because they or somebody else let in only whom
    they know.
    """

    def __init__(self, app: ASGIApp, hosts: AllowedHosts, guarded: bool = False) -> None:
        self.app = app
        self.hosts = hosts
        self.guarded = guarded

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        why = self._why_refused(headers)
        if why is None:
            await self.app(scope, receive, send)
            return
        refusal: Response
        if scope["type"] == "http" and asks_for_a_page(headers):
            refusal = refused_page(403, *why)
        else:
            refusal = problem_response(403, *why)
        await refuse(refusal, scope, receive, send)

    def _why_refused(self, headers: Headers) -> tuple[str, str] | None:
        """Code and words of the refusal; None for what may go further in."""
        host = headers.get("host", "")
        if not self.hosts.allows(host):
            return (
                "foreign_host",
                f"This server is not called {host!r}. Open it as localhost, by its address, or "
                "name it in SPINDLE_ALLOWED_HOSTS.",
            )
        proxy = None if self.guarded else passed_on_by(headers)
        if proxy is not None:
            return (
                "passed_on",
                f"A proxy passed this request on ({proxy}), and this server lets in whoever "
                "reaches it. Set SPINDLE_AUTH=required to have people sign in, or SPINDLE_AUTH=off "
                "if the proxy lets in only whom you know.",
            )
        origin = headers.get("origin")
        if origin is not None and origin_host(origin) != host.lower():
            return (
                "foreign_origin",
                f"A page of {origin!r} may not use this server, which was called as {host!r}; only "
                "its own pages may. A proxy must pass on the Host that the browser sent.",
            )
        return None


class BodyTooLarge(HTTPException):
    """Raised while a body is being read; FastAPI lets it through to the problem handler."""

    def __init__(self, bytes_max: int) -> None:
        super().__init__(413, f"The request body is larger than {bytes_max} bytes.")


# A client whose connection closes while it still sends loses the answer: so much is read and
# dropped.
DROPPED_BYTES_MAX = 64 * 1024 * 1024


async def drop_body(receive: Receive) -> None:
    """Read what is left of a request's body, up to a bound."""
    dropped = 0
    while dropped < DROPPED_BYTES_MAX:
        message = await receive()
        if message["type"] != "http.request" or not message.get("more_body", False):
            return
        dropped += len(message.get("body", b""))


async def answer_and_drop(response: Response, scope: Scope, receive: Receive, send: Send) -> None:
    """Answer at once, and close the connection only when the other end has sent its body."""

    async def send_open(message: Message) -> None:
        await send({**message, "more_body": True} if "body" in message else message)

    await response(scope, receive, send_open)
    await drop_body(receive)
    await send({"type": "http.response.body", "body": b""})


class BodyBound:
    """Refuses bodies beyond a bound, by their declared length or while they arrive.

    bytes_max: for every route but those under upload_paths, which have upload_bytes_max.
    Protects the memory of the process.
    """

    def __init__(
        self, app: ASGIApp, bytes_max: int, upload_bytes_max: int, upload_paths: tuple[str, ...]
    ) -> None:
        self.app = app
        self.bytes_max = bytes_max
        self.upload_bytes_max = upload_bytes_max
        self.upload_paths = upload_paths

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        is_upload = scope["path"].startswith(self.upload_paths)
        bytes_max = self.upload_bytes_max if is_upload else self.bytes_max
        headers = Headers(scope=scope)
        declared = headers.get("content-length", "0")
        if (
            not declared.isdecimal()
            or len(declared) > LENGTH_DIGITS_MAX
            or int(declared) > bytes_max
        ):
            detail = f"The request body may have at most {bytes_max} bytes, not {declared[:30]}."
            refusal = problem_response(413, "too_large", detail, headers={"connection": "close"})
            # Who waits for leave to send does not send.
            if headers.get("expect", "").lower() == "100-continue":
                await refusal(scope, receive, send)
            else:
                await answer_and_drop(refusal, scope, receive, send)
            return
        received = 0

        async def bounded_receive() -> Message:
            nonlocal received
            message = await receive()
            received += len(message.get("body", b""))
            if received > bytes_max:
                if message.get("more_body", False):
                    await drop_body(receive)
                raise BodyTooLarge(bytes_max)
            return message

        await self.app(scope, bounded_receive, send)


class SecurityHeaders:
    """Puts the fixed headers on every response."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in SECURITY_HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        await self.app(scope, receive, send_with_headers if scope["type"] == "http" else send)


DOCS = "docs/behind-a-proxy.md"
# By code; the English words are the refusal's own.
CHINESE = {
    "foreign_host": "此服务器不叫这个名称（Host）。请用 localhost 或其 IP 地址打开，"
    "或将该名称写入 SPINDLE_ALLOWED_HOSTS。",
    "passed_on": "此请求由代理转发，而此服务器对任何能访问它的人开放。请设置 SPINDLE_AUTH=required "
    "要求登录；若代理只放行您认识的人，可设置 SPINDLE_AUTH=off。",
    "foreign_origin": "其他来源（Origin）的页面不得使用此服务器。若在代理之后，"
    "代理须原样传递浏览器所用的名称（Host）。",
}
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Spindle: {code}</title>
<meta name="viewport" content="width=device-width"><meta name="color-scheme" content="light dark">
<body style="font: 16px/1.5 system-ui; max-width: 40rem; margin: 4rem auto; padding: 0 1rem">
<h1>Spindle does not answer this way</h1><p>{detail}</p><p>Behind a proxy: {docs}</p>
<div lang="zh-CN"><h2>Spindle 未接受此访问</h2><p>{chinese}</p><p>代理设置见 {docs}</p></div>
<p><code>{code}</code></p>
"""


def refused_page(status: int, code: str, detail: str) -> HTMLResponse:
    """The refusal as a page of both languages, for a person whose browser opens what is refused.

    Programs and scripts get it as a problem. Nothing is fetched for it: the addresses of files may
    be what is wrong. code: one of CHINESE; detail: the English words.
    """
    page = PAGE.format(
        code=code, detail=escape(detail), chinese=escape(CHINESE[code]), docs=escape(DOCS)
    )
    return HTMLResponse(page, status)
