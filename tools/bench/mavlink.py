"""The rival's side of the link benchmark: samples a second through pymavlink's parser.

Runs in the rivals' environment and prints one JSON object. DEBUG_FLOAT_ARRAY carries 58 floats a
frame, the most samples for its framing. Usage: python mavlink.py FRAMES
"""

import json
import sys
import time

from pymavlink.dialects.v20 import common

SAMPLES = 58
BLOCK_BYTES = 4096


def main() -> None:
    frames = int(sys.argv[1])
    writer = common.MAVLink(None, srcSystem=1, srcComponent=1)
    wire = bytearray()
    for index in range(frames):
        values = [float(index + at) for at in range(SAMPLES)]
        message = common.MAVLink_debug_float_array_message(index, b"spindle", 1, values)
        wire += message.pack(writer)
        writer.seq = (writer.seq + 1) % 256
    best = float("inf")
    for _ in range(5):
        reader = common.MAVLink(None)
        heard = 0
        start = time.perf_counter()
        for at in range(0, len(wire), BLOCK_BYTES):
            heard += len(reader.parse_buffer(bytes(wire[at : at + BLOCK_BYTES])) or [])
        best = min(best, time.perf_counter() - start)
        assert heard == frames, heard
    print(json.dumps({"samples_per_s": frames * SAMPLES / best, "frames_per_s": frames / best}))


if __name__ == "__main__":
    main()
