"""A simulated unit as a child process on a pseudo-terminal, opened through pyserial like any other.

The child runs the real firmware against physics (`python -m sim_device unit`). It ends with this
link, and by itself when this process dies.
"""

from __future__ import annotations

import contextlib
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from urllib.parse import parse_qs

from backend.device.link.base import READ_BYTES_MAX
from backend.device.link.serial_port import BAUD_DEFAULT, SerialPort, baud_of
from backend.errors import InvalidRequest, LinkError

# A cold start of Python and numpy on a loaded machine takes about 2 s.
READY_TIMEOUT_S = 15.0
STOP_TIMEOUT_S = 2.0
POLL_S = 0.1
NAME_DEFAULT = "unit"
SETTINGS = ("seed", "speed", "clock", "scenario", "flash", "market", "unlock_key", "baud", "sensor")
CLOCKS = ("real", "virtual")
# What the noise of the physics is begun with is 64 bits wide there and has a sign.
SEED_MAX = 2**63 - 1
# What the child says last is quoted when it fails; more than this helps nobody.
COMPLAINT_CHARACTERS_MAX = 600
COMPLAINT_BYTES_MAX = 4 * COMPLAINT_CHARACTERS_MAX


@dataclass(frozen=True)
class SimulatedAddress:
    """`sim` or `sim:NAME?seed=&speed=&clock=&scenario=&flash=&market=&unlock_key=&baud=&sensor=`,
    taken apart.

    Each name is a unit of its own: without a seed the name makes one, so two names never share a
    serial number. clock: `real`, or `virtual` for time that passes only when told to. scenario:
    one of Spindle's, `none`, or the path of a TOML file. flash: file that keeps the unit's
    configuration. market: whose law it was made for, `eu_epac` unless told; a flash that is there
    keeps its own. unlock_key: file with the maker's public key; without one the unit's limits only
    go down. baud: its line has a rate like a real one, from 115200 bit/s on, and this is the rate
    to ask for. sensor: the state of its torque sensor, of sim_device.sensor_state.
    """

    name: str
    seed: int
    speed: float
    scenario: str | None
    flash: str | None
    unlock_key: str | None = None
    clock: str = "real"
    baud: int | None = None
    market: str | None = None
    sensor: str | None = None

    @classmethod
    def parse(cls, url: str) -> SimulatedAddress:
        """Read the url; raises InvalidRequest naming what is wrong."""
        path, _, query = url.removeprefix("sim").removeprefix(":").partition("?")
        name = path or NAME_DEFAULT
        settings = {key: values[-1] for key, values in parse_qs(query).items()}
        unknown = sorted(set(settings) - set(SETTINGS))
        if unknown:
            raise InvalidRequest(
                f"{url}: `{unknown[0]}` is no setting of a simulated unit; "
                f"there are {', '.join(SETTINGS)}."
            )
        try:
            seed = int(settings.get("seed", zlib.crc32(name.encode()) % 1_000_000))
            speed = float(settings.get("speed", 1.0))
        except ValueError as error:
            raise InvalidRequest(f"{url}: seed is a whole number, speed a number.") from error
        if not 0 <= seed <= SEED_MAX:
            raise InvalidRequest(f"{url}: seed is from 0 to {SEED_MAX}.")
        if not 0.01 <= speed <= 1000.0:
            raise InvalidRequest(f"{url}: speed is a factor from 0.01 to 1000.")
        clock = settings.get("clock", "real")
        if clock not in CLOCKS:
            raise InvalidRequest(f"{url}: clock is {' or '.join(CLOCKS)}, not {clock}.")
        baud = baud_of(url, settings["baud"]) if "baud" in settings else None
        if baud is not None and clock == "virtual":
            raise InvalidRequest(f"{url}: bytes take time on a line with a rate; clock=real.")
        scenario, flash = settings.get("scenario"), settings.get("flash")
        key, market = settings.get("unlock_key"), settings.get("market")
        sensor = settings.get("sensor")
        return cls(name, seed, speed, scenario, flash, key, clock, baud, market, sensor)

    @property
    def memory_name(self) -> str:
        """The file of a unit that has no flash of its own: another for another market.

        Markets are in upper case there and `none` is not, as every version has written them, so
        that units keep their settings.
        """
        market = (self.market or "").upper()
        made_for = f"-{'none' if market == 'NONE' else market}" if market else ""
        return f"unit-{self.seed}{made_for}.flash"

    def command(self, pty_path: Path) -> list[str]:
        """The command line of the child that serves this address on `pty_path`."""
        words = [sys.executable, "-m", "sim_device", "unit", "--pty", str(pty_path)]
        words += ["--seed", str(self.seed), "--speed", str(self.speed)]
        if self.clock == "virtual":
            words += ["--virtual"]
        if self.baud is not None:
            words += ["--serial-rate", str(BAUD_DEFAULT)]
        if self.scenario is not None:
            words += ["--scenario", self.scenario]
        if self.flash is not None:
            words += ["--flash", self.flash]
        if self.market is not None:
            words += ["--market", self.market]
        if self.sensor is not None:
            words += ["--sensor", self.sensor]
        if self.unlock_key is not None:
            words += ["--unlock-key", self.unlock_key]
        return words


class SimulatedLink:
    """The child process and the serial port on its pseudo-terminal.

    flash_folder: where units without a flash of their own keep their configuration, None for
    nowhere. given_up: set by who no longer waits for its start. Raises LinkError with the child's
    own words when it does not get ready.
    """

    def __init__(
        self,
        url: str,
        flash_folder: Path | None = None,
        ready_timeout_s: float = READY_TIMEOUT_S,
        cancelled: threading.Event | None = None,
    ) -> None:
        if os.name != "posix":
            raise LinkError(
                f"{url}: a simulated unit of Spindle's own needs pseudo-terminals. Here, start "
                "`spindle sim --tcp 8751` and add `socket://127.0.0.1:8751`."
            )
        address = SimulatedAddress.parse(url)
        if address.flash is None and flash_folder is not None:
            flash_folder.mkdir(parents=True, exist_ok=True)
            address = replace(address, flash=str(flash_folder / address.memory_name))
        self._url = url
        self._cancelled = cancelled or threading.Event()
        self._folder = Path(tempfile.mkdtemp(prefix="spindle-sim-"))
        self._child = self._start(address.command(self._folder / "port"))
        # In memory: a full disk would take none of the words that say so.
        self._complaints = bytearray()
        self._listener = threading.Thread(target=self._listen, name=f"{url} stderr", daemon=True)
        self._listener.start()
        try:
            self._port = SerialPort(
                self._ready_path(ready_timeout_s), url, address.baud is not None, address.baud
            )
        except BaseException:
            self._stop()
            raise

    @property
    def url(self) -> str:
        """What the unit was asked for with."""
        return self._url

    @property
    def bits_per_second(self) -> float | None:
        """The line's rate now; None without `baud`, where a pseudo-terminal takes no time."""
        return self._port.bits_per_second

    @property
    def bits_per_second_requested(self) -> int | None:
        """What `baud` asks for."""
        return self._port.bits_per_second_requested

    def set_baudrate(self, bits_per_second: int) -> None:
        """Run the line at this rate from now on."""
        self._port.set_baudrate(bits_per_second)

    @property
    def process_id(self) -> int:
        """The child's process id."""
        return self._child.pid

    def read(self, bytes_max: int = READ_BYTES_MAX) -> bytes:
        """Return what has arrived, at most `bytes_max`; b"" when nothing has."""
        with self._child_quoted():
            return self._port.read(bytes_max)

    def write(self, data: bytes) -> int:
        """Send what the port takes now and return how many bytes that was."""
        with self._child_quoted():
            return self._port.write(data)

    def close(self) -> None:
        """Close the port and end the child; twice is allowed."""
        self._port.close()
        self._stop()

    @contextlib.contextmanager
    def _child_quoted(self) -> Iterator[None]:
        """A port that vanished because the child ended says what the child said."""
        try:
            yield
        except LinkError as error:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._child.wait(POLL_S)
            code = self._child.returncode
            if not code:
                raise
            raise LinkError(
                f"{self._url}: the simulated unit ended with code {code}: "
                f"{self._complaint() or 'it said nothing'}",
                code="simulator_failed",
            ) from error

    def _start(self, command: list[str]) -> subprocess.Popen[bytes]:
        folders = [str(Path(__file__).resolve().parents[2]), os.environ.get("PYTHONPATH")]
        python_path = os.pathsep.join(folder for folder in folders if folder)
        return subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": python_path},
            # Ctrl-C in the terminal goes to the server, which then ends its children in order.
            start_new_session=True,
        )

    def _ready_path(self, timeout_s: float) -> str:
        """Wait for the child's line `ready PATH` and return the path."""
        lines: queue.Queue[bytes] = queue.Queue(maxsize=1)
        stream = self._child.stdout
        assert stream is not None
        threading.Thread(
            target=lambda: lines.put(stream.readline()), name=f"{self._url} ready", daemon=True
        ).start()
        until_s = time.monotonic() + timeout_s
        while True:
            try:
                line = lines.get(timeout=POLL_S)
                break
            except queue.Empty:
                if self._cancelled.is_set():
                    raise self._not_ready("nobody waits for it any more") from None
                if time.monotonic() >= until_s:
                    raise self._not_ready(f"not ready after {timeout_s:g} s") from None
        words = line.decode("utf-8", "replace").split(maxsplit=1)
        if len(words) != 2 or words[0] != "ready":
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._child.wait(STOP_TIMEOUT_S)
            raise self._not_ready(f"it ended with code {self._child.returncode}")
        return words[1].strip()

    def _not_ready(self, cause: str) -> LinkError:
        return LinkError(
            f"{self._url}: the simulated unit did not start ({cause}): "
            f"{self._complaint() or 'it said nothing'}",
            code="simulator_failed",
        )

    def _complaint(self) -> str:
        """The last that the child complained of."""
        if self._child.poll() is not None:
            self._listener.join(STOP_TIMEOUT_S)
        return self._complaints.decode("utf-8", "replace").strip()[-COMPLAINT_CHARACTERS_MAX:]

    def _listen(self) -> None:
        stream = self._child.stderr
        assert stream is not None
        with stream:
            for line in stream:
                self._complaints += line
                del self._complaints[:-COMPLAINT_BYTES_MAX]

    def _stop(self) -> None:
        self._child.terminate()
        try:
            self._child.wait(STOP_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._child.kill()
            self._child.wait()
        if self._child.stdout is not None:
            self._child.stdout.close()
        self._listener.join(STOP_TIMEOUT_S)
        shutil.rmtree(self._folder, ignore_errors=True)
