"""Goal: what was meant for one bike is never done to the next one on the same cable,
and whatever changes the unit on a connection can name the unit that it is for.

Method: two factory-fresh units of the small honest kind, one behind the other on one connection,
behind the real thread and the real services. Both have the same generation and the same content.
Who can name a unit is read in the description of the API.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import pytest

from backend.errors import NoAnswer, OtherUnit
from backend.tuning.service import Tuning
from backend.tuning.types import etag
from backend.units.outcome import find_outcome
from backend.units.service import Devices
from firmware_protocol._generated import MessageId
from firmware_protocol.parameters import default_config, unpack_image
from tests.fakes.api import description
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.server import eventually
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

CHANGE = {"pedal_stop_ms": 200}
CHANGES_A_UNIT = {MessageId.CFG_BEGIN, MessageId.CFG_CONFIRM, MessageId.CFG_ROLLBACK}
# What a connection sends by itself (streams, clocks, signs of life) goes on meanwhile.
SENT_ON_REQUEST = CHANGES_A_UNIT | {
    MessageId.CFG_READ,
    MessageId.EVT_FAULT_CLEAR,
    MessageId.LIVE_SET,
}


@dataclass
class Bench:
    """One cable; unit A on it from the start."""

    opener: UnitOpener
    devices: Devices
    tuning: Tuning
    a: FakeUnit
    b: FakeUnit
    id: str

    def key(self, unit: FakeUnit) -> str:
        """Under which what belongs to a unit is kept."""
        return f"ebl:{unit.uid.hex()}"

    def plug(self, unit: FakeUnit) -> None:
        """Take off what is there and put another unit in its place; returns when it is ready."""
        self.opener.unplug()
        self.opener.unit = unit
        self.opener.plug_in()
        eventually(lambda: self.devices.get(self.id).unit_key == self.key(unit))
        assert self.devices.wait_connected(self.id, 20.0)


@pytest.fixture
def bench() -> Iterator[Bench]:
    a, b = FakeUnit(b"FIRST-UNIT-1"), FakeUnit(b"OTHER-UNIT-1")
    opener = UnitOpener(a, "socket://bench:1")
    devices = Devices(opener=lambda url: opener)
    device = devices.add(opener.url)
    tuning = Tuning(devices, MemoryRevisions())
    yield Bench(opener, devices, tuning, a, b, device.id)
    devices.close()


def test_a_change_made_for_a_is_refused_at_b_and_waits_for_a(bench: Bench) -> None:
    note_unit = bench.tuning.read_config(bench.id)
    tag = etag(note_unit.unit_key, note_unit.generation, note_unit.crc32)
    bench.plug(bench.b)

    with pytest.raises(OtherUnit, match=bench.key(bench.b)):
        bench.tuning.write_config(bench.id, CHANGE, if_match=tag)
    assert unpack_image(bench.b.image) == default_config()
    assert not CHANGES_A_UNIT & set(bench.b.executed)

    bench.plug(bench.a)
    change = bench.tuning.write_config(bench.id, CHANGE, if_match=tag)
    assert (change.unit_key, change.verified) == (bench.key(bench.a), True)


def test_a_change_that_names_its_unit_is_refused_at_another_one(bench: Bench) -> None:
    bench.plug(bench.b)

    with pytest.raises(OtherUnit, match="was meant for"):
        bench.tuning.write_config(bench.id, CHANGE, unit_key=bench.key(bench.a))
    with pytest.raises(OtherUnit):
        bench.devices.check_meant(bench.id, bench.key(bench.a))

    bench.devices.check_meant(bench.id, bench.key(bench.b))
    assert not CHANGES_A_UNIT & set(bench.b.executed)


@pytest.mark.parametrize(
    "work",
    [
        lambda bench, unit: unit.read_config(),
        lambda bench, unit: unit.clear_faults(),
        lambda bench, unit: unit.confirm_config(default_config()),
        lambda bench, unit: unit.rollback_config(),
        lambda bench, unit: unit.end_trial_values(),
    ],
    ids=["read", "clear faults", "keep a trial", "end a trial", "end what is tried"],
)
def test_what_began_with_a_does_not_go_on_with_b(
    bench: Bench, work: Callable[[Bench, object], object]
) -> None:
    _, begun_with_a = bench.devices.own(bench.id)
    bench.plug(bench.b)

    with pytest.raises(OtherUnit):
        work(bench, begun_with_a)

    assert not SENT_ON_REQUEST & set(bench.b.executed)


def test_b_is_not_asked_what_became_of_a_s_change(bench: Bench) -> None:
    bench.plug(bench.b)

    with pytest.raises(NoAnswer) as caught:
        find_outcome(
            bench.devices,
            bench.id,
            bench.key(bench.a),
            lambda unit: unit.read_config(),
            NoAnswer("The link went down."),
        )

    assert caught.value.outcome == "unknown"


UNDER_A_CONNECTION = "/devices/{device_id}/"


def test_every_change_under_a_connection_takes_the_unit_s_key_and_may_refuse() -> None:
    changes = [
        operation
        for path, operations in description()["paths"].items()
        if UNDER_A_CONNECTION in path
        for method, operation in operations.items()
        if method != "get"
    ]

    assert len(changes) >= 12
    for operation in changes:
        headers = {one["name"] for one in operation["parameters"] if one["in"] == "header"}
        assert "spindle-unit" in headers, operation["operationId"]
        assert "412" in operation["responses"], operation["operationId"]
