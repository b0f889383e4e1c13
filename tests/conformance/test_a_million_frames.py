"""Goal: C and Python agree on a million frames, whole and damaged (a tenth of them in `make test`).

Method: seeded random frames in bulk, encoded by both (PyPI cobs and zlib here, the unit's own C
there), damaged once in a while, and decoded by both in the same blocks.
"""

from __future__ import annotations

import numpy as np
import pytest

from firmware_protocol import framing
from sim_device.firmware.python import wire
from tests import counts

pytestmark = [pytest.mark.slow, pytest.mark.large_count]

FRAMES = counts.of(1_000_000)
BATCH = 20_000
# Most frames on the line are short; the long ones decide about runs of 254.
SHORT_MAX, LONG_MAX = 40, 540
DAMAGED_EVERY_BYTES = 4000


def random_frames(random: np.random.Generator, count: int) -> list[bytes]:
    lengths = random.integers(4, SHORT_MAX, count)
    long = random.random(count) < 0.03
    lengths[long] = random.integers(SHORT_MAX, LONG_MAX, int(long.sum()))
    total = int(lengths.sum())
    sparse = random.integers(0, 256, total, dtype=np.uint8)
    sparse[random.random(total) < random.choice([0.0, 0.02, 0.6])] = 0
    data = sparse.tobytes()
    ends = np.cumsum(lengths)
    starts = ends - lengths
    return [data[a:b] for a, b in zip(starts.tolist(), ends.tolist(), strict=True)]


def damaged(random: np.random.Generator, line: bytes) -> bytes:
    harmed = np.frombuffer(line, dtype=np.uint8).copy()
    places = random.integers(0, len(harmed), len(harmed) // DAMAGED_EVERY_BYTES)
    harmed[places] ^= (1 << random.integers(0, 8, len(places))).astype(np.uint8)
    return np.delete(harmed, places[: len(places) // 3]).tobytes()


@pytest.mark.host_build("five minutes of volume")
def test_both_write_and_read_a_million_frames_alike() -> None:
    random = np.random.default_rng(2026)
    host, unit = framing.FrameDecoder(), wire.FrameDecoder()
    heard = sent = 0

    for batch in range(FRAMES // BATCH):
        frames = random_frames(random, BATCH)
        line = b"".join(map(framing.encode_frame, frames))
        assert wire.encode_frames(frames) == line, f"batch {batch}"
        line = damaged(random, line)
        from_host, from_unit = host.feed(line), unit.feed(line)
        assert from_host == from_unit, f"batch {batch}"
        heard += len(from_host)
        sent += len(frames)

    assert host.stats == unit.stats
    assert host.stats.crc_errors > FRAMES // 1000
    assert host.stats.cobs_errors > FRAMES // 1000
    assert 0.9 * sent < heard < sent
