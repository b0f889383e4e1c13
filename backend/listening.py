"""How the server listens, says where, and runs the application until it is stopped."""

from __future__ import annotations

import asyncio
import socket
import ssl
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

import uvicorn

from backend.core.hosts import bracketed
from backend.errors import LinkError
from backend.server.certificate import ServerCertificate
from backend.web.connections import PatientProtocol
from backend.web.tls_handshake import TlsHandshake

# An open WebSocket or a long download must not hold a stopping server back.
SHUTDOWN_S = 2
# Connections that may wait while the store and the units are being opened.
BACKLOG = 128


def listening_socket(host: str, port: int) -> socket.socket:
    """A socket on the address, before anything else is opened. Raises LinkError if it is taken."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        return socket.create_server((host, port), family=family, backlog=BACKLOG)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise LinkError(
            f"{host} port {port} cannot be listened on: {reason}. Stop what uses "
            "it, or choose another with --port (0 takes a free one)."
        ) from None


def server_config(
    app: Callable[..., Any], proxies: tuple[str, ...] = (), tls: ssl.SSLContext | None = None
) -> uvicorn.Config:
    """How uvicorn runs the application.

    proxies: addresses and networks that are believed whom they pass on; nobody else is.
    tls: spoken on every connection; None for none.
    """
    http: Any = PatientProtocol if tls is None else partial(TlsHandshake, tls, PatientProtocol)
    return uvicorn.Config(
        app,
        log_level="warning",
        lifespan="off",
        proxy_headers=bool(proxies),
        forwarded_allow_ips=",".join(proxies),
        http=http,
        # Compressing 20 small frames a second costs more than it saves on loopback.
        ws_per_message_deflate=False,
        # Browsers send nothing larger; whatever does is not a browser.
        ws_max_size=64 * 1024,
        server_header=False,
        timeout_graceful_shutdown=SHUTDOWN_S,
    )


class AnnouncingServer(uvicorn.Server):
    """Prints one line with the address, and only once requests are really answered.

    end_waiting: lets go of requests that would wait for longer than the server takes to end.
    first_token: of the link for the first administrator; None where none is needed. certificate:
    of the TLS it speaks; None without.
    """

    def __init__(
        self,
        config: uvicorn.Config,
        end_waiting: Callable[[], None],
        first_token: str | None = None,
        certificate: ServerCertificate | None = None,
    ) -> None:
        super().__init__(config)
        self._end_waiting = end_waiting
        self._first_token = first_token
        self._certificate = certificate

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Starts to listen, then says where."""
        await super().startup(sockets)
        if self.started and sockets:
            host, port = sockets[0].getsockname()[:2]
            scheme = "http" if self._certificate is None else "https"
            url = f"{scheme}://{bracketed(host)}:{port}"
            sys.stdout.write(f"Spindle is ready at {url} (Ctrl-C stops it)\n")
            if self._certificate is not None:
                sys.stdout.write(words_of(self._certificate))
            if self._first_token is not None:
                sys.stdout.write(first_link(host, port, self._first_token, scheme))
            sys.stdout.flush()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stops to listen, answers who waits, ends."""
        ending = asyncio.create_task(asyncio.to_thread(self._end_waiting))
        await super().shutdown(sockets)
        await ending


def words_of(certificate: ServerCertificate) -> str:
    """What is printed of a certificate: by what people know that it is this server's."""
    made = "which it made itself, " if certificate.is_own else ""
    return (
        f"Its certificate, {made}ends on {certificate.ends_at:%Y-%m-%d}. SHA-256 fingerprint:\n"
        f"  {certificate.sha256}\n"
    )


def first_link(host: str, port: int, token: str, scheme: str = "http") -> str:
    """What is printed while there is no administrator.

    The token stands behind the `#`: a browser sends it to nobody, and no log of requests has it.
    """
    anywhere = host in ("0.0.0.0", "::")
    shown = "localhost" if anywhere else bracketed(host)
    return (
        "There is no administrator yet. Whoever opens this link first becomes one (it works once, "
        f"until the next start):\n  {scheme}://{shown}:{port}/sign-in#first={token}\n"
    )
