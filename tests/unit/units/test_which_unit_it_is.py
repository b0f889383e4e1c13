"""Goal: what belongs to a unit follows the unit and not its cable; one without a serial number is
read by anybody, and written only once its owner has given it a name.

Method: the small honest unit behind the real thread, tuning and store; once as it is, once as a
family whose identity has no serial number.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from backend.device.ebl.unit import EblUnit
from backend.device.states import DeviceStatus
from backend.errors import Conflict, NameFirst
from backend.imports.service import Uploads
from backend.imports.unit_logs import Collect, word_of
from backend.store import Store, open_store
from backend.tuning.records import RevisionStore
from backend.tuning.service import Tuning
from backend.tuning.trial_values import TrialTuning
from backend.units.inspection import Inspection
from backend.units.memory import UnitMemory
from backend.units.records import UnitStore
from backend.units.service import Devices
from firmware_protocol._generated import MessageId
from tests.fakes.server import eventually
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

SHED, DESK = "socket://shed:1", "socket://desk:1"
BARE_SHED, BARE_DESK = f"{SHED}?family=bare", f"{DESK}?family=bare"
BARE_SHED_KEY = f"bare:url:{BARE_SHED}"
CHANGE = {"pedal_stop_ms": 200}
# What a unit does when it is written.
WRITES = {
    MessageId[name]
    for name in (
        "LIVE_SET",
        "CFG_BEGIN",
        "CFG_CONFIRM",
        "CFG_ROLLBACK",
        "EVT_FAULT_CLEAR",
        "LOG_ERASE",
    )
}


class BareUnit(EblUnit):
    """One that says what it is and not which one."""

    family = "bare"

    def status(self) -> DeviceStatus:
        status = super().status()
        if status.identity is None:
            return status
        return replace(status, identity=replace(status.identity, serial_number=None))


class Desk:
    """Everything that keeps something of a unit, over one store; units by url."""

    def __init__(self, store: Store, units: dict[str, FakeUnit], folder: Path) -> None:
        self.store = store
        note_unit = UnitStore(store.database)
        self.devices = Devices(
            opener=lambda url: UnitOpener(units[url], url),
            families={EblUnit.family: EblUnit, BareUnit.family: BareUnit},
            bike_of=note_unit.bike_of,
        )
        self.tuning = Tuning(self.devices, RevisionStore(store.database))
        self.memory = UnitMemory(
            self.devices, RevisionStore(store.database), note_unit, self.tuning.note_trial_end
        )
        self.devices.watch(self.memory.follow)
        self.live = TrialTuning(self.devices)
        self.inspection = Inspection(self.devices)
        self.uploads = Uploads(store)
        self.collect = Collect(self.devices, self.uploads, folder)

    def bike_of(self, device_id: str) -> int:
        """The bike its unit is on, once it is made."""
        return int(eventually(lambda: self.devices.get(device_id).bike_id) or 0)

    def close(self) -> None:
        self.collect.close()
        self.uploads.close()
        self.devices.close()
        self.memory.close()


OpenDesk = Callable[[dict[str, FakeUnit]], Desk]


@pytest.fixture
def open_desk(tmp_path: Path) -> Iterator[OpenDesk]:
    """Starts anew on the same folder each time; what ran before is closed."""
    running: list[Desk] = []

    def end() -> None:
        for desk in running:
            desk.close()
            desk.store.close()
        running.clear()

    def begin(units: dict[str, FakeUnit]) -> Desk:
        end()
        store = open_store(f"sqlite:///{tmp_path}/spindle.db", (tmp_path / "objects").as_uri())
        running.append(Desk(store, units, tmp_path / "collecting"))
        return running[0]

    yield begin
    end()


@contextmanager
def refused(unit: FakeUnit) -> Iterator[None]:
    """What is in here is refused for want of a name, and the unit hears nothing of it."""
    with pytest.raises(NameFirst, match="Give it a name first") as caught:
        yield
    assert caught.value.code == "name_first"
    assert not WRITES & set(unit.executed)


@pytest.mark.slow
def test_a_unit_on_another_cable_keeps_its_bike_and_its_configurations(
    open_desk: OpenDesk,
) -> None:
    unit = FakeUnit()
    before = open_desk({SHED: unit})
    shed = before.devices.add(SHED)
    before.tuning.write_config(shed.id, CHANGE, "later stop")
    bike_id = before.bike_of(shed.id)

    after = open_desk({DESK: unit})
    desk = after.devices.add(DESK)

    assert (shed.id, desk.id) == ("socket-shed-1", "socket-desk-1")
    assert shed.unit_key == desk.unit_key == f"ebl:{unit.uid.hex()}"
    assert after.bike_of(desk.id) == bike_id
    assert "later stop" in [one.reason for one in after.tuning.revisions(desk.id)]
    assert after.memory.ride_context(desk.id).unit_key == shed.unit_key


@pytest.mark.slow
def test_another_unit_on_the_same_cable_has_none_of_what_was_there(open_desk: OpenDesk) -> None:
    before = open_desk({SHED: FakeUnit(b"FIRST-UNIT-1")})
    first = before.devices.add(SHED)
    before.tuning.write_config(first.id, CHANGE, "later stop")
    bike_id = before.bike_of(first.id)

    after = open_desk({SHED: FakeUnit(b"OTHER-UNIT-1")})
    other = after.devices.add(SHED)

    assert other.id == first.id
    assert after.bike_of(other.id) != bike_id
    assert "later stop" not in [one.reason for one in after.tuning.revisions(other.id)]


def test_the_name_of_a_unit_with_a_number_changes_nothing_but_its_name(
    open_desk: OpenDesk,
) -> None:
    desk = open_desk({SHED: FakeUnit()})
    before = desk.devices.add(SHED)

    named = desk.devices.add(SHED, name="Commuter")

    assert named.name == "Commuter"
    assert (named.id, named.unit_key) == (before.id, before.unit_key)


def test_a_unit_without_a_number_is_read_and_is_on_no_bike(open_desk: OpenDesk) -> None:
    desk = open_desk({BARE_SHED: FakeUnit()})
    device = desk.devices.add(BARE_SHED)
    found = eventually(lambda: desk.tuning.revisions(device.id))

    assert device.identity is not None
    assert device.identity.serial_number is None
    assert (device.unit_key, device.bike_id) == (BARE_SHED_KEY, None)
    assert desk.tuning.read_config(device.id).generation == 7
    assert len(desk.tuning.parameters(device.id)) > 10
    assert found[0].unit_key == BARE_SHED_KEY
    assert desk.devices.get(device.id).bike_id is None
    context = desk.memory.ride_context(device.id)
    assert (context.unit_key, context.device_serial) == (BARE_SHED_KEY, None)


def test_nothing_is_written_to_a_unit_without_number_and_name(open_desk: OpenDesk) -> None:
    unit = FakeUnit()
    desk = open_desk({BARE_SHED: unit})
    device = desk.devices.add(BARE_SHED).id
    calibration = desk.tuning.read_part(device, "calibration").value

    with refused(unit):
        desk.tuning.write_config(device, CHANGE)
    with refused(unit):
        desk.tuning.write_config(device, CHANGE, confirm_s=30)
    with refused(unit):
        desk.tuning.write_part(device, "calibration", calibration)
    with refused(unit):
        desk.tuning.confirm_config(device)
    with refused(unit):
        desk.tuning.rollback_config(device)
    with refused(unit):
        desk.live.set(device, CHANGE, 30)
    with refused(unit):
        desk.live.end(device)
    with refused(unit):
        desk.inspection.clear_faults(device)
    with refused(unit):
        desk.collect.erase(device, 1)


@pytest.mark.slow
def test_a_named_unit_is_written_and_its_configurations_come_back_under_its_name(
    open_desk: OpenDesk,
) -> None:
    unit = FakeUnit()
    before = open_desk({BARE_SHED: unit})
    shed = before.devices.add(BARE_SHED, name="Commuter")
    written = before.tuning.write_config(shed.id, CHANGE, "later stop")
    bike_id = before.bike_of(shed.id)

    after = open_desk({BARE_DESK: unit, BARE_SHED: FakeUnit()})
    desk = after.devices.add(BARE_DESK, name="Commuter")
    other = after.devices.add(BARE_SHED, name="Tandem")

    assert written.state == "committed"
    assert shed.unit_key == desk.unit_key == "bare:name:Commuter"
    assert after.bike_of(desk.id) == bike_id
    assert after.bike_of(other.id) != bike_id
    assert "later stop" in [one.reason for one in after.tuning.revisions(desk.id)]
    assert "later stop" not in [one.reason for one in after.tuning.revisions(other.id)]


def test_a_unit_may_be_named_after_it_was_connected(open_desk: OpenDesk) -> None:
    unit = FakeUnit()
    desk = open_desk({BARE_SHED: unit})
    device = desk.devices.add(BARE_SHED)
    with refused(unit):
        desk.tuning.write_config(device.id, CHANGE)

    named = desk.devices.add(BARE_SHED, name="Commuter")

    assert (named.id, named.unit_key) == (device.id, "bare:name:Commuter")
    assert desk.bike_of(device.id) > 0
    assert desk.tuning.write_config(device.id, CHANGE).state == "committed"
    assert len(desk.devices.list()) == 1


def test_two_connections_cannot_have_one_name(open_desk: OpenDesk) -> None:
    desk = open_desk({BARE_SHED: FakeUnit(), BARE_DESK: FakeUnit(b"OTHER-UNIT-1")})
    desk.devices.add(BARE_SHED, name="Commuter")

    with pytest.raises(Conflict, match=f"over {BARE_SHED.replace('?', '.')} already"):
        desk.devices.add(BARE_DESK, name="Commuter")
    assert [device.url for device in desk.devices.list()] == [BARE_SHED]

    tandem = desk.devices.add(BARE_DESK, name="Tandem")
    with pytest.raises(Conflict, match="Commuter is connected as"):
        desk.devices.add(BARE_DESK, name="Commuter")
    assert desk.devices.get(tandem.id).unit_key == "bare:name:Tandem"


def test_files_of_a_unit_s_logs_are_called_by_its_number_else_by_a_word_any_disk_takes() -> None:
    assert word_of("ebl:0123abcd") == "0123abcd"
    # By hand: printf 'bare:name:../me' | sha256sum
    assert word_of("bare:name:../me") == "6719992aa392a6a2e06c9e6e"
