"""Goal: whatever a file does to its reader, the server gets an answer.

Method: the real child process, on sound, hostile and expensive files.
"""

from __future__ import annotations

import os
import select
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from backend.ingest import COMPLETE, REJECTED, Children, ReadingStopped, read_in_child
from backend.ingest.formats import read_file
from backend.ingest.sandbox import ROOT, decode
from backend.ingest.worker import encode
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
    children = Children()
    with ThreadPoolExecutor(1) as server:
        reading = server.submit(read_in_child, path, "ride.fit", 60, children)
        # Opens as soon as the child does, which then waits for bytes.
        with path.open("wb"):
            children.stop()

            with pytest.raises(ReadingStopped):
                reading.result()
    with pytest.raises(ReadingStopped):
        read_in_child(path, "ride.fit", children=children)


@pytest.mark.skipif(not hasattr(os, "getpgrp"), reason="needs process groups")
def test_a_ctrl_c_meant_for_the_server_does_not_reach_a_child() -> None:
    told = Children().run([sys.executable, "-c", "import os; print(os.getpgrp())"], 60)

    assert int(told.stdout) != os.getpgrp()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs a file that its reader waits for")
def test_a_child_ends_with_a_server_that_is_killed(tmp_path: Path) -> None:
    path = tmp_path / "object"
    os.mkfifo(path)
    words = f"import pathlib, backend.ingest as i; i.read_in_child(pathlib.Path({str(path)!r}), '')"
    server = subprocess.Popen([sys.executable, "-c", words], cwd=ROOT)
    # Opens as soon as the child does, which then waits for bytes for ever.
    with path.open("wb", buffering=0) as file:
        server.kill()
        server.wait()
        reader_gone = select.poll()
        reader_gone.register(file, 0)

        assert reader_gone.poll(30_000)
