"""Goal: the firmware reads and writes only its own memory and relies on nothing undefined.

Method: a host's whole story and thousands of rounds of noise are recorded on the usual build and
replayed on one with AddressSanitizer and UndefinedBehaviorSanitizer. It must end well and say the
very same bytes.
"""

import math
import random
import shutil
import struct
import subprocess
from pathlib import Path

import pytest
from sim_device.firmware.python._native import ffi, lib

from firmware_protocol import codec, framing, parameters
from firmware_protocol._generated import (
    CHANNELS,
    PARAMETERS,
    REQUEST_BY_ID,
    CfgCommitRequest,
    CfgSetRequest,
    CfgValidateRequest,
    MessageId,
    StrSubscribeRequest,
)
from tests import counts
from tests.fakes.bench_unit import BenchUnit, crc32

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).parent
FOLDERS = [
    "firmware_protocol/c",
    "sim_device/firmware/control",
    "sim_device/firmware/app",
    "third_party/monocypher",
    "sim_device/firmware/hal",
    "sim_device/firmware/boards/host",
]
BOARD = ("bench_board.c", "log_flash.c")
COMPILER = shutil.which("gcc") or shutil.which("clang")


@pytest.fixture(scope="module")
def sanitized(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bench as a program whose every access is watched."""
    if COMPILER is None:
        pytest.fail("There is no C compiler, which `make setup` asks for.", pytrace=False)
    program = tmp_path_factory.mktemp("sanitized") / "unit"
    sources = [path for folder in FOLDERS[:4] for path in sorted((ROOT / folder).rglob("*.c"))]
    command = [COMPILER, "-std=c99", "-g", "-O1", "-ffp-contract=off", "-fno-math-errno"]
    command += ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    command += [f"-I{ROOT / folder}" for folder in FOLDERS]
    sources += [ROOT / FOLDERS[5] / name for name in BOARD]
    command += [*map(str, sources), str(HERE / "sanitized_unit.c")]
    built = subprocess.run(
        [*command, "-o", str(program)], capture_output=True, text=True, check=False
    )
    if built.returncode != 0 and ("libasan" in built.stderr or "libubsan" in built.stderr):
        pytest.skip("the compiler has no sanitizer libraries")
    assert built.returncode == 0, built.stderr
    return program


class RecordedUnit(BenchUnit):
    """Writes down what is done to it, and everything it says."""

    def __init__(self) -> None:
        self.script = bytearray()
        self.said = bytearray()
        super().__init__()

    def boot(self) -> None:
        self.script += b"b"
        super().boot()

    def advance(self, seconds: float) -> None:
        self.script += struct.pack("<cI", b"a", round(seconds * 1e6))
        super().advance(seconds)

    def say(self, wire: bytes) -> None:
        self.script += struct.pack("<cH", b"s", len(wire)) + wire
        super().say(wire)
        self.hear_all()

    def line_room(self, length: int) -> None:
        self.script += struct.pack("<cI", b"r", length)
        super().line_room(length)

    def inputs(self, **values: float) -> None:
        if "speed_kmh" in values:
            self.script += struct.pack("<cf", b"w", values["speed_kmh"])
        super().inputs(**values)
        inputs = ffi.new("hal_inputs *")
        lib.bench_inputs_get(self.board, inputs)
        self.script += b"i" + bytes(ffi.buffer(inputs))

    def take_wire(self) -> bytes:
        wire = self._heard + super().take_wire()
        self._heard = b""
        self.said += wire
        return wire

    _heard = b""

    def hear_all(self) -> None:
        """The program hands over what was said after every record, so the recording does too."""
        self._heard += super().take_wire()


def a_hosts_story(unit: RecordedUnit) -> None:
    unit.hello()
    every_channel = bytes(channel.id for channel in CHANNELS)
    unit.ask(StrSubscribeRequest(1, 1, 12, 0, 60, every_channel))
    unit.ask(StrSubscribeRequest(2, 7, 1, 0, 2, every_channel[:1]))
    transaction = unit.begin()
    for items in parameters.set_items(parameters.default_config() | {"gear_ratio": 40.34}):
        unit.ask(CfgSetRequest(transaction, items))
    points = next(row.id for row in PARAMETERS if row.name == "fuzzy_speed_points_kmh")
    unit.ask(CfgSetRequest(transaction, struct.pack("<HBB5f", points, 0, 5, *[9.0] * 5)))
    unit.ask(CfgValidateRequest(transaction))
    unit.stage(transaction, {"fuzzy_speed_points_kmh": [1.0, 2.0, 3.0, 4.0, 5.0]})
    unit.ask(CfgCommitRequest(transaction, 0, 0, 0))
    unit.advance(31.0)
    for cutoff in (24.0, 23.0, 22.0):
        unit.write({"assist_cutoff_kmh": cutoff})
    unit.line_room(0)
    unit.advance(5.0)
    unit.line_room(lib.BENCH_LINE_BYTES)
    for raw in (3000.0, math.nan, math.inf, -1e30, 1e38, 0.0):
        unit.inputs(torque_raw_counts=raw, speed_kmh=raw, cadence_rpm=raw, crank_angle_deg=raw)
        unit.advance(0.5)
    unit.boot()
    unit.read_image()


def noise_on_an_open_transaction(unit: RecordedUnit) -> None:
    noise = random.Random(5)
    image = parameters.pack_image(parameters.default_config())
    for _ in range(counts.of(3000)):
        message_id = noise.choice(list(REQUEST_BY_ID))
        transaction = struct.pack("<H", noise.randrange(1, 4))
        row = noise.choice(PARAMETERS)
        item = struct.pack("<HBB", row.id, noise.randrange(6), noise.randrange(1, 26))
        at = row.image_offset
        body = transaction + (item + image[at : at + row.size]) * noise.randrange(1, 3)
        if message_id == MessageId.CFG_BEGIN and noise.random() < 0.8:
            body = struct.pack("<II", 1, crc32(image))
        elif message_id == MessageId.HELLO:
            body = struct.pack("<BBHH", 1, 1, 0, noise.choice([128, 129, 544, 1024])) + bytes(8)
        elif message_id == MessageId.STR_SUBSCRIBE and noise.random() < 0.8:
            numbers = (noise.randrange(6), noise.randrange(4), noise.randrange(30), 0, 20)
            body = struct.pack("<BHBBB", *numbers) + bytes(range(1, noise.randrange(1, 24)))
        elif noise.random() < 0.3:
            body = noise.randbytes(noise.randrange(530))
        frame = struct.pack("<BBH", 0x20, noise.randrange(256), message_id) + body
        unit.say(framing.encode_frame(frame))
        unit.say(noise.randbytes(noise.randrange(60)))
        if noise.random() < 0.3:
            unit.advance(noise.choice([0.01, 0.2, 1.0]))


@pytest.mark.long
@pytest.mark.large_count
@pytest.mark.host_build("compiles for the host")
@pytest.mark.parametrize("story", [a_hosts_story, noise_on_an_open_transaction])
def test_a_watched_build_touches_nothing_it_must_not_and_says_the_same(
    sanitized: Path, story: object
) -> None:
    assert callable(story)
    unit = RecordedUnit()
    story(unit)
    unit.hear()

    replay = subprocess.run(
        [sanitized], input=bytes(unit.script), capture_output=True, check=False, timeout=120
    )

    assert replay.returncode == 0, replay.stderr.decode()
    assert replay.stdout == bytes(unit.said)
    decoder = framing.FrameDecoder()
    kinds = {type(codec.decode(frame)) for frame in decoder.feed(replay.stdout)}
    assert {codec.Response, codec.Stream, codec.Event} <= kinds
