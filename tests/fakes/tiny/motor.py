"""The tiny unit itself behind a TCP port: one line of text asks, one answers.

I            TINY 1.2
G 3          28              setting 3; ERR for one there is not
S 3 29       OK              kept at once, in force from the next start on
V            182 640         speed in 0.1 km/h, cadence in 0.1 rpm
"""

from __future__ import annotations

import socketserver
import threading
from collections.abc import Iterator
from contextlib import contextmanager

SETTINGS = {1: 25, 2: 15, 3: 28, 4: 5, 5: 20, 6: 250, 7: 31, 8: 1}
"""By number, as it leaves the factory."""


class TinyMotor:
    """Answers lines. silent: hears and says nothing. stuck: settings it takes and does not keep."""

    def __init__(self) -> None:
        self.settings = dict(SETTINGS)
        self.speed_kmh = self.cadence_rpm = 0.0
        self.silent = False
        self.stuck: set[int] = set()
        self._lock = threading.Lock()

    def answer(self, line: str) -> str | None:
        """The line it says to a line; None while it is silent."""
        with self._lock:
            if self.silent:
                return None
            word, *numbers = line.split()
            if word == "I":
                return "TINY 1.2"
            if word == "V":
                return f"{round(self.speed_kmh * 10)} {round(self.cadence_rpm * 10)}"
            return self._setting(word, [int(number) for number in numbers])

    def _setting(self, word: str, numbers: list[int]) -> str:
        if not numbers or numbers[0] not in self.settings:
            return "ERR"
        if word == "S":
            if numbers[0] not in self.stuck:
                self.settings[numbers[0]] = numbers[1]
            return "OK"
        return str(self.settings[numbers[0]])


@contextmanager
def listening(motor: TinyMotor) -> Iterator[str]:
    """The motor behind a free port of this machine; its url."""

    class Port(socketserver.StreamRequestHandler):
        def handle(self) -> None:
            for line in self.rfile:
                told = motor.answer(line.decode().strip())
                if told is not None:
                    self.wfile.write(f"{told}\n".encode())

    class Ports(socketserver.ThreadingTCPServer):
        daemon_threads = True
        allow_reuse_address = True
        # A host that is closed first leaves its port's thread reading; nobody waits for it.
        block_on_close = False

    with Ports(("127.0.0.1", 0), Port) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True)
        thread.start()
        try:
            yield f"socket://127.0.0.1:{server.server_address[1]}?family=tiny"
        finally:
            server.shutdown()
            thread.join()
