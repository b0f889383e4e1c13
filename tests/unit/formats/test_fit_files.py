"""Goal: a FIT file becomes a ride by our rules, and no bytes whatever can crash the reader.

Method: files written by the tests' own writer; cut, flipped, lied about and joined. The readers'
own opinion of a damaged file is not trusted: rows are compared with what was written.
"""

from __future__ import annotations

import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from backend.formats.fit import read_fit
from backend.formats.fit.read import read_damaged
from backend.formats.formats import read_file
from backend.formats.outcome import COMPLETE, PARTIAL, REJECTED, ImportedRide, Outcome
from tests.fakes.fit_file import START_S, commute, definition, enclosed, fit_file
from tests.fakes.kept_rides import column_of

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ROWS = 300
WHOLE = fit_file(commute(ROWS))
CODES = {
    None,
    "empty_file",
    "unknown_format",
    "unsupported_format",
    "no_records",
    "no_valid_time",
    "too_many_rows",
    "truncated",
    "damaged",
    "checksum_mismatch",
    # Of the gzip file that two bytes begin.
    "container_damaged",
}


def only_ride(outcome: Outcome) -> ImportedRide:
    (ride,) = outcome.rides
    return ride


def is_sensible(outcome: Outcome) -> bool:
    """States, codes and rides go together, and times are strictly increasing."""
    assert outcome.code in CODES
    assert (outcome.state == COMPLETE) == (outcome.code is None)
    assert (outcome.state == REJECTED) == (not outcome.rides)
    assert outcome.completeness is None or 0.0 <= outcome.completeness <= 1.0
    for ride in outcome.rides:
        assert (np.diff(ride.rows.times_us) > 0).all()
        for channel in ride.rows.channels:
            assert len(ride.rows.counts[channel.name]) == len(ride.rows.times_us)
    return True


def test_a_sound_file_is_read_in_our_units() -> None:
    outcome = read_file("ride.fit", WHOLE)

    ride = only_ride(outcome)
    assert (outcome.state, outcome.code, outcome.completeness) == (COMPLETE, None, 1.0)
    assert (ride.started_us, ride.period_us) == (START_S * 1_000_000, 1_000_000)
    assert ride.sport == "cycling"
    assert column_of(ride, "speed_kmh") == pytest.approx([18.0] * ROWS)
    assert column_of(ride, "rider_power_w") == pytest.approx([150.0] * ROWS)
    assert column_of(ride, "motor_power_w") == pytest.approx([200.0] * ROWS)
    assert column_of(ride, "altitude_m")[0] == pytest.approx(520.2)
    assert column_of(ride, "latitude_deg")[9] == pytest.approx(48.0 + 9 * 4.5e-5, abs=1e-6)
    assert column_of(ride, "distance_m")[-1] == pytest.approx(5.0 * (ROWS - 1))


def test_the_walk_for_damaged_files_reads_a_sound_one_just_the_same() -> None:
    fast, slow = only_ride(read_fit(WHOLE)), only_ride(read_damaged(WHOLE))

    assert [c.name for c in slow.rows.channels] == [c.name for c in fast.rows.channels]
    assert slow.rows.times_us.tolist() == fast.rows.times_us.tolist()
    for name, counts in fast.rows.counts.items():
        assert slow.rows.counts[name].tolist() == counts.tolist()


def test_a_header_checksum_of_zero_is_legal() -> None:
    outcome = read_fit(fit_file(commute(ROWS), header_crc=False))

    assert outcome.state == COMPLETE
    assert len(only_ride(outcome).rows.times_us) == ROWS


def test_missing_is_missing_and_not_zero() -> None:
    records = commute(20)
    records[5]["power"] = None
    records[6]["power"] = 0

    power = column_of(only_ride(read_fit(fit_file(records))), "rider_power_w")

    assert np.isnan(power[5])
    assert power[6] == 0.0


def test_parts_of_a_row_written_one_after_the_other_become_one_row() -> None:
    """Bosch writes several records for one second, each with some of the fields (dreeve#2270)."""
    records = []
    for row in commute(30):
        records.append({"timestamp": row["timestamp"], "speed": row["speed"], "power": None})
        records.append({"timestamp": row["timestamp"], "speed": None, "power": row["power"]})

    ride = only_ride(read_fit(fit_file(records)))

    assert len(ride.rows.times_us) == 30
    assert column_of(ride, "speed_kmh") == pytest.approx([18.0] * 30)
    assert column_of(ride, "rider_power_w") == pytest.approx([150.0] * 30)


def test_a_clock_that_was_not_set_or_ran_backwards_is_put_right_and_told() -> None:
    records = commute(60)
    records[3]["timestamp"] = 631_065_600 + 5
    records[40]["timestamp"] = START_S + 30 * 86_400
    records[20], records[21] = records[21], records[20]

    ride = only_ride(read_fit(fit_file(records)))

    assert len(ride.rows.times_us) == 58
    assert ride.intake is not None
    assert ride.intake.rows_moved == 1
    assert ride.intake.rows_dropped == {"clock_not_set": 1, "clock_jumped": 1}


def test_files_in_a_row_are_a_ride_each() -> None:
    chained = WHOLE + fit_file(commute(50, START_S + 86_400))

    outcome = read_fit(chained)

    assert outcome.state == COMPLETE
    assert [len(ride.rows.times_us) for ride in outcome.rides] == [ROWS, 50]


def test_a_cut_file_keeps_what_is_before_the_cut_and_says_where() -> None:
    record_bytes = (len(WHOLE) - len(fit_file(commute(ROWS - 100)))) // 100
    # After the records: definition and message of the session, and the checksum.
    tail_bytes = 12 + 6 + 2
    cut = len(WHOLE) - tail_bytes - 100 * record_bytes + 4

    outcome = read_fit(WHOLE[:cut])

    assert (outcome.state, outcome.code) == (PARTIAL, "truncated")
    assert len(only_ride(outcome).rows.times_us) == ROWS - 100
    assert outcome.offset is not None
    assert cut - record_bytes <= outcome.offset <= cut
    assert outcome.completeness == pytest.approx(cut / len(WHOLE), abs=0.01)
    assert f"of {cut}" in str(outcome.detail)


def test_a_header_that_was_never_completed_still_gives_every_record() -> None:
    """After a power loss head units leave sizes of 0 (fitdecode#27)."""
    no_size = WHOLE[:4] + bytes(4) + WHOLE[8:]
    no_header_size = b"\x00" + WHOLE[1:]

    for damaged in (no_size, no_header_size):
        outcome = read_fit(damaged)

        assert (outcome.state, outcome.code) == (PARTIAL, "damaged")
        assert len(only_ride(outcome).rows.times_us) == ROWS


@pytest.mark.parametrize("declared", [100, 4_000_000_000])
def test_a_header_that_lies_about_the_size_still_gives_every_record(declared: int) -> None:
    outcome = read_fit(WHOLE[:4] + struct.pack("<I", declared) + WHOLE[8:])

    assert outcome.state == PARTIAL
    assert len(only_ride(outcome).rows.times_us) == ROWS


def test_a_wrong_checksum_is_told_though_every_record_was_read() -> None:
    damaged = bytearray(WHOLE)
    damaged[-1] ^= 0xFF

    outcome = read_fit(bytes(damaged))

    assert (outcome.state, outcome.code) == (PARTIAL, "checksum_mismatch")
    assert len(only_ride(outcome).rows.times_us) == ROWS


def test_rows_behind_a_lost_byte_are_found_again() -> None:
    again = definition(1, 20, [(253, 4, 0x86), (7, 2, 0x84)])
    rows = b"".join(
        struct.pack("<BIH", 1, START_S - 631_065_600 + second, 150) for second in range(400)
    )
    body = definition(1, 20, [(253, 4, 0x86), (7, 2, 0x84)]) + rows[: 7 * 200]
    body += again + rows[7 * 200 :]
    whole = enclosed(body)
    lost = 14 + 17 + 7 * 50 + 3

    outcome = read_fit(whole[:lost] + whole[lost + 1 :])

    assert outcome.state == PARTIAL
    assert len(only_ride(outcome).rows.times_us) >= 240


@pytest.mark.parametrize("share", np.linspace(0.0, 1.0, 41))
def test_any_truncation_has_a_reason_or_a_ride(share: float) -> None:
    cut = WHOLE[: int(share * len(WHOLE))]

    outcome = read_file("ride.fit", cut)

    assert is_sensible(outcome)
    if len(cut) < len(WHOLE):
        assert outcome.code is not None
        assert outcome.detail


@pytest.mark.parametrize("bit", range(8))
def test_one_flipped_bit_anywhere_costs_two_records_at_most(bit: int) -> None:
    """In the only definition of the records, too: the checksum tells which bit it was."""
    whole = fit_file(commute(60))
    for place in range(14, len(whole) - 2, 7):
        damaged = bytearray(whole)
        damaged[place] ^= 1 << bit

        outcome = read_fit(bytes(damaged))

        assert sum(len(ride.rows.times_us) for ride in outcome.rides) >= 58, place
        assert outcome.state == PARTIAL


@settings(max_examples=80, deadline=None)
@given(st.lists(st.tuples(st.integers(0, len(WHOLE) - 1), st.integers(1, 255)), max_size=12))
def test_no_bit_flips_crash_the_reader_or_pass_as_a_sound_file(
    flips: list[tuple[int, int]],
) -> None:
    damaged = bytearray(WHOLE)
    for position, mask in flips:
        damaged[position] ^= mask

    outcome = read_file("ride.fit", bytes(damaged))

    assert is_sensible(outcome)
    # A header checksum of 0 and an old protocol version are legal, so the header may differ.
    if bytes(damaged)[14:] != WHOLE[14:]:
        assert outcome.state != COMPLETE


@settings(max_examples=60, deadline=None)
@given(st.binary(max_size=400), st.sampled_from(["ride.fit", "ride", "x.csv", "../../etc/x"]))
def test_random_bytes_never_crash_the_reader(noise: bytes, name: str) -> None:
    assert is_sensible(read_file(name, noise))
    assert is_sensible(read_file(name, WHOLE[:14] + noise))


@pytest.mark.parametrize(
    ("contents", "code", "told"),
    [
        (b"", "empty_file", "empty"),
        (b"<!DOCTYPE html><html>Not found</html>", "unsupported_format", "HTML"),
        (b'<?xml version="1.0"?><gpx></gpx>', "no_records", "no point"),
        (b'<?xml version="1.0"?><kml></kml>', "unsupported_format", "XML"),
        (b"PK\x03\x04" + bytes(60), "unsupported_format", "ZIP"),
        (b"\x1f\x8b\x08" + bytes(60), "container_damaged", "gzip"),
        (b"\x7fELF" + bytes(60), "unsupported_format", "ELF"),
        (b"\xff\xd8\xff\xe0" + bytes(60), "unsupported_format", "JPEG"),
        (b'{"error": "denied"}', "unsupported_format", "JSON"),
        (bytes(range(64)), "unknown_format", "00 01 02 03"),
    ],
)
def test_what_is_no_ride_is_refused_by_its_name(contents: bytes, code: str, told: str) -> None:
    outcome = read_file("ride.fit", contents)

    assert (outcome.state, outcome.code) == (REJECTED, code)
    assert told in str(outcome.detail)


def test_a_file_without_records_is_no_activity() -> None:
    settings_file = enclosed(definition(0, 2, [(1, 1, 0x02)]) + b"\x00\x05")

    outcome = read_fit(settings_file)

    assert (outcome.state, outcome.code) == (REJECTED, "no_records")
