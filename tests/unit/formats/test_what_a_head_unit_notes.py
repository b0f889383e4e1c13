"""Goal: laps, pauses, devices and the balance of the legs that a FIT file tells are kept as they
were told, and a pause of the timer is told as a gap however short it is.

Method: a file written byte by byte; fitdecode, with a profile of its own, is the other reader.
"""

from __future__ import annotations

import io
import struct

import fitdecode
import numpy as np
import pytest

from backend.core.breaks import find_breaks
from backend.core.device_metadata import (
    DeviceFigure,
    DeviceMetadata,
    DeviceSession,
    Instrument,
    Lap,
    Pause,
    metadata_from_json,
    metadata_to_json,
    within,
)
from backend.core.ride import find_gaps
from backend.formats.fit import read_fit
from backend.formats.fit.device_figures import SESSION_FIELDS
from backend.formats.fit.metadata_words import (
    BATTERY_STATUS,
    DEVICE_KINDS,
    LOCAL_KINDS,
    MANUFACTURERS,
)
from backend.formats.outcome import ImportedRide
from tests.fakes.fit_file import FIT_EPOCH_S, START_S, definition, enclosed

NOW = START_S - FIT_EPOCH_S
ENUM, UINT8, UINT16, UINT32, UINT32Z, TEXT = 0x00, 0x02, 0x84, 0x86, 0x8C, 0x07
RECORD, SESSION, LAP, EVENT, DEVICE_INFO = 20, 18, 19, 21, 23
STOP_ALL, START = 4, 0


def a_ride_with_a_stop() -> bytes:
    """100 s, of which the timer stood from 40 to 46: two laps, a head unit, a power meter."""
    body = definition(0, RECORD, [(253, 4, UINT32), (7, 2, UINT16), (30, 1, UINT8)])
    for second in [*range(40), *range(46, 100)]:
        right_52_pct, side_unknown = 0x80 | 52, 48
        balance = right_52_pct if second != 5 else side_unknown
        body += struct.pack("<BIHB", 0, NOW + second, 200, balance)
    body += definition(1, EVENT, [(253, 4, UINT32), (0, 1, ENUM), (1, 1, ENUM), (3, 4, UINT32)])
    for second, kind in ((0, START), (40, STOP_ALL), (46, START), (99, STOP_ALL)):
        body += struct.pack("<BIBBI", 1, NOW + second, 0, kind, 0)
    body += definition(
        2, LAP, [(253, 4, UINT32), (2, 4, UINT32), (7, 4, UINT32), (9, 4, UINT32), (24, 1, ENUM)]
    )
    for start, stop, trigger in ((0, 60, 0), (60, 99, 7)):
        body += struct.pack(
            "<BIIIIB", 2, NOW + stop, NOW + start, 1000 * (stop - start), 500 * stop, trigger
        )
    body += definition(
        3,
        DEVICE_INFO,
        [
            (253, 4, UINT32),
            (0, 1, UINT8),
            (1, 1, UINT8),
            (2, 2, UINT16),
            (3, 4, UINT32Z),
            (10, 2, UINT16),
            (11, 1, UINT8),
            (27, 12, TEXT),
        ],
    )
    for at, index, kind, serial, volts, status, name in (
        (0, 0, 0xFF, 3900001, 0xFFFF, 0xFF, b"Edge 530"),
        (1, 1, 11, 77, int(2.9 * 256), 2, b""),
        (90, 1, 11, 77, int(2.5 * 256), 4, b""),
    ):
        body += struct.pack(
            "<BIBBHIHB12s", 3, NOW + at, index, kind, 1, serial, volts, status, name
        )
    return enclosed(body)


def only_ride(file: bytes) -> ImportedRide:
    (ride,) = read_fit(file).rides
    return ride


def theirs(file: bytes, message: str) -> list[dict[str, object]]:
    with fitdecode.FitReader(io.BytesIO(file)) as reader:
        return [
            {field.name: field.value for field in frame.fields}
            for frame in reader
            if isinstance(frame, fitdecode.FitDataMessage) and frame.name == message
        ]


def test_laps_are_those_of_another_reader() -> None:
    file = a_ride_with_a_stop()

    laps = only_ride(file).metadata.laps

    told = theirs(file, "lap")
    assert [lap.distance_m for lap in laps] == [lap["total_distance"] for lap in told]
    assert [lap.trigger for lap in laps] == [lap["lap_trigger"] for lap in told]
    assert [lap.to_s - lap.from_s for lap in laps] == [lap["total_elapsed_time"] for lap in told]
    assert (laps[0].from_s, laps[1].from_s) == (0.0, 60.0)


def test_a_stop_of_the_timer_is_a_pause_and_a_gap_though_it_is_short() -> None:
    """Rows that are six seconds apart are usually no break: head units write when they like."""
    ride = only_ride(a_ride_with_a_stop())
    empty = np.zeros(len(ride.rows.times_us), dtype=bool)

    (gap,) = find_gaps(
        ride.rows.times_us, empty, find_breaks({}, ride.rows.times_us, ride.metadata.pauses)
    )

    assert ride.metadata.pauses == (Pause(40.0, 46.0, by_rider=True),)
    assert (gap.from_s, gap.to_s, gap.rows_lost) == (39.0, 46.0, None)
    assert find_gaps(ride.rows.times_us, empty, find_breaks({}, ride.rows.times_us)) == ()


def test_a_pause_in_which_rows_were_written_is_no_gap() -> None:
    times_us = np.arange(100, dtype=np.int64) * 1_000_000
    empty = np.zeros(100, dtype=bool)

    assert find_gaps(times_us, empty, find_breaks({}, times_us, [Pause(40.0, 46.0)])) == ()


def test_devices_are_told_once_each_with_what_was_heard_of_them_last() -> None:
    recorder, meter = only_ride(a_ride_with_a_stop()).metadata.instruments

    assert recorder == Instrument("recorder", "garmin", "Edge 530", "3900001")
    assert (meter.kind, meter.serial_number, meter.battery_status) == ("bike_power", "77", "low")
    assert meter.battery_v == pytest.approx(2.5, abs=1 / 256)


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        (DEVICE_KINDS, "antplus_device_type"),
        (LOCAL_KINDS, "local_device_type"),
        (BATTERY_STATUS, "battery_status"),
    ],
)
def test_words_for_numbers_are_the_profile_s(words: dict[int, str], kind: str) -> None:
    """Three of ours leave out what only tells which lamp or how old a protocol is."""
    profile = fitdecode.profile.FIELD_TYPES[kind].enum

    for number, word in words.items():
        assert profile[number].replace("env_", "environment_").startswith(word)


def test_makers_are_the_profile_s() -> None:
    profile = fitdecode.profile.FIELD_TYPES["manufacturer"].enum

    for number, word in MANUFACTURERS.items():
        assert profile[number].startswith(word)


def test_the_share_of_the_right_leg_is_a_channel_and_an_unknown_side_is_none() -> None:
    ride = only_ride(a_ride_with_a_stop())

    specs = {channel.name: channel for channel in ride.rows.channels}
    share = specs["right_leg_pct"].to_values(ride.rows.counts["right_leg_pct"])
    raw = specs["left_right_balance"].to_values(ride.rows.counts["left_right_balance"])
    assert np.isnan(share[5])
    assert (np.delete(share, 5) == 52).all()
    assert raw[5] == 48
    assert np.isnan(np.delete(raw, 5)).all()


def test_notes_survive_being_written_and_a_newer_version_s_words() -> None:
    noted = DeviceMetadata(
        (Lap(0.0, 60.0, "manual"),), (Pause(1.0, 2.0),), (Instrument("recorder"),)
    )
    body = metadata_to_json(noted)
    newer = {**body, "laps": [{"from_s": 0.0, "to_s": 60.0, "trigger": "manual", "mood": "good"}]}

    assert metadata_from_json(body) == noted
    assert metadata_from_json(newer) == noted
    assert metadata_from_json(None) == DeviceMetadata()


def an_e_bikes_session(times: bool = True) -> bytes:
    """Ten seconds, and what the device says of them: some of it contradicts the records."""
    body = definition(0, RECORD, [(253, 4, UINT32), (7, 2, UINT16)])
    for second in range(10):
        body += struct.pack("<BIH", 0, NOW + second, 200)
    fields = [
        (253, 4, UINT32),
        (2, 4, UINT32),
        (3, 4, 0x85),
        (7, 4, UINT32),
        (9, 4, UINT32),
        (11, 2, UINT16),
        (14, 2, UINT16),
        (124, 4, UINT32),
        (20, 2, UINT16),
        (48, 4, UINT32),
        (129, 2, UINT16),
        (130, 2, UINT16),
        (131, 1, UINT8),
        (177, 2, UINT16),
        (65, 8, UINT32),
        (22, 2, UINT16),
    ]
    when, start = (NOW + 9, NOW) if times else (0xFFFFFFFF, 0xFFFFFFFF)
    elapsed = 9000 if times else 0xFFFFFFFF
    told = (603979776, elapsed, 8050, 31, 0xFFFF, 8056, 222, 2100, 84, 250, 69, 400, 1, 2, 0xFFFF)
    body += definition(1, SESSION, fields)
    body += struct.pack("<BIIiIIHHIHIHHBHIIH", 1, when, start, *told)
    return enclosed(body)


def test_what_a_session_states_is_what_fitdecode_reads_and_stands_beside_ours() -> None:
    file = an_e_bikes_session()

    (ride,) = read_fit(file).rides

    (statement,) = ride.metadata.statements
    told = {figure.name: (figure.value, figure.unit) for figure in statement.figures}
    with fitdecode.FitReader(io.BytesIO(file)) as reader:
        (theirs,) = (
            message
            for message in reader
            if isinstance(message, fitdecode.FitDataMessage) and message.name == "session"
        )
    for name in (
        "total_elapsed_time",
        "total_distance",
        "total_calories",
        "avg_power",
        "total_work",
        "avg_lev_motor_power",
        "max_lev_motor_power",
        "lev_battery_consumption",
    ):
        assert told[name][0] == pytest.approx(theirs.get_value(name)), name
    assert told["lev_battery_consumption"] == (34.5, "%")
    # Only the wider of two fields of one meaning has a value.
    wider = [field.value for field in theirs.fields if field.name == "enhanced_avg_speed"]
    assert told["avg_speed"][0] in wider
    assert told["avg_speed"] == (8.056, "m/s")
    # What the profile does not know is listed under its number; a place is no figure.
    assert told["unknown_177"] == (400.0, "")
    assert not any("position" in name for name in told)
    # What was not told is not there: it is no zero.
    assert "total_ascent" not in told
    assert ride.intake is not None
    assert ride.intake.fields_unread == {"session_unknown_65": 1}
    # The device's mean is not the records'.
    assert {channel.name for channel in ride.rows.channels} == {"rider_power_w"}
    assert (ride.rows.counts["rider_power_w"] == 200).all()


def test_a_session_without_times_is_of_the_records() -> None:
    (ride,) = read_fit(an_e_bikes_session(times=False)).rides

    (statement,) = ride.metadata.statements
    assert (statement.from_s, statement.to_s) == (0.0, 9.0)


def test_a_statement_is_never_cut_and_comes_back_from_json() -> None:
    whole = DeviceMetadata(
        statements=(DeviceSession(100.0, 500.0, (DeviceFigure("total_work", 9.0, "J"),)),)
    )

    of_second = within(whole, 300.0, 200.0)

    assert of_second.statements == (DeviceSession(-200.0, 200.0, whole.statements[0].figures),)
    assert within(whole, 600.0, 100.0).statements == ()
    assert metadata_from_json(metadata_to_json(of_second)) == of_second
    # As a version wrote it that knew no statements.
    assert metadata_from_json({"laps": [], "pauses": [], "instruments": []}) == DeviceMetadata()


def test_every_figure_of_a_session_is_that_of_fitdecodes_profile() -> None:
    theirs = fitdecode.profile.MESSAGE_TYPES[SESSION].fields

    for number, ours in SESSION_FIELDS.items():
        field = theirs[number]
        assert ours.name == field.name.replace("enhanced_", ""), number
        assert (ours.scale, ours.offset) == (field.scale or 1, field.offset or 0), number
