"""Goal: a calibration tool that knows only the A2L description reads and means what we do.

Method: `a2ltool`, a parser that is not ours, judges the file in its strict mode; then images and
rows are decoded from nothing but what the file says and compared with the host's own reading.
"""

from __future__ import annotations

import re
import struct
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from backend.device.ebl.operations.live_values import values_of
from firmware_protocol._generated import (
    CHANNELS,
    IMAGE_LENGTH,
    PARAMETERS,
    SCHEMA_HASH,
    LimitFlags,
)
from firmware_protocol.parameters import default_config, pack_image
from firmware_protocol.spelling import word_of

A2L = Path(__file__).resolve().parents[2] / "firmware_protocol" / "a2l" / "ebl.a2l"
LIVE_ROW = 0x10000
CODES = {"UBYTE": "B", "UWORD": "H", "ULONG": "I", "FLOAT32_IEEE": "f", "SWORD": "h"}
FACTORY = 2


@dataclass(frozen=True)
class Block:
    """`/begin KIND name ...  /end KIND`: its words, texts without their quotes."""

    kind: str
    words: tuple[str, ...]

    @property
    def name(self) -> str:
        return self.words[0]

    def after(self, word: str, count: int = 1) -> list[str]:
        at = self.words.index(word)
        return list(self.words[at + 1 : at + 1 + count])


def blocks(text: str) -> list[Block]:
    """The innermost blocks of an A2L text."""
    plain = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    found = []
    for match in re.finditer(r"/begin (\w+)((?:(?!/begin|/end).)*)/end \1", plain, flags=re.S):
        words = re.findall(r'"(?:[^"\\]|\\.)*"|\S+', match[2])
        found.append(Block(match[1], tuple(word.strip('"') for word in words)))
    return found


@pytest.fixture(scope="module")
def described() -> list[Block]:
    return blocks(A2L.read_text(encoding="utf-8"))


def judged(text: str, folder: Path) -> subprocess.CompletedProcess[str]:
    file = folder / "judged.a2l"
    file.write_text(text, encoding="utf-8")
    tool = Path(sys.executable).with_name("a2ltool")
    return subprocess.run(
        [tool, "--strict", "--check", file], capture_output=True, text=True, check=False
    )


def test_a_strict_parser_that_is_not_ours_finds_no_fault(tmp_path: Path) -> None:
    judgement = judged(A2L.read_text(encoding="utf-8"), tmp_path)

    assert judgement.returncode == 0, judgement.stdout + judgement.stderr


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("COMPU_TAB_REF label.table", "COMPU_TAB_REF nowhere"),
        ("VALUE 0x0 f32", "VALUE f32"),
        ("/end MODULE", ""),
    ],
)
def test_that_parser_would_find_one(tmp_path: Path, right: str, wrong: str) -> None:
    text = A2L.read_text(encoding="utf-8")
    assert right in text

    assert judged(text.replace(right, wrong, 1), tmp_path).returncode != 0


def elements(described: list[Block], block: Block, image: bytes) -> list[Any]:
    """The values of a characteristic in an image, by what the description says alone."""
    _, _, kind, address, layout, _, method = block.words[:7]
    layouts = {one.name: one.words[3] for one in described if one.kind == "RECORD_LAYOUT"}
    code = CODES[layouts[layout]]
    if kind == "ASCII":
        size = int(block.after("NUMBER")[0])
        return [image[int(address, 16) :][:size].split(b"\0")[0].decode()]
    count = 1
    if kind == "VAL_BLK":
        sizes = block.words[block.words.index("MATRIX_DIM") + 1 :]
        for size_text in (word for word in sizes if word.isdecimal()):
            count *= int(size_text)
    values = list(struct.unpack_from(f"<{count}{code}", image, int(address, 16)))
    tables = {one.name: one.words[4:] for one in described if one.kind == "COMPU_VTAB"}
    if f"{method}.table" not in tables:
        return values
    names = dict(zip(*[iter(tables[f"{method}.table"])] * 2, strict=True))
    return [word_of(names[str(value)]) for value in values]


def flat(value: Any) -> list[Any]:
    return [one for item in value for one in flat(item)] if isinstance(value, list) else [value]


NAN = float("nan")
"""What a value that is none reads as."""

CHANGED = {
    "fuzzy_rules": [["NB", "NS", "ZO", "PS", "PB"]] * 4 + [["PB", "PS", "ZO", "NS", "NB"]],
    "mode_names": ["a", "bb", "ccc", "dddd", "eeeee"],
    "fuzzy_inference": "weighted_average",
    "pedal_stop_ms": 321,
    "sensor_reference_degc": 21.5,
    "calibrated_at_utc_s": 0xF0E1D2C3,
    "calibration_certificate": [1, 2, 3, 250, 251, 252, 253, 254],
}


@pytest.mark.parametrize("changes", [{}, CHANGED], ids=["factory", "changed"])
def test_every_parameter_is_read_from_its_address(
    described: list[Block], changes: dict[str, Any]
) -> None:
    config = default_config() | changes
    image = pack_image(config)
    blocks_by_name: dict[str, list[Block]] = {}
    for block in described:
        if block.kind == "CHARACTERISTIC":
            blocks_by_name.setdefault(block.name.partition("[")[0], []).append(block)

    assert list(blocks_by_name) == [row.name for row in PARAMETERS]
    for name, found in blocks_by_name.items():
        read = [value for block in found for value in elements(described, block, image)]
        there = [NAN if value is None else value for value in flat(config[name])]
        assert read == pytest.approx(there, nan_ok=True), name


def test_every_byte_of_the_image_is_described_once_with_its_limits(
    described: list[Block],
) -> None:
    found = [block for block in described if block.kind == "CHARACTERISTIC"]
    ends = [int(block.words[3], 16) for block in found[1:]] + [IMAGE_LENGTH]
    for block, end in zip(found, ends, strict=True):
        row = next(row for row in PARAMETERS if row.name == block.name.partition("[")[0])
        size = row.length if row.type == "text" else row.size
        assert int(block.words[3], 16) + size == end, block.name
        if row.min is not None:
            assert [float(word) for word in block.words[7:9]] == [row.min, row.max]
        assert ("READ_ONLY" in block.words) == (row.access == FACTORY)


def test_every_channel_of_a_row_is_read_from_its_address(described: list[Block]) -> None:
    counts = [7 * at - 31 for at in range(len(CHANNELS))]
    row = struct.pack(f"<{len(counts)}h", *counts)
    methods = {one.name: one for one in described if one.kind == "COMPU_METHOD"}
    read = {}
    for block in described:
        if block.kind == "MEASUREMENT" and "." not in block.name:
            at = int(block.after("ECU_ADDRESS")[0], 16) - LIVE_ROW
            (count,) = struct.unpack_from("<" + CODES[block.words[2]], row, at)
            scale, offset = methods[block.words[3]].after("COEFFS_LINEAR", 2)
            read[block.name] = count * float(scale) + float(offset)

    assert read == pytest.approx(values_of(0, row).channels)


def test_a_flag_is_a_bit_of_its_channel(described: list[Block]) -> None:
    masks = {
        block.name.partition(".")[2]: int(block.after("BIT_MASK")[0], 16)
        for block in described
        if block.kind == "MEASUREMENT" and block.name.startswith("limit_flags.")
    }

    assert masks == {flag.name: flag.value for flag in LimitFlags if flag.value < 1 << 15}


def test_the_description_says_which_schema_it_is_of(described: list[Block]) -> None:
    assert f'EPK "{SCHEMA_HASH.hex()}"' in A2L.read_text(encoding="utf-8")
