"""Goal: a file that somebody's editor saved is read whatever mark it begins with, and one that is
none is refused in words."""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.cli.device import read_json
from backend.errors import InvalidRequest


def test_a_byte_order_mark_is_no_part_of_a_file(tmp_path: Path) -> None:
    file = tmp_path / "backup.json"
    file.write_bytes(b'\xef\xbb\xbf{"parameters": {"fuzzy_table_name": "\xe9\x9b\xa8"}}')

    assert read_json(file) == {"parameters": {"fuzzy_table_name": "雨"}}


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"\xff\xfe{\x00}\x00", "backup.json is not UTF-8 text, at byte 0"),
        (b"{", "backup.json is not JSON"),
    ],
)
def test_another_file_is_refused_in_words(tmp_path: Path, content: bytes, says: str) -> None:
    file = tmp_path / "backup.json"
    file.write_bytes(content)

    with pytest.raises(InvalidRequest, match=says):
        read_json(file)
