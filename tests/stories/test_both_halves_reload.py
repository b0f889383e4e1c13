"""Goal: `make dev` shows a change of either half at once, and leaves nothing behind.

Method: the command as it is, on free ports and in a folder of its own. A page asks through Vite as
a browser does, with its Origin, by HTTP and by WebSocket. A Python file is given a new time.
"""

import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from websockets.sync.client import connect

from backend import dev, errors
from backend.settings import Settings, load
from tests.fakes.server import eventually

ROOT = Path(__file__).resolve().parents[2]
WITHIN_S = 90

pytestmark = [pytest.mark.slow, pytest.mark.host_build("a unit of `make dev` is the host's")]


class Running:
    """`make dev` without make."""

    def __init__(self, folder: Path) -> None:
        self.log = folder / "dev.log"
        settings = {"SPINDLE_PORT": "0", "SPINDLE_DATA": str(folder / "data"), "NO_COLOR": "1"}
        with self.log.open("w") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "backend.dev"],
                cwd=ROOT,
                env={**os.environ, **settings},
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def told(self, pattern: str, times: int = 1) -> str:
        """The first group of the pattern, once it was printed so often."""
        found = eventually(
            lambda: re.findall(pattern, self.log.read_text()),
            lambda hits: len(hits) >= times,
            WITHIN_S,
        )
        return str(found[0])

    def interrupt(self) -> None:
        """Ctrl-C, which reaches every process of the terminal."""
        os.killpg(self.process.pid, signal.SIGINT)

    def is_gone(self) -> bool:
        """Whether no process of the terminal is left."""
        try:
            os.killpg(self.process.pid, 0)
        except ProcessLookupError:
            return True
        return False


@pytest.fixture
def running(tmp_path: Path) -> Iterator[Running]:
    started = Running(tmp_path)
    yield started
    if started.process.poll() is None:
        started.interrupt()
        started.process.wait(WITHIN_S)


@pytest.mark.long
def test_a_change_of_python_is_there_at_once_and_ctrl_c_ends_all(running: Running) -> None:
    pages = running.told(r"Local:\s+(http://127\.0\.0\.1:\d+)")
    running.told(r"Spindle is ready at (\S+)")
    client = httpx.Client(base_url=pages, headers={"origin": pages}, trust_env=False, timeout=30)

    assert "/@vite/client" in client.get("/").text
    health = client.get("/api/v1/health").raise_for_status()
    with connect(f"{pages.replace('http', 'ws')}/api/v1/devices/none/live", origin=pages) as live:
        assert "not_found" in str(live.recv(timeout=WITHIN_S))

    os.utime(errors.__file__)
    running.told(r"Spindle is ready at (\S+)", times=2)
    assert client.get("/api/v1/health").raise_for_status().json().keys() == health.json().keys()

    running.interrupt()
    assert running.process.wait(WITHIN_S) == 0
    assert eventually(running.is_gone)
    with pytest.raises(httpx.ConnectError):
        client.get("/")


def test_a_port_that_is_taken_is_told_and_a_free_one_used(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        taken = other.getsockname()[1]
        settings: Settings = load({"host": "127.0.0.1", "port": taken})

        with dev.a_socket(settings) as listening:
            port = listening.getsockname()[1]

    assert port != taken
    assert f"127.0.0.1 port {taken} cannot be listened on" in capsys.readouterr().err
