"""Files are read in child processes with limits on time and memory, never in the server.

A child reads one file after the other: starting one costs more than reading most files does. The
limits are of each file. A file that kills its reader is refused with the reason, and the next file
gets a new child.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from backend.formats.answer import decode
from backend.formats.containers.archive import BrokenArchive, Entry, Left
from backend.formats.containers.frames import decode_frame
from backend.formats.formats import SNIFFED_BYTES, refused_by_head
from backend.formats.outcome import TOO_SLOW, Outcome, rejected
from backend.formats.questions import TableAnswer, answer_to_json
from backend.formats.worker import (
    CPU_S,
    DATA_BYTES,
    FRAME,
    MORE,
    NO_CALLER,
    OUT_OF_MEMORY,
    OVERTIME,
    WORN,
)

ROOT = Path(__file__).resolve().parents[2]
WORKER = (sys.executable, "-m", "backend.formats.worker")
# CPU time is what the child's own limit counts; the wall clock also covers a stuck disk.
WALL_S = 3 * CPU_S
# Computing for all files of an archive: 4 GB are inflated in about 20 s.
UNPACK_CPU_S = 3 * CPU_S
STDERR_SHOWN = 300
# An answer holds the rows of a file: more than its reader may hold in memory is none.
ANSWER_BYTES_MAX = DATA_BYTES
# Children that wait for the next file; each holds about 60 MB.
WAITING_MAX = 2


class ReadingStopped(Exception):
    """Spindle stops: the file was not read to its end, and nothing is known of it."""


class Child:
    """One process that reads files, asked by one thread at a time."""

    def __init__(self, command: tuple[str, ...]) -> None:
        # One thread: a pool of them would count against the memory limit without being used.
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
        self.process = subprocess.Popen(
            command,
            cwd=ROOT,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            # Ctrl-C in a terminal is meant for the server: a child that died of it would look
            # like one that its file killed.
            start_new_session=True,
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        )
        self._stderr_lines: deque[bytes] = deque(maxlen=50)
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()
        self.worn = False
        self.late = False
        self.has_more = False

    def send(self, request: dict[str, object], wall_s: float) -> bytes | None:
        """The answer, or its first part; as `more`."""
        assert self.process.stdin is not None
        # What it did not take, it has no answer to either.
        with suppress(OSError):
            self.process.stdin.write(json.dumps(request).encode() + b"\n")
            self.process.stdin.flush()
        return self.more(wall_s)

    def more(self, wall_s: float) -> bytes | None:
        """The next answer; None when the child died of it, or was ended after `wall_s`."""
        watch = threading.Timer(wall_s, self._end_late)
        watch.daemon = True
        watch.start()
        try:
            answer = self._received()
        finally:
            watch.cancel()
        return None if self.late else answer

    def end(self) -> int:
        """End it if it lives, and let go of its pipes; how it ended."""
        self.process.kill()
        code = self.process.wait()
        self._listener.join()
        for pipe in (self.process.stdin, self.process.stdout, self.process.stderr):
            # What was not sent any more is nobody's loss.
            with suppress(OSError):
                pipe.close() if pipe else None
        return code

    @property
    def last_words(self) -> str:
        """The end of what it wrote to standard error."""
        return b"".join(self._stderr_lines).decode(errors="replace").strip()

    def _received(self) -> bytes | None:
        answers = self.process.stdout
        assert answers is not None
        head = answers.read(FRAME.size)
        if len(head) < FRAME.size:
            self._wait_dead()
            return None
        length, flags = FRAME.unpack(head)
        self.has_more = bool(flags & MORE)
        answer = answers.read(length) if length <= ANSWER_BYTES_MAX else b""
        self.worn = bool(flags & WORN) or len(answer) < length
        return answer

    def _wait_dead(self) -> None:
        """A closed pipe is the child's end, which the system tells a moment later."""
        with suppress(subprocess.TimeoutExpired):
            self.process.wait(5)

    def _end_late(self) -> None:
        self.late = True
        self.process.kill()

    def _listen(self) -> None:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self._stderr_lines.append(line)


class Readers:
    """Children that read, and those that wait for the next file; safe from any thread.

    waiting_max: how many are kept when nothing is to be read. command: what a child runs.
    """

    def __init__(self, waiting_max: int = WAITING_MAX, command: tuple[str, ...] = WORKER) -> None:
        self._lock = threading.Lock()
        self._waiting_max = waiting_max
        self._command = command
        self._waiting: list[Child] = []
        self._busy: set[Child] = set()
        self._stopped = False
        self.begun = 0

    def read(
        self,
        path: Path,
        name: str,
        wall_s: float = WALL_S,
        cpu_s: float = CPU_S,
        table_answer: TableAnswer | None = None,
    ) -> Outcome:
        """A file -> what came of it; the death of its reader is an outcome too.

        path: where the bytes are. name: what the file was called, which may decide the format.
        wall_s, cpu_s: how long a child may take, and compute. table_answer: as of `read_file`.
        Raises ReadingStopped after `stop`.
        """
        if path.is_file() and (refused := refused_here(path, name)) is not None:
            return refused
        request: dict[str, object] = {
            "path": str(path),
            "name": printable(name),
            "cpu_s": cpu_s,
            "said": answer_to_json(table_answer) if table_answer else None,
        }
        while True:
            child = self._taken()
            try:
                answer = child.send(request, wall_s)
            except BaseException:
                self._lost(child)
                raise
            if answer is not None:
                self._return_child(child)
                return decode(answer)
            code = self._lost(child)
            if code != NO_CALLER:
                return death_outcome(child, code, wall_s, cpu_s)

    def unpack(self, path: Path, wall_s: float = WALL_S) -> Iterator[Entry | Left]:
        """The files of an archive, one at a time, as whoever asks takes them; then what is left.

        wall_s: how long the child may take for each. Raises BrokenArchive when nothing more can be
        read, also for the death of the child; ReadingStopped.
        """
        request: dict[str, object] = {"path": str(path), "unpack": True, "cpu_s": UNPACK_CPU_S}
        child = self._taken()
        is_complete = False
        try:
            frame = child.send(request, wall_s)
            while frame is not None:
                is_complete = not child.has_more
                yield decode_frame(frame)
                if is_complete:
                    return
                frame = child.more(wall_s)
        finally:
            if is_complete:
                self._return_child(child)
            else:
                code = self._lost(child)
        if code == NO_CALLER:
            yield from self.unpack(path, wall_s)
        else:
            raise BrokenArchive(death_outcome(child, code, wall_s, UNPACK_CPU_S))

    def stop(self) -> None:
        """End every child, and begin no other."""
        with self._lock:
            self._stopped = True
            for child in self._busy:
                child.process.kill()
            waiting, self._waiting = self._waiting, []
        for child in waiting:
            child.end()

    def _taken(self) -> Child:
        with self._lock:
            self._check()
            while self._waiting:
                child = self._waiting.pop()
                if child.process.poll() is None:
                    break
                child.end()
            else:
                child = Child(self._command)
                self.begun += 1
            self._busy.add(child)
            return child

    def _return_child(self, child: Child) -> None:
        with self._lock:
            self._busy.discard(child)
            keeps = not (self._stopped or child.worn or len(self._waiting) >= self._waiting_max)
            if keeps:
                self._waiting.append(child)
        if not keeps:
            child.end()

    def _lost(self, child: Child) -> int:
        code = child.end()
        with self._lock:
            self._busy.discard(child)
            self._check()
        return code

    def _check(self) -> None:
        if self._stopped:
            raise ReadingStopped


def refused_here(path: Path, name: str) -> Outcome | None:
    """Why a file is no ride, where its first bytes say so: no child need be asked."""
    with path.open("rb") as file:
        head = file.read(SNIFFED_BYTES)
    return refused_by_head(name, head) if head else None


def read_in_child(
    path: Path,
    name: str,
    wall_s: float = WALL_S,
    cpu_s: float = CPU_S,
    table_answer: TableAnswer | None = None,
) -> Outcome:
    """As `Readers.read`, by a child of its own that ends with it."""
    readers = Readers(waiting_max=0)
    return readers.read(path, name, wall_s, cpu_s, table_answer)


def death_outcome(child: Child, code: int, wall_s: float, cpu_s: float) -> Outcome:
    """Why a file has no answer, as an outcome."""
    if child.late:
        return rejected(TOO_SLOW, f"Reading took longer than {wall_s:g} s and was stopped.")
    if OVERTIME and code == -OVERTIME:
        return rejected(TOO_SLOW, f"Reading took more than {cpu_s:g} s of computing; stopped.")
    if code == OUT_OF_MEMORY or "memory allocation" in child.last_words:
        return rejected(
            "too_much_memory", f"Reading needed more than {DATA_BYTES >> 20} MB; stopped."
        )
    stderr_text = child.last_words[-STDERR_SHOWN:]
    return rejected("parser_crashed", f"The reader died ({code}). {stderr_text}".strip())


def printable(name: str) -> str:
    """A file name that can stand on a line of text."""
    return "".join(c if c.isprintable() else "_" for c in name)[-200:] or "file"
