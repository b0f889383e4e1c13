"""Goal: whoever has SPEC.md and nothing else can speak to a unit.

Method: a host written from the page (from_the_page: its own framing, check value, and a codec made
of the page's tables; nothing of firmware_protocol or backend) against the simulated unit in virtual
time. The page's worked exchange is held against the unit byte for byte.
"""

from __future__ import annotations

import ast
import itertools
import json
import re
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path

import pytest

from sim_device.lockstep import LockstepUnit
from tests.conformance.from_the_page.client import Client
from tests.conformance.from_the_page.log_download import blocks_of, downloaded, listed
from tests.conformance.from_the_page.page import Page
from tests.conformance.from_the_page.wire import Frame, Receiver, crc32, stuffed, unstuffed

FOLDER = Path(__file__).parent / "from_the_page"
NONCE = bytes(range(8))
ACTIVE = 0
CONFIRMED = 2
CONFIG, SCHEMA, DATA, CONFIG_REST = 1, 2, 3, 7
SPEED_LIMITS_KMH = (10.0, 30.0)


class Wire:
    """The unit's line. losing: so many of the unit's next bytes that come are lost."""

    def __init__(self) -> None:
        self.unit = LockstepUnit(seed=3)
        self.losing = 0

    def send(self, data: bytes) -> object:
        return self.unit.send(data)

    def receive(self) -> bytes:
        data = self.unit.receive()
        lost = min(self.losing, len(data))
        self.losing -= lost
        return data[lost:]

    def advance(self, seconds: float) -> None:
        self.unit.advance(seconds)


@pytest.fixture
def wire() -> Wire:
    return Wire()


@pytest.fixture(scope="module")
def page() -> Page:
    return Page()


@pytest.fixture
def host(wire: Wire, page: Page) -> Client:
    found = Client(wire, page)
    found.connect(NONCE)
    return found


def number(value: object) -> int:
    assert isinstance(value, int)
    return value


def data(value: object) -> bytes:
    assert isinstance(value, bytes)
    return value


def imported(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""


def test_the_host_is_written_from_the_page_alone() -> None:
    rooms = {
        name.partition(".")[0]
        for path in FOLDER.glob("*.py")
        for name in imported(path)
        if not name.startswith("tests.conformance.from_the_page")
    }

    assert rooms <= {
        "__future__",
        "collections",
        "dataclasses",
        "pathlib",
        "re",
        "struct",
        "typing",
    }


@pytest.mark.parametrize("length", [0, 1, 253, 254, 255, 508, 509])
def test_its_framing_is_its_own_and_right(length: int) -> None:
    for sample in (bytes(length), b"\1" * length, bytes(i % 256 for i in range(length))):
        assert 0 not in stuffed(sample)
        assert unstuffed(stuffed(sample)) == sample
        assert crc32(sample) == zlib.crc32(sample)


def test_it_is_greeted_and_asks_whether_the_unit_is_still_the_same(wire: Wire, page: Page) -> None:
    host = Client(wire, page)

    hello = host.connect(NONCE)
    alive = host.ask("ALIVE").fields

    assert number(hello["device_class"]) & 0x80
    assert (hello["major"], hello["max_outstanding"]) == (1, 4)
    assert (alive["boot_id"], alive["session_id"]) == (hello["boot_id"], hello["session_id"])
    small = host.ask("HELLO", {"major_min": 1, "major_max": 1, "host_flags": 0, "host_mtu": 127,
                               "host_nonce": NONCE})  # fmt: skip
    assert (small.status, small.detail) == ("RANGE", 128)


def test_it_reads_a_snapshot_in_the_page_s_units(wire: Wire, host: Client, page: Page) -> None:
    wire.unit.place(18.0)
    host.listen(0.5)
    channel, scale = page.channels["speed_kmh"]

    answer = host.ask("STR_SNAPSHOT", {"channel_ids": bytes([channel])})

    (count,) = struct.unpack("<h", data(answer.fields["values"]))
    assert SPEED_LIMITS_KMH[0] < count * scale < SPEED_LIMITS_KMH[1]


def test_it_counts_a_stream_s_rows_and_misses_none(host: Client, page: Page) -> None:
    ids = bytes(page.channels[name][0] for name in ("speed_kmh", "battery_voltage_v"))
    asked = {"stream_id": 9, "divider": 2, "batch": 5, "encoding": 0, "lease_s": 5,
             "channel_ids": ids}  # fmt: skip

    begun = host.ask("STR_SUBSCRIBE", asked).fields
    host.listen(2.0)

    assert begun["period_us"] == 20_000
    epochs = {frame.payload[5] & 7 for frame in host.streams}
    assert epochs == {begun["epoch"]}
    first = number(begun["start_seq"])
    assert [frame.word for frame in host.streams] == list(range(first, first + len(host.streams)))
    assert len(host.streams) in (19, 20)
    times = [struct.unpack_from("<I", frame.payload)[0] for frame in host.streams]
    assert {after - before for before, after in itertools.pairwise(times)} == {100_000}
    volts = {struct.unpack_from("<h", frame.payload, 8)[0] for frame in host.streams}
    assert all(30.0 < count * page.channels["battery_voltage_v"][1] < 44.0 for count in volts)


def active_image(host: Client) -> bytes:
    image, total = b"", 1
    while len(image) < total:
        part = host.ask("CFG_READ", {"bank": ACTIVE, "offset": len(image), "length": 512}).fields
        total = number(part["total_length"])
        image += data(part["data"])
    return image


def test_it_writes_a_parameter_and_believes_only_what_it_reads_back(
    host: Client, page: Page
) -> None:
    row = page.parameters["pedal_stop_ms"]
    before = active_image(host)
    value = (213).to_bytes(2, "little")
    after = before[: row.image_byte] + value + before[row.image_byte + 2 :]
    info = host.ask("CFG_INFO").fields

    begun = host.ask(
        "CFG_BEGIN", {"base_generation": info["generation"], "base_crc32": crc32(before)}
    ).fields
    transaction = begun["transaction"]
    items = row.id.to_bytes(2, "little") + b"\0\1" + value
    steps = [
        host.ask("CFG_SET", {"transaction": transaction, "items": items}),
        host.ask("CFG_VALIDATE", {"transaction": transaction}),
        host.ask("CFG_COMMIT", {"transaction": transaction, "staged_crc32": crc32(after),
                                "flags": 0, "confirm_s": 0}),
    ]  # fmt: skip

    assert [step.status for step in steps] == ["OK", "OK", "OK"]
    assert active_image(host) == after
    assert number(host.ask("CFG_INFO").fields["generation"]) == number(info["generation"]) + 1


def test_an_answer_that_was_lost_is_given_again_and_nothing_is_done_twice(
    wire: Wire, host: Client
) -> None:
    info = host.ask("CFG_INFO").fields
    base = {"base_generation": info["generation"], "base_crc32": crc32(active_image(host))}
    wire.losing = 12

    begun = host.ask("CFG_BEGIN", base)

    # Executed anew, the second sending would have met the first one's transaction: BUSY.
    assert (begun.status, host.repetitions) == ("OK", 1)
    assert host.ask("CFG_BEGIN", base).status == "BUSY"


def test_events_come_again_until_they_are_acknowledged(wire: Wire, page: Page) -> None:
    host = Client(wire, page, acknowledges=False)
    host.connect(NONCE)
    wire.unit.simulation_set({"faults": {"torque_sensor": "open_high"}})
    host.listen(2.0)
    told = [event for event in host.events if event.name == "FAULT_SET"]

    assert len(told) >= 6
    assert len({event.seq for event in told}) == 1
    assert [event.repeated for event in told] == [False] + [True] * (len(told) - 1)
    assert number(told[0].fields["fault_flags"]) & 1 << 0

    host.acknowledges = True
    host.listen(0.5)
    host.events.clear()
    host.listen(1.0)
    assert host.events == []


def test_it_fetches_a_ride_log_and_proves_it(wire: Wire, host: Client) -> None:
    wire.unit.place(18.0)
    wire.unit.rider("legs", 25.0)
    host.listen(10.0)
    wire.unit.rider("off")
    wire.unit.brake(True)
    host.listen(40.0)
    (log,) = listed(host)

    whole = downloaded(host, log)

    name = {"log_id": log["log_id"], "generation": log["generation"]}
    told = host.ask("LOG_CRC", {**name, "offset": 0, "length": len(whole)})
    assert told.fields["crc32"] == crc32(whole)
    blocks = blocks_of(whole)
    kinds = [kind for kind, _ in blocks]
    assert kinds[:3] == [CONFIG, CONFIG_REST, SCHEMA]
    assert DATA in kinds
    config, rest = blocks[0][1], blocks[1][1]
    assert config[28:] + rest[4:] == active_image(host)
    assert config[24:28] == rest[:4] == crc32(active_image(host)).to_bytes(4, "little")
    kept = host.ask("LOG_CONFIRM", {**name, "length": len(whole), "crc32": crc32(whole)})
    assert kept.status == "OK"
    assert number(listed(host)[0]["flags"]) & CONFIRMED


def test_it_reads_what_a_simulated_unit_says_of_its_world(host: Client) -> None:
    text = data(host.ask("SIM_GET").fields["text"])

    world = json.loads(text if text.startswith(b"{") else zlib.decompress(text))

    assert "speed_factor" in world
    refused = host.ask("SIM_SET", {"text": b'{"no_such_member": 1}'})
    assert refused.status == "RANGE"
    member, _, why = refused.rest.decode().partition("\n")
    assert (member, why != "") == ("no_such_member", True)


def exchange(page: Page) -> list[tuple[str, str]]:
    """Who speaks, and the bytes in hexadecimal, of the page's worked exchange."""
    chapter = page.text.partition("## 12. A worked exchange")[2]
    blocks = "".join(re.findall(r"(?s)```\n(.*?)```", chapter))
    lines = re.findall(r"(?m)^(host|unit|data)  (.*(?:\n      .*)*)", blocks)
    return [(who, re.sub(r"\s", "", words)) for who, words in lines]


def test_the_worked_exchange_is_what_travels(page: Page) -> None:
    unit = LockstepUnit(seed=3)
    said = b""
    frames: list[Frame] = []
    lines = exchange(page)
    assert len(lines) >= 10
    for who, words in lines:
        if who == "host":
            assert (said, frames) == (b"", []), "the page leaves something out"
            unit.send(bytes.fromhex(words))
            unit.poll()
            said = unit.receive()
            frames = Receiver().feed(said)
        elif who == "unit":
            assert said.hex(" ") == bytes.fromhex(words).hex(" ")
            said, frames = b"", []
        else:
            frame = frames.pop(0)
            assert re.fullmatch(words, frame.bytes().hex()), frame.bytes().hex(" ")
            said = b""
    assert (said, frames) == (b"", [])
