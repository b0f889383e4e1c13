"""Several units at once: added, found, listened to, asked and let go.

Each url opens a link to a small honest unit in memory; the threads are the real ones.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator

import pytest

from backend.device.ebl.operations.config_transaction import read_config
from backend.device.states import LinkState, StateChanged
from backend.device.stream import StreamBlock
from backend.errors import Conflict, InvalidRequest, NoAnswer, NotFound
from backend.units.inspection import Inspection
from backend.units.service import Devices
from firmware_protocol._generated import FaultSetEvent, MessageId, Status
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import Heard, UnitOpener

PATIENCE_S = 4.0
LEFT, RIGHT = "socket://left:1", "socket://right:1"


class Workshop:
    """Units by url; urls without one are empty ports."""

    def __init__(self) -> None:
        self.units = {LEFT: FakeUnit(b"LEFT-UNIT-01"), RIGHT: FakeUnit(b"RIGHT-UNIT-1")}
        self.openers: dict[str, UnitOpener] = {}

    def opener(self, url: str) -> UnitOpener:
        self.openers[url] = UnitOpener(self.units.get(url) or FakeUnit(b"NOBODY-THERE"), url)
        if url not in self.units:
            self.openers[url].unplug()
        return self.openers[url]


@pytest.fixture
def workshop() -> Workshop:
    return Workshop()


@pytest.fixture
def devices(workshop: Workshop) -> Iterator[Devices]:
    devices = Devices(opener=workshop.opener)
    yield devices
    devices.close()


def test_an_added_unit_has_its_connection_s_id_and_its_own_key(devices: Devices) -> None:
    device = devices.add(LEFT)

    assert device.id == "socket-left-1"
    assert device.unit_key == f"ebl:{b'LEFT-UNIT-01'.hex()}"
    assert device.state == "ready"
    assert device.kind == "socket"
    assert device.identity is not None
    assert device.config is not None
    assert device.config.generation == 7


def test_a_simulated_unit_behind_a_socket_is_called_simulated(
    devices: Devices, workshop: Workshop
) -> None:
    workshop.units[LEFT].device_class = 129

    assert devices.add(LEFT).kind == "simulated"


def test_two_units_side_by_side_keep_their_rows_apart(devices: Devices, workshop: Workshop) -> None:
    workshop.units[LEFT].level, workshop.units[RIGHT].level = 111, 222
    left, right = devices.add(LEFT), devices.add(RIGHT)
    heard = {device.id: Heard() for device in (left, right)}
    for device_id, listener in heard.items():
        devices.subscribe(device_id, listener)

    blocks = {
        device_id: listener.wait_for(StreamBlock, count=3) for device_id, listener in heard.items()
    }

    assert [device.id for device in devices.list()] == [left.id, right.id]
    assert set(blocks[left.id].values.ravel()) == {111}  # type: ignore[attr-defined]
    assert set(blocks[right.id].values.ravel()) == {222}  # type: ignore[attr-defined]


def test_the_same_url_twice_is_the_same_device(devices: Devices) -> None:
    assert devices.add(LEFT).id == devices.add(LEFT).id
    assert len(devices.list()) == 1


def test_a_unit_on_another_port_takes_the_place_of_its_lost_connection(
    devices: Devices, workshop: Workshop
) -> None:
    lost = devices.add(LEFT)
    heard = Heard()
    devices.subscribe(lost.id, heard)
    workshop.openers[LEFT].unplug()
    heard.wait_for(StateChanged)
    workshop.units[RIGHT] = FakeUnit(b"LEFT-UNIT-01")

    again = devices.add(RIGHT)

    assert (again.unit_key, again.state) == (lost.unit_key, "ready")
    assert [one.url for one in devices.list()] == [RIGHT]


def test_the_same_unit_over_a_second_way_is_refused_naming_the_first(
    devices: Devices, workshop: Workshop
) -> None:
    workshop.units[RIGHT] = FakeUnit(b"LEFT-UNIT-01")
    devices.add(LEFT)

    with pytest.raises(Conflict, match=f"over {LEFT} already"):
        devices.add(RIGHT)

    assert [device.url for device in devices.list()] == [LEFT]


def test_a_bad_url_is_refused_and_adds_nothing(devices: Devices) -> None:
    with pytest.raises(InvalidRequest):
        devices.add("http://bike")

    assert list(devices.list()) == []


def test_a_port_that_is_empty_is_kept_with_its_reason_and_taken_up_later(
    devices: Devices, workshop: Workshop
) -> None:
    device = devices.add("socket://later:1")
    assert device.id == "socket-later-1"
    assert device.state == "connecting"
    assert "no such port" in device.reason

    heard = Heard()
    devices.subscribe(device.id, heard)
    workshop.openers["socket://later:1"].plug_in()
    heard.wait_for(StateChanged, state=LinkState.READY)

    serial_number = b"NOBODY-THERE".hex()
    assert devices.get("socket-later-1").id == "socket-later-1"
    assert devices.get(serial_number).id == "socket-later-1"


def test_a_removed_unit_is_gone_and_its_port_given_back(
    devices: Devices, workshop: Workshop
) -> None:
    device = devices.add(LEFT)
    heard = Heard()
    devices.subscribe(device.id, heard)

    devices.remove(device.id)

    heard.wait_for(StateChanged, state=LinkState.CLOSED)
    assert workshop.openers[LEFT].links[0].closed
    with pytest.raises(NotFound):
        devices.get(device.id)
    assert devices.add(LEFT).state == "ready"


def test_a_watcher_hears_of_devices_present_and_to_come(devices: Devices) -> None:
    heard = Heard()
    left = devices.add(LEFT)
    leave = devices.watch(heard)
    right = devices.add(RIGHT)
    enough = threading.Event()
    ids: set[str] = set()

    def note(device_id: str, event: object) -> None:
        ids.add(device_id)
        if len(ids) == 2:
            enough.set()

    leave()
    devices.watch(note)

    assert enough.wait(20.0)
    assert ids == {left.id, right.id}


def test_who_stopped_listening_hears_nothing_more(devices: Devices) -> None:
    device = devices.add(LEFT)
    gone, stays = Heard(), Heard()
    leave = devices.subscribe(device.id, gone)
    devices.subscribe(device.id, stays)

    leave()
    count = len(gone.events)
    stays.wait_for(StreamBlock, count=3)

    assert len(gone.events) == count


@pytest.mark.slow
def test_a_snapshot_is_the_newest_row_with_nothing_missing_made_up(
    devices: Devices, workshop: Workshop
) -> None:
    workshop.units[LEFT].level = 1250
    device = devices.add(LEFT)
    heard = Heard()
    devices.subscribe(device.id, heard)
    heard.wait_for(StreamBlock)
    assert Inspection(devices).snapshot(device.id).channels["speed_kmh"] == 12.5

    workshop.units[LEFT].level = -32768
    heard.wait_for(StreamBlock, count=len(heard.events) + 3)

    assert set(Inspection(devices).snapshot(device.id).channels.values()) == {None}


def test_a_snapshot_of_a_unit_that_does_not_stream_is_asked_for(workshop: Workshop) -> None:
    workshop.units[LEFT].level = 500
    devices = Devices(streaming=False, opener=workshop.opener)
    device = devices.add(LEFT)

    values = Inspection(devices).snapshot(device.id)

    assert values.channels["rider_torque_nm"] == 5.0
    assert values.t_us > 5_000_000
    devices.close()


def test_a_snapshot_of_an_absent_unit_is_no_answer_with_the_reason(devices: Devices) -> None:
    device = devices.add("socket://later:1")

    with pytest.raises(NoAnswer, match="no such port"):
        Inspection(devices).snapshot(device.id)


@pytest.mark.slow
def test_faults_come_with_words(devices: Devices, workshop: Workshop) -> None:
    device = devices.add(LEFT)
    heard = Heard()
    devices.subscribe(device.id, heard)
    heard.wait_for(StreamBlock)

    workshop.units[LEFT].tell(FaultSetEvent(1))
    heard.wait_for(StreamBlock, count=10)

    (fault,) = Inspection(devices).faults(device.id)
    assert fault.name == "torque_sensor"
    assert "see your dealer" in fault.description
    assert "the bridge for an open or shorted arm" in fault.mechanic_text
    assert fault.severity == "latched"


def test_the_simulation_is_read_and_set(devices: Devices, workshop: Workshop) -> None:
    workshop.units[LEFT].device_class = 129
    device = devices.add(LEFT)

    assert Inspection(devices).simulate(device.id, {"road": {"grade_deg": 3.0}}) == {
        "road": {"grade_deg": 3.0}
    }
    assert json.loads(workshop.units[LEFT].simulation) == Inspection(devices).simulation(device.id)


def test_a_real_unit_has_no_simulation(devices: Devices, workshop: Workshop) -> None:
    workshop.units[LEFT].refuse[MessageId.SIM_GET] = Status.UNKNOWN_MSG
    device = devices.add(LEFT)

    with pytest.raises(Conflict, match="real unit"):
        Inspection(devices).simulation(device.id)


def test_the_ports_are_listed_with_the_simulated_unit(devices: Devices) -> None:
    assert "sim" in [port.url for port in devices.ports()]


def test_units_are_let_go_side_by_side(devices: Devices, workshop: Workshop) -> None:
    together = threading.Barrier(2)
    for url in (LEFT, RIGHT):
        devices.add(url)
        link = workshop.openers[url].links[-1]

        def close(close: Callable[[], None] = link.close) -> None:
            together.wait(timeout=PATIENCE_S)
            close()

        link.close = close  # type: ignore[method-assign]

    devices.close()

    assert not together.broken
    assert list(devices.list()) == []


def test_a_unit_that_was_let_go_answers_at_once_that_it_is_gone(
    devices: Devices, workshop: Workshop
) -> None:
    devices.add(LEFT)
    driver = devices._find(b"LEFT-UNIT-01".hex()).unit.driver
    devices.remove(b"LEFT-UNIT-01".hex())

    with pytest.raises(NoAnswer) as caught:
        driver.run(read_config(), PATIENCE_S)

    assert caught.value.code == "not_connected"
