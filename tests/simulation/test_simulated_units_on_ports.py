"""Simulated units as processes on pseudo-terminals, opened through pyserial like any other unit.

Real processes in real time; the tests wait for events and never for the clock.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.device.link.simulated import SimulatedLink
from backend.device.states import LinkState, StateChanged
from backend.device.stream import StreamBlock
from backend.tuning.service import Tuning
from backend.units.service import Devices
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.unit_link import Heard

WAIT_S = 30.0


@pytest.fixture
def devices(tmp_path: Path) -> Iterator[Devices]:
    devices = Devices(flash_folder=tmp_path / "units")
    yield devices
    devices.close()


@pytest.fixture
def children(monkeypatch: pytest.MonkeyPatch) -> list[SimulatedLink]:
    """The links that are opened from now on, each to a process of its own."""
    children: list[SimulatedLink] = []
    start = SimulatedLink.__init__

    def noted(self: SimulatedLink, *arguments: object, **options: object) -> None:
        start(self, *arguments, **options)  # type: ignore[arg-type]
        children.append(self)

    monkeypatch.setattr(SimulatedLink, "__init__", noted)
    return children


def test_two_simulated_units_stream_side_by_side(devices: Devices) -> None:
    left = devices.add("sim:left", WAIT_S)
    right = devices.add("sim:right", WAIT_S)
    heard = {left.id: Heard(), right.id: Heard()}
    for device_id, listener in heard.items():
        devices.subscribe(device_id, listener)

    for device_id, listener in heard.items():
        block = listener.wait_for(StreamBlock, count=10)
        assert isinstance(block, StreamBlock)
        assert devices.get(device_id).link["stream_rows_lost"] == 0

    assert left.id != right.id
    assert {left.kind, right.kind} == {"simulated"}


def test_a_simulated_unit_that_dies_comes_back_with_its_configuration(
    devices: Devices, children: list[SimulatedLink]
) -> None:
    device = devices.add("sim:mortal?scenario=none", WAIT_S)
    tuning = Tuning(devices, MemoryRevisions())
    tuning.write_config(device.id, {"pedal_stop_ms": 240}, "to be kept")
    heard = Heard()
    devices.subscribe(device.id, heard)

    os.kill(children[0].process_id, signal.SIGTERM)
    heard.wait_for(StateChanged, state=LinkState.LOST)
    heard.wait_for(StateChanged, state=LinkState.READY)

    assert len(children) == 2
    assert tuning.read_config(device.id).parameters["pedal_stop_ms"] == 240


def test_removing_a_simulated_unit_ends_its_process(
    devices: Devices, children: list[SimulatedLink]
) -> None:
    device = devices.add("sim:short", WAIT_S)

    devices.remove(device.id)

    with pytest.raises(ProcessLookupError):
        os.kill(children[0].process_id, 0)


def test_a_scenario_that_does_not_exist_is_told_in_the_simulator_s_words(
    devices: Devices,
) -> None:
    device = devices.add("sim:lost?scenario=moon", WAIT_S)

    assert device.state == "connecting"
    assert "moon" in device.reason
