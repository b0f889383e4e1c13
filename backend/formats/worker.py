"""The child process that reads files, one after the other. What it dies of, the server survives.

    python -m backend.formats.worker
A request is a line of JSON on standard input, {"path": ..., "name": ..., "cpu_s": ..., "said": what
was said of a table}. An answer on standard output is its length as u64, WORN and MORE as u8, and
the bytes of `answer.encode`; for a request with "unpack" it is a frame for each file within the
archive, as `containers.frames` has them, all but the last with MORE. A worn child ends. Exit 3: out
of memory; 4: no request for a long time.
"""

from __future__ import annotations

import json
import os
import select
import signal
import struct
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

CPU_S = 20.0
DATA_BYTES = 512 * 1024 * 1024
OUT_OF_MEMORY = 3
NO_CALLER = 4
# A child holds about 60 MB: it is given back when no files come, and begun anew with the next.
IDLE_S = 300.0
# What was once allocated may never come back to the system: the next large file would fail for it.
WORN_BYTES = DATA_BYTES // 2
FILES_MAX = 500
FRAME = struct.Struct("<QB")
WORN, MORE = 1, 2
# Signal by which the system ends a child that has used its time on a file.
OVERTIME = getattr(signal, "SIGPROF", 0)


def end_with_the_server() -> None:
    """End as soon as nobody can take the answer any more, whatever is being read."""
    if not hasattr(select, "poll"):
        return
    reader = select.poll()
    # No event is subscribed to: the closing of the other end is reported all the same.
    reader.register(sys.stdout.fileno(), 0)

    def watch() -> None:
        reader.poll()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def limit_resources() -> None:
    """Memory, no files written, no core dumps. A limit the system lacks is left out."""
    try:
        import resource
    except ImportError:
        return
    for limit, value in (
        (resource.RLIMIT_DATA, DATA_BYTES),
        (resource.RLIMIT_FSIZE, 0),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(limit)[1]
        soft = value if hard == resource.RLIM_INFINITY else min(value, hard)
        resource.setrlimit(limit, (soft, hard))


def limit_time(cpu_s: float) -> None:
    """End this process after so much computing from now on; 0 for as long as it likes.

    The system does it: nothing that is being read can keep it from happening.
    """
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, cpu_s)


def is_worn() -> bool:
    """Whether the most memory this process ever held is so much that the next file may fail.

    Not by getrusage: what it tells after a start is what the server held. False where only that is.
    """
    try:
        status = Path("/proc/self/status").read_text()
    except OSError:
        return False
    peaks_kb = [line.split()[1] for line in status.splitlines() if line.startswith("VmHWM:")]
    return any(int(peak_kb) * 1024 > WORN_BYTES for peak_kb in peaks_kb)


def requests() -> bool:
    """Whether another request comes; False after a long time without, if the system can tell."""
    if not hasattr(select, "poll"):
        return True
    poll = select.poll()
    poll.register(sys.stdin.fileno(), select.POLLIN)
    return bool(poll.poll(IDLE_S * 1000))


def answers(request: dict[str, Any]) -> Iterator[tuple[tuple[bytes, ...], bool]]:
    """What a request is answered with, in pieces, and whether it is the last: one answer for a
    file, one a file for an archive."""
    from backend.formats.answer import encode
    from backend.formats.containers.frames import frames
    from backend.formats.formats import read_file
    from backend.formats.questions import answer_from_json

    path = Path(request["path"])
    if request.get("unpack"):
        yield from frames(path)
    else:
        answer = answer_from_json(request.get("said"))
        yield (encode(read_file(request["name"], path.read_bytes(), answer)),), True


def say(answer: tuple[bytes, ...], flags: int) -> None:
    """Write one answer."""
    sys.stdout.buffer.write(FRAME.pack(sum(map(len, answer)), flags))
    for piece in answer:
        sys.stdout.buffer.write(piece)
    sys.stdout.buffer.flush()


def main() -> int:
    """Read files and answer until nobody asks."""
    limit_resources()
    end_with_the_server()
    import backend.formats.formats  # noqa: F401 - while nobody waits for it

    for number in range(1, FILES_MAX + 1):
        if not requests():
            return NO_CALLER
        line = sys.stdin.buffer.readline()
        if not line:
            return 0
        request = json.loads(line)
        limit_time(request["cpu_s"])
        try:
            for answer, last in answers(request):
                if not last:
                    say(answer, MORE)
                    continue
                limit_time(0)
                worn = number == FILES_MAX or is_worn()
                say(answer, WORN if worn else 0)
                if worn:
                    return 0
        except MemoryError:
            return OUT_OF_MEMORY
    return 0


if __name__ == "__main__":
    sys.exit(main())
