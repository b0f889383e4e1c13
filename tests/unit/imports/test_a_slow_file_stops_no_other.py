"""Goal: a file that eats all its time keeps nothing else waiting, and none becomes two or none.

Method: readers that the test holds and lets go; no times.
"""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from backend.errors import Conflict, NotFound
from backend.formats import Outcome, ReadingStopped
from backend.formats.formats import read_file
from backend.formats.outcome import rejected
from backend.imports.service import WAITS, Uploads
from backend.store import Store, Verdict
from tests.fakes.fit_file import START_S, commute, fit_file

SOUND = fit_file(commute(100))
TOO_SLOW = rejected("too_slow", "It took too long.")


class Counter:
    """How many were inside at once."""

    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.inside = 0
        self.most = 0

    def __enter__(self) -> None:
        with self.lock:
            self.inside += 1
            self.most = max(self.most, self.inside)

    def __exit__(self, *_: object) -> None:
        with self.lock:
            self.inside -= 1


class HeldReader:
    """Reads at once, but a file called `slow` only when it is let go, or never after a stop."""

    def __init__(self, at_once: Counter | None = None) -> None:
        self.begun = threading.Semaphore(0)
        self.let_go = threading.Event()
        self.stopped = False
        self.at_once = at_once or Counter()

    def __call__(self, path: Path, name: str) -> Outcome:
        with self.at_once:
            self.begun.release()
            if name.startswith("slow"):
                assert self.let_go.wait(30)
            if self.stopped:
                raise ReadingStopped
            return read_file("ride.fit", path.read_bytes())

    def stop(self) -> None:
        self.stopped = True
        self.let_go.set()


def impatient(path: Path, name: str) -> Outcome:
    """The quick lane's reader: a file called `slow` needs more time than it has."""
    return TOO_SLOW if name.startswith("slow") else read_file("ride.fit", path.read_bytes())


def arrived(uploads: Uploads, name: str, content: bytes) -> str:
    """An upload whose last byte is here, and for which nobody waits."""
    upload = uploads.begin(name, len(content))
    uploads.add(upload.id, 0, content)
    return upload.id


def rides_of_length(*seconds: int) -> list[bytes]:
    days = range(1, len(seconds) + 1)
    return [
        fit_file(commute(length, START_S + day * 86_400))
        for day, length in zip(days, seconds, strict=True)
    ]


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


def test_files_that_take_long_wait_for_one_another_and_quick_ones_go_on(store: Store) -> None:
    patient = HeldReader()
    uploads = Uploads(store, reader=impatient, slow_reader=patient)
    files = rides_of_length(50, 60, 70, 80)
    with ThreadPoolExecutor(4) as clients:
        slow = [
            clients.submit(uploads.receive_file, f"slow {n}.fit", content)
            for n, content in enumerate(files)
        ]
        assert patient.begun.acquire(timeout=30)

        quick = uploads.receive_file("quick.fit", SOUND)
        waiting = [sent.done() for sent in slow]
        patient.let_go.set()

    assert quick.state == "complete"
    assert not any(waiting)
    assert [sent.result(30).state for sent in slow] == ["complete"] * 4


def test_a_file_that_takes_too_long_in_the_slow_lane_too_is_refused(store: Store) -> None:
    uploads = Uploads(store, reader=impatient, slow_reader=lambda path, name: TOO_SLOW)

    refused = uploads.receive_file("slow.fit", SOUND)

    assert (refused.state, refused.code) == ("rejected", "too_slow")


@pytest.mark.slow
def test_three_files_are_read_at_once_and_no_more(store: Store) -> None:
    at_once = Counter()
    held, patient = HeldReader(at_once), HeldReader(at_once)

    def quick(path: Path, name: str) -> Outcome:
        return TOO_SLOW if "long" in name else held(path, name)

    uploads = Uploads(store, reader=quick, slow_reader=patient)
    files = rides_of_length(*range(20, 28))
    ids = [arrived(uploads, "slow and long.fit", content) for content in files[:4]]
    assert patient.begun.acquire(timeout=30)
    ids += [arrived(uploads, "slow.fit", content) for content in files[4:]]
    for _ in range(2):
        assert held.begun.acquire(timeout=30)

    most = at_once.most
    held.let_go.set()
    patient.let_go.set()
    uploads.recover()
    states = [uploads.get(each).state for each in ids]

    assert most == 3
    assert at_once.most == 3
    assert set(states) == {"complete"}


@pytest.mark.slow
def test_a_stop_ends_the_reading_and_the_next_start_reads_what_waited(store: Store) -> None:
    reader = HeldReader()
    uploads = Uploads(store, reader=reader, stop_readers=reader.stop)
    files = rides_of_length(50, 60, 70, 80)
    with ThreadPoolExecutor(1) as client:
        waited_for = client.submit(uploads.receive_file, "slow.fit", files[0])
        assert reader.begun.acquire(timeout=30)
        ids = [arrived(uploads, f"slow {n}.fit", each) for n, each in enumerate(files[1:])]

        uploads.close()
        late = arrived(uploads, "late.fit", SOUND)

    ids += [waited_for.result().id, late]
    assert {uploads.get(each).state for each in ids} == {"queued"}
    assert waited_for.result().state == "queued"

    read = Uploads(store, reader=lambda path, name: impatient(path, "any")).recover()

    assert sorted(upload.id for upload in read) == sorted(ids)
    assert {upload.state for upload in read} == {"complete"}
    assert len(store.rides.list().items) == 5


def test_one_damaged_file_keeps_no_other_from_being_read_at_a_start(store: Store) -> None:
    stopped = Uploads(store, reader=impatient)
    stopped.close()
    broken, sound = (arrived(stopped, "a.fit", each) for each in rides_of_length(50, 60))
    original = store.objects.local_path(str(stopped.get(broken).object_key))
    original.chmod(0o600)
    original.write_bytes(b"damaged")

    read = Uploads(store, reader=impatient).recover()

    assert [upload.id for upload in read] == [sound]
    assert stopped.get(sound).state == "complete"
    assert stopped.get(broken).state == "queued"


def test_housekeeping_does_not_wait_for_the_files_it_has_looked_at(store: Store) -> None:
    reader = HeldReader()
    stopped = Uploads(store)
    stopped.close()
    upload_id = arrived(stopped, "slow.fit", SOUND)
    store.uploads.conclude(upload_id, Verdict("queued", WAITS))
    uploads = Uploads(store, reader=reader)

    (looking,) = uploads.retry_waiting(1)
    assert reader.begun.acquire(timeout=30)
    (again,) = uploads.retry_waiting(1)
    waits = not looking.done()
    reader.let_go.set()

    assert waits
    assert again is looking
    assert looking.result(30).state == "complete"


def test_a_file_that_waits_for_its_turn_can_be_removed(store: Store) -> None:
    held = HeldReader()
    uploads = Uploads(store, reader=held)
    first, second, third = rides_of_length(50, 60, 70)
    read = [arrived(uploads, "slow.fit", each) for each in (first, second)]
    for _ in read:
        assert held.begun.acquire(timeout=30)
    waiting = uploads.begin("slow too.fit", len(third))
    promise = uploads.add(waiting.id, 0, third).reading
    assert promise is not None

    uploads.remove(waiting.id)
    told = promise.exception(0)
    held.let_go.set()
    uploads.recover()

    assert isinstance(told, NotFound)
    with pytest.raises(NotFound):
        uploads.get(waiting.id)
    assert {uploads.get(each).state for each in read} == {"complete"}


def test_a_file_that_could_not_be_removed_keeps_its_turn(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(token: str, now_us: int, audited: bool) -> None:
        raise Conflict("A ride came from it.", code="has_rides")

    held = HeldReader()
    uploads = Uploads(store, reader=held)
    files = rides_of_length(50, 60, 70)
    ids = [arrived(uploads, "slow.fit", each) for each in files]
    for _ in range(2):
        assert held.begun.acquire(timeout=30)

    monkeypatch.setattr(store.uploads, "remove", refuse)
    with pytest.raises(Conflict):
        uploads.remove(ids[2])
    held.let_go.set()
    uploads.recover()

    assert {uploads.get(each).state for each in ids} == {"complete"}


def test_a_file_that_is_being_read_cannot_be_removed_until_that_is_over(store: Store) -> None:
    held = HeldReader()

    def refusing(path: Path, name: str) -> Outcome:
        held(path, name)
        return rejected("no_records", "Nothing.")

    uploads = Uploads(store, reader=refusing)
    with ThreadPoolExecutor(1) as client:
        sent = client.submit(uploads.receive_file, "slow.fit", SOUND)
        assert held.begun.acquire(timeout=30)
        (upload,) = store.uploads.list()
        with pytest.raises(Conflict, match="is being read") as refused:
            uploads.remove(upload.id)
        held.let_go.set()

    assert refused.value.code == "being_read"
    assert sent.result().state == "rejected"
    uploads.remove(upload.id)
    with pytest.raises(NotFound):
        uploads.get(upload.id)
