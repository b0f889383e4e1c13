"""Goal: what a simulated unit has acknowledged is on disk, whenever its process ends.

Method: real processes, a socket in place of a host, and SIGKILL the moment the answer is read. A
death in the middle of the writing itself is played at every call that touches the disk: the files
are copied as they lie there, and what the next start loads must be a moment the flash had.
"""

import errno
import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from sim_device import flash_file
from sim_device.configure import ConfigureError, read_image, write_config
from sim_device.firmware.python.unit import FLASH_LENGTH, LOG_LENGTH, Unit
from sim_device.flash_file import FlashFile, LogFile

ROOT = Path(__file__).resolve().parents[3]
WAIT_S = 0.05


class SocketUnit:
    """A unit behind a socket, as `Exchange` wants one."""

    def __init__(self, port: str) -> None:
        self._socket = socket.create_connection(("127.0.0.1", int(port)))
        self._socket.settimeout(WAIT_S)

    def receive(self, data: bytes) -> int:
        self._socket.sendall(data)
        return len(data)

    def advance_us(self, _duration_us: int) -> None:
        """Its time passes without us."""

    def transmit(self) -> bytes:
        try:
            return self._socket.recv(4096)
        except TimeoutError:
            return b""


@contextmanager
def killed_at_the_end(flash: Path, *words: str) -> Iterator[Any]:
    """A running unit with this flash, killed as soon as the body is through."""
    command = [sys.executable, "-m", "sim_device", "unit", "--tcp", "0", "--scenario", "none"]
    child = subprocess.Popen(
        [*command, "--flash", str(flash), *words], cwd=ROOT, stdout=subprocess.PIPE, text=True
    )
    try:
        assert child.stdout is not None
        word, _, port = child.stdout.readline().strip().partition(" ")
        assert word == "ready"
        yield SocketUnit(port)
    finally:
        child.kill()
        child.communicate()


@pytest.mark.slow
@pytest.mark.slow
def test_an_acknowledged_change_outlives_a_process_killed_at_once(tmp_path: Path) -> None:
    flash = tmp_path / "flash"

    for ratio in (0.25, 0.5, 0.75, 1.25):
        with killed_at_the_end(flash) as unit:
            write_config(unit, {"mode_ratios": (0.0, ratio, 1.0, 1.0, 1.5)})
            acknowledged = read_image(unit)

        with killed_at_the_end(flash) as unit:
            assert read_image(unit) == acknowledged


@pytest.mark.slow
@pytest.mark.slow
def test_what_the_factory_wrote_outlives_a_process_killed_when_it_is_ready(tmp_path: Path) -> None:
    flash = tmp_path / "flash"

    with killed_at_the_end(flash, "--market", "japan"):
        pass

    with killed_at_the_end(flash, "--market", "china") as unit:
        image = read_image(unit)
    made_for_japan = Unit(uid=bytes(12), boot_id=1, flash=FlashFile(flash).load())
    assert read_image(made_for_japan) == image


def deaths(folder: Path, monkeypatch: pytest.MonkeyPatch, act: Callable[[], None]) -> list[Path]:
    """Copies of the folder as the disk has it before each call that changes it, and at the end."""
    copies: list[Path] = []

    def kept() -> None:
        copies.append(folder.with_name(f"{folder.name}.{len(copies)}"))
        shutil.copytree(folder, copies[-1])

    class Watched:
        """`os` with an eye on what writes."""

        def __getattr__(self, name: str) -> Any:
            real = getattr(os, name)
            if name not in ("write", "pwrite", "fsync", "open", "close"):
                return real

            def call(*words: Any, **named: Any) -> Any:
                kept()
                return real(*words, **named)

            return call

    with monkeypatch.context() as patch:
        patch.setattr(flash_file, "os", Watched())
        act()
    kept()
    return copies


class LogOnly:
    """A unit whose flash for ride logs is what a test says."""

    def __init__(self, image: bytes) -> None:
        self.image = image
        self.log_changes = 0
        self.changed: range = range(0)

    def program(self, *places: int) -> None:
        image = bytearray(self.image)
        for at in places:
            image[at : at + 512] = bytes(512)
        self.image, self.log_changes = bytes(image), self.log_changes + 1
        first, last = min(places), max(places) + 512
        self.changed = range(
            min(first, self.changed.start) if self.changed else first,
            max(last, self.changed.stop) if self.changed else last,
        )

    def log_changed(self) -> tuple[int, bytes]:
        changed, self.changed = self.changed, range(0)
        return changed.start, self.image[changed.start : changed.stop]


def test_a_log_half_written_when_the_process_died_is_the_old_one_or_the_new_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "unit"
    folder.mkdir()
    unit = LogOnly(b"\xff" * LOG_LENGTH)
    file = LogFile(folder / "flash.log")
    unit.program(8192)
    file.save(unit)
    before = unit.image

    unit.program(0, 40_000, LOG_LENGTH - 512)
    copies = deaths(folder, monkeypatch, lambda: file.save(unit))

    assert len(copies) > 5
    seen = [LogFile(copy / "flash.log").load() for copy in copies]
    assert set(seen) == {before, unit.image}
    assert seen[-1] == unit.image
    assert LogFile(copies[-1] / "flash.log").load() == unit.image


def test_a_first_log_half_written_is_none_or_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "unit"
    folder.mkdir()
    unit = LogOnly(b"\xff" * LOG_LENGTH)
    unit.program(4096)

    copies = deaths(folder, monkeypatch, lambda: LogFile(folder / "flash.log").save(unit))

    seen = [LogFile(copy / "flash.log").load() for copy in copies]
    assert set(seen) <= {None, b"\xff" * LOG_LENGTH, unit.image}
    assert seen[-1] == unit.image


def test_a_flash_half_written_is_the_old_one_or_the_new_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "unit"
    folder.mkdir()
    old, new = bytes(FLASH_LENGTH), b"\xff" * FLASH_LENGTH
    FlashFile(folder / "flash").save(old)

    copies = deaths(folder, monkeypatch, lambda: FlashFile(folder / "flash").save(new))

    seen = [FlashFile(copy / "flash").load() for copy in copies]
    assert set(seen) == {old, new}
    assert seen[-1] == new


@pytest.mark.slow
@pytest.mark.slow
def test_a_disk_without_room_stops_the_unit_with_the_flash_s_name_and_what_to_do(
    tmp_path: Path,
) -> None:
    flash = tmp_path / "flash"
    with killed_at_the_end(flash):
        pass
    (tmp_path / "flash.new").symlink_to("/dev/full")

    command = [sys.executable, "-m", "sim_device", "unit", "--tcp", "0", "--flash", str(flash)]
    child = subprocess.Popen(
        [*command, "--scenario", "none"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert child.stdout is not None
        unit = SocketUnit(child.stdout.readline().split()[1])
        with pytest.raises((ConfigureError, OSError)):
            write_config(unit, {"torque_filter_s": 0.4})
        _, said = child.communicate(timeout=60.0)
    finally:
        child.kill()

    assert child.returncode == 1
    assert f"{flash} cannot be written (No space left on device)" in said
    assert "start it again" in said


def test_a_ride_log_without_room_names_its_file_too(tmp_path: Path) -> None:
    unit = LogOnly(b"\xff" * LOG_LENGTH)
    file = LogFile(tmp_path / "flash.log")
    unit.program(4096)
    file.journal.symlink_to("/dev/full")

    with pytest.raises(OSError, match=r"flash\.log cannot be written .No space left") as caught:
        file.save(unit)

    assert caught.value.errno == errno.ENOSPC
