"""Goal: a word of docs/glossary.md is found where the glossary says it lives.

Method: the last column of every row: its files and folders exist, and the names it gives are in one
of them. The words themselves are in order and there once.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
GLOSSARY = ROOT / "docs" / "glossary.md"


def rows() -> list[tuple[str, str]]:
    """Word and place of every row."""
    cells = [line.split("|")[1:-1] for line in GLOSSARY.read_text().splitlines() if line[:1] == "|"]
    return [
        (word.strip(), where.strip())
        for word, _, where in cells
        if word.strip() != "word" and not word.startswith("---")
    ]


def texts(path: Path) -> list[str]:
    files = [path] if path.is_file() else [one for one in path.rglob("*") if one.is_file()]
    return [one.read_text(errors="replace") for one in files if one.suffix not in (".so", ".pyc")]


@pytest.mark.parametrize(("word", "where"), rows(), ids=[word for word, _ in rows()])
def test_a_word_lives_where_the_glossary_says(word: str, where: str) -> None:
    marked = re.findall(r"`([^`]+)`", where)
    paths = [one for one in marked if "/" in one]
    names = [one for one in marked if "/" not in one]

    assert paths, f"{word}: no place is given"
    assert [one for one in paths if not (ROOT / one).exists()] == [], f"{word}: gone"
    found = "\n".join(text for one in paths for text in texts(ROOT / one))
    assert [one for one in names if not re.search(rf"\b{re.escape(one)}\b", found)] == []


def test_words_stand_once_and_in_order_within_their_part() -> None:
    parts = GLOSSARY.read_text().split("\n## ")[1:]

    for part in parts:
        words = re.findall(r"(?m)^\| ([^|]+?) \|", part)[1:]
        assert words == sorted(words, key=str.lower), part.splitlines()[0]
    words = [word for word, _ in rows()]
    assert len(words) == len(set(words))
