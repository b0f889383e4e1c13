"""Goal: the words of `spindle api` are the request that they look like, and a wrong one is named.

Method: words in, query and body out; no server.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.cli.api import fields_of, header
from backend.errors import InvalidRequest


def test_values_are_json_or_text_and_dots_are_members(tmp_path: Path) -> None:
    # A comment of MATLAB on Windows: no UTF-8.
    fis = tmp_path / "table.fis"
    fis.write_bytes(b"% Stra\xdfe\n[System]")

    query, body = fields_of(
        ["a.b=1", "a.c=no json", "d=[1, 2]", f"text=@{fis}", "formats==csv", "formats==fit"], True
    )

    assert body["a"] == {"b": 1, "c": "no json"}
    assert body["d"] == [1, 2]
    assert body["text"].endswith("e\n[System]")
    assert query == [("formats", "csv"), ("formats", "fit")]
    assert fields_of(["limit=5"], False) == ([("limit", "5")], {})


@pytest.mark.parametrize("words", [["novalue"], ["=1"], ["a=1", "a.b=2"], ["a=@no-such-file"]])
def test_a_word_that_is_no_field_is_named(words: list[str]) -> None:
    with pytest.raises(InvalidRequest, match=r"novalue|=1|a\.b=2|no-such-file"):
        fields_of(words, True)


def test_a_header_has_a_name_and_a_value() -> None:
    assert header('if-match: "7:x"') == ("if-match", '"7:x"')
    with pytest.raises(InvalidRequest, match="name: value"):
        header("if-match")
