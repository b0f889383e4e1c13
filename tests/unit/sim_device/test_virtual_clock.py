"""Goal: with a virtual clock a unit answers at any moment, but its time passes only when told to.

What is measured is the unit's own time, which no wall clock may touch; bytes of two units with the
same seed and the same calls are compared as they are.
"""

from __future__ import annotations

import json
from typing import Any

import pytest

from firmware_protocol._generated import HelloRequest, SimGetRequest, SimSetRequest
from firmware_protocol.codec import Request, Response, decode, encode
from firmware_protocol.framing import FrameDecoder, encode_frame
from sim_device.controls import unpack
from sim_device.lockstep import LockstepUnit
from sim_device.scenario_file import ScenarioError
from sim_device.simulator import ServedUnit, serve


class Host:
    """The host's end of a line without a wire; stops the unit's process after so many rounds."""

    address = "memory"

    def __init__(self, rounds: int, takes_bytes: int = 4096) -> None:
        self.to_unit = bytearray()
        self.from_unit = bytearray()
        self.rounds = rounds
        self.takes_bytes = takes_bytes

    def read(self) -> bytes:
        data, self.to_unit = bytes(self.to_unit), bytearray()
        return data

    def write(self, data: bytes) -> int:
        self.from_unit += data[: self.takes_bytes]
        return min(len(data), self.takes_bytes)

    def close(self) -> None: ...

    def stop(self) -> bool:
        self.rounds -= 1
        return self.rounds < 0

    def ask(self, tid: int, message: Any) -> None:
        self.to_unit += encode_frame(encode(Request(tid, message)))

    def answers(self) -> list[Response]:
        decoded = [decode(frame) for frame in FrameDecoder().feed(bytes(self.from_unit))]
        return [message for message in decoded if isinstance(message, Response)]


def live_for(unit: LockstepUnit, seconds: float, takes_bytes: int = 4096) -> Host:
    """Asks the unit for `seconds` and runs its process until they have passed."""
    until_s = unit.simulation_get()["t_s"] + seconds
    host = Host(rounds=10_000, takes_bytes=takes_bytes)
    host.ask(1, SimSetRequest(json.dumps({"advance_s": seconds}).encode()))
    serve(
        [ServedUnit(unit, host)],
        lambda: host.stop() or unit.simulation_get()["t_s"] >= until_s - 1e-9,
    )
    return host


def test_the_unit_answers_while_its_time_stands() -> None:
    unit = LockstepUnit(seed=1, scenario="commute", clock="virtual")
    host = Host(rounds=3)
    host.ask(1, HelloRequest(1, 1, 0, 512, b"12345678"))
    host.ask(2, SimGetRequest())

    serve([ServedUnit(unit, host)], host.stop)

    hello, simulation = host.answers()
    assert hello.tid == 1
    seen = unpack(simulation.message.text)  # type: ignore[union-attr]
    assert (seen["clock"], seen["t_s"], seen["advance_left_s"]) == ("virtual", 0.0, 0.0)


def test_exactly_the_time_that_was_asked_for_passes() -> None:
    unit = LockstepUnit(seed=1, clock="virtual")

    live_for(unit, 1.25)

    assert unit.simulation_get()["t_s"] == pytest.approx(1.25, abs=1e-9)
    assert unit.owed_us == 0


def test_a_line_that_takes_little_makes_time_wait_and_changes_nothing() -> None:
    quick, slow = (LockstepUnit(seed=4, scenario="commute", clock="virtual") for _ in range(2))

    live_for(quick, 20.0)
    live_for(slow, 20.0, takes_bytes=7)

    assert slow.observe()["distance_m"] > 0.0
    assert slow.simulation_get() == quick.simulation_get()


def test_the_same_seed_gives_the_same_bytes() -> None:
    hosts = [
        live_for(LockstepUnit(seed=9, scenario="commute", clock="virtual"), 3.0) for _ in range(2)
    ]

    assert hosts[0].from_unit == hosts[1].from_unit


def test_a_real_clock_cannot_be_advanced_and_a_virtual_one_can_be_let_go() -> None:
    unit = LockstepUnit(seed=1)
    with pytest.raises(ScenarioError, match="clock is real"):
        unit.simulation_set({"advance_s": 1.0, "brake": True})
    assert unit.simulation_get()["brake"] is False

    unit.simulation_set({"clock": "virtual", "advance_s": 60.0})
    assert unit.simulation_get()["advance_left_s"] == 60.0
    unit.simulation_set({"clock": "real"})
    assert unit.simulation_get()["advance_left_s"] == 0.0


@pytest.mark.parametrize("seconds", [-1.0, 86_401.0, float("nan"), "soon", None])
def test_a_time_that_cannot_pass_is_refused_by_name(seconds: Any) -> None:
    unit = LockstepUnit(seed=1, clock="virtual")

    with pytest.raises(ScenarioError, match="advance_s"):
        unit.simulation_set({"advance_s": seconds})

    assert unit.owed_us == 0
