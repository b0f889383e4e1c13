"""atheris on what the host reads: the wire, CSV, FIT, GPX, TCX and Mahle's JSON, ride logs of
units, archives, and what tells them apart.

Usage: python -m tools.fuzz.host wire|csv|fit|track|mahle|log|archive|head [libFuzzer options].
Only what is promised may be raised: nothing at all by decoders, an Outcome by readers.
"""

import gzip
import io
import sys
import zipfile
from contextlib import suppress

import atheris

with atheris.instrument_imports(include=["firmware_protocol", "backend"]):
    from backend.formats.blocks import Block, encode_block, scan
    from backend.formats.containers.archive import BrokenArchive, Entry, entries
    from backend.formats.formats import SNIFFED_BYTES, read_file, refused_by_head
    from backend.formats.mahle import read_mahle
    from backend.formats.questions import TableAnswer
    from backend.formats.ride_logs import read_blocks
    from firmware_protocol.codec import Malformed, decode, encode
    from firmware_protocol.framing import FrameDecoder, encode_frame
    from tests.fakes.fit_file import definition, enclosed
    from tests.fakes.mahle_file import mahle_file, mahle_ride
    from tests.fakes.zip_file import zipped


TABLE_HEADS = [
    *("time,speed_kmh,", "timestamp,speed,distance,temperature\n2023-03-26T00:59:59,"),
    "Minutes, Torq (N-m),Km/h,Watts,Km,Cadence,Hrate,ID\n0.021,8.1,25.2,",
    "Device Type,Date/Time,Firmware Version\n1,2012-11-27 13:40:41,1\n\n\nMinutes,Km/h\n",
    "ZEIT;STRECKE;POWER;RPM;SPEED;PULS;HÖHE;TEMP;INTERVAL;PAUSE\nL_SEC;KM\n0;0,1;",
    "secs,cad,hr,km,kph,nm,watts,alt,lon,lat\n0,90,150,",
    "iBike,8,english\n2008,8,8,6,32,52\n\n0,0,0,0,1,0\nSpeed (mph),Power (W)\n15,",
    "Ah\tV\tA\tS\tD\tDeg\tRPM\tHW\tNm\tThI\tThO\tAuxA\tAuxD\tFlgs\n0.1\t50\t4\t36\t",
    "0.1\t50\t4\t36\t0.01\t41\t60\t125\t20\t1\t1\t0\t0\t1\n",
    "ms_today;input_voltage;current_motor;speed_meters_per_sec;gnss_lat\n86399000;50;",
    "Time (min);Speed (m/s)\n0:01:30;",
]
TRACK_PIECES = [
    *(b"<trk>", b"</trk>", b"<trkseg>", b"</trkseg>", b"</trkpt>", b"<trkpt/>", b"</gpx>"),
    *(b'<trkpt lat="48.1" lon="', b'11.5">', b"<time>2023-11-14T22:13:20Z</time>", b"<ele>"),
    *(
        b"<time>2023-11-14T22:13:2",
        b"1Z</time>",
        b"500</ele>",
        b"<hr>120</hr>",
        b"<type>Run</type>",
    ),
    *(b'<Activity Sport="Biking">', b"</Activity>", b"<Course>", b"</Course>", b"<Creator>"),
    *(b'<Lap StartTime="2023-11-14T22:13:20Z">', b"</Lap>", b"<TotalTimeSeconds>", b"</Creator>"),
    *(b"<Trackpoint>", b"</Trackpoint>", b"<Time>2023-11-14T22:13:20Z</Time>", b"<Value>", b"<x:y"),
    *(b"<Time>2023-11-14T22:13:21</Time>", b"<HeartRateBpm>"),
    *(
        b"<Watts>150</Watts>",
        b"9e99",
        b"-1",
        b"\xff\xfe",
        b"<!DOCTYPE a [",
        b"]>",
        b"&a;",
        b"<![CDATA[",
    ),
    *(b"<?xml version='1.0' encoding='", b"utf-16'?>", b"rot13'?>", b"<!--", b"-->", b"\0"),
]
MAHLE = mahle_file(mahle_ride(3))
MAHLE_HEAD = MAHLE[: MAHLE.index(b'"locations"')]
MAHLE_PIECES = [
    *(b'"locations": [', b'"start_date": "2024-07-24 15:35:43",', b'"stop_date": "2024-', b'"aw"'),
    *(b'{"al": 1, "bt": [', b'{"bc": 3, "vl": 36.5}', b'], "cp": 60,', b'"ts": "2024-07-24 17:3'),
    *(b'5:44.28"}', b'5:48.28+02:00"}', b"}", b"]", b",", b'"la": 50.6, "lo": ', b"-1e999", b"NaN"),
    *(
        b"null",
        b"true",
        b"[[[[",
        b'"\\u12',
        b"\xff",
        b"\xef\xbb\xbf",
        b'{"ts": ',
        b'"batteries": [',
    ),
]
# Beginnings of everything that is told apart by its beginning.
HEADS = [
    *(
        b"",
        MAHLE_HEAD,
        b'{"type": "FeatureCollection"',
        b"[",
        b"PK\x03\x04",
        b"PK\x05\x06",
        b"%PDF",
    ),
    *(b"\x0e\x10\x00\x00\x00\x00\x00\x00.FIT", b"\x0c\x10", b"....", b"<?xml version='1.0'?><gpx>"),
    *(
        b"<html>",
        b"<TrainingCenterDatabase>",
        b"\xff\xfe<\x00g\x00p\x00x\x00>\x00",
        b"\xef\xbb\xbf",
    ),
    *(
        b"time,speed_kmh\n",
        b"Minutes, Torq (N-m),Km/h\n",
        b"iBike,8,english\n",
        b"secs\n",
        b"\x89PNG",
    ),
    encode_block(Block(0, 1, 1, 1, 1, 0, 0, 0, 1, b"")),
]
NAMES = [
    "ride",
    "ride.fit",
    "ride.csv",
    "ride.json",
    "ride.gpx.gz",
    "2024-10-10_12-54-08.txt",
    "a.sbl",
]


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
    """A table of any maker: a ride, a part of it, a question, or a reason; answered, too."""
    from_input = atheris.FuzzedDataProvider(data)
    head = from_input.PickValueInList(TABLE_HEADS)
    name = from_input.PickValueInList(["ride.csv", "2024-10-10_12-54-08.csv", "CAlog.txt"])
    file = head.encode(from_input.PickValueInList(["utf-8", "latin-1", "utf-16"]))
    file += from_input.ConsumeBytes(from_input.remaining_bytes())
    outcome = read_file(name, file)
    assert outcome.state
    if outcome.question is not None:
        units = {c.name: c.units[0] for c in outcome.question.columns if c.units}
        assert (
            read_file(name, file, TableAnswer("Europe/Dublin", units, 5.0)).code != "needs_mapping"
        )


def fit(data: bytes) -> None:
    """A ride, a part of it, or a reason."""
    head = b"\x0e\x10\x00\x00" + data[:4] + b".FIT"
    assert read_file("ride.fit", head + data[4:]).state
    # Its checksum fits, so that whatever it says is taken for sound.
    assert read_file("ride.fit", enclosed(fit_messages(atheris.FuzzedDataProvider(data)))).state


def track(data: bytes) -> None:
    """A track of any pieces that tracks have, in any order, with anything between: a ride, a part
    of it, or a reason."""
    from_input = atheris.FuzzedDataProvider(data)
    file = from_input.PickValueInList([b"<gpx>", b"<TrainingCenterDatabase>"])
    while from_input.remaining_bytes():
        file += from_input.PickValueInList(TRACK_PIECES)
        if from_input.ConsumeIntInRange(0, 3) == 0:
            file += from_input.ConsumeBytes(from_input.ConsumeIntInRange(0, 12))
    asked = read_file("ride", file)
    assert asked.state
    if asked.question is not None:
        assert read_file("ride", file, TableAnswer("Europe/Berlin")).code != "needs_mapping"


def mahle(data: bytes) -> None:
    """A document of any pieces that such rides have: a ride, a part of it, a question, or a
    reason; answered, too."""
    from_input = atheris.FuzzedDataProvider(data)
    file = (
        MAHLE_HEAD if from_input.ConsumeBool() else MAHLE[: from_input.ConsumeIntInRange(0, 4096)]
    )
    while from_input.remaining_bytes():
        file += from_input.PickValueInList(MAHLE_PIECES)
        if from_input.ConsumeIntInRange(0, 3) == 0:
            file += from_input.ConsumeBytes(from_input.ConsumeIntInRange(0, 12))
    asked = read_mahle(file)
    assert asked.state
    if asked.question is not None:
        assert read_mahle(file, TableAnswer("Europe/Berlin")).code != "needs_mapping"


def archive(data: bytes) -> None:
    """A ZIP with an archive within, cut and changed anywhere: files, each told apart, or a
    reason."""
    from_input = atheris.FuzzedDataProvider(data)
    file = bytearray(from_input.PickValueInList(ARCHIVES))
    del file[from_input.ConsumeIntInRange(0, len(file)) :]
    while from_input.remaining_bytes() and file:
        file[from_input.ConsumeIntInRange(0, len(file) - 1)] = from_input.ConsumeIntInRange(0, 255)
    with suppress(BrokenArchive):
        names = [told.name for told in entries(io.BytesIO(file)) if isinstance(told, Entry)]
        assert len(set(names)) == len(names)


def head(data: bytes) -> None:
    """What a beginning alone refuses, the whole file is refused for, too; packed or not."""
    from_input = atheris.FuzzedDataProvider(data)
    name = from_input.PickValueInList(NAMES)
    file = from_input.PickValueInList(HEADS)
    packed = from_input.ConsumeIntInRange(0, 7) == 0
    file += from_input.ConsumeBytes(from_input.remaining_bytes())
    if packed:
        file = gzip.compress(file)
    refused = refused_by_head(name, file[:SNIFFED_BYTES])
    if refused is not None:
        assert refused.state == read_file(name, file).state == "rejected"
        assert packed or refused.code == read_file(name, file).code or not file


def fit_messages(from_input: atheris.FuzzedDataProvider) -> bytes:
    """Definitions of messages that are read, with any fields, and data for them."""
    body, sizes = b"", {0: 0}
    while from_input.remaining_bytes():
        local = from_input.ConsumeIntInRange(0, 3)
        if from_input.ConsumeIntInRange(0, 3) == 0:
            fields = [
                (
                    from_input.PickValueInList([253, 0, 1, 2, 3, 5, 6, 7, 8, 69, 222]),
                    from_input.ConsumeIntInRange(0, 9),
                    from_input.PickValueInList(
                        [0x00, 0x02, 0x07, 0x0D, 0x84, 0x86, 0x88, 0x90, 0xFF]
                    ),
                )
                for _ in range(from_input.ConsumeIntInRange(0, 6))
            ]
            message = from_input.PickValueInList([20, 20, 20, 18, 206, 99])
            body += definition(local, message, fields)
            sizes[local] = sum(size for _, size, _ in fields)
        else:
            head = local if from_input.ConsumeBool() else 0x80 | local << 5 | 7
            size = sizes.get(local, 0)
            body += bytes([head]) + from_input.ConsumeBytes(size).ljust(size, b"\x3c")
    return body


def log(data: bytes) -> None:
    """Blocks sealed over whatever they say, between them damage: a ride, a part, or a reason."""
    from_input = atheris.FuzzedDataProvider(data)
    file = b""
    while from_input.remaining_bytes():
        if from_input.ConsumeBool():
            file += encode_block(any_block(from_input))[: from_input.ConsumeIntInRange(1, 1024)]
        else:
            file += from_input.ConsumeBytes(40)
    assert scan(file).damaged <= len(file)
    assert read_blocks(file).state


def any_block(from_input: atheris.FuzzedDataProvider) -> Block:
    """A block of a log whose header and payload the input chose."""
    number = from_input.ConsumeIntInRange
    kind, log_id, boot_id, seq = number(0, 8), number(0, 2), number(0, 2), number(0, 2**32 - 1)
    t0_us, n, schema_id = number(0, 2**64 - 1), number(0, 2**16 - 1), number(0, 2)
    payload = from_input.ConsumeBytes(number(0, 472))
    return Block(0, number(0, 2), kind, log_id, boot_id, seq, t0_us, n, schema_id, payload)


RIDE_FILE = enclosed(definition(0, 0, [(0, 1, 0)]) + b"\x00\x04")
ARCHIVES = [
    zipped(
        {"a.fit": RIDE_FILE, "in.zip": zipped({"b.fit": RIDE_FILE}), "c": b""}, packing, streamed
    )
    for packing in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
    for streamed in (False, True)
]


def main() -> None:
    targets = (wire, csv, fit, track, mahle, log, archive, head)
    target = next(target for target in targets if target.__name__ == sys.argv[1])
    atheris.Setup([sys.argv[0], *sys.argv[2:]], target)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
