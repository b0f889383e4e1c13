"""Goal: a server that tells its address, ends everything it started, and says why it cannot start.

A server is a process where the story is about its end, or about what it left behind.
"""

from __future__ import annotations

import os
import signal
import socket
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from tests.fakes.command import refused_start
from tests.fakes.fit_file import commute, fit_file
from tests.fakes.server import ServerHere, ServerProcess, SpindleServer, eventually

STANDING = "sim?clock=virtual&scenario=none"


def test_the_simulated_unit_appears_ready_with_its_identity(
    server: SpindleServer, device: str
) -> None:
    unit = server.get(f"/devices/{device}")
    health = server.get("/health")

    assert unit["kind"] == "simulated"
    serial_number = unit["identity"]["serial_number"]
    assert unit["url"].startswith("sim:")
    assert unit["id"].startswith("sim-")
    assert unit["name"] is None
    assert unit["unit_key"] == f"ebl:{serial_number}"
    # Its bike is made as soon as it was seen; a bookmark of before is a serial number.
    eventually(lambda: server.get(f"/devices/{serial_number}")["bike_id"])
    assert server.get(f"/devices/{unit['unit_key']}")["id"] == device
    assert unit["identity"]["protocol_version"] == "1.0"
    assert unit["config"]["generation"] >= 1
    (told,) = health["devices"]
    assert (told["id"], told["state"]) == (device, "ready")
    assert (health["status"], health["reasons"]) == ("ok", [])
    assert "sim" in [port["url"] for port in server.get("/ports")["items"]]


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_the_end_of_the_server_is_the_end_of_its_simulator(
    tmp_path: Path, ending: signal.Signals
) -> None:
    server = ServerProcess(tmp_path, [STANDING]).start()
    server.ready_device()
    simulators = children_of(server.pid)

    said = server.stop(ending)

    assert simulators
    assert server.exit_code == 0
    assert "Traceback" not in said
    eventually(
        lambda: [pid for pid in simulators if Path(f"/proc/{pid}").exists()], lambda x: not x
    )


def children_of(server_pid: int, word: bytes = b"sim_device") -> list[int]:
    """Processes this server started with this word in their command: its simulators."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
        except OSError:
            continue
        if parent == server_pid and word in words:
            found.append(int(folder.name))
    return found


def test_a_unit_is_named_by_connecting_it_again_with_a_name(
    server: SpindleServer, device: str
) -> None:
    unit = server.get(f"/devices/{device}")

    named = server.ask("POST", "/devices", json={"url": unit["url"], "name": "日常 Commuter"})
    blank = server.client.post("/devices", json={"url": unit["url"], "name": "  "})

    assert named["name"] == "日常 Commuter"
    assert (named["id"], named["unit_key"]) == (device, unit["unit_key"])
    assert blank.status_code == 422
    assert server.get(f"/devices/{device}")["name"] == "日常 Commuter"


def test_what_a_unit_was_told_survives_a_restart(tmp_path: Path) -> None:
    server = ServerHere(tmp_path, [STANDING])
    with server:
        device = server.ready_device()
        server.configure(device, "to stay", torque_filter_s=0.33)
        bike_id = eventually(lambda: server.get(f"/devices/{device}")["bike_id"])

    with server:
        again = server.ready_device()
        value = server.get(f"/devices/{again}/config")["parameters"]["torque_filter_s"]
        revisions = server.get(f"/devices/{again}/config/revisions")["items"]
        found = eventually(lambda: server.get(f"/devices/{again}")["bike_id"])

    assert again == device
    assert found == bike_id
    assert value == pytest.approx(0.33)
    assert "to stay" in [revision["reason"] for revision in revisions]


def test_a_taken_port_is_said_before_anything_is_opened(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        result = refused_start(tmp_path / "data", "--port", str(port))

    assert result.returncode == 1
    assert f"port {port}" in result.stderr
    assert not (tmp_path / "data").exists()


def test_two_servers_do_not_share_one_folder(tmp_path: Path) -> None:
    with ServerHere(tmp_path):
        second = refused_start(tmp_path)

    assert second.returncode == 1
    assert "--data" in second.stderr


def test_a_unit_s_address_that_is_none_is_refused(tmp_path: Path) -> None:
    result = refused_start(tmp_path, "--device", "ftp://bike")

    assert result.returncode == 2
    assert "ftp://bike" in result.stderr


def test_a_unit_that_is_not_there_keeps_nobody_waiting(tmp_path: Path) -> None:
    with ServerHere(tmp_path, ["/dev/no-such-port"]) as server:
        unit = eventually(lambda: server.get("/devices")["items"])[0]
        answer = server.client.get(f"/devices/{unit['id']}/config")

    assert unit["state"] in ("connecting", "lost")
    assert "/dev/no-such-port" in unit["reason"]
    assert answer.status_code in (503, 504)
    assert answer.json()["detail"]


@pytest.mark.slow
def test_a_server_that_ends_waits_for_no_file_that_is_read(tmp_path: Path) -> None:
    """A reader that stands still, as on a machine with too much to do."""
    server = ServerProcess(tmp_path, []).start()
    with ThreadPoolExecutor(1) as browser:
        sending = browser.submit(
            server.client.post, "/rides/import?name=a.fit", content=fit_file(commute(60))
        )
        (reader,) = eventually(lambda: children_of(server.pid, b"backend.formats.worker"))
        os.kill(reader, signal.SIGSTOP)

        said = server.stop(signal.SIGTERM)

        assert sending.result().json()["state"] == "queued"
    assert said == ""
    assert server.exit_code == 0


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("ending", [signal.SIGTERM, signal.SIGKILL])
def test_a_file_that_is_read_when_the_server_ends_is_one_ride_after_the_next_start(
    tmp_path: Path, ending: signal.Signals
) -> None:
    first = ServerProcess(tmp_path, []).start()
    with ThreadPoolExecutor(1) as browser:
        # Its reader takes longer to start than to be found.
        sending = browser.submit(
            first.client.post, "/rides/import?name=a.fit", content=fit_file(commute(3000))
        )
        readers = eventually(lambda: children_of(first.pid, b"backend.formats.worker"))

        said = first.stop(ending)
        sending.exception()

    eventually(lambda: not any(Path(f"/proc/{pid}").exists() for pid in readers))
    assert "Traceback" not in said
    assert ending == signal.SIGKILL or first.exit_code == 0

    second = ServerProcess(tmp_path, []).start()
    (upload,) = eventually(
        lambda: second.get("/uploads")["items"], lambda items: items[0]["state"] == "complete"
    )
    rides = [ride["id"] for ride in second.get("/rides")["items"]]
    second.stop()

    assert rides == upload["ride_ids"]
    assert len(rides) == 1


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.host_build("a board takes a tenth of a core at rest: these are about the server")
@pytest.mark.parametrize("wait_for_all", [True, False], ids=["ready", "starting"])
def test_thirty_two_simulated_units_end_with_the_server(tmp_path: Path, wait_for_all: bool) -> None:
    server = ServerProcess(tmp_path, [f"sim:unit{number}" for number in range(32)]).start()
    if wait_for_all:
        server.all_ready(32)
    simulators = children_of(server.pid)

    said = server.stop(signal.SIGTERM)

    assert server.exit_code == 0
    assert "Traceback" not in said
    assert "does not end" not in said
    eventually(
        lambda: [pid for pid in simulators if Path(f"/proc/{pid}").exists()], lambda x: not x
    )
