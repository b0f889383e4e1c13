"""Goal: a file that eats all its time keeps no other from becoming a ride, and none becomes two.

Method: a reader that the test holds; no times.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from backend.ingest import Outcome
from backend.ingest.formats import read_file
from backend.services.upload import Uploads
from backend.store import Store, open_store
from tests.fakes.fit_file import commute, fit_file

SOUND = fit_file(commute(100))


class HeldReader:
    """Reads at once, but a file called `slow` only when it is let go."""

    def __init__(self) -> None:
        self.begun = threading.Semaphore(0)
        self.let_go = threading.Event()

    def __call__(self, path: Path, name: str) -> Outcome:
        self.begun.release()
        if name.startswith("slow"):
            assert self.let_go.wait(30)
        return read_file("ride.fit", path.read_bytes())


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with open_store(f"sqlite:///{tmp_path}/db", f"file://{tmp_path}/objects") as opened:
        yield opened


def test_while_one_file_is_read_another_becomes_a_ride(store: Store) -> None:
    reader = HeldReader()
    uploads = Uploads(store, reader=reader)
    with ThreadPoolExecutor(1) as client:
        slow = client.submit(uploads.receive_file, "slow.fit", fit_file(commute(50)))
        assert reader.begun.acquire(timeout=30)

        other = uploads.receive_file("other.fit", SOUND)
        waits = not slow.done()
        reader.let_go.set()

    assert waits
    assert (other.state, slow.result().state) == ("complete", "complete")


def test_the_same_bytes_sent_twice_at_once_are_one_ride(store: Store) -> None:
    reader = HeldReader()
    uploads = Uploads(store, reader=reader)
    with ThreadPoolExecutor(2) as clients:
        both = [clients.submit(uploads.receive_file, f"slow {n}.fit", SOUND) for n in range(2)]
        for _ in both:
            assert reader.begun.acquire(timeout=30)
        reader.let_go.set()

    assert sorted(str(sent.result().code) for sent in both) == ["None", "duplicate"]
    assert len(store.rides.list().items) == 1
