"""A fresh store in a folder of its own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from backend.store import Store, open_store
from backend.store.objects import Disk

OpenStore = Callable[..., Store]


def urls(folder: Path, database: str = "spindle.db") -> tuple[str, str]:
    """Of a store's database and of its objects."""
    return f"sqlite:///{folder}/{database}", (folder / "objects").as_uri()


@pytest.fixture
def reopen(tmp_path: Path) -> Iterator[OpenStore]:
    """Opens the same folder, again and again; what is still open at the end is closed."""
    opened: list[Store] = []

    def work(disk: Disk | None = None) -> Store:
        store = open_store(*urls(tmp_path), disk=disk)
        opened.append(store)
        return store

    yield work
    for store in opened:
        store.close()


@pytest.fixture
def store(reopen: OpenStore) -> Store:
    return reopen()
