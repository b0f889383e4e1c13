"""A line that drops: a TCP relay whose connections end after some bytes."""

from __future__ import annotations

import contextlib
import random
import socket
import struct
import threading

# On the socket's end what was not sent is dropped, as when a radio loses its cell.
RESET = struct.pack("ii", 1, 0)


class BadLine:
    """Passes on connections to a server's port; every `holds_every`-th holds, of the others each
    ends, in the middle of whatever it says, after up to `bytes_max` bytes in either direction.

    dropped: how many did.
    """

    def __init__(self, port: int, bytes_max: int = 150_000, holds_every: int = 4) -> None:
        self._to = port
        self._bytes_max = bytes_max
        self._holds_every = holds_every
        # The same line in every run.
        self._random = random.Random(2011)
        self.dropped = 0
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self) -> None:
        self._listener.close()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            for number in range(1, 1_000_000):
                client, _ = self._listener.accept()
                holds = number % self._holds_every == 0
                left = None if holds else self._random.randrange(200, self._bytes_max)
                threading.Thread(target=self._connect, args=(client, left), daemon=True).start()

    def _connect(self, client: socket.socket, left: int | None) -> None:
        server = socket.create_connection(("127.0.0.1", self._to))
        back = threading.Thread(target=self._pass, args=(server, client, left), daemon=True)
        back.start()
        self._pass(client, server, left)
        back.join()
        client.close()
        server.close()

    def _pass(self, source: socket.socket, target: socket.socket, left: int | None) -> None:
        with contextlib.suppress(OSError):
            while data := source.recv(4096):
                if left is not None and (left := left - len(data)) < 0:
                    self.dropped += 1
                    break
                target.sendall(data)
            else:
                target.shutdown(socket.SHUT_WR)
                return
        for one in (source, target):
            with contextlib.suppress(OSError):
                one.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET)
                one.shutdown(socket.SHUT_RDWR)
