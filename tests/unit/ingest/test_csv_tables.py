"""Goal: our own CSV comes back as the same ride, and tables of others by their field names.

Method: texts written here; the sentinel and unit traps are those of a public e-bike data set.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.ingest.csv_rows import read_csv
from backend.ingest.formats import read_file
from backend.ingest.outcome import COMPLETE, REJECTED, ImportedRide


def column(ride: ImportedRide, name: str) -> list[float]:
    channel = next(channel for channel in ride.rows.channels if channel.name == name)
    found: list[float] = channel.to_values(ride.rows.counts[name]).tolist()
    return found


def test_our_own_export_comes_back() -> None:
    text = (
        "time_utc,t_s,speed_kmh,rider_torque_nm,fuzzy_gain\r\n"
        "2026-03-01T08:00:00.000Z,0,20.01,31.5,0.20005\r\n"
        "2026-03-01T08:00:00.010Z,0.01,20.02,,0.2001\r\n"
        "2026-03-01T08:00:00.020Z,0.02,20.03,-1.25,0.20015\r\n"
    )

    (ride,) = read_file("ride.csv", text.encode()).rides

    assert ride.period_us == 10_000
    assert column(ride, "speed_kmh") == pytest.approx([20.01, 20.02, 20.03])
    torque = column(ride, "rider_torque_nm")
    assert np.isnan(torque[1])
    assert torque[2] == pytest.approx(-1.25)
    assert column(ride, "fuzzy_gain") == pytest.approx([0.20005, 0.2001, 0.20015])


@pytest.mark.parametrize("data", [b"", b"\n", b"\xef\xbb\xbf", b"\r\n\r\n", b";"])
def test_a_table_without_a_table_is_rejected_and_raises_nothing(data: bytes) -> None:
    outcome = read_csv(data)

    assert (outcome.state, outcome.rides) == (REJECTED, ())


def test_a_makers_no_value_number_is_missing() -> None:
    text = (
        "timestamp,heart_rate,cadence,distance,speed\n"
        "2023-03-10T09:24:30,255,43,0.0,11.981\n"
        "2023-03-10T09:24:31,255,255,4.0,14.4\n"
        "2023-03-10T09:24:32,255,45,8.0,14.4\n"
    )

    (ride,) = read_csv(text.encode()).rides

    assert "heart_rate_bpm" not in [channel.name for channel in ride.rows.channels]
    assert np.isnan(column(ride, "cadence_rpm")[1])
    assert column(ride, "speed_kmh")[1] == pytest.approx(14.4, abs=0.01)


def test_semicolons_decimal_commas_and_a_byte_order_mark_are_read() -> None:
    text = "\ufefftime;speed_kmh\r\n2026-03-01T08:00:00Z;20,5\r\n2026-03-01T08:00:01Z;21,5\r\n"

    outcome = read_file("fahrt.csv", text.encode())

    assert outcome.state == COMPLETE
    assert column(outcome.rides[0], "speed_kmh") == pytest.approx([20.5, 21.5])


@pytest.mark.parametrize(
    "text",
    ["time,speed_kmh\n", "time,speed_kmh\nyesterday,20\n", "time,colour\n2026-01-01,red\n"],
)
def test_a_table_without_a_ride_is_refused_with_the_reason(text: str) -> None:
    outcome = read_file("x.csv", text.encode())

    assert outcome.state == REJECTED
    assert outcome.detail


@pytest.mark.parametrize(
    ("text", "code", "word"),
    [
        ("t_s\n0\n0.01\n", "no_records", "only column is t_s"),
        ("time\n2026-01-01\n", "no_records", "only column is time"),
        ("t_s,speed_kmh\n0,20\n", "no_valid_time", "add one of time_utc"),
    ],
)
def test_a_table_of_nothing_but_times_or_of_no_date_says_what_is_missing(
    text: str, code: str, word: str
) -> None:
    for name in ("ride.csv", "ride"):
        outcome = read_file(name, text.encode())

        assert (outcome.state, outcome.code) == (REJECTED, code)
        assert word in (outcome.detail or "")
