"""A desk that takes files in this process: the real store and the real reader, no child."""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.formats.formats import read_file
from backend.formats.outcome import Outcome
from backend.formats.questions import TableAnswer
from backend.imports.mapping import TableMapping
from backend.imports.service import Uploads
from backend.store import Store


def reader(path: Path, name: str, *, table_answer: TableAnswer | None = None) -> Outcome:
    """Reads a file here and now."""
    return read_file(name, path.read_bytes(), table_answer)


@pytest.fixture
def uploads(store: Store) -> Uploads:
    """What takes files."""
    return Uploads(store, reader=reader)


@pytest.fixture
def mapping(store: Store, uploads: Uploads) -> TableMapping:
    """What asks and is answered about tables."""
    return TableMapping(store, uploads)
