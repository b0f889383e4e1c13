"""A cable that can be pulled while the unit at its other end goes on: a TCP relay."""

from __future__ import annotations

import contextlib
import socket
import threading


class Relay:
    """Listens on `port`, a free one if 0, and passes bytes on to a unit's; `cut` and `mend` as
    often as needed."""

    def __init__(self, unit_port: int, port: int = 0) -> None:
        self._unit_port = unit_port
        self._lock = threading.Lock()
        self._open: list[socket.socket] = []
        self.port = port
        self.mend()

    def mend(self) -> None:
        """Let connections through again, at the same port."""
        listener = socket.create_server(("127.0.0.1", self.port))
        self.port = listener.getsockname()[1]
        self._keep(listener)
        threading.Thread(target=self._accept, args=(listener,), daemon=True).start()

    def cut(self) -> None:
        """End every connection, and refuse new ones."""
        with self._lock:
            sockets, self._open = self._open, []
        for one in sockets:
            with contextlib.suppress(OSError):
                one.shutdown(socket.SHUT_RDWR)
            one.close()

    def _keep(self, one: socket.socket) -> None:
        with self._lock:
            self._open.append(one)

    def _accept(self, listener: socket.socket) -> None:
        with contextlib.suppress(OSError):
            while True:
                host, _ = listener.accept()
                unit = socket.create_connection(("127.0.0.1", self._unit_port))
                for source, target in ((host, unit), (unit, host)):
                    self._keep(source)
                    threading.Thread(target=pump, args=(source, target), daemon=True).start()


def pump(source: socket.socket, target: socket.socket) -> None:
    """Pass bytes on until either side ends; then both do."""
    with contextlib.suppress(OSError):
        while data := source.recv(4096):
            target.sendall(data)
    for one in (source, target):
        with contextlib.suppress(OSError):
            one.shutdown(socket.SHUT_RDWR)
