"""Goal: our own CSV comes back as the same ride, and tables of others by their field names.

Method: texts written here; the sentinel and unit traps are those of a public e-bike data set.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.formats.formats import read_file
from backend.formats.outcome import COMPLETE, PARTIAL, REJECTED
from backend.formats.questions import TableAnswer
from backend.formats.tables import read_table
from tests.fakes.kept_rides import column_of


def test_our_own_export_comes_back() -> None:
    text = (
        "time_utc,t_s,speed_kmh,rider_torque_nm,fuzzy_gain\r\n"
        "2026-03-01T08:00:00.000Z,0,20.01,31.5,0.20005\r\n"
        "2026-03-01T08:00:00.010Z,0.01,20.02,,0.2001\r\n"
        "2026-03-01T08:00:00.020Z,0.02,20.03,-1.25,0.20015\r\n"
    )

    (ride,) = read_file("ride.csv", text.encode()).rides

    assert ride.period_us == 10_000
    assert column_of(ride, "speed_kmh") == pytest.approx([20.01, 20.02, 20.03])
    torque = column_of(ride, "rider_torque_nm")
    assert np.isnan(torque[1])
    assert torque[2] == pytest.approx(-1.25)
    assert column_of(ride, "fuzzy_gain") == pytest.approx([0.20005, 0.2001, 0.20015])


@pytest.mark.parametrize("data", [b"", b"\n", b"\xef\xbb\xbf", b"\r\n\r\n", b";"])
def test_a_table_without_a_table_is_rejected_and_raises_nothing(data: bytes) -> None:
    outcome = read_table(data)

    assert (outcome.state, outcome.rides) == (REJECTED, ())


# As a public e-bike data set writes it: times of no zone, a speed of no unit.
NOTHING_SAID = (
    "timestamp,heart_rate,cadence,distance,speed,Weather\n"
    "2023-03-26T00:59:59,255,43,0.0,11.981,drizzle\n"
    "2023-03-26T02:00:00,255,255,4.0,14.4,drizzle\n"
    "2023-03-26T02:00:01,255,45,8.0,14.4,drizzle\n"
)
SAID = TableAnswer("Europe/Dublin", {"distance": "m", "speed": "km/h"})


def test_a_makers_no_value_number_is_missing() -> None:
    (ride,) = read_table(NOTHING_SAID.encode(), "", SAID).rides

    assert "heart_rate_bpm" not in [channel.name for channel in ride.rows.channels]
    assert np.isnan(column_of(ride, "cadence_rpm")[1])
    assert column_of(ride, "speed_kmh")[1] == pytest.approx(14.4, abs=0.01)


def test_a_table_of_no_unit_and_no_zone_is_not_read_until_its_owner_says_them() -> None:
    outcome = read_table(NOTHING_SAID.encode())

    assert (outcome.state, outcome.code, outcome.rides) == (REJECTED, "needs_mapping", ())
    assert outcome.question is not None
    assert outcome.question.time_zone
    asked = {c.name: c.units for c in outcome.question.columns if c.units}
    assert asked == {"distance": ("m", "km", "mi"), "speed": ("km/h", "m/s", "mph")}
    samples = {c.name: c.samples for c in outcome.question.columns}
    assert samples["speed"] == ("11.981", "14.4", "14.4")


@pytest.mark.parametrize(
    ("unit", "km_h"), [("km/h", 14.4), ("m/s", 14.4 * 3.6), ("mph", 14.4 * 1.609344)]
)
def test_what_is_said_decides_and_is_told_with_the_ride(unit: str, km_h: float) -> None:
    said = TableAnswer("Europe/Dublin", {"distance": "m", "speed": unit})

    (ride,) = read_table(NOTHING_SAID.encode(), "", said).rides

    assert column_of(ride, "speed_kmh")[1] == pytest.approx(km_h, abs=1e-9)
    assert ride.intake is not None
    assert ride.intake.taken_as == {"distance": "m", "speed": unit, "time_zone": "Europe/Dublin"}
    assert ride.intake.fields_unread == {"Weather": 3}


def test_a_clock_that_was_put_forward_within_the_ride_makes_no_gap_of_an_hour() -> None:
    """In Dublin 01:00 became 02:00 that night: two rows that are a second apart."""
    (ride,) = read_table(NOTHING_SAID.encode(), "", SAID).rides

    assert ride.rows.times_us.tolist() == [0, 1_000_000, 2_000_000]
    assert ride.started_us == 1_679_792_399 * 1_000_000


@pytest.mark.parametrize(
    "wrong",
    [
        TableAnswer("Europe/Atlantis", SAID.units),
        TableAnswer(None, SAID.units),
        TableAnswer("../../etc/passwd", SAID.units),
        TableAnswer("Europe/Dublin", {"speed": "knots", "distance": "m"}),
        TableAnswer("Europe/Dublin", {"speed": "km/h"}),
    ],
)
def test_an_answer_that_says_half_or_nonsense_is_none(wrong: TableAnswer) -> None:
    assert read_table(NOTHING_SAID.encode(), "", wrong).code == "needs_mapping"


@pytest.mark.parametrize(
    "header",
    ["time,Speed (km/h)", "time,speed [kph]", "time,speed_kmh", "Time;Speed (km/h)", "time\tkm/h"],
)
def test_a_table_that_says_unit_and_zone_asks_nothing(header: str) -> None:
    row = "2026-03-01T08:00:00+01:00" + header[4] + "21.5"

    (ride,) = read_table(f"{header}\n{row}\n".encode()).rides

    assert ride.started_us == 1_772_348_400 * 1_000_000
    assert column_of(ride, "speed_kmh") == pytest.approx([21.5])


def test_tables_of_one_header_share_a_question_and_others_do_not() -> None:
    def header(text: str) -> str:
        question = read_table(text.encode()).question
        assert question is not None
        return question.header_sha256

    later = NOTHING_SAID.replace("2023-03-26", "2024-07-01").replace("14.4", "20.1")
    assert header(later) == header(NOTHING_SAID)
    assert header(NOTHING_SAID.replace(",speed", ",enhanced_speed")) != header(NOTHING_SAID)


def test_rows_that_are_cut_short_are_told() -> None:
    text = "time,speed_kmh,cadence_rpm\n2026-03-01T08:00:00Z,20.5,70\n2026-03-01T08:00:01Z,2"

    outcome = read_table(text.encode())

    assert (outcome.state, outcome.code) == (PARTIAL, "truncated")


def test_semicolons_decimal_commas_and_a_byte_order_mark_are_read() -> None:
    text = "\ufefftime;speed_kmh\r\n2026-03-01T08:00:00Z;20,5\r\n2026-03-01T08:00:01Z;21,5\r\n"

    outcome = read_file("fahrt.csv", text.encode())

    assert outcome.state == COMPLETE
    assert column_of(outcome.rides[0], "speed_kmh") == pytest.approx([20.5, 21.5])


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
    ],
)
def test_a_table_of_nothing_but_times_says_what_is_missing(text: str, code: str, word: str) -> None:
    for name in ("ride.csv", "ride"):
        outcome = read_file(name, text.encode())

        assert (outcome.state, outcome.code) == (REJECTED, code)
        assert word in (outcome.detail or "")
