"""How fast the host reads the wire: samples decoded a second from a full stream."""

import numpy as np

from firmware_protocol._generated import CHANNELS
from firmware_protocol.codec import Stream, decode_stream, encode
from firmware_protocol.framing import FrameDecoder, encode_frame
from tools.bench.figures import Figure, best_of

FRAMES = 20_000
ROWS = 5
BLOCK_BYTES = 4096


def run() -> list[Figure]:
    random = np.random.default_rng(3)
    width = len(CHANNELS)
    wire = b"".join(
        encode_frame(
            encode(
                Stream(
                    stream_id=1,
                    seq=index & 0xFFFF,
                    t0_us=(index * 50_000) & 0xFFFFFFFF,
                    epoch=1,
                    values=random.integers(-20_000, 20_000, (ROWS, width), dtype=np.int16),
                )
            )
        )
        for index in range(FRAMES)
    )

    def read_everything() -> int:
        decoder = FrameDecoder()
        frames = 0
        for start in range(0, len(wire), BLOCK_BYTES):
            for frame in decoder.feed(wire[start : start + BLOCK_BYTES]):
                decode_stream(frame, width)
                frames += 1
        assert frames == FRAMES
        return frames

    seconds = best_of(5, read_everything)
    samples = FRAMES * ROWS * width
    line_bytes = 1_000_000 / 10
    return [
        Figure(
            "samples decoded a second (20 channels, 5 rows a frame)",
            f"{samples / seconds / 1e6:.1f} M",
            ">= 5 M",
            samples / seconds >= 5e6,
            f"{FRAMES / seconds:,.0f} frames/s; a full line at 1 Mbaud takes "
            f"{100 * line_bytes * seconds / len(wire):.2f} % of a core",
        )
    ]
