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

from backend.domain.noted import Instrument, Lap, Noted, Pause, noted_from_json, noted_to_json
from backend.domain.ride import find_gaps
from backend.ingest.fit import read_fit
from backend.ingest.fit.noted_words import (
    BATTERY_STATUS,
    DEVICE_KINDS,
    LOCAL_KINDS,
    MANUFACTURERS,
)
from backend.ingest.outcome import ImportedRide
from tests.fakes.fit_file import FIT_EPOCH_S, START_S, definition, enclosed

NOW = START_S - FIT_EPOCH_S
ENUM, UINT8, UINT16, UINT32, UINT32Z, TEXT = 0x00, 0x02, 0x84, 0x86, 0x8C, 0x07
RECORD, LAP, EVENT, DEVICE_INFO = 20, 19, 21, 23
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

    laps = only_ride(file).noted.laps

    told = theirs(file, "lap")
    assert [lap.distance_m for lap in laps] == [lap["total_distance"] for lap in told]
    assert [lap.trigger for lap in laps] == [lap["lap_trigger"] for lap in told]
    assert [lap.to_s - lap.from_s for lap in laps] == [lap["total_elapsed_time"] for lap in told]
    assert (laps[0].from_s, laps[1].from_s) == (0.0, 60.0)


def test_a_stop_of_the_timer_is_a_pause_and_a_gap_though_it_is_short() -> None:
    """Rows that are six seconds apart are usually no break: head units write when they like."""
    ride = only_ride(a_ride_with_a_stop())
    empty = np.zeros(len(ride.rows.times_us), dtype=bool)

    (gap,) = find_gaps(ride.rows.times_us, empty, None, ride.noted.pauses)

    assert ride.noted.pauses == (Pause(40.0, 46.0, by_rider=True),)
    assert (gap.from_s, gap.to_s, gap.rows_lost) == (39.0, 46.0, None)
    assert find_gaps(ride.rows.times_us, empty, None) == ()


def test_a_pause_in_which_rows_were_written_is_no_gap() -> None:
    times_us = np.arange(100, dtype=np.int64) * 1_000_000
    empty = np.zeros(100, dtype=bool)

    assert find_gaps(times_us, empty, 1_000_000, [Pause(40.0, 46.0)]) == ()


def test_devices_are_told_once_each_with_what_was_heard_of_them_last() -> None:
    recorder, meter = only_ride(a_ride_with_a_stop()).noted.instruments

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
    noted = Noted((Lap(0.0, 60.0, "manual"),), (Pause(1.0, 2.0),), (Instrument("recorder"),))
    body = noted_to_json(noted)
    newer = {**body, "laps": [{"from_s": 0.0, "to_s": 60.0, "trigger": "manual", "mood": "good"}]}

    assert noted_from_json(body) == noted
    assert noted_from_json(newer) == noted
    assert noted_from_json(None) == Noted()
