"""Goal: a disk that is really full is seen in /health and once in the log, and so is its end.

Method: the server's data on a small file system of its own (needs the right to mount), filled by
another file while a simulated bike rides, or before a start; then that file is removed.
"""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from backend.device.link.simulated import SimulatedLink
from backend.errors import LinkError, StoreError
from backend.store import open_store
from tests.fakes.ride_in_time import ride_on
from tests.fakes.server import ServerProcess, eventually

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="needs to mount"),
]


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", tmp_path], check=False
    )
    if mounted.returncode:
        pytest.skip("may not mount here")
    yield tmp_path
    subprocess.run(["umount", "-l", tmp_path], check=True)


def fill(path: Path) -> None:
    """Take all there is."""
    with path.open("wb", buffering=0) as file:
        try:
            while True:
                file.write(bytes(4096))
        except OSError:
            pass


@pytest.mark.long
def test_a_full_disk_while_recording_is_told_and_costs_nothing_when_freed(
    small_disk: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    # The unit's own memory is on another disk, as a real unit's is.
    flash = tmp_path_factory.mktemp("unit") / "flash"
    unit = f"sim?clock=virtual&scenario=none&flash={flash}"
    server = ServerProcess(small_disk, [unit]).start()
    device = server.ready_device()

    def recorder() -> dict[str, Any]:
        told: dict[str, Any] = server.get("/health")["devices"][0]["recorder"]
        return told

    ride_on(server, device, 15.0)
    eventually(recorder, lambda told: told["rows_saved"] > 0)
    fill(small_disk / "filler")
    server.advance(device, 15.0)
    full = eventually(lambda: server.get("/health"), lambda told: told["status"] == "degraded")
    assert {reason["code"] for reason in full["reasons"]} == {"disk_full"}
    eventually(recorder, lambda told: told["rows_waiting"] > 200)
    upload = server.client.post(
        "/uploads",
        headers={"tus-resumable": "1.0.0", "upload-length": "1000", "upload-metadata": ""},
    )
    assert upload.status_code in (201, 507), upload.text
    if upload.status_code == 507:
        assert upload.headers["content-type"] == "application/problem+json"
        assert upload.json()["code"] == "disk_full"

    (small_disk / "filler").unlink()
    eventually(lambda: server.get("/health"), lambda told: told["status"] == "ok")
    told = eventually(recorder, lambda told: told["rows_waiting"] <= 200)

    assert told["rows_lost"] == 0
    assert server.get(f"/devices/{device}")["state"] == "ready"
    said = server.stop()
    assert said.count("cannot be written") == said.count("can be written again") >= 1
    assert said.count("The database cannot be written") == 1


@pytest.mark.parametrize("used_before", [False, True])
def test_a_start_on_a_full_disk_says_what_to_do_and_works_once_there_is_room(
    small_disk: Path, used_before: bool
) -> None:
    urls = f"sqlite:///{small_disk}/spindle.db", (small_disk / "objects").as_uri()
    if used_before:
        open_store(*urls).close()
    fill(small_disk / "filler")

    with pytest.raises(StoreError, match=r"no space is left on its disk\. Free some") as refusal:
        open_store(*urls)

    assert refusal.value.code == "disk_full"
    (small_disk / "filler").unlink()
    open_store(*urls).close()


def test_a_simulated_unit_on_a_full_disk_is_no_unplugged_one(
    small_disk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its memory, and the folder for temporary files too, are on the disk that is full."""
    temporary = small_disk / "tmp"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    first = SimulatedLink("sim:a?seed=3&scenario=none", small_disk / "flash")
    fill(small_disk / "other")
    with pytest.raises(LinkError, match=r"unit-4\.flash cannot be written \(No space"):
        SimulatedLink("sim:b?seed=4&scenario=none", small_disk / "flash")
    os.kill(first.process_id, signal.SIGKILL)
    with pytest.raises(LinkError, match="simulated unit ended with code -9: it said nothing"):
        read_on(first)
    first.close()


def read_on(link: SimulatedLink) -> None:
    """Read until the link ends."""
    while True:
        link.read()
