"""Goal: every sample of every kind of FIT file is what a reader that is not ours reads, and our two
walks, the one for sound files and the one for damaged ones, find the same.

Method: small files with one feature of the format each, written byte by byte; fitdecode is the
other reader (`tools.compare_decoders` does the same for folders of real files).
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

import numpy as np
import pytest

from backend.formats.fit import read_fit
from backend.formats.fit.read import read_damaged
from backend.formats.outcome import COMPLETE, ImportedRide
from tests.fakes.fit_file import FIT_EPOCH_S, START_S, commute, definition, enclosed, fit_file
from tests.fakes.kept_rides import column_of
from tools.compare_decoders.cells import compare

NOW = START_S - FIT_EPOCH_S
UINT8, UINT16, UINT32, SINT32, FLOAT32, TEXT, BYTES = 0x02, 0x84, 0x86, 0x85, 0x88, 0x07, 0x0D
RECORD, SESSION = 20, 18
STAMP, POWER, HEART_RATE = (253, 4, UINT32), (7, 2, UINT16), (3, 1, UINT8)


def big_endian() -> bytes:
    fields = [STAMP, POWER]
    head = struct.pack(">BBBHB", 0x40, 0, 1, RECORD, len(fields))
    body = head + b"".join(struct.pack("BBB", *field) for field in fields)
    return enclosed(body + b"".join(struct.pack(">BIH", 0, NOW + s, 150 + s) for s in range(9)))


def compressed_times() -> bytes:
    """The seconds of 40 records in five bits each, which go round once; the first has a time."""
    body = definition(0, RECORD, [STAMP, POWER]) + struct.pack("<BIH", 0, NOW, 100)
    body += definition(1, RECORD, [POWER, HEART_RATE])
    for second in range(1, 41):
        head = 0x80 | 1 << 5 | (NOW + second) & 0x1F
        body += struct.pack("<BHB", head, 100 + second, 90)
    return enclosed(body)


def compressed_speed_and_distance() -> bytes:
    """5 m/s for 100 s: the distance of 12 bits goes round after 256 m. Some records have none."""
    body = definition(0, RECORD, [STAMP, (8, 3, BYTES)])
    for second in range(100):
        speed, distance = 500, 80 * second & 0xFFF
        packed = speed | distance << 12
        three = b"\xff\xff\xff" if second % 10 == 7 else packed.to_bytes(3, "little")
        body += struct.pack("<BI", 0, NOW + second) + three
    return enclosed(body)


def a_field_twice() -> bytes:
    """Zwift writes an empty compressed speed beside the real one."""
    body = definition(0, RECORD, [STAMP, (8, 3, BYTES), (6, 2, UINT16), (5, 4, UINT32)])
    for second in range(9):
        body += struct.pack("<BI", 0, NOW + second) + b"\xff\xff\xff"
        body += struct.pack("<HI", 8056, 100 * second)
    return enclosed(body)


def developer_fields() -> bytes:
    """Of an app: a known name, an unknown one, and one that is called as the profile's power."""
    body = definition(0, 207, [(3, 1, UINT8)]) + b"\x00\x00"
    body += definition(
        1, 206, [(0, 1, UINT8), (1, 1, UINT8), (2, 1, UINT8), (3, 16, TEXT), (8, 8, TEXT)]
    )
    for number, (name, unit) in enumerate(
        [("rider_torque", "Nm"), ("Leg Spring", "kN/m"), ("Power", "W")]
    ):
        body += struct.pack("<BBBB16s8s", 1, 0, number, FLOAT32, name.encode(), unit.encode())
    head = struct.pack("<BBBHB", 0x40 | 0x20 | 2, 0, 0, RECORD, 2)
    head += struct.pack("BBB", *STAMP) + struct.pack("BBB", *POWER)
    body += head + bytes([3]) + b"".join(bytes([number, 4, 0]) for number in range(3))
    for s in range(9):
        body += struct.pack("<BIHfff", 2, NOW + s, 150, 20.5 + s, 11.25, 333.0)
    return enclosed(body)


def developer_fields_that_are_known() -> bytes:
    """Of an app: by the profile's number a temperature in percent of nothing, a temperature, and
    the power that the device has as well; by its name the charge of the battery."""
    body = definition(0, 207, [(3, 1, UINT8)]) + b"\x00\x00"
    cells = [(0, 1, UINT8), (1, 1, UINT8), (2, 1, UINT8), (14, 2, UINT16), (15, 1, UINT8)]
    body += definition(1, 206, [*cells, (3, 16, TEXT), (8, 8, TEXT)])
    described = [
        ("strange", "%", RECORD, 127),
        ("Body Temp", "C", RECORD, 139),
        ("Pedal Power", "watts", RECORD, 7),
        ("currBattery", "%", 0xFFFF, 0xFF),
    ]
    for number, (name, unit, message, native) in enumerate(described):
        head = struct.pack("<BBBBHB", 1, 0, number, FLOAT32, message, native)
        body += head + struct.pack("<16s8s", name.encode(), unit.encode())
    head = struct.pack("<BBBHB", 0x40 | 0x20 | 2, 0, 0, RECORD, 2)
    head += struct.pack("BBB", *STAMP) + struct.pack("BBB", *POWER)
    body += head + bytes([4]) + b"".join(bytes([number, 4, 0]) for number in range(4))
    for s in range(9):
        body += struct.pack("<BIHffff", 2, NOW + s, 150, 5.0, 38.25, 148.0, 90.0 - s)
    return enclosed(body)


def unknown_and_odd_fields() -> bytes:
    """A number the profile has no name for, a list of two, a text, and a size no number has."""
    fields = [STAMP, (222, 2, UINT16), (69, 2, UINT8), (230, 6, TEXT), (231, 3, UINT32)]
    body = definition(0, RECORD, fields)
    for second in range(9):
        body += struct.pack("<BIHBB6s3s", 0, NOW + second, 7 * second, 10, 200, b"abc", b"xyz")
    return enclosed(body)


def defined_anew() -> bytes:
    """A sensor joins in the middle: the same number, another layout; then both by turns."""
    body = definition(0, RECORD, [STAMP, POWER])
    body += b"".join(struct.pack("<BIH", 0, NOW + s, 100) for s in range(5))
    body += definition(0, RECORD, [STAMP, POWER, HEART_RATE])
    body += b"".join(struct.pack("<BIHB", 0, NOW + s, 100, 90) for s in range(5, 10))
    body += definition(3, RECORD, [STAMP, HEART_RATE])
    for s in range(10, 20):
        body += (
            struct.pack("<BIHB", 0, NOW + s, 100, 90)
            if s % 2
            else struct.pack("<BIB", 3, NOW + s, 91)
        )
    return enclosed(body)


def a_field_of_no_bytes() -> bytes:
    """Before the time, at the same byte."""
    body = definition(0, RECORD, [(1, 0, SINT32), STAMP, POWER])
    return enclosed(body + b"".join(struct.pack("<BIH", 0, NOW + s, 100 + s) for s in range(9)))


FEATURES = {
    "a usual file": fit_file(commute(30)),
    "no checksum of the header": fit_file(commute(30), header_crc=False),
    "numbers with the highest byte first": big_endian(),
    "times in the headers": compressed_times(),
    "speed and distance in three bytes": compressed_speed_and_distance(),
    "a field twice": a_field_twice(),
    "fields of a developer": developer_fields(),
    "fields of a developer by number": developer_fields_that_are_known(),
    "unknown and odd fields": unknown_and_odd_fields(),
    "a layout that changes": defined_anew(),
    "two files in a row": fit_file(commute(30)) + fit_file(commute(20, START_S + 86_400)),
}


@pytest.mark.parametrize("name", FEATURES)
def test_every_cell_is_what_another_reader_reads(name: str) -> None:
    told = compare(FEATURES[name])

    assert told.same, told
    assert told.equal > 0


@pytest.mark.parametrize("name", FEATURES)
def test_the_walk_for_damaged_files_finds_the_same_samples(name: str) -> None:
    sound, damaged = read_fit(FEATURES[name]), read_damaged(FEATURES[name])

    assert (sound.state, damaged.state) == (COMPLETE, COMPLETE)
    assert [rows_of(ride) for ride in damaged.rides] == [rows_of(ride) for ride in sound.rides]


def rows_of(ride: ImportedRide) -> dict[str, object]:
    counts = {name: values.tolist() for name, values in ride.rows.counts.items()}
    return {"start": ride.started_us, "times": ride.rows.times_us.tolist(), **counts}


def only_ride(file: bytes) -> ImportedRide:
    (ride,) = read_fit(file).rides
    return ride


def test_times_in_headers_go_on_from_the_last_told_one() -> None:
    ride = only_ride(compressed_times())

    assert ride.started_us == START_S * 1_000_000
    assert (np.diff(ride.rows.times_us) == 1_000_000).all()
    assert column_of(ride, "rider_power_w") == pytest.approx([100.0 + s for s in range(41)])


def test_a_field_of_no_bytes_is_no_value_and_moves_no_other() -> None:
    """fitdecode reads nothing of such a file."""
    ride = only_ride(a_field_of_no_bytes())

    assert (np.diff(ride.rows.times_us) == 1_000_000).all()
    assert column_of(ride, "rider_power_w") == pytest.approx([100.0 + s for s in range(9)])


def test_a_distance_that_goes_round_is_added_up() -> None:
    ride = only_ride(compressed_speed_and_distance())

    assert column_of(ride, "distance_m")[-1] == pytest.approx(5.0 * 99)
    assert np.isnan(column_of(ride, "speed_kmh")[7])
    assert column_of(ride, "speed_kmh")[8] == pytest.approx(18.0)


def test_a_speed_is_kept_to_the_millimetre_a_second() -> None:
    assert column_of(only_ride(a_field_twice()), "speed_kmh") == pytest.approx(
        [8.056 * 3.6] * 9, abs=1e-9
    )


def test_fields_that_no_bike_has_are_channels_of_their_own_name_and_unit() -> None:
    """What an app calls power is not what the profile calls so: nobody knows what it means."""
    ride = only_ride(developer_fields())

    units = {channel.name: channel.unit for channel in ride.rows.channels}
    assert units["leg_spring"] == "kN/m"
    assert column_of(ride, "leg_spring") == pytest.approx([11.25] * 9)
    assert column_of(ride, "rider_torque_nm")[8] == pytest.approx(28.5)
    assert column_of(ride, "rider_power_w") == pytest.approx([150.0] * 9)
    assert column_of(ride, "developer_power") == pytest.approx([333.0] * 9)


def test_a_developer_s_field_with_a_number_of_the_profile_is_that_field() -> None:
    """Unless its unit is no unit of it, or the device itself has another value in the same row."""
    ride = only_ride(developer_fields_that_are_known())

    assert column_of(ride, "core_temperature") == pytest.approx([38.25] * 9)
    assert column_of(ride, "battery_soc_pct") == [90.0 - s for s in range(9)]
    assert column_of(ride, "rider_power_w") == pytest.approx([150.0] * 9)
    assert column_of(ride, "pedal_power") == pytest.approx([148.0] * 9)
    assert column_of(ride, "strange") == pytest.approx([5.0] * 9)


def test_what_is_no_single_number_is_listed() -> None:
    ride = only_ride(unknown_and_odd_fields())

    assert column_of(ride, "unknown_222") == pytest.approx([7.0 * s for s in range(9)])
    assert ride.intake is not None
    assert ride.intake.fields_unread == {"left_power_phase": 9, "unknown_230": 9, "unknown_231": 9}


def test_every_record_is_kept_or_counted() -> None:
    """One of no time, one of a clock that jumped away, two of the same second that agree."""
    records = [*commute(30)]
    records[4] = {**records[4], "timestamp": None}
    records[9] = {**records[9], "timestamp": START_S + 40 * 86_400}
    records.insert(20, {**records[20], "speed": None})

    intake = only_ride(fit_file(records)).intake

    assert intake is not None
    assert intake.rows_read == 31
    assert (intake.rows_kept, intake.rows_joined) == (28, 1)
    assert intake.rows_dropped == {"no_time": 1, "clock_jumped": 1}


def test_five_records_a_second_are_five_samples() -> None:
    """A head unit at 5 Hz: its times have whole seconds only."""
    records = [
        {"timestamp": START_S + row // 5, "speed": 5.0 + 0.01 * row, "power": 100 + row}
        for row in range(50)
    ]

    ride = only_ride(fit_file(records))

    assert len(ride.rows.times_us) == 50
    assert ride.period_us == 200_000
    assert column_of(ride, "rider_power_w") == pytest.approx([100.0 + row for row in range(50)])
    assert ride.intake is not None
    assert ride.intake.rows_spread == 50


def test_a_pause_of_thirty_days_makes_two_rides_of_all_records() -> None:
    later = commute(169, START_S + 30 * 86_400)

    outcome = read_fit(fit_file(commute(328) + later))

    assert outcome.state == COMPLETE
    assert [len(ride.rows.times_us) for ride in outcome.rides] == [328, 169]


def test_a_clock_that_was_never_set_gives_a_ride_without_a_date() -> None:
    """FIT counts from the device's start then."""
    ride = only_ride(fit_file(commute(30, FIT_EPOCH_S + 17_217_864)))

    assert len(ride.rows.times_us) == 30
    assert not ride.start_known


def test_records_without_a_value_are_no_ride() -> None:
    body = definition(0, RECORD, [STAMP])
    body += b"".join(struct.pack("<BI", 0, NOW + s) for s in range(175))

    assert read_fit(enclosed(body)).code == "no_valid_time"


@pytest.mark.parametrize(
    ("field", "spike", "channel"),
    [
        ("distance", 84_000.0, "distance_m"),
        ("speed", 30.0, "speed_kmh"),
        ("enhanced_altitude", 3000.0, "altitude_m"),
        ("position_lat", 58.0, "latitude_deg"),
    ],
)
@pytest.mark.parametrize("at", [0, 17, 29])
def test_one_flipped_bit_changes_neither_distance_nor_maxima(
    field: str, spike: float, channel: str, at: int
) -> None:
    records = commute(30)
    records[at][field] = spike

    ride = only_ride(fit_file(records))

    clean = np.array(column_of(only_ride(fit_file(commute(30))), channel))
    found = np.array(column_of(ride, channel))
    assert np.isnan(found[at])
    assert np.delete(found, at) == pytest.approx(np.delete(clean, at))
    assert ride.intake is not None
    assert ride.intake.values_dropped[channel] == 1


def test_an_odometer_that_stood_through_a_pause_is_no_spike() -> None:
    """Ten minutes without records, and the bike was carried 3 km by train with its head unit on."""
    records = commute(30) + [
        {**row, "distance": row["distance"] + 3000.0 if row["distance"] is not None else None}
        for row in commute(30, START_S + 630)
    ]

    ride = only_ride(fit_file(records))

    assert not np.isnan(column_of(ride, "distance_m")).any()


def test_nowhere_is_no_position() -> None:
    records = commute(30)
    for row in records[:5]:
        row["position_lat"] = row["position_long"] = 0.0

    latitude = column_of(only_ride(fit_file(records)), "latitude_deg")

    assert np.isnan(latitude[:5]).all()
    assert not np.isnan(latitude[5:]).any()


def test_a_runner_s_power_is_no_power_at_the_pedals() -> None:
    names = {c.name for c in only_ride(fit_file(commute(30), sport=1)).rows.channels}

    assert "rider_power_w" not in names
    assert "power" in names


def test_each_sport_of_a_triathlon_is_a_ride_of_its_own() -> None:
    file = triathlon([(5, 100), (2, 300), (1, 200)])

    rides = read_fit(file).rides

    assert [(ride.sport, len(ride.rows.times_us)) for ride in rides] == [
        ("swimming", 100),
        ("cycling", 300),
        ("running", 200),
    ]


def triathlon(legs: Sequence[tuple[int, int]]) -> bytes:
    """Sport and seconds of each leg, one after the other, then their sessions."""
    body = definition(0, RECORD, [STAMP, POWER])
    total = sum(seconds for _, seconds in legs)
    body += b"".join(struct.pack("<BIH", 0, NOW + s, 150) for s in range(total))
    body += definition(1, SESSION, [STAMP, (2, 4, UINT32), (7, 4, UINT32), (5, 1, 0x00)])
    start = NOW
    for sport, seconds in legs:
        body += struct.pack("<BIIIB", 1, start + seconds, start, 1000 * seconds, sport)
        start += seconds
    return enclosed(body)
