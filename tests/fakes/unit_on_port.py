"""A simulated unit on a TCP port, on a thread of this process: it can be silenced, let time pass,
and be unplugged.

The loop is that of `python -m sim_device unit --tcp`.
"""

from __future__ import annotations

import threading
from typing import Self

from sim_device.__main__ import command_line, host_unit
from sim_device.serial_line import TcpLine
from sim_device.simulator import serve


class UnitOnPort:
    """Plugged in from the start; words: of the command line of `sim_device unit`."""

    def __init__(self, *words: str, port: int = 0) -> None:
        asked = ["unit", "--tcp", str(port), *words]
        self._unit, self._flash, self._log = host_unit(command_line().parse_args(asked))
        self._line = TcpLine("127.0.0.1", port)
        self.port = int(self._line.address)
        self.url = f"socket://127.0.0.1:{self.port}"
        self._speaking = threading.Event()
        self._speaking.set()
        self._ending = threading.Event()
        self._pass_s = 0.0
        self._passed = threading.Event()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def silence(self) -> None:
        """It neither hears nor says anything, and its time stands; the port stays open."""
        self._speaking.clear()

    def speak(self) -> None:
        """It goes on."""
        self._speaking.set()

    def let_pass(self, seconds: float) -> None:
        """So much of its time passes at once; returns when it has."""
        self._passed.clear()
        self._pass_s = seconds
        assert self._passed.wait(30.0), "The unit's time does not pass."

    def unplug(self) -> None:
        """It is gone, and its port with it; twice is allowed."""
        self._ending.set()
        self._speaking.set()
        self._thread.join()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.unplug()

    def _serve(self) -> None:
        try:
            serve(self._unit, self._line, self._between, self._flash, self._log)
        finally:
            self._line.close()

    def _between(self) -> bool:
        """Asked by the loop before each round: whether it ends."""
        self._speaking.wait()
        if self._pass_s:
            self._unit.advance(self._pass_s)
            self._pass_s = 0.0
            self._passed.set()
        return self._ending.is_set()
