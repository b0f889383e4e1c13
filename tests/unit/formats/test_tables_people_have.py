"""Goal: numbers as people write them and tables of the loggers of e-bikes and their riders are
read; what is open is asked, and what cannot be read is said.

Method: small tables written here after each program's own description of its header.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.formats.formats import read_file
from backend.formats.outcome import ImportedRide, Outcome
from backend.formats.questions import TableAnswer

ROWS = 60
ZONE = TableAnswer("UTC")


def table(header: str, row: str, rows: int = ROWS) -> bytes:
    """row: a pattern of `format` with n, the row's number, and t, the time of day."""
    lines = [header] + [row.format(n=n, t=f"10:00:{n:02}") for n in range(rows)]
    return "\n".join(lines).encode()


def read(data: bytes, answer: TableAnswer = ZONE, name: str = "ride.csv") -> Outcome:
    return read_file(name, data, answer)


def ride_of(data: bytes, answer: TableAnswer = ZONE, name: str = "ride.csv") -> ImportedRide:
    outcome = read(data, answer, name)
    assert outcome.state == "complete", outcome
    (ride,) = outcome.rides
    return ride


def values(ride: ImportedRide, name: str) -> np.ndarray:
    channel = next(one for one in ride.rows.channels if one.name == name)
    return channel.to_values(ride.rows.counts[name])


@pytest.mark.parametrize(
    ("separator", "cell"),
    [
        (";", "1.234,5"),
        (",", '"1,234.5"'),
        (";", "1'234,5"),
        (";", "1 234,5"),
        (";", "1234.5"),
        (",", '"1234,5"'),
        (",", "1234.5 m"),
        (",", "1.2345e3"),
    ],
)
def test_a_height_of_1234_and_a_half_is_that_however_it_is_written(
    separator: str, cell: str
) -> None:
    header = separator.join(("time", "altitude (m)", "cadence"))
    data = table(header, separator.join(("2025-05-01 {t}", cell, "{n}")))

    assert values(ride_of(data), "altitude_m") == pytest.approx(1234.5, abs=0.11)


def test_percent_signs_and_units_in_cells_are_no_text() -> None:
    data = table("time,speed,battery", "2025-05-01 {t},{n} mph,8{n} %", rows=10)

    ride = ride_of(data)

    assert values(ride, "speed_kmh")[9] == pytest.approx(9 * 1.609344, abs=0.01)
    assert values(ride, "battery_soc_pct").tolist() == [80.0 + n for n in range(10)]


def test_three_digits_behind_a_mark_follow_the_rest_of_the_table() -> None:
    """1.005 m of a German table are a kilometre, where another column has 21,5."""
    data = table("Zeit;Distanz (m);Tempo (km/h)", "2025-05-01 {t};1.0{n:02};21,5")

    distance_m = values(ride_of(data), "distance_m")

    assert distance_m[-1] - distance_m[0] == pytest.approx(ROWS - 1)


def test_the_separator_is_that_of_all_lines_not_of_the_first() -> None:
    data = b"Ride of Tuesday, with Anna, Tom\n" + table(
        "time;speed (km/h);cadence", "2025-05-01 {t};2{n},5;80"
    )

    assert values(ride_of(data), "cadence_rpm").tolist() == [80.0] * ROWS


def test_a_column_that_can_hardly_be_read_is_asked_about_with_a_sample() -> None:
    data = table("time,speed (km/h),cadence", "2025-05-01 {t},{n} (est.) x{n},80")

    outcome = read(data)

    assert outcome.code == "needs_mapping"
    assert outcome.question is not None
    (asked,) = [one for one in outcome.question.columns if one.channels]
    assert (asked.name, asked.unread) == ("speed (km/h)", ROWS)
    assert asked.samples[0] == "0 (est.) x0"
    left_out = read(data, TableAnswer("UTC", channels={"speed (km/h)": ""}))
    assert left_out.state == "complete"


@pytest.mark.parametrize(
    ("header", "row", "whose"),
    [
        ("time,voltage (V),current (A),power (W)", "2025-05-01 {t},36,{n},", "battery_power_w"),
        ("time,cadence,power (W)", "2025-05-01 {t},80,", "rider_power_w"),
    ],
)
def test_what_stands_beside_a_power_says_whose_it_is(header: str, row: str, whose: str) -> None:
    data = "\n".join(
        [header] + [row.format(t=f"10:00:{n:02}", n=n) + str(36 * n) for n in range(ROWS)]
    ).encode()

    names = {channel.name for channel in ride_of(data).rows.channels}

    assert names & {"battery_power_w", "rider_power_w", "motor_power_w"} <= {whose}


def test_a_power_that_may_be_anyones_is_asked_once() -> None:
    """A percentage called power is no power at all, and asked about by nobody."""
    assert read(table("time,speed (km/h),power (%)", "2025-05-01 {t},20,8{n}")).code is None
    data = table("time,speed (km/h),voltage (V),power (W)", "2025-05-01 {t},20,36,1{n:02}")

    outcome = read(data)

    assert outcome.question is not None
    (asked,) = [one for one in outcome.question.columns if one.channels]
    assert {"rider_power_w", "motor_power_w", "battery_power_w"} <= set(asked.channels)
    ride = ride_of(data, TableAnswer("UTC", channels={asked.name: "battery_power_w"}))
    assert "rider_power_w" not in {channel.name for channel in ride.rows.channels}


def test_an_owner_says_what_any_column_is() -> None:
    data = table("time,speed (km/h),foo", "2025-05-01 {t},20,9{n}")

    ride = ride_of(data, TableAnswer("UTC", channels={"foo": "heart_rate_bpm"}))

    assert values(ride, "heart_rate_bpm")[5] == 95.0


def test_euc_world() -> None:
    header = (
        "datetime,duration,duration_riding,distance,distance_total,speed,voltage,current,"
        "current_phase,power,battery,temp,temp_motor,safety_margin,gps_lat,gps_lon,gps_alt,hr"
    )
    row = (
        "2025-05-01T{t}.000+0200,{n},{n},0.0{n:02},1234.0{n:02},25.5,66.6,10,20,666,88,31,41,50,"
        "48.1,11.5,520,130"
    )
    ride = ride_of(table(header, row))

    assert ride.started_us == 1_746_086_400 * 1_000_000
    assert values(ride, "battery_power_w") == pytest.approx(666.0)
    assert values(ride, "motor_temperature_degc") == pytest.approx(41.0)
    assert values(ride, "distance_m")[-1] == pytest.approx(59.0)


def test_floaty_counts_in_milliseconds_and_zero_degrees_are_no_temperature() -> None:
    header = (
        "timestamp,speed,dutyCycle,batteryVolts,batteryPercent,batteryCurrent,motorCurrent,"
        "motorTemp,controllerTemp,tripDistance,altitude,latitude,longitude"
    )
    rows = [header] + [
        f"{1_746_093_600_000 + 1000 * n},21,0.3,66.6,0.88,10,20,0,35,{n},520,48.1,11.5"
        for n in range(ROWS)
    ]
    answer = TableAnswer("UTC", units={"speed": "km/h", "tripDistance": "m"})

    ride = ride_of("\n".join(rows).encode(), answer)

    assert ride.started_us == 1_746_093_600 * 1_000_000
    assert values(ride, "battery_soc_pct") == pytest.approx(88.0)
    assert "motor_temperature_degc" not in {channel.name for channel in ride.rows.channels}


def test_racechrono_states_units_and_sources_below_its_header() -> None:
    preamble = "This file is created using RaceChrono\nFormat,3\nSession title,Commute\n\n"
    header = "timestamp,fragment_id,lap_number,elapsed_time,distance_traveled,speed,speed,altitude"
    units = "unix time,,,s,m,m/s,m/s,m\n,,,,,100: gps,200: calc,100: gps\n"
    rows = "\n".join(f"{1_746_093_600 + n}.000,0,1,{n},{10 * n},10.0,10.1,520" for n in range(ROWS))

    ride = ride_of(f"{preamble}{header}\n{units}{rows}".encode())

    assert ride.started_us == 1_746_093_600 * 1_000_000
    assert values(ride, "speed_kmh") == pytest.approx(36.0, abs=0.01)
    assert values(ride, "distance_m")[-1] == pytest.approx(590.0)


def test_polar_flow_states_date_and_time_in_a_row_above() -> None:
    data = (
        "Name,Sport,Date,Start time,Duration\n"
        "Anna,CYCLING,20-06-2018,11:17:03,00:01:00\n"
        "Sample rate,Time,HR (bpm),Speed (km/h),Cadence,Altitude (m),Distances (m),Power (W)\n"
        + "\n".join(
            f"{'1' if not n else ''},00:00:{n:02},131,25.2,80,104,{7 * n},150" for n in range(ROWS)
        )
    )

    ride = ride_of(data.encode())

    assert ride.started_us == 1_529_493_423 * 1_000_000
    assert values(ride, "rider_power_w") == pytest.approx(150.0)
    assert values(ride, "distance_m")[-1] == pytest.approx(413.0)
