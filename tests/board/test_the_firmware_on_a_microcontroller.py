"""Goal: what runs on the Cortex-M4F is the firmware, and small enough in its habits for one.

Method: the image of boards/mps2_an386, read with the compiler's own tools, and started in QEMU with
its serial line behind pyserial. The whole conformance suite runs against it as well:
`make test-board`.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.device.link import Opener
from firmware_protocol import codec, framing
from firmware_protocol._generated import MTU_BEFORE_HELLO, HelloRequest, HelloResponse, Status
from sim_device import emulator
from sim_device.emulated import prepare
from tests.fakes.server import eventually

pytestmark = pytest.mark.slow

UID = b"board-test-1"

# Frames above the 512 bytes of the design, each with its reason; none may grow or join them
# without one: the last was the calibration in the configuration, 28 bytes.
LARGE_FRAMES = {
    "crypto_eddsa_check_equation": 1100,  # Monocypher: the window of one point
    "config_image_is_valid": 880,  # a configuration, and the law's view of it
    "refused_settle": 544,  # the factory's image, once, for a flash of other firmware
}
FRAME_BYTES_MAX = 512
HOST_BOARD = emulator.BOARD_FOLDER.parent / "host"
OTHER_IMAGES = ("main_bench", "main_count")


@pytest.fixture
def board(image: Path, tmp_path: Path) -> Iterator[emulator.Emulator]:
    memory = tmp_path / "memory"
    emulator.make_memory(memory)
    prepare(memory, UID, None)
    with emulator.Emulator(image, memory) as running:
        yield running


def said_by(tool: str, *words: str) -> str:
    return subprocess.run([tool, *words], capture_output=True, text=True, check=True).stdout


def hello(address: str) -> HelloResponse:
    link = Opener(address).open()
    decoder = framing.FrameDecoder()
    request = codec.Request(1, HelloRequest(1, 1, 0, 544, b"12345678"))
    heard: list[HelloResponse] = []

    def listen() -> list[HelloResponse]:
        for frame in decoder.feed(link.read()):
            answer = codec.decode(frame)
            if isinstance(answer, codec.Response) and isinstance(answer.message, HelloResponse):
                assert answer.status == Status.OK
                heard.append(answer.message)
        return heard

    try:
        link.write(b"\0\0" + framing.encode_frame(codec.encode(request)))
        return eventually(listen)[0]
    finally:
        link.close()


def test_a_host_finds_it_behind_its_serial_line(board: emulator.Emulator) -> None:
    answer = hello(board.host_address)

    assert answer.uid == UID
    assert answer.boot_id == 1
    assert answer.config_generation == 1


@pytest.mark.long
def test_built_for_short_frames_it_says_so(image: Path, tmp_path: Path) -> None:
    short = emulator.build("unit", frame_bytes=MTU_BEFORE_HELLO)

    with emulator.Emulator(short) as running:
        answer = hello(running.host_address)

    assert (answer.rx_mtu, answer.tx_mtu) == (MTU_BEFORE_HELLO, MTU_BEFORE_HELLO)


def test_its_flash_outlives_the_power(image: Path, tmp_path: Path) -> None:
    memory = tmp_path / "memory"
    answers = []
    for _ in range(2):
        with emulator.Emulator(image, memory) as running:
            answers.append(hello(running.host_address))

    assert [answer.boot_id for answer in answers] == [1, 2]
    assert answers[0].config_crc32 == answers[1].config_crc32


def test_the_image_has_no_heap_no_libm_and_prints_nothing(image: Path) -> None:
    names = {line.split()[-1] for line in said_by("arm-none-eabi-nm", str(image)).splitlines()}

    foreign = {"malloc", "calloc", "free", "_sbrk", "printf", "sinf", "cosf", "sqrtf", "powf"}
    assert names.isdisjoint(foreign)


def test_no_multiplication_is_fused_with_an_addition(image: Path) -> None:
    code = said_by("arm-none-eabi-objdump", "-d", str(image))

    assert "vmul.f32" in code
    assert re.findall(r"\bvfn?m[as]\.\w+", code) == []


def test_no_function_takes_more_stack_than_it_may(image: Path) -> None:
    large = {}
    for report in image.parent.glob("*.su"):
        if (HOST_BOARD / f"{report.stem}.c").exists() or report.stem in OTHER_IMAGES:
            continue
        for line in report.read_text().splitlines():
            place, size, kind = line.split("\t")
            assert kind == "static", line
            name = place.rpartition(":")[2]
            if int(size) > FRAME_BYTES_MAX and is_linked(image, name):
                large[name] = int(size)

    assert {name: size for name, size in large.items() if size > LARGE_FRAMES.get(name, 0)} == {}


def is_linked(image: Path, name: str) -> bool:
    return re.search(rf" {name}$", said_by("arm-none-eabi-nm", str(image)), re.M) is not None
