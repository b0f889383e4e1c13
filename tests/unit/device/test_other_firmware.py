"""Goal: a unit of another firmware is tuned where that is safe, looked at where it is not, and told
apart with the reason in words; what was read of it once is not read again. A fault this Spindle has
no name for is listed like any other, as long as it is active.

Method: the small honest unit with a schema made from the registry by one change; for faults the
operation is driven by hand, answered as the unit's firmware would.
"""

from __future__ import annotations

import hashlib
import json
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from backend.device.ebl.faults import NAME_OF_BIT, fault_names
from backend.device.ebl.operations.config_transaction import read_config, write_config
from backend.device.ebl.operations.readings import fault_frames
from backend.device.ebl.session.operation import Question
from backend.device.ebl.session.stream_receiver import StreamPlan
from backend.device.readings import Fault
from backend.device.states import LinkState
from backend.store.schemas import SCHEMAS_MAX, SchemaFiles
from firmware_protocol._generated import (
    EvtFaultFreezeRequest,
    EvtFaultListRequest,
    EvtFaultListResponse,
    FaultFlags,
    MessageId,
    Status,
)
from firmware_protocol.codec import Response
from firmware_protocol.framing import FrameDecoder, encode_frame
from firmware_protocol.generate.registry import load
from tests.fakes.bench import Bench
from tests.fakes.unit import FakeUnit

REGISTRY = Path(__file__).parents[3] / "firmware_protocol" / "registry.toml"
Change = Callable[[dict[str, Any]], object]


def of(rows: list[dict[str, Any]], name: str) -> dict[str, Any]:
    return next(row for row in rows if row["name"] == name)


def unit_with(change: Change) -> FakeUnit:
    """A unit whose schema differs from ours by `change`."""
    schema = json.loads(load(REGISTRY).schema)
    change(schema)
    text = json.dumps(schema).encode()
    unit = FakeUnit()
    unit.schema, unit.schema_hash = zlib.compress(text), hashlib.sha256(text).digest()[:8]
    return unit


def a_new_message(schema: dict[str, Any]) -> None:
    row = {"id": 0x0FFF, "name": "FUTURE", "request": [], "response": []}
    schema["message"].append(row)


def an_answer_that_grew(schema: dict[str, Any]) -> None:
    of(schema["message"], "CFG_INFO")["response"].append(["wear", "u32"])


def a_request_that_is_shorter(schema: dict[str, Any]) -> None:
    of(schema["message"], "STR_SUBSCRIBE")["request"].pop()


def a_channel_more(schema: dict[str, Any]) -> None:
    schema["channel"].append({"id": 250, "name": "moon", "unit": "lx", "scale": 1})


def no_high_halves(schema: dict[str, Any]) -> None:
    for row in schema["message"]:
        for layout in ("request", "response"):
            row[layout] = [field for field in row[layout] if field[2:] != ["high"]]


@pytest.mark.parametrize(
    "change",
    [
        a_new_message,
        an_answer_that_grew,
        a_request_that_is_shorter,
        a_channel_more,
        no_high_halves,
    ],
)
def test_a_unit_whose_difference_does_not_concern_us_is_ready_and_tuned(change: Change) -> None:
    bench = Bench(unit_with(change), StreamPlan()).connect()

    assert bench.session.state is LinkState.READY
    base = bench.ask(read_config())
    assert bench.ask(write_config(base, {"pedal_stop_ms": 200})).parameters["pedal_stop_ms"] == 200


def another_scale(schema: dict[str, Any]) -> None:
    schema["channel"][0]["scale"] = 0.02


def another_choice(schema: dict[str, Any]) -> None:
    schema["enum"]["law"]["TURBO"] = 3


def another_bound(schema: dict[str, Any]) -> None:
    of(schema["parameter"], "pedal_stop_ms")["max"] = 5000


def a_parameter_more(schema: dict[str, Any]) -> None:
    schema["parameter"].append({**schema["parameter"][0], "id": 0x0FFF, "name": "moon_phase"})


def a_parameter_less(schema: dict[str, Any]) -> None:
    schema["parameter"].remove(of(schema["parameter"], "gear_ratio"))


def no_transaction(schema: dict[str, Any]) -> None:
    schema["message"].remove(of(schema["message"], "CFG_BEGIN"))


def an_answer_that_is_shorter(schema: dict[str, Any]) -> None:
    of(schema["message"], "CFG_STATUS")["response"].pop()


def a_request_that_grew(schema: dict[str, Any]) -> None:
    of(schema["message"], "CFG_COMMIT")["request"].append(["reason", "u8"])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (another_scale, "its channel speed_kmh is another or missing"),
        (another_choice, "mode_laws means something else to it"),
        (another_bound, "pedal_stop_ms means something else to it"),
        (a_parameter_more, "does not know its moon_phase"),
        (a_parameter_less, "it has no gear_ratio"),
        (no_transaction, "it does not know CFG_BEGIN"),
        (an_answer_that_is_shorter, "CFG_STATUS means something else to it"),
        (a_request_that_grew, "CFG_COMMIT means something else to it"),
        (lambda schema: schema.clear(), "it has no sensor_offset_counts"),
        (lambda schema: schema.update(channel=7), "its channel speed_kmh"),
        (lambda schema: schema.update(enum=[]), "mode_laws means something else"),
    ],
)
def test_a_unit_whose_difference_matters_is_read_only_and_says_which(
    change: Change, words: str
) -> None:
    bench = Bench(unit_with(change), StreamPlan()).connect()

    assert bench.session.state is LinkState.READ_ONLY
    assert words in bench.session.reason


def test_a_unit_that_does_not_tell_its_schema_is_read_only_and_nothing_of_it_is_shown() -> None:
    unit = unit_with(a_new_message)
    bench = Bench(unit, StreamPlan())
    frames = FrameDecoder()

    def without_schema_read(data: bytes) -> bytes:
        heard = [frame for frame in frames.feed(data) if frame[2] != MessageId.SCHEMA_READ]
        return b"".join(encode_frame(frame) for frame in heard)

    bench.to_unit = without_schema_read
    bench.connect()
    bench.run(1.0)

    assert bench.session.state is LinkState.READ_ONLY
    assert "could not be read from it" in bench.session.reason
    assert bench.blocks() == []


def test_a_description_that_was_read_once_is_not_read_again_after_a_restart(
    tmp_path: Path,
) -> None:
    unit = unit_with(a_new_message)
    for _ in range(2):
        # A new server: only the folder is the same.
        bench = Bench(unit, schemas=SchemaFiles(tmp_path / "schemas")).connect()
        assert bench.session.state is LinkState.READY

    assert unit.executed.count(MessageId.HELLO) == 2
    read = [message for message in unit.executed if message is MessageId.SCHEMA_READ]
    pieces = -(-len(unit.schema) // (544 - 16))
    assert len(read) == pieces


def test_a_kept_description_that_was_damaged_is_read_again(tmp_path: Path) -> None:
    unit = unit_with(a_new_message)
    Bench(unit, schemas=SchemaFiles(tmp_path)).connect()
    (file,) = tmp_path.iterdir()
    file.write_bytes(b"moths")

    bench = Bench(unit, schemas=SchemaFiles(tmp_path)).connect()

    assert bench.session.state is LinkState.READY
    assert file.read_bytes() == unit.schema


def test_the_folder_keeps_so_many_descriptions_and_lets_the_oldest_go(tmp_path: Path) -> None:
    kept = SchemaFiles(tmp_path)
    names = [f"{number:016x}" for number in range(SCHEMAS_MAX + 3)]

    for name in names:
        kept[name] = name.encode()

    assert list(kept) == names[3:]
    assert sorted(file.stem for file in tmp_path.iterdir()) == names[3:]
    with pytest.raises(ValueError, match="no hash"):
        kept["../../etc/passwd"] = b""


def test_a_disk_that_refuses_costs_the_memory_only(tmp_path: Path) -> None:
    blocked = tmp_path / "a file"
    blocked.write_text("not a folder")

    kept = SchemaFiles(blocked)
    kept["0" * 16] = b"known"

    assert kept["0" * 16] == b"known"


NEWER_BIT = 30  # the last one that is ever given


def answer(asked: Question, active: int) -> Response:
    """What a unit says that keeps no freeze frame."""
    if isinstance(asked.message, EvtFaultListRequest):
        return Response(1, asked.message.MESSAGE_ID, Status.OK, 0, EvtFaultListResponse(active))
    assert isinstance(asked.message, EvtFaultFreezeRequest)
    return Response(1, asked.message.MESSAGE_ID, Status.NOT_FOUND)


def listed(active: int) -> list[Fault]:
    operation = fault_frames()
    try:
        questions = next(operation)
        while True:
            questions = operation.send([answer(question, active) for question in questions])
    except StopIteration as done:
        return list(done.value)


def test_an_unknown_fault_is_named_by_its_bit() -> None:
    assert NEWER_BIT not in NAME_OF_BIT

    assert fault_names(FaultFlags.TORQUE_SENSOR | 1 << NEWER_BIT) == ("torque_sensor", "fault_30")


def test_an_active_fault_of_a_newer_firmware_is_listed() -> None:
    found = listed(FaultFlags.TORQUE_SENSOR | 1 << NEWER_BIT)

    assert [(one.name, one.active) for one in found] == [
        ("torque_sensor", True),
        ("fault_30", True),
    ]
