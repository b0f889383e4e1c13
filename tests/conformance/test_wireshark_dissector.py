"""Goal: what Wireshark shows of the wire is what travelled, and damage is marked as what it is.

Method: the generated dissector reads the golden vectors and a conversation of the real firmware;
the host's codec is the oracle. It runs in Lua 5.2 and 5.4 against a Wireshark that only records,
and in the real `tshark` in `make prove`, which installs it.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from backend.device.ebl.operations.config_transaction import read_config, write_config
from backend.device.ebl.session.stream_receiver import StreamPlan
from firmware_protocol import codec
from firmware_protocol._generated import PARAMETERS, REQUEST_BY_ID, RESPONSE_BY_ID, Event, MessageId
from firmware_protocol.framing import FrameDecoder, encode_frame
from firmware_protocol.layout import MISSING, Message
from firmware_protocol.parameters import unpack_image
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench
from tests.fakes.simulated_unit import LockstepAsUnit
from tests.fakes.wireshark import (
    DLT_ETHERNET,
    DLT_USER0,
    HOST,
    UNIT,
    RecordingWireshark,
    Seen,
    tcp_packets,
    tshark,
)

VECTORS = Path(__file__).resolve().parents[2] / "firmware_protocol" / "vectors"
ENGINES = [
    pytest.param(52, id="lua 5.2"),
    pytest.param(54, id="lua 5.4"),
    pytest.param(0, id="tshark", marks=pytest.mark.long),
]
Serial = Callable[[list[bytes]], list[Seen]]
Segments = list[tuple[str, bytes]]


@pytest.fixture(params=ENGINES)
def engine(request: pytest.FixtureRequest) -> int:
    return int(request.param)


@pytest.fixture
def serial(engine: int) -> Serial:
    """Shows packets of a serial line to the engine."""
    if engine:
        return lambda packets: RecordingWireshark(engine).serial(packets)
    return lambda packets: tshark(packets, DLT_USER0)


@pytest.fixture
def tcp(engine: int) -> Callable[[Segments], list[Seen]]:
    """Shows segments of a TCP connection to the engine."""
    if engine:
        return lambda segments: RecordingWireshark(engine).tcp(segments)
    return lambda segments: tshark(tcp_packets(segments), DLT_ETHERNET)


def cases(name: str) -> list[Any]:
    rows: list[Any] = json.loads((VECTORS / f"{name}.json").read_text(encoding="utf-8"))["cases"]
    return rows


def same(meant: object, shown: str) -> bool:
    """Whether a text shows a value; numbers may be decimal or hexadecimal, bytes with colons."""
    if isinstance(meant, bytes):
        return shown.replace(":", "") == meant.hex()
    if isinstance(meant, float):
        return math.isclose(float(shown), meant, rel_tol=1e-5, abs_tol=1e-9)
    if isinstance(meant, int):
        words = {"True": 1, "False": 0}
        return (words[shown] if shown in words else int(shown, 0)) == meant
    # What is no text is shown in every engine's own way.
    return shown == meant or not str(meant).isprintable()


def members(message: Message, path: str, length: int) -> Iterator[tuple[str, object]]:
    """The fields a dissector must show of a message whose payload has this length."""
    halved = {field.high_of for field in message.LAYOUT}
    for field in message.LAYOUT:
        if field.high_of and length == message.LENGTH:
            continue  # of a peer that does not know it
        value = getattr(message, field.high_of or field.name)
        if field.high_of or field.name in halved:
            value = value >> 16 if field.high_of else value & 0xFFFF
        if field.name == "text":
            value = value.decode("latin-1")
        if value in (b"", ""):
            continue
        values = value if isinstance(value, tuple) else (value,)
        if field.name == "states":
            values = tuple(value)
        for one in values:
            yield f"{path}.{field.name}", one


def expected(frame: bytes) -> list[tuple[str, object]]:
    """Name and value of the fields of a frame's message, by the host's codec."""
    decoded = codec.decode(frame)
    if isinstance(decoded, codec.Malformed):
        return [("ebl.malformed", decoded.reason.name)]
    if isinstance(decoded, codec.Request):
        name = MessageId(decoded.message.MESSAGE_ID).name.lower()
        found = members(decoded.message, f"ebl.{name}.request", len(frame) - 4)
        return [("ebl.retransmit", decoded.retransmit), ("ebl.tid", decoded.tid), *found]
    if isinstance(decoded, codec.Response):
        head = [("ebl.tid", decoded.tid), ("ebl.status", int(decoded.status))]
        if decoded.message is None:
            return [*head, ("ebl.detail", decoded.detail)]
        name = MessageId(decoded.message_id).name.lower()
        return [*head, *members(decoded.message, f"ebl.{name}.response", len(frame) - 5)]
    if isinstance(decoded, codec.Event):
        head = [("ebl.seq", decoded.seq), ("ebl.event.code", int(decoded.code))]
        if decoded.message is None:
            return [*head, ("ebl.event.t_us", decoded.t_us)]
        path = f"ebl.event.{Event(decoded.code).name.lower()}"
        return [*head, *members(decoded.message, path, len(frame) - 9)]
    if isinstance(decoded, codec.Bulk):
        head = [("ebl.bulk.session", decoded.session), ("ebl.bulk.offset", decoded.offset)]
        return [*head, ("ebl.bulk.length", len(decoded.data)), ("ebl.bulk.data", decoded.data)]
    return [
        ("ebl.stream.id", decoded.stream_id),
        ("ebl.stream.t0_us", decoded.t0_us),
        ("ebl.stream.epoch", decoded.epoch),
        ("ebl.stream.overrun", decoded.overrun),
        ("ebl.stream.clip", decoded.clip),
    ]


def check(name: str, seen: Seen, meant: list[tuple[str, object]]) -> None:
    """Every field that is meant is shown, in its order, and no other fault than the meant one."""
    names = {path for path, _ in meant}
    shown = [(path, text) for path, text in seen if path in names]
    assert [path for path, _ in shown] == [path for path, _ in meant], name
    for (path, text), (_, value) in zip(shown, meant, strict=True):
        assert same(value, text), f"{name}: {path} is {value!r}, shown {text!r}"
    if "ebl.malformed" not in names:
        # Vectors fill items with arbitrary bytes, which are no items.
        assert [text for path, text in seen if path == "ebl.malformed" and text != "ITEM"] == []


def test_every_golden_message_shows_its_fields(serial: Serial) -> None:
    rows = cases("messages")
    frames = [bytes.fromhex(row["frame"]) for row in rows]

    seen = serial([encode_frame(frame) for frame in frames])

    for row, frame, fields in zip(rows, frames, seen, strict=True):
        check(row["name"], fields, expected(frame))


def test_every_verdict_is_that_of_the_codec(serial: Serial) -> None:
    # A frame without a header is no stretch that the framing lets through.
    rows = [row for row in cases("verdicts") if len(row["frame"]) >= 8]
    frames = [bytes.fromhex(row["frame"]) for row in rows]

    seen = serial([encode_frame(frame) for frame in frames])

    for row, frame, fields in zip(rows, frames, seen, strict=True):
        check(row["name"], fields, expected(frame))


def test_damage_is_counted_like_a_receiver_counts_it(serial: Serial) -> None:
    rows = [row for row in cases("damage") if row["wire"]]
    names = {"CRC": "crc_errors", "COBS": "cobs_errors", "OVERFLOW": "overflows"}

    seen = serial([bytes.fromhex(row["wire"]) for row in rows])

    for row, fields in zip(rows, seen, strict=True):
        faults = [text for path, text in fields if path == "ebl.malformed"]
        counted = {name: faults.count(code) for code, name in names.items()}
        assert counted == {name: row[name] for name in names.values()}, row["name"]
        assert sum(path == "ebl.crc" for path, _ in fields) == row["frames_ok"], row["name"]


def conversation(piece: int) -> tuple[Bench, Segments]:
    """A host that connects, streams, reads and changes the configuration of the real firmware."""
    bench = Bench(LockstepAsUnit(LockstepUnit(seed=1)), StreamPlan())
    segments: Segments = []

    def tap(source: str) -> Callable[[bytes], bytes]:
        def note(data: bytes) -> bytes:
            pieces = [data[at : at + piece] for at in range(0, len(data), piece)]
            segments.extend((source, part) for part in pieces)
            return data

        return note

    bench.to_unit, bench.to_host = tap(HOST), tap(UNIT)
    bench.connect()
    base = bench.ask(read_config())
    bench.ask(write_config(base, {"pedal_stop_ms": 200, "fuzzy_table_name": "rain"}))
    bench.run(0.2)
    return bench, segments


def elements(image: bytes) -> list[tuple[str, object]]:
    """Every element of the image by its parameter's name; a choice as its number."""
    found: list[tuple[str, object]] = []
    for row in PARAMETERS:
        for index in range(row.count):
            at = row.image_offset + index * row.length
            data = image[at : at + row.length]
            value: object = int.from_bytes(data, "little")
            if row.type == "text":
                value = data.split(b"\0")[0].decode("latin-1")
            elif row.type == "f32":
                value = unpack_image(image)[row.name]
                for size in reversed(row.shape):
                    assert isinstance(value, list)
                    value = value[index % size]
            found.append((f"ebl.parameter.{row.name}", value))
    return found


def test_a_conversation_cut_anywhere_shows_values_by_their_names(
    tcp: Callable[[Segments], list[Seen]],
) -> None:
    bench, segments = conversation(piece=37)
    wire = b"".join(data for source, data in segments if source == UNIT)
    answers = [codec.decode(frame) for frame in FrameDecoder().feed(wire)]
    images = [
        answer.message.data
        for answer in answers
        if isinstance(answer, codec.Response)
        and answer.message_id == MessageId.CFG_READ
        and answer.message is not None
    ]

    seen = [field for fields in tcp(segments) for field in fields]

    assert [text for path, text in seen if path == "ebl.malformed"] == []
    changed: list[tuple[str, object]] = [
        ("ebl.parameter.fuzzy_table_name", "rain"),
        ("ebl.parameter.pedal_stop_ms", 200),
    ]
    parameters = [pair for pair in seen if pair[0].startswith("ebl.parameter.")]
    before, after = elements(images[0]), elements(images[-1])
    meant = [*before, *changed, *after]
    assert [path for path, _ in parameters] == [path for path, _ in meant]
    assert all(same(value, text) for (_, text), (_, value) in zip(parameters, meant, strict=True))
    check_rows(bench, seen)


def check_rows(bench: Bench, seen: Seen) -> None:
    """Every value of every row that the session took is shown, in its order."""
    rows = [
        (channel, int(count))
        for block in bench.blocks()
        for counts in block.values
        for channel, count in zip(block.channels, counts, strict=True)
    ]
    shown, in_stream = [], False
    for path, text in seen:
        if path == "ebl.kind":
            in_stream = int(text, 0) == codec.KIND_STREAM
        elif in_stream and path.startswith("ebl.channel."):
            shown.append((path, text))
    assert len(rows) > 100
    assert len(shown) == len(rows)
    for (path, text), (channel, count) in zip(shown, rows, strict=True):
        if count == MISSING:
            assert (path, text) == ("ebl.channel.missing", channel.name)
        else:
            assert path == f"ebl.channel.{channel.name}"
            assert same(count * channel.scale, text), f"{path}: {count} shown as {text}"


def test_a_stream_that_nobody_was_seen_to_ask_for_is_shown_as_bytes(serial: Serial) -> None:
    rows = codec.Stream(1, 7, 1000, 2, np.zeros((2, 3), "<i2"))

    (seen,) = serial([encode_frame(codec.encode(rows))])

    assert ("ebl.stream.values", "00" * 12) in [(p, t.replace(":", "")) for p, t in seen]


def test_every_message_has_a_request_and_a_response_in_it(serial: Serial) -> None:
    frames = [
        codec.encode(codec.Response(1, identity, 2, 0x0101))
        for identity in {*REQUEST_BY_ID, *RESPONSE_BY_ID}
    ]

    seen = serial([encode_frame(frame) for frame in frames])

    assert all(("ebl.malformed") not in dict(fields) for fields in seen)
