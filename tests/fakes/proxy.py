"""A proxy in front of a server, with the mistakes that proxies are set up with."""

from __future__ import annotations

import contextlib
import socket
import threading
from dataclasses import dataclass
from typing import Self
from urllib.parse import urlsplit

from tests.fakes.relay import pump

HEAD_BYTES_MAX = 65536


@dataclass
class Proxy:
    """Listens on a free port of 127.0.0.1; `url` is its address, and the site's.

    server_url: where requests go. own_host: it calls the server by the server's address, as nginx
    does unless told otherwise. below: path of the site under which the server is ("/spindle");
    strips: whether it is taken off. Elsewhere on the site there is nothing. sockets: whether it
    passes on that a WebSocket is wanted; may be changed at any time.
    """

    server_url: str
    own_host: bool = False
    below: str = ""
    strips: bool = True
    sockets: bool = True

    def __enter__(self) -> Self:
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.url = "http://{}:{}".format(*self._listener.getsockname())
        self._server = urlsplit(self.server_url)
        threading.Thread(target=self._accept, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        # Closing alone would leave the thread that waits in accept.
        with contextlib.suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                client, _ = self._listener.accept()
                threading.Thread(target=self._pass_on, args=(client,), daemon=True).start()

    def _pass_on(self, client: socket.socket) -> None:
        """One request of a connection, which ends with it."""
        with contextlib.suppress(OSError):
            received = b""
            while b"\r\n\r\n" not in received and len(received) < HEAD_BYTES_MAX:
                more = client.recv(4096)
                if not more:
                    client.close()
                    return
                received += more
            head, rest = received.split(b"\r\n\r\n", 1)
            passed = self._changed(head.decode("latin-1"))
            if passed is None:
                client.sendall(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n")
                client.sendall(b"Connection: close\r\n\r\n")
                client.close()
                return
            server = socket.create_connection((self._server.hostname, self._server.port))
            server.sendall(passed.encode("latin-1") + rest)
            threading.Thread(target=pump, args=(client, server), daemon=True).start()
            pump(server, client)

    def _changed(self, head: str) -> str | None:
        """The head of a request as the server gets it; None for what is not passed on."""
        first, *lines = head.split("\r\n")
        method, path, version = first.split(" ")
        if self.below:
            if not path.startswith(f"{self.below}/"):
                return None
            path = path[len(self.below) :] if self.strips else path
        headers = [line.split(":", 1) for line in lines]
        wants_socket = any(name.lower() == "upgrade" for name, _ in headers)
        dropped = set() if wants_socket and self.sockets else {"upgrade", "connection"}
        if self.own_host:
            dropped.add("host")
        kept = [f"{name}:{value}" for name, value in headers if name.lower() not in dropped]
        if self.own_host:
            kept.append(f"Host: {self._server.netloc}")
        if "connection" in dropped:
            kept.append("Connection: close")
        return "\r\n".join([f"{method} {path} {version}", *kept]) + "\r\n\r\n"
