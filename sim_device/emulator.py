"""A microcontroller on this computer: QEMU with an image of boards/mps2_an386 and its two lines.

The 16 MB that stand for the board's flash memories are a file, shared with whoever looks on. QEMU
ends with the process that started it, however that ends.
"""

import ctypes
import fcntl
import mmap
import os
import re
import shutil
import signal
import socket
import subprocess
import tempfile
from pathlib import Path
from types import TracebackType
from typing import Any, Final

from firmware_protocol._generated import MTU

BOARD: Final = "mps2_an386"

# Where simulated units run that are not told: pytest --unit=qemu sets it for all it starts.
BOARD_VARIABLE: Final = "SIM_DEVICE_BOARD"

BOARD_FOLDER: Final = Path(__file__).parent / "firmware" / "boards" / BOARD
IMAGE_FOLDER: Final = Path(__file__).resolve().parents[1] / "build" / BOARD

MEMORY_START: Final = 0x21000000
MEMORY_BYTES: Final = 16 * 2**20

START_TIMEOUT_S = 20.0
COMPLAINT_CHARACTERS_MAX = 600
PR_SET_PDEATHSIG = 1


class EmulatorError(RuntimeError):
    """There is no emulated board; the message says why and what to do."""


def missing() -> str | None:
    """Why no board can be emulated here, None where one can."""
    wanted = ("qemu-system-arm", "arm-none-eabi-gcc", "make")
    absent = [name for name in wanted if shutil.which(name) is None]
    if not absent:
        return None
    return f"{', '.join(absent)} not found: run .ci/ensure-tools board"


def build(image: str, frame_bytes: int = MTU) -> Path:
    """The image of this name (`unit`, `bench`, `count`), built where it is not fresh.

    frame_bytes: of the largest frame; fewer make a unit that needs less RAM.
    """
    reason = missing()
    if reason is not None:
        raise EmulatorError(reason)
    folder = IMAGE_FOLDER if frame_bytes == MTU else IMAGE_FOLDER / f"mtu-{frame_bytes}"
    target = folder / f"{image}.elf"
    options = (f"OUT={folder}", f"MTU={frame_bytes}")
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:
        # Several units that start at once would compile into one another's objects.
        fcntl.flock(lock, fcntl.LOCK_EX)
        made = subprocess.run(
            ["make", "-s", "-C", str(BOARD_FOLDER), *options, str(target)],
            capture_output=True,
            text=True,
            check=False,
        )
    if made.returncode != 0:
        said = made.stderr[-COMPLAINT_CHARACTERS_MAX:]
        raise EmulatorError(f"{image}.elf was not built:\n{said}")
    return target


def free_port(address: tuple[str, int]) -> tuple[str, int]:
    """The address, with any free port in place of port 0: QEMU has to be told one."""
    with socket.create_server(address) as listener:
        host, port = listener.getsockname()[:2]
        return str(host), int(port)


class Emulator:
    """One board, running. Use as a context, or call `close`.

    Args:
        image: the ELF file.
        memory: the file behind the flash memories; made if it is not there. None: thrown away.
        tcp: (host, port) that the first serial line listens on; None: a pseudo-terminal.
        more: further words for QEMU.

    Raises:
        EmulatorError: QEMU did not start.
    """

    def __init__(
        self,
        image: Path,
        memory: Path | None = None,
        tcp: tuple[str, int] | None = None,
        more: tuple[str, ...] = (),
    ) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="spindle-board-")
        self.memory_file = memory or Path(self._folder.name) / "memory"
        make_memory(self.memory_file)
        bench_path = f"{self._folder.name}/bench"
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(bench_path)
            listener.listen(1)
            listener.settimeout(START_TIMEOUT_S)
            self._process = subprocess.Popen(
                _command(image, self.memory_file, tcp, bench_path, more),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                preexec_fn=_end_with_parent,
            )
            try:
                self.bench, _ = listener.accept()
            except TimeoutError:
                raise EmulatorError(f"QEMU did not start: {self._output()}") from None
        self.bench.settimeout(None)
        self.host_address = f"{tcp[0]}:{tcp[1]}" if tcp is not None else self._pty_name()
        self._far = -1
        if tcp is None:
            # Held open, so that the line is there while no host has it.
            self._far = os.open(self.host_address, os.O_RDWR | os.O_NOCTTY)

    def memory(self) -> mmap.mmap:
        """The board's flash memories as they are now; writing to them is damage."""
        with self.memory_file.open("r+b") as file:
            return mmap.mmap(file.fileno(), MEMORY_BYTES)

    @property
    def running(self) -> bool:
        """Whether the board has power."""
        return self._process.poll() is None

    def close(self) -> None:
        """Takes the board its power."""
        self._process.kill()
        self._process.wait()
        self.bench.close()
        if self._far >= 0:
            os.close(self._far)
            self._far = -1
        self._folder.cleanup()

    def __enter__(self) -> "Emulator":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _pty_name(self) -> str:
        assert self._process.stdout is not None
        said = ""
        for line in iter(self._process.stdout.readline, b""):
            said += line.decode(errors="replace")
            found = re.search(r"redirected to (\S+)", said)
            if found:
                return found.group(1)
        raise EmulatorError(f"QEMU named no pseudo-terminal: {said[-COMPLAINT_CHARACTERS_MAX:]}")

    def _output(self) -> str:
        self._process.kill()
        out, _ = self._process.communicate()
        self._folder.cleanup()
        text: str = out.decode(errors="replace")
        return text[-COMPLAINT_CHARACTERS_MAX:] or "it said nothing"


def _command(
    image: Path, memory: Path, tcp: tuple[str, int] | None, bench: str, more: tuple[str, ...]
) -> list[str]:
    line = (
        "pty,id=host"
        if tcp is None
        else f"socket,id=host,host={tcp[0]},port={tcp[1]},server=on,wait=off,nodelay=on"
    )
    backing = f"memory-backend-file,id=memory,size={MEMORY_BYTES},mem-path={memory},share=on"
    return [
        *("qemu-system-arm", "-M", "mps2-an386,memory-backend=memory", "-object", backing),
        *("-display", "none", "-monitor", "none", "-chardev", line, "-serial", "chardev:host"),
        *("-chardev", f"socket,id=bench,path={bench}", "-serial", "chardev:bench"),
        *("-kernel", str(image), *more),
    ]


def make_memory(path: Path) -> None:
    """A file for a board's flash memories where there is none. Raises EmulatorError."""
    if path.exists() and path.stat().st_size == MEMORY_BYTES:
        return
    if path.exists():
        raise EmulatorError(
            f"{path} has {path.stat().st_size} bytes, this board's memory has {MEMORY_BYTES}; "
            "move it away to start with an erased one"
        )
    with path.open("wb") as file:
        file.truncate(MEMORY_BYTES)


def _end_with_parent() -> None:
    """Runs in the child before QEMU does."""
    libc: Any = ctypes.CDLL(None)
    libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
