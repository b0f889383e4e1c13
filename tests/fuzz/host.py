"""atheris on what the host reads: the wire, CSV and FIT files.

Usage: python -m tests.fuzz.host wire|csv|fit [libFuzzer options]. Only what is promised may be
raised: nothing at all by decoders, an Outcome by readers. FIT's fast reader is compiled C and may
die of a file; it runs in a child in the server and is left out here.
"""

import sys

import atheris

with atheris.instrument_imports(include=["firmware_protocol", "backend"]):
    from backend.ingest.formats import read_file
    from firmware_protocol.codec import Malformed, decode, encode
    from firmware_protocol.framing import FrameDecoder, encode_frame


def wire(data: bytes) -> None:
    """Any split gives the same frames; every frame decodes; what is a message encodes again."""
    whole, split = FrameDecoder(), FrameDecoder()
    step = max(1, data[0] if data else 1)
    frames = whole.feed(data)
    pieces = [
        frame for at in range(0, len(data), step) for frame in split.feed(data[at : at + step])
    ]
    assert frames == pieces
    assert whole.stats == split.stats
    for frame in [*frames, data]:
        message = decode(frame)
        if not isinstance(message, Malformed):
            assert isinstance(encode(message), bytes)
        assert frame not in frames or FrameDecoder().feed(encode_frame(frame)) == [frame]


def csv(data: bytes) -> None:
    """A table or a reason."""
    assert read_file("ride.csv", b"time,speed_kmh," + data, False).state


def fit(data: bytes) -> None:
    """A ride, a part of it, or a reason."""
    head = b"\x0e\x10\x00\x00" + data[:4] + b".FIT"
    assert read_file("ride.fit", head + data[4:], False).state


def main() -> None:
    target = {"wire": wire, "csv": csv, "fit": fit}[sys.argv[1]]
    atheris.Setup([sys.argv[0], *sys.argv[2:]], target)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
