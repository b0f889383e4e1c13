"""Goal: the unit's C and the host's Python read and write exactly the same wire.

Method: golden vectors. Both languages, each through its own door, must give the bytes, the fields
and the verdicts that firmware_protocol/vectors states; the four of seed.json were worked out by
hand before either existed.
"""

import hashlib
import json
import zlib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from firmware_protocol import _generated as registry
from firmware_protocol import codec, framing
from firmware_protocol.layout import Message
from sim_device.firmware.python import wire

VECTORS = Path(__file__).resolve().parents[2] / "firmware_protocol" / "vectors"
DOORS = [pytest.param(framing, id="python"), pytest.param(wire, id="c")]
RESULTS = {reason.name: reason.value for reason in codec.Reason} | {"OK": 0}


def cases(name: str) -> list[Any]:
    rows = json.loads((VECTORS / f"{name}.json").read_text(encoding="utf-8"))["cases"]
    return [pytest.param(row, id=row["name"]) for row in rows]


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("case", cases("seed"))
def test_the_frames_the_protocol_was_designed_with_are_what_travels(
    door: ModuleType, case: dict[str, str]
) -> None:
    frame, on_the_wire = bytes.fromhex(case["frame"]), bytes.fromhex(case["wire"])

    assert door.encode_frame(frame) == on_the_wire
    assert door.FrameDecoder().feed(on_the_wire) == [frame]


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("case", cases("framing"))
def test_stuffing_is_right_at_the_edges_of_a_run(door: ModuleType, case: dict[str, Any]) -> None:
    fillings = {"zeros": b"\0", "ones": b"\1", "counting": bytes(range(256))}
    frame = (fillings[case["pattern"]] * case["length"])[: case["length"]]

    sent = door.encode_frame(frame)
    received = door.FrameDecoder().feed(sent)

    assert sent.hex() == case["wire"]
    assert received == ([frame] if case["accepted"] else [])


@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("step", [1, 7, 100_000], ids=lambda step: f"by {step}")
@pytest.mark.parametrize("case", cases("damage"))
def test_damage_is_counted_the_same_way_in_any_split(
    door: ModuleType, step: int, case: dict[str, Any]
) -> None:
    data = bytes.fromhex(case["wire"])
    decoder = door.FrameDecoder()

    frames = [f for at in range(0, len(data), step) for f in decoder.feed(data[at : at + step])]

    assert len(frames) == case["frames_ok"]
    assert decoder.stats == framing.Counts(
        case["frames_ok"], case["crc_errors"], case["cobs_errors"], case["overflows"]
    )


@pytest.mark.parametrize("case", cases("verdicts"))
def test_both_sides_pass_the_same_verdict_on_odd_frames(case: dict[str, str]) -> None:
    frame = bytes.fromhex(case["frame"])

    host = codec.decode(frame)
    unit, _ = wire.check_frame(frame)

    verdict = host.reason.name if isinstance(host, codec.Malformed) else "OK"
    assert verdict == case["verdict"]
    assert unit == RESULTS[case["verdict"]]


def as_vector(message: Message) -> dict[str, Any]:
    fields = {}
    for column in (column for column in message.LAYOUT if not column.high_of):
        value = getattr(message, column.name)
        if isinstance(value, bytes):
            value = value.hex()
        fields[column.name] = list(value) if isinstance(value, tuple) else value
    return fields


@pytest.mark.parametrize("case", cases("messages"))
def test_every_message_has_the_same_fields_on_both_sides(case: dict[str, Any]) -> None:
    frame = bytes.fromhex(case["frame"])
    struct_name = f"ebl_{case['message'].lower()}_{case['kind']}"
    head = {"request": 4, "response": 5, "event": 9}[case["kind"]]

    decoded = codec.decode(frame)

    assert isinstance(decoded, codec.Request | codec.Response | codec.Event)
    assert decoded.message is not None
    assert as_vector(decoded.message) == case["fields"]
    # A peer that does not know the high half of a number ends before it; it is written as 0.
    written = frame + bytes(2 * high_halves_missing(decoded.message, frame[head:]))
    assert codec.encode(decoded) == written
    if case["fields"]:
        assert wire.read_message(struct_name, frame[head:]) == case["fields"]
        assert wire.copy_message(struct_name, frame[head:]) == written[head:]


def high_halves_missing(message: Message, payload: bytes) -> int:
    highs = sum(bool(column.high_of) for column in message.LAYOUT)
    return highs if len(payload) == message.LENGTH else 0


@pytest.mark.parametrize("case", cases("images"))
def test_the_unit_refuses_the_values_its_registry_forbids(case: dict[str, Any]) -> None:
    image = bytearray(wire.default_image())
    for offset, data in case["changes"]:
        image[offset : offset + len(data) // 2] = bytes.fromhex(data)

    found = wire.image_violations(bytes(image))

    assert [(i, at, registry.Violation(code).name) for i, at, code in found] == [
        tuple(row) for row in case["violations"]
    ]


def test_the_unit_carries_the_schema_its_hash_promises() -> None:
    unit_hash, unit_schema = wire.schema()

    canonical_json = zlib.decompress(unit_schema)

    assert unit_hash == hashlib.sha256(canonical_json).digest()[:8] == registry.SCHEMA_HASH
    assert len(json.loads(canonical_json)["parameter"]) == len(registry.PARAMETERS)


def test_whatever_the_registry_has_the_vectors_hold() -> None:
    messages = {(case.values[0]["message"], case.values[0]["kind"]) for case in cases("messages")}
    images = {case.values[0]["name"].split(":")[0] for case in cases("images")}

    names = {message.name for message in registry.MessageId}
    expected = {(name, kind) for name in names for kind in ("request", "response")}
    assert messages == expected | {(event.name, "event") for event in registry.Event}
    assert images >= {row.name for row in registry.PARAMETERS}


def test_the_vectors_stay_small_enough_to_read() -> None:
    assert sum(path.stat().st_size for path in VECTORS.iterdir()) < 300_000
