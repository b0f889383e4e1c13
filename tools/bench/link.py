"""How sound and cheap the link is: damage that gets through, frames lost beside a fault, a rival.

Damage is drawn by a seeded generator and goes through the unit's own C decoder in bulk, and through
the host's decoder for the faults beside.
"""

import json
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from backend.device.ebl.session.stream_receiver import StreamPlan
from firmware_protocol import framing
from firmware_protocol._generated import CHANNELS, MTU
from firmware_protocol.codec import Stream, decode, decode_stream, encode
from firmware_protocol.framing import encode_frame
from sim_device.firmware.python import wire
from sim_device.lockstep import LockstepUnit
from tests.fakes.bench import Bench
from tests.fakes.simulated_unit import LockstepAsUnit
from tools.bench.figures import Figure, best_of

HERE = Path(__file__).resolve().parent
RIVALS = HERE.parents[1] / ".make" / "rivals-venv" / "bin" / "python"
# A little more than ten million, because a few of them are flipped back to what they were.
DAMAGED_FRAMES = 10_100_000
BATCH = 100_000
FRAME_BYTES = 36
FAULTY_FRAMES = 50_000
RIVAL_FRAMES = 4_000
LINE_BYTES_PER_S = 100_000
BLOCK_S = 0.020
SECONDS = 30
# As many as a frame holds; 24 bytes are its head and check.
ROWS = (MTU - 24) // (2 * len(CHANNELS))

Bytes = npt.NDArray[np.uint8]


def run() -> list[Figure]:
    return [undetected(), *fault_neighbours(), against_pymavlink(), host_cpu()]


def undetected() -> Figure:
    """Frames heard that nobody sent, out of ten million with 1 to 8 flipped bits each."""
    random = np.random.default_rng(5)
    decoder = wire.FrameDecoder()
    wrong = damaged = 0
    for _ in range(DAMAGED_FRAMES // BATCH):
        body = random.integers(1, 256, (1000, FRAME_BYTES), dtype=np.uint8)
        frames = [row.tobytes() for row in body]
        encoded = np.frombuffer(b"".join(map(encode_frame, frames)), dtype=np.uint8)
        line = np.tile(encoded.reshape(len(frames), -1), (BATCH // len(frames), 1))
        for flip in range(8):
            hit = np.flatnonzero(random.random(BATCH) < 1.0 / (1 + flip))
            # Between the delimiters, where damage is damage to this frame.
            at = random.integers(1, line.shape[1] - 1, len(hit))
            line[hit, at] ^= (1 << random.integers(0, 8, len(hit))).astype(np.uint8)
        same = (line == np.tile(encoded.reshape(len(frames), -1), (BATCH // len(frames), 1))).all(1)
        damaged += BATCH - int(same.sum())
        sent = set(frames)
        wrong += sum(frame not in sent for frame in decoder.feed(line.tobytes()))
    return Figure(
        "damaged frames that were believed", f"{wrong} of {damaged:,}", "0", wrong == 0,
        "1 to 8 flipped bits a frame, the unit's decoder",
    )  # fmt: skip


def fault_neighbours() -> list[Figure]:
    """Frames lost beyond the faulty one, for each fault in every tenth frame."""
    faults: dict[str, Callable[[bytes, int], bytes]] = {
        "a flipped bit": lambda data, at: data[:at] + bytes([data[at] ^ 4]) + data[at + 1 :],
        "a lost byte": lambda data, at: data[:at] + data[at + 1 :],
        "a doubled byte": lambda data, at: data[: at + 1] + data[at:],
        "a byte become zero": lambda data, at: data[:at] + b"\0" + data[at + 1 :],
        "an end cut off": lambda data, at: data[:at],
    }
    figures = []
    for name, harm in faults.items():
        random = np.random.default_rng(7)
        line, harmed = bytearray(), 0
        for index in range(FAULTY_FRAMES):
            size = int(random.integers(8, 200))
            data = encode_frame(random.integers(0, 256, size, dtype=np.uint8).tobytes())
            if index % 10 == 5:
                harmed += 1
                data = harm(data, int(random.integers(1, len(data) - 1)))
            line += data
        lost = {
            side: FAULTY_FRAMES - harmed - len(decoder.feed(bytes(line)))
            for side, decoder in (("C", wire.FrameDecoder()), ("Python", framing.FrameDecoder()))
        }
        figures.append(
            Figure(
                f"frames lost beside {name}", str(max(lost.values())), "0", not any(lost.values()),
                f"{harmed:,} faults in {FAULTY_FRAMES:,} frames, C and Python",
            )
        )  # fmt: skip
    return figures


def stream_wire(count: int, epoch: int, first: int) -> list[bytes]:
    """Full stream frames, one after the other."""
    random = np.random.default_rng(3)
    values = random.integers(-20_000, 20_000, (ROWS, len(CHANNELS)), dtype=np.int16)
    period_us = ROWS * 10_000
    return [
        encode_frame(encode(Stream(1, (first + at) % 65536, at * period_us % 2**32, epoch, values)))
        for at in range(count)
    ]


def against_pymavlink() -> Figure:
    """Samples decoded a second, ours and theirs, in the same run."""
    frames = 4_000
    line = b"".join(stream_wire(frames, 1, 0))

    def read() -> None:
        decoder = framing.FrameDecoder()
        heard = 0
        for at in range(0, len(line), 4096):
            for frame in decoder.feed(line[at : at + 4096]):
                decode_stream(frame, len(CHANNELS))
                heard += 1
        assert heard == frames

    ours = frames * ROWS * len(CHANNELS) / best_of(9, read)
    script = [RIVALS, HERE / "mavlink.py", str(RIVAL_FRAMES)]
    answer = subprocess.run(script, capture_output=True, text=True, check=True).stdout
    theirs = json.loads(answer)["samples_per_s"]
    return Figure(
        "times the samples a second of pymavlink", f"{ours / theirs:,.0f}", ">= 5",
        ours / theirs >= 5,
        f"{ours / 1e6:.1f} M against {theirs / 1e6:.2f} M samples/s",
    )  # fmt: skip


def host_cpu() -> Figure:
    """Part of a core that a session takes on a line that is full at 1 Mbaud."""
    unit = LockstepAsUnit(LockstepUnit(seed=1))
    bench = Bench(unit, StreamPlan(batch=ROWS)).connect()
    bench.run(1.0)
    session = bench.session
    receiver = session._subscription._receiver
    assert receiver is not None
    one = stream_wire(1, 0, 0)[0]
    count = int(SECONDS * LINE_BYTES_PER_S / len(one))
    frames = stream_wire(count, receiver._wire_epoch, receiver._next_sequence)
    per_read = round(LINE_BYTES_PER_S * BLOCK_S / len(one))
    before = session.link_statistics().stream_rows
    answers, busy_s = b"", 0.0
    for index, at in enumerate(range(0, count, per_read)):
        now_s = bench.now_s + (index + 1) * BLOCK_S
        data = answers + b"".join(frames[at : at + per_read])
        start = time.process_time()
        session.receive(data, now_s)
        session.tick(now_s)
        asked = session.bytes_to_send()
        session.next_events()
        busy_s += time.process_time() - start
        unit.receive(asked)
        unit.advance(BLOCK_S)
        # The unit's rows are replaced by those of the full line; its answers are not.
        answers = answers_of(unit.transmit())
    rows = session.link_statistics().stream_rows - before
    seconds = count * len(one) / LINE_BYTES_PER_S
    part = 100.0 * busy_s / seconds
    return Figure(
        "host CPU of a session on a full line of 1 Mbaud", f"{part:.2f} % of a core", "<= 3 %",
        part <= 3.0 and rows == count * ROWS,
        f"{rows / seconds:,.0f} rows of {len(CHANNELS)} channels a second, 20 ms a read",
    )  # fmt: skip


def answers_of(received: bytes) -> bytes:
    """What the unit said, without its stream."""
    frames = framing.FrameDecoder().feed(received)
    return b"".join(encode_frame(f) for f in frames if not isinstance(decode(f), Stream))
