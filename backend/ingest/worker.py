"""The child process that reads one file. What it dies of, the server survives.

    python -m backend.ingest.worker PATH NAME
The answer goes to standard output: u32 header length, header JSON, then the arrays one after the
other as the header's order tells. Exit 0 with an answer, 3 out of memory.
"""

from __future__ import annotations

import json
import os
import select
import struct
import sys
import threading
from dataclasses import asdict
from pathlib import Path

from backend.domain.channels import channel_to_json
from backend.domain.noted import noted_to_json
from backend.ingest.outcome import Outcome

CPU_S = 20
DATA_BYTES = 512 * 1024 * 1024
OUT_OF_MEMORY = 3


def end_with_the_server() -> None:
    """End as soon as nobody can take the answer any more, whatever is being read."""
    if not hasattr(select, "poll"):
        return
    reader = select.poll()
    # Nothing is asked for: that the other end is closed is told all the same.
    reader.register(sys.stdout.fileno(), 0)

    def watch() -> None:
        reader.poll()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def limit_resources() -> None:
    """CPU, memory, no files written, no core dumps. A limit the system lacks is left out."""
    try:
        import resource
    except ImportError:
        return
    for limit, value in (
        (resource.RLIMIT_CPU, CPU_S),
        (resource.RLIMIT_DATA, DATA_BYTES),
        (resource.RLIMIT_FSIZE, 0),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(limit)[1]
        soft = value if hard == resource.RLIM_INFINITY else min(value, hard)
        resource.setrlimit(limit, (soft, hard))


def encode(outcome: Outcome) -> bytes:
    """An outcome as bytes, the inverse of `sandbox.decode`."""
    arrays: list[bytes] = []
    rides = []
    for ride in outcome.rides:
        arrays.append(ride.rows.times_us.astype("<i8").tobytes())
        for channel in ride.rows.channels:
            counts = ride.rows.counts[channel.name]
            arrays.append(counts.astype(counts.dtype.newbyteorder("<")).tobytes())
        rides.append(
            {
                "started_us": ride.started_us,
                "period_us": ride.period_us,
                "sport": ride.sport,
                "notes": ride.notes,
                "context": asdict(ride.context),
                "start_known": ride.start_known,
                "events": [asdict(event) for event in ride.events],
                "intake": None if ride.intake is None else asdict(ride.intake),
                "noted": noted_to_json(ride.noted),
                "rows": len(ride.rows.times_us),
                "channels": [channel_to_json(channel) for channel in ride.rows.channels],
            }
        )
    facts = {key: value for key, value in asdict(_bare(outcome)).items() if key != "rides"}
    header = json.dumps({**facts, "rides": rides}).encode()
    return struct.pack("<I", len(header)) + header + b"".join(arrays)


def _bare(outcome: Outcome) -> Outcome:
    return Outcome(
        outcome.state, (), outcome.code, outcome.detail, outcome.offset, outcome.completeness
    )


def main(arguments: list[str]) -> int:
    """Read the file and answer."""
    path, name = arguments
    limit_resources()
    end_with_the_server()
    from backend.ingest.formats import read_file

    try:
        answer = encode(read_file(name, Path(path).read_bytes()))
    except MemoryError:
        return OUT_OF_MEMORY
    sys.stdout.buffer.write(answer)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
