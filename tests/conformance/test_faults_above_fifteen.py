"""Goal: a fault whose bit is above 15 is latched, frozen, told, logged and cleared like any other.

Method: a registry made in the test, with a latched fault at bit 29 and a warning at bit 30; from it
the generator's C, with the unit's own code around it, built for the host. What an older peer sends,
and what it makes of ours, is in the golden messages (test_wire_vectors.py).
"""

import shutil
import struct
import subprocess
from pathlib import Path

import pytest

from backend.formats.blocks import EVENT, Block
from backend.formats.ride_logs import events_in
from firmware_protocol._generated import EvtFaultClearRequest, FaultSetEvent, LogEvent
from firmware_protocol.generate import c_header, c_source, typescript, wireshark
from firmware_protocol.generate.registry import BadRegistry, Registry, load
from tests.conformance.test_wire_sanitized import STRICT, compiler

ROOT = Path(__file__).resolve().parents[2]
FIRMWARE = ROOT / "sim_device" / "firmware"
ROOMS = [FIRMWARE / "app", FIRMWARE / "control", FIRMWARE / "hal"]
UNIT = [
    "app/faults/faults.c",
    "app/faults/signs.c",
    "app/faults/motion.c",
    "app/faults/inputs.c",
    "control/wheel_speed.c",
    "app/ride_log/pages.c",
]
LATCHED, WARNING = 1 << 29, 1 << 30


def registry_with(folder: Path, **bits: int) -> Registry:
    """The registry with these faults more: name and bit."""
    text = (ROOT / "firmware_protocol" / "registry.toml").read_text(encoding="utf-8")
    lines = "".join(f"{name} = {bit}\n" for name, bit in bits.items())
    rows = "".join(
        f'[[fault]]\nflag = "{name}"\nseverity = "{name.rpartition("_")[2]}"\n'
        'rider_text = "Made up."\nmechanic_text = "Made up."\n\n'
        for name in bits
    )
    text = text.replace("MOTOR_HALL = 14\n", "MOTOR_HALL = 14\n" + lines)
    text = text.replace("[[fault]]\n", rows + "[[fault]]\n", 1)
    (folder / "registry.toml").write_text(text, encoding="utf-8")
    return load(folder / "registry.toml")


@pytest.fixture
def made(tmp_path: Path) -> Registry:
    return registry_with(tmp_path, MADE_UP_LATCHED=29, MADE_UP_WARNING=30)


def built(made: Registry, folder: Path) -> Path:
    """The program of faults_high.c with the registry's C in place of the committed one."""
    codec = folder / "codec"
    shutil.copytree(ROOT / "firmware_protocol" / "c", codec)
    (codec / "ebl_registry.h").write_text(c_header.header(made, 1))
    (codec / "ebl_registry.c").write_text(c_source.registry_source(made))
    (codec / "ebl_messages.c").write_text(c_source.messages_source(made))
    (codec / "ebl_schema.c").write_text(c_source.schema_source(b"\0", bytes(8)))
    program = folder / "faults_high"
    build = subprocess.run(
        [compiler(), *STRICT, *[f"-I{room}" for room in (codec, *ROOMS)],
         Path(__file__).with_name("faults_high.c"), *[FIRMWARE / name for name in UNIT],
         *sorted(codec.glob("*.c")), "-o", program],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert build.returncode == 0, build.stderr
    return program


def block_of(payload: bytes) -> Block:
    """An EVENT block of two events."""
    return Block(0, 1, EVENT, 1, 1, 1, 0, 2, 0, payload)


@pytest.mark.slow
@pytest.mark.host_build("compiles for the host")
@pytest.mark.slow
def test_the_unit_treats_it_like_any_other(made: Registry, tmp_path: Path) -> None:
    program = built(made, tmp_path)

    run = subprocess.run([program], capture_output=True, text=True, timeout=60, check=True)

    said = dict(line.split() for line in run.stdout.splitlines())
    event, logged = bytes.fromhex(said.pop("event")), bytes.fromhex(said.pop("logged"))
    assert {name: int(value, 16) for name, value in said.items()} == {
        "new": 1,
        "active": LATCHED | WARNING,
        "inhibits": 1,
        "frozen": 1,
        "frozen_speed": 7,
        "too_early": 0,
        "latched_cleared": LATCHED,
        "left": WARNING,
        "warning_cleared": WARNING,
        "forgotten": 0,
    }
    assert event == struct.pack("<HH", 2, (LATCHED | WARNING) >> 16)
    assert FaultSetEvent.from_bytes(event).fault_flags == LATCHED | WARNING | 2
    block = block_of(logged)
    assert list(events_in(block)) == [
        (1, LogEvent.FAULT_SET, LATCHED | WARNING),
        (2, LogEvent.FAULT_CLEARED, 3),
    ]


def test_a_log_of_an_older_unit_has_only_the_low_bits() -> None:
    old = struct.pack("<QBHQBH", 1, 2, 5, 2, 3, 4)

    assert list(events_in(block_of(old))) == [(1, 2, 5), (2, 3, 4)]


def test_an_older_host_s_clear_concerns_the_low_bits() -> None:
    assert EvtFaultClearRequest.from_bytes(b"\xff\xff").fault_flags == 0xFFFF
    assert EvtFaultClearRequest(LATCHED | 1).to_bytes() == b"\x01\x00\x00\x20"


def test_every_tool_is_told_which_bit_of_which_channel_it_is(made: Registry) -> None:
    dissector = wireshark.dissector(made, "")
    browser = typescript.module(made)

    table = dissector.partition('["fault_flags_high"] = {')[2].partition("}")[0]
    assert '[13] = "MADE_UP_LATCHED", [14] = "MADE_UP_WARNING"' in table
    assert "made_up_warning: 30," in browser


@pytest.mark.parametrize("bit", [15, 31])
def test_a_bit_that_would_be_a_channel_s_sign_is_refused(tmp_path: Path, bit: int) -> None:
    with pytest.raises(BadRegistry, match="0 to 14 or 16 to 30"):
        registry_with(tmp_path, MADE_UP_WARNING=bit)
