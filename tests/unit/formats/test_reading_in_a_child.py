"""Goal: whatever a file does to its reader, the server gets an answer.

Method: the real child process, on sound, hostile and expensive files.
"""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from backend.formats import COMPLETE, REJECTED, Readers, ReadingStopped, read_in_child
from backend.formats.answer import decode, encode
from backend.formats.formats import read_file
from backend.formats.outcome import Outcome
from backend.formats.sandbox import ROOT
from tests.fakes.fit_file import commute, definition, enclosed, fit_file

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow


def test_the_child_s_answer_is_what_reading_here_gives(tmp_path: Path) -> None:
    data = fit_file(commute(120))
    path = tmp_path / "object"
    path.write_bytes(data)

    there, here = read_in_child(path, "ride.fit"), read_file("ride.fit", data)

    assert there.state == COMPLETE
    (mine,), (its,) = here.rides, there.rides
    assert its.started_us == mine.started_us
    assert its.rows.channels == mine.rows.channels
    assert its.rows.times_us.tolist() == mine.rows.times_us.tolist()
    for name, counts in mine.rows.counts.items():
        assert its.rows.counts[name].tolist() == counts.tolist()


def test_an_answer_that_was_cut_is_a_refusal_and_not_a_crash() -> None:
    answer = encode(read_file("ride.fit", fit_file(commute(20))))

    outcomes = [decode(answer[:length]) for length in range(0, len(answer), 37)]

    assert {outcome.code for outcome in outcomes} == {"parser_crashed"}


@pytest.mark.long
def test_a_million_empty_messages_end_in_an_answer(tmp_path: Path) -> None:
    path = tmp_path / "object"
    path.write_bytes(enclosed(definition(0, 20, []) + bytes(1_000_000)))

    outcome = read_in_child(path, "bomb.fit")

    assert outcome.state == REJECTED


def test_reading_that_takes_too_long_is_stopped_with_the_reason(
    tmp_path: Path,
) -> None:
    path = tmp_path / "object"
    path.write_bytes(fit_file(commute(20)))

    assert read_in_child(path, "ride.fit", wall_s=0.001).code == "too_slow"


def test_a_name_can_be_anything(tmp_path: Path) -> None:
    path = tmp_path / "object"
    path.write_bytes(fit_file(commute(20)))

    for name in ("", "--help", "a\nb\x00c.fit", "=cmd|' /C calc'!A0.fit", "\u202egpj.tif"):
        assert read_in_child(path, name).state == COMPLETE


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs a file that its reader waits for")
def test_a_stop_ends_a_child_at_its_work_and_begins_no_other(tmp_path: Path) -> None:
    path = tmp_path / "object"
    os.mkfifo(path)
    readers = Readers()
    with ThreadPoolExecutor(1) as server:
        reading = server.submit(readers.read, path, "ride.fit")
        # Opens as soon as the child does, which then waits for bytes.
        with path.open("wb"):
            readers.stop()

            with pytest.raises(ReadingStopped):
                reading.result()
    with pytest.raises(ReadingStopped):
        readers.read(path, "ride.fit")


# What a file does to its reader, by its name: the real child, with this instead of its formats.
DOINGS = """
import os, sys, time
import backend.formats.formats as formats
from backend.formats import worker
from backend.formats.outcome import rejected
held = []
def read_file(name, data, said):
    what, _, amount = name.partition(" ")
    if what == "computes":
        ends_s = time.process_time() + float(amount)
        while time.process_time() < ends_s: pass
    if what == "dies": os._exit(int(amount))
    if what == "sleeps": time.sleep(float(amount))
    if what == "holds": held.append(b"x" * (int(amount) << 20)); del held[:]
    if what == "writes": open(sys.argv[0] + "/new", "wb").write(b"x")
    return rejected("unknown_format", f"{os.getpid()} {os.getpgrp()}")
formats.read_file = read_file
sys.exit(worker.main())
"""


class Desk:
    """Readers whose files are called by what they do."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "object"
        self.path.write_bytes(fit_file(commute(1)))
        self.readers = Readers(command=(sys.executable, "-c", DOINGS))

    def read(self, does: str = "nothing", wall_s: float = 60.0, cpu_s: float = 20.0) -> Outcome:
        return self.readers.read(self.path, does, wall_s, cpu_s)

    def reader_of(self, does: str = "nothing") -> int:
        return int(str(self.read(does).detail).split()[0])


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    opened = Desk(tmp_path)
    yield opened
    opened.readers.stop()


def test_what_is_no_ride_costs_no_child(desk: Desk) -> None:
    desk.path.write_bytes(b"\x7fELF" + bytes(100))

    assert (desk.read().code, desk.readers.begun) == ("unsupported_format", 0)


def test_one_child_reads_one_file_after_the_other(desk: Desk) -> None:
    assert len({desk.reader_of() for _ in range(20)}) == 1


@pytest.mark.skipif(not hasattr(os, "getpgrp"), reason="needs process groups")
def test_a_ctrl_c_meant_for_the_server_does_not_reach_a_child(desk: Desk) -> None:
    assert int(str(desk.read().detail).split()[1]) != os.getpgrp()


@pytest.mark.parametrize(
    ("does", "limits", "code"),
    [
        ("dies 7", {}, "parser_crashed"),
        ("dies 3", {}, "too_much_memory"),
        ("computes 60", {"cpu_s": 0.3}, "too_slow"),
        ("sleeps 60", {"wall_s": 2.0}, "too_slow"),
        ("holds 600", {}, "too_much_memory"),
        ("writes", {}, "parser_crashed"),
    ],
)
def test_a_file_that_kills_its_reader_is_refused_and_the_next_is_read(
    desk: Desk, does: str, limits: dict[str, float], code: str
) -> None:
    first = desk.reader_of()

    assert desk.read(does, **limits).code == code
    assert desk.reader_of() != first
    assert desk.readers.begun == 2


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs a timer of computing")
def test_the_time_to_compute_is_of_each_file_and_not_of_the_child_s_life(desk: Desk) -> None:
    outcomes = [desk.read("computes 0.3", cpu_s=0.6) for _ in range(4)]

    assert {outcome.code for outcome in outcomes} == {"unknown_format"}
    assert desk.readers.begun == 1


def test_a_child_that_held_much_memory_answers_and_makes_room_for_another(desk: Desk) -> None:
    swollen = desk.reader_of("holds 300")

    assert desk.reader_of() != swollen


def test_children_that_wait_are_few_and_end_with_the_stop(desk: Desk) -> None:
    with ThreadPoolExecutor(4) as crowd:
        list(crowd.map(desk.read, ["sleeps 0.5"] * 4))
    waiting = list(desk.readers._waiting)
    desk.readers.stop()

    assert len(waiting) == 2
    assert all(child.process.returncode is not None for child in waiting)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs a file that its reader waits for")
def test_a_child_ends_with_a_server_that_is_killed(tmp_path: Path) -> None:
    path = tmp_path / "object"
    os.mkfifo(path)
    words = (
        f"import pathlib, backend.formats as i; i.read_in_child(pathlib.Path({str(path)!r}), '')"
    )
    server = subprocess.Popen([sys.executable, "-c", words], cwd=ROOT)
    # Opens as soon as the child does, which then waits for bytes for ever.
    with path.open("wb", buffering=0) as file:
        server.kill()
        server.wait()
        reader_gone = select.poll()
        reader_gone.register(file, 0)

        assert reader_gone.poll(30_000)
