"""Goal: from the unit's control loop to a WebSocket, every row, its time and its state.

The frames are taken apart by the contract's layout: u32 sequence, u32 rows lost, u64 unit time,
u16 rows, u16 channels, then i16 counts.
"""

from __future__ import annotations

import json
import struct
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from websockets.sync.client import ClientConnection, connect

from tests.fakes.server import PATIENCE_S, SpindleServer


@pytest.fixture(scope="module")
def device(server: SpindleServer) -> Iterator[str]:
    """A unit whose clock is real: what it tells comes by itself."""
    live = str(server.ask("POST", "/devices", json={"url": "sim:live?seed=76"})["id"])
    server.ready_device()
    yield live
    server.ask("DELETE", f"/devices/{live}")


@contextmanager
def live(server: SpindleServer, device: str, **query: object) -> Iterator[ClientConnection]:
    words = "&".join(f"{name}={value}" for name, value in query.items())
    url = f"{server.url.replace('http', 'ws')}/api/v1/devices/{device}/live?{words}"
    with connect(url, origin=server.url) as socket:
        yield socket


def next_text(socket: ClientConnection, kind: str) -> dict[str, Any]:
    """The next text frame of this kind."""
    deadline_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline_s:
        frame = socket.recv(timeout=PATIENCE_S)
        if isinstance(frame, str) and json.loads(frame)["type"] == kind:
            message: dict[str, Any] = json.loads(frame)
            return message
    raise AssertionError(f"no text frame {kind}")


def next_rows(socket: ClientConnection, frames: int) -> list[tuple[int, int, int, np.ndarray]]:
    """Sequence, rows lost, unit time and counts of the next binary frames."""
    found = []
    while len(found) < frames:
        frame = socket.recv(timeout=PATIENCE_S)
        if isinstance(frame, bytes):
            sequence, lost, t0_us, rows, channels = struct.unpack_from("<IIQHH", frame)
            counts = np.frombuffer(frame, "<i2", offset=20)
            found.append((sequence, lost, t0_us, counts.reshape(rows, channels)))
    return found


def test_rows_follow_one_another_without_a_hole(server: SpindleServer, device: str) -> None:
    with live(server, device, channels="speed_kmh,rider_torque_nm") as socket:
        described = next_text(socket, "stream")
        frames = next_rows(socket, 20)

    assert [channel["name"] for channel in described["channels"]] == [
        "speed_kmh",
        "rider_torque_nm",
    ]
    assert (described["rate_hz"], described["period_us"]) == (100.0, 10_000)
    for before, after in pairwise(frames):
        assert after[0] == before[0] + 1
        assert after[1] == 0
        assert after[2] == before[2] + len(before[3]) * 10_000


def test_the_first_thing_told_is_where_the_unit_stands(server: SpindleServer, device: str) -> None:
    with live(server, device) as socket:
        state = next_text(socket, "state")
        described = next_text(socket, "stream")

    assert state["state"] == "ready"
    serial_number = server.get(f"/devices/{device}")["identity"]["serial_number"]
    assert serial_number in state["reason"]
    assert len(described["channels"]) >= 20


def test_a_slower_rate_is_the_unit_s_rows_picked_evenly(server: SpindleServer, device: str) -> None:
    with live(server, device, channels="cadence_rpm", rate_hz=20) as socket:
        described = next_text(socket, "stream")
        frames = next_rows(socket, 8)

    period_us = described["period_us"]
    times_us = [t0 + i * period_us for _, _, t0, rows in frames for i in range(len(rows))]
    assert period_us == 50_000
    assert set(np.diff(times_us)) == {50_000}


def test_an_unknown_channel_or_unit_is_told_and_the_socket_closed(
    server: SpindleServer, device: str
) -> None:
    for asked, query in ((device, {"channels": "altitude"}), ("nobody", {})):
        with live(server, asked, **query) as socket:
            refusal = next_text(socket, "error")

            assert refusal["detail"]
            with pytest.raises(Exception, match="4404"):
                socket.recv(timeout=PATIENCE_S)


def test_a_unit_that_is_let_go_is_told(
    server: SpindleServer,
) -> None:
    guest = server.ask("POST", "/devices", json={"url": "sim:guest?seed=77"})

    with live(server, guest["id"]) as socket:
        next_text(socket, "state")
        server.ask("DELETE", f"/devices/{guest['id']}")
        assert next_text(socket, "state")["state"] == "closed"

    assert guest["id"] not in [item["id"] for item in server.get("/devices")["items"]]
