"""Goal: a server whose objects are in S3 records, takes files and goes on whatever the bucket does.

Method: the server as it is, its bucket behind a gate that fails, waits, or kills the server in the
middle of a file; what is in the bucket is looked at by another client.
"""

from __future__ import annotations

import hashlib
import threading
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.store.objects import content_key
from tests.fakes.command import spindle
from tests.fakes.fit_file import commute, fit_file
from tests.fakes.ride_in_time import REST_S, all_done, ride_on, rides_of
from tests.fakes.s3 import KEYS, Gate, S3Server, keys_in
from tests.fakes.server import ServerHere, ServerProcess, SpindleServer, eventually
from tests.fakes.uploading import CHUNK, TUS, described
from tests.fakes.zip_file import zipped

pytestmark = pytest.mark.slow
UNIT = "sim?clock=virtual&scenario=none"
FILE = fit_file(commute(600))
# Sent to the bucket in more than one part.
LARGE = zipped({"ride.fit": FILE, "film.bin": bytes(20 << 20)}, zipfile.ZIP_STORED)
PIECE_BYTES = 8 << 20


@pytest.fixture(scope="module")
def s3(tmp_path_factory: pytest.TempPathFactory) -> Iterator[S3Server]:
    running = S3Server(tmp_path_factory.mktemp("s3") / "log")
    yield running
    running.stop()


@pytest.fixture
def gate(s3: S3Server, monkeypatch: pytest.MonkeyPatch) -> Iterator[Gate]:
    for name, value in KEYS.items():
        monkeypatch.setenv(name, value)
    opened = Gate(s3)
    yield opened
    opened.close()


@pytest.fixture
def bucket(s3: S3Server, gate: Gate) -> str:
    return f"s3://{s3.new_bucket()}/shop?endpoint={gate.url}"


def send(server: SpindleServer, data: bytes, name: str = "ride.fit") -> tuple[str, int]:
    """Address of an upload, and the status of the answer to its last piece."""
    headers = TUS | described(filename=name) | {"upload-length": str(len(data))}
    created = server.client.post("/uploads", headers=headers)
    address = str(created.headers["location"]).removeprefix("/api/v1")
    status = created.status_code
    for offset in range(0, len(data), PIECE_BYTES):
        piece, at = data[offset : offset + PIECE_BYTES], {"upload-offset": str(offset)}
        status = server.client.patch(address, headers=CHUNK | at, content=piece).status_code
    return address, status


def original_key(data: bytes) -> str:
    return content_key("originals", hashlib.sha256(data).hexdigest())


def reasons(server: SpindleServer) -> set[str]:
    return {reason["code"] for reason in server.get("/health")["reasons"]}


def test_what_comes_while_the_bucket_is_away_is_there_when_it_is_back(
    s3: S3Server, gate: Gate, bucket: str, tmp_path: Path
) -> None:
    with ServerHere(tmp_path / "data", [UNIT], SPINDLE_OBJECTS=bucket) as server:
        device = server.ready_device()
        ride_on(server, device, 30.0)
        gate.meddle = lambda method, path: 503 if method in ("PUT", "POST") else None
        server.simulate(device, rider={"kind": "off"}, brake=True)
        server.advance(device, REST_S)
        address, status = send(server, FILE)
        assert status == 503
        eventually(lambda: reasons(server), lambda codes: codes == {"objects_unreachable"})
        # The next ride is recorded meanwhile.
        ride_on(server, device, 30.0)

        gate.meddle = lambda method, path: None
        eventually(lambda: reasons(server), lambda codes: not codes)
        verdict = eventually(lambda: server.get(address), lambda now: now["state"] == "complete")

        assert len(verdict["ride_ids"]) == 1
        server.simulate(device, rider={"kind": "off"}, brake=True)
        server.advance(device, REST_S)
        done = eventually(lambda: rides_of(server, device), all_done)
        assert len(done) == 2
        assert all(ride["completeness"] == 1.0 for ride in done)
    kept = keys_in(s3, bucket)
    assert sum(key.endswith(".parquet") for key in kept) == 3
    assert original_key(FILE) in kept


def test_a_slow_bucket_holds_up_nothing_but_what_is_sent_to_it(
    gate: Gate, bucket: str, tmp_path: Path
) -> None:
    let_go = threading.Event()
    waits = threading.Event()

    def held(method: str, path: str) -> None:
        if "originals/" in path and method == "PUT":
            waits.set()
            let_go.wait(9.0)

    with ServerHere(tmp_path / "data", [UNIT], SPINDLE_OBJECTS=bucket) as server:
        device = server.ready_device()
        gate.meddle = held
        answers: list[Any] = []
        sending = threading.Thread(target=lambda: answers.append(send(server, FILE)))
        sending.start()
        assert waits.wait(30)

        ride_on(server, device, 30.0)
        (ride,) = rides_of(server, device)
        recorder = eventually(
            lambda: server.get("/health")["devices"][0]["recorder"],
            lambda now: now["rows_saved"] > 0,
        )
        held_up = not answers
        let_go.set()
        sending.join()

        assert held_up
        assert (ride["state"], recorder["rows_lost"]) == ("live", 0)
        assert answers[0][1] == 204


def test_a_server_that_is_killed_while_it_sends_a_file_sends_it_again(
    s3: S3Server, gate: Gate, bucket: str, tmp_path: Path
) -> None:
    data = tmp_path / "data"
    server = ServerProcess(data, [], SPINDLE_OBJECTS=bucket).start()
    parts = 0

    def kill_at_the_second_part(method: str, path: str) -> None:
        nonlocal parts
        parts += "partNumber" in path
        if parts == 2:
            server.kill()
            time.sleep(0.2)

    gate.meddle = kill_at_the_second_part
    with pytest.raises(httpx.TransportError):
        send(server, LARGE)
    key = original_key(LARGE)
    assert parts >= 2
    assert key not in keys_in(s3, bucket)

    gate.meddle = lambda method, path: None
    server = ServerProcess(data, [], SPINDLE_OBJECTS=bucket).start()
    upload = eventually(
        lambda: next(one for one in server.get("/uploads")["items"] if one["part_of"] is None),
        lambda found: found["state"] not in ("receiving", "queued"),
    )
    assert len(upload["ride_ids"]) == 1
    assert key in keys_in(s3, bucket)
    server.stop()
    found = spindle(None, "store", "check", "--data", data, SPINDLE_OBJECTS=bucket)
    assert found.returncode == 0, found.stdout
