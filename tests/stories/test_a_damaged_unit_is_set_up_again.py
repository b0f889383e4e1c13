"""Goal: a unit that lost its settings is well again once a dealer has written them, also where they
are the very defaults that stand in their place; and what the maker chose is no dealer's to write.

Method: flash files of simulated units, one bit of a record turned over in the only copy.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from sim_device.lockstep import LockstepUnit
from tests.fakes.config_flash import records_at
from tests.fakes.server import ServerHere, SpindleServer

pytestmark = pytest.mark.host_build("the flash that is hurt here is a file of the host's build")

# A row, and the faults of the start.
SWITCHED_ON_S = 0.5
SAME = {"parameters": {"torque_filter_s": 0.5}}
"""What every unit has from the factory."""


def hurt(folder: Path, record: str) -> str:
    """The url of a unit that was made for the EU and has lost this record."""
    flash = bytearray(LockstepUnit(name=record).unit.flash())
    flash[records_at(flash)[record].start + 5] ^= 0x10
    file = folder / f"{record}.flash"
    file.write_bytes(flash)
    return f"sim:{record}?clock=virtual&scenario=none&flash={file}"


@pytest.fixture
def running(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[SpindleServer]:
    with ServerHere(tmp_path / "data", [hurt(tmp_path, request.param)]) as server:
        server.advance(server.ready_device(), SWITCHED_ON_S)
        yield server


def active_faults(server: SpindleServer, device: str) -> list[str]:
    items = server.get(f"/devices/{device}/faults")["items"]
    return [fault["name"] for fault in items if fault["active"]]


@pytest.mark.parametrize("running", ["TUNABLE", "CALIBRATION"], indirect=True)
def test_writing_what_stands_there_already_ends_the_walking_pace(running: SpindleServer) -> None:
    device = running.ready_device()
    before = running.get(f"/devices/{device}/config")
    assert active_faults(running, device) == ["config_defaulted"]
    assert running.get(f"/devices/{device}/parts/limits")["effective_assist_cutoff_kmh"] is None

    written = running.ask("PATCH", f"/devices/{device}/config", json=SAME)

    assert (written["state"], written["verified"]) == ("committed", True)
    assert written["generation"] == before["generation"] + 1
    assert running.get(f"/devices/{device}/config")["parameters"] == before["parameters"]
    assert active_faults(running, device) == []
    assert running.get(f"/devices/{device}/parts/limits")["effective_assist_cutoff_kmh"] == 25.0
    again = running.ask("PATCH", f"/devices/{device}/config", json=SAME)
    assert again["generation"] == written["generation"]


@pytest.mark.parametrize("running", ["MARKET"], indirect=True)
def test_a_market_that_is_lost_is_never_called_written_by_a_dealer(running: SpindleServer) -> None:
    device = running.ready_device()

    for market in ("eu_epac", "us_class_3"):
        body = {"parameters": {"market": market}}
        response = running.client.patch(f"/devices/{device}/config", json=body)

        assert response.status_code == 403
        assert "the maker" in response.json()["detail"]
    assert active_faults(running, device) == ["config_defaulted"]
