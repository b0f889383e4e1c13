"""Goal: a cable pulled in the middle of a ride costs the recording a stretch, and not the ride.

Method: the real firmware rides in virtual time, the real recorder listens, the cable is out for
half a minute. Afterwards the unit's own log is fetched. The log's bytes as they came are the truth:
every row of it in the gap must be in the ride, at its time, and every row heard live must be as it
was heard.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from backend.core.ride import Ride
from backend.formats import ImportedRide
from backend.formats.formats import read_file
from backend.imports.service import Uploads
from backend.imports.unit_logs import Collect
from backend.rides.recording.recorder import Recorder
from backend.rides.recording.unit_recorder import RecordSettings
from backend.store import Store, open_store
from backend.tuning.records import RevisionStore
from backend.units.inspection import Inspection
from backend.units.memory import UnitMemory
from backend.units.records import UnitStore
from backend.units.service import Devices
from sim_device.lockstep import LockstepUnit
from tests.fakes.server import eventually
from tests.fakes.simulated_unit import LockstepAsUnit
from tests.fakes.unit_link import UnitOpener
from tests.fakes.uploading import read_here

URL = "socket://unit:1"
AWAY_S = 30.0
REST_S = 40.0
# So much of the unit's time in one read of its host.
PIECE_S, PIECES = 0.1, 5
MISSING = -32768


class UnitInTime(LockstepAsUnit):
    """A unit whose time passes only as far as it is told to, while its host reads; `goes_by`: or
    with every read, as it must for a host that waits for the unit's flash."""

    def __init__(self, unit: LockstepUnit) -> None:
        super().__init__(unit)
        self._said = bytearray()
        self.owed_s = 0.0
        self.goes_by = False

    def transmit(self) -> bytes:
        self._said += self.unit.receive()
        said = bytes(self._said)
        self._said.clear()
        return said

    def advance(self, seconds: float) -> None:
        if self.goes_by:
            self.unit.advance(seconds)
        elif self.owed_s <= 0.0:
            self.unit.poll()
        for _ in range(PIECES):
            if self.owed_s <= 0.0:
                break
            # What the unit says meanwhile fits its queue.
            self.unit.advance(PIECE_S)
            self._said += self.unit.receive()
            self.owed_s -= PIECE_S


@dataclass
class Desk:
    """One unit on a cable, and a Spindle that records and fetches."""

    unit: LockstepUnit
    in_time: UnitInTime
    cable: UnitOpener
    devices: Devices
    recorder: Recorder
    store: Store
    collect: Collect
    uploads: Uploads
    device: str

    def ridden_for(self, seconds: float) -> None:
        """Let time pass until so much more of it is recorded."""
        until = self.rows() + round(seconds * 100)
        self.in_time.owed_s = seconds

        def recorded() -> int:
            # The bike rolls, and with it the recorder, a moment after the rider pushes.
            if self.in_time.owed_s <= 0.0:
                self.in_time.owed_s = PIECE_S
            return self.rows()

        eventually(recorded, lambda rows: rows >= until)

    def rows(self) -> int:
        status = self.recorder.status(self.device)
        return status.rows if status else 0

    def only_ride(self) -> Ride:
        (ride,) = self.store.rides.list().items
        return ride


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    unit = LockstepUnit(seed=6)
    in_time = UnitInTime(unit)
    cable = UnitOpener(in_time, URL)
    devices = Devices(opener=lambda url: cable)
    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as store:
        memory = UnitMemory(
            devices, RevisionStore(store.database), UnitStore(store.database), lambda unit: None
        )
        recorder = Recorder(store.rides, memory.ride_context, RecordSettings())
        uploads = Uploads(store, reader=read_here)
        collect = Collect(devices, uploads, tmp_path / "collecting")
        devices.watch(memory.follow)
        devices.watch(recorder.watch)
        device = devices.add(URL).id
        yield Desk(unit, in_time, cable, devices, recorder, store, collect, uploads, device)
        collect.close()
        devices.close()
        recorder.close()
        memory.close()


def test_the_stretch_without_a_cable_comes_from_the_unit_and_the_rest_stays_as_it_was_heard(
    desk: Desk,
) -> None:
    devices, store = desk.devices, desk.store
    devices.wait_connected(desk.device, 20.0)
    desk.device = devices.list()[0].id
    legs = {"kind": "legs", "torque_nm": 25.0, "cadence_rpm_max": 80.0}
    Inspection(devices).simulate(desk.device, {"rider": legs})
    desk.ridden_for(15.0)
    desk.cable.unplug()
    assert desk.cable.tried.wait(20.0)
    desk.unit.advance(AWAY_S)
    desk.cable.plug_in()
    eventually(lambda: devices.list()[0].state, lambda state: state == "ready")
    desk.ridden_for(AWAY_S + 10.0)
    Inspection(devices).simulate(desk.device, {"rider": {"kind": "off"}, "brake": True})
    desk.in_time.owed_s = REST_S
    eventually(lambda: desk.only_ride().state, lambda state: state == "done")
    assert [log.state for log in desk.collect.logs(desk.device).items] == ["closed"]
    heard = desk.only_ride()
    names = [channel.name for channel in heard.channels]
    before = store.rides.reader(heard.id).counts(names, 0, heard.row_count)
    store.rides.patch(heard.id, "With a loose cable", "Found it afterwards.")
    lost = sum(gap.rows_lost or 0 for gap in heard.gaps)
    assert lost >= AWAY_S * 100

    desk.in_time.goes_by = True
    desk.collect.start(desk.device, 1)
    done = eventually(
        lambda: desk.collect.get(desk.device, 1), lambda seen: seen.state in ("done", "failed")
    )

    assert (done.state, done.ride_id, done.confirmed) == ("done", heard.id, True), done
    ride = desk.only_ride()
    assert (ride.name, ride.notes) == ("With a loose cable", "Found it afterwards.")
    assert ride.row_count == heard.row_count
    after = store.rides.reader(ride.id).counts(names, 0, ride.row_count)
    was_empty = np.all([before[name] == MISSING for name in names], axis=0)
    is_empty = np.all([after[name] == MISSING for name in names], axis=0)
    for name in names:
        assert (after[name][~was_empty] == before[name][~was_empty]).all()
    check_against_log(desk, ride, was_empty, after, done.upload_id)
    filled = sum(span.rows_filled for span in ride.filled)
    assert int(was_empty.sum()) == lost
    assert int(is_empty.sum()) == lost - filled
    still = sum(gap.rows_lost or 0 for gap in ride.gaps)
    assert still + sum(span.rows_lost for span in ride.filled) == lost
    assert ride.completeness is not None
    assert ride.completeness > 0.99


def check_against_log(
    desk: Desk,
    ride: Ride,
    was_empty: np.ndarray[tuple[int], np.dtype[np.bool_]],
    after: object,
    upload_id: str | None,
) -> None:
    """Every row of the log that fell into a gap is in the ride, at its time, as it was taken."""
    log = log_of(desk, upload_id)
    assert ride.context.unit_t0_us is not None
    assert log.context.unit_t0_us is not None
    offset_us = log.context.unit_t0_us - ride.context.unit_t0_us
    places = np.rint((log.rows.times_us + offset_us) / 10_000).astype(int)
    inside = (places >= 0) & (places < ride.row_count)
    inside[inside] = was_empty[places[inside]]
    assert int(inside.sum()) == sum(span.rows_filled for span in ride.filled)
    assert int(inside.sum()) >= AWAY_S * 10
    for name, counts in log.rows.counts.items():
        found = after[name]  # type: ignore[index]
        assert (found[places[inside]] == counts[inside]).all(), name


def log_of(desk: Desk, upload_id: str | None) -> ImportedRide:
    assert upload_id is not None
    key = desk.store.uploads.get(upload_id).object_key
    assert key is not None
    (log,) = read_file("log.ebll", desk.store.objects.local_path(key).read_bytes()).rides
    return log
