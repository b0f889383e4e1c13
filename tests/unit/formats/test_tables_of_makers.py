"""Goal: tables of head units, of the Cycle Analyst and of VESC Tool become the ride they tell, each
number in its unit and with its owner; damage costs the rows it hit and raises nothing.

Method: files written here after the makers' layouts; what they should say is computed beside them.
"""

from __future__ import annotations

import random

import numpy as np
import pytest

from backend.formats.formats import read_file
from backend.formats.outcome import COMPLETE, PARTIAL, REJECTED, ImportedRide
from backend.formats.questions import TableAnswer
from tests.fakes.kept_rides import column_of

POWERTAP = "Minutes, Torq (N-m),Km/h,Watts,Km,Cadence,Hrate,ID\r\n" + "".join(
    f"{(row + 1) * 0.021:.3f},{8.1 + row * 0.1:.1f},25.2,{180 + row},{row * 0.0088:.4f},"
    "85,140,1\r\n"
    for row in range(40)
)
JOULE = (
    'Version,Date/Time,Km,Minutes,RPE,Tags,"Weight, kg","Work, kJ",FTP,"Sample Rate, s",'
    "Device Type,Firmware Version,Last Updated,Category 1,Category 2\r\n"
    "6,2012-11-27 13:40:41,0,0,0,,55.8,788,227,1,Joule,18.018,,0,\r\n"
    "User Name,Power Zone 1\r\n,0\r\n"
    "Minutes, Torq (N-m),Km/h,Watts,Km,Cadence,Hrate,ID,Altitude (m),"
    'Temperature (°C),"Grade, %"\r\n'
) + "".join(f"{row / 60:.6f},8.1,25.2,180,0.1,85,140,1,62,16.7,0.5\r\n" for row in range(30))
ERGOMO = (
    "ZEIT;STRECKE;POWER;RPM;SPEED;PULS;HÖHE;TEMP;INTERVAL;PAUSE\r\n"
    "L_SEC;KM;WATT;RPM;KM/H;BPM;METER;°C;NUM;SEC\r\n"
) + "".join(
    f"{row * 5};{row * 0.035:.3f};200;90;25,2;150;{400 + row};18,5;1;{60 if row == 9 else 0}\r\n"
    for row in range(20)
).replace(".", ",")
CHEETAH = "secs,cad,hr,km,kph,nm,watts,alt,lon,lat,headwind,slope,temp,interval\n" + "".join(
    f"{row},90,150,{row * 0.007:.5f},25.2,21.23,200,{400 + row},11.5,{48 + row * 1e-5:.6f},"
    "0,0,-255,0\n"
    for row in range(30)
)
IBIKE = (
    "iBike,8,english\n2008,8,8,6,32,52\n\n0,0,0,0,1,0\n"
    "Speed (mph),Wind Speed (mph),Power (W),Distance (miles),Cadence (RPM),Heartrate (BPM),"
    "Elevation (feet),Hill slope (%),Internal,Internal,Internal,DFPM Power,Latitude,Longitude\n"
) + "".join(f"15.0,2.0,{180 + r},{r / 240:.5f},85,140,100,1,0,0,0,0,0,0\n" for r in range(30))
CA_NAMES = tuple("Ah V A S D Deg RPM HW Nm ThI ThO AuxA AuxD Flgs".split())  # noqa: SIM905


def analyst(rows: int, rate_hz: float, header: bool = True, first_km: float = 0.0) -> str:
    """At 36 km/h; 20 Nm and 60 rpm are 125.7 W of the rider; the battery gives 4 A at 50 V."""
    lines = ["\t".join(CA_NAMES)] if header else []
    lines += [
        f"{row * 4 / 3600 / rate_hz:.4f}\t50.0\t4.00\t36.0\t{first_km + row * 0.01 / rate_hz:.4f}\t"
        "41.5\t60.0\t125.7\t20.0\t0.83\t1.52\t0\t0\t1XB"
        for row in range(rows)
    ]
    return "\r\n".join(lines) + "\r\n"


VESC = (
    "ms_today;input_voltage;temp_mos_max;temp_motor;current_motor;current_in;erpm;duty_cycle;"
    "fault_code;speed_meters_per_sec;tacho_meters;tacho_abs_meters;battery_level;"
    "gnss_lat;gnss_lon;gnss_alt\n"
) + "".join(
    f"{86_399_000 + 100 * row if row < 10 else 100 * row - 1000};50.2;31.5;0;12.25;4.125;3000;0.35;"
    f"0;5.5;{0.55 * row:.2f};{0.55 * row:.2f};0.805;0;0;0\n"
    for row in range(30)
)
KM = TableAnswer(None, {"S": "km/h", "D": "km"})
FILES: dict[str, tuple[str, bytes, TableAnswer | None]] = {
    "powertap": ("ride.csv", POWERTAP.encode(), None),
    "joule": ("joule.csv", JOULE.encode("latin-1"), TableAnswer("Europe/Berlin")),
    "ergomo": ("e.csv", ERGOMO.encode("latin-1"), None),
    "cheetah": ("2012_11_27_13_40_41.csv", CHEETAH.encode(), TableAnswer("Europe/Berlin")),
    "ibike": ("i.csv", IBIKE.encode(), TableAnswer("America/New_York")),
    "analyst": ("CAlog_7.txt", analyst(600, 10.0).encode(), KM),
    "vesc": ("2024-10-10_23-59-59.csv", VESC.encode(), TableAnswer("Europe/Dublin")),
}


def ride_of(name: str) -> ImportedRide:
    file, data, said = FILES[name]
    outcome = read_file(file, data, said)
    assert outcome.state == COMPLETE, outcome.detail
    (ride,) = outcome.rides
    return ride


def taken_as(ride: ImportedRide) -> dict[str, str]:
    assert ride.intake is not None
    return dict(ride.intake.taken_as)


def test_a_powertap_s_torque_is_that_of_the_wheel_and_its_ride_has_no_date() -> None:
    ride = ride_of("powertap")

    assert column_of(ride, "wheel_torque_nm")[1] == pytest.approx(8.2)
    assert "rider_torque_nm" not in {channel.name for channel in ride.rows.channels}
    assert column_of(ride, "rider_power_w")[:2] == [180.0, 181.0]
    assert column_of(ride, "distance_m")[10] == pytest.approx(88.0)
    assert ride.period_us == 1_260_000
    assert not ride.start_known
    assert taken_as(ride) == {"start": "none"}


def test_a_joule_s_file_is_latin_1_and_begins_at_its_own_clock() -> None:
    ride = ride_of("joule")

    assert ride.started_us == 1_354_020_041 * 1_000_000  # 13:40:41 in Berlin, an hour before UTC
    assert column_of(ride, "temperature_degc")[0] == pytest.approx(16.7)
    assert len(ride.rows.times_us) == 30


def test_an_ergomo_s_pause_is_time_and_its_commas_are_points() -> None:
    ride = ride_of("ergomo")

    steps = np.diff(ride.rows.times_us)
    assert steps[9] == 65_000_000
    assert (np.delete(steps, 9) == 5_000_000).all()
    assert column_of(ride, "speed_kmh")[0] == pytest.approx(25.2)
    assert column_of(ride, "distance_m")[2] == pytest.approx(70.0)


def test_a_golden_cheetah_file_has_its_date_in_its_name_and_minus_255_is_no_temperature() -> None:
    ride = ride_of("cheetah")

    assert ride.started_us == 1_354_020_041 * 1_000_000
    assert taken_as(ride) == {"time_zone": "Europe/Berlin", "start": "file_name"}
    assert "temperature_degc" not in {channel.name for channel in ride.rows.channels}
    assert column_of(ride, "torque_nm")[0] == pytest.approx(21.23)
    assert column_of(ride, "latitude_deg")[2] == pytest.approx(48.00002, abs=1e-9)


def test_an_ibike_s_miles_and_feet_are_kilometres_and_metres() -> None:
    ride = ride_of("ibike")

    assert ride.period_us == 1_000_000
    assert column_of(ride, "speed_kmh")[0] == pytest.approx(15 * 1.609344)
    assert column_of(ride, "altitude_m")[0] == pytest.approx(30.48)
    assert "latitude_deg" not in {channel.name for channel in ride.rows.channels}


@pytest.mark.parametrize("rate_hz", [1.0, 5.0, 10.0])
def test_a_cycle_analyst_s_rate_is_found_by_its_odometer(rate_hz: float) -> None:
    (ride,) = read_file("CAlog_7.txt", analyst(900, rate_hz).encode(), KM).rides

    assert ride.period_us == round(1e6 / rate_hz)
    assert taken_as(ride)["rows_per_second"] == f"{rate_hz:g}"


def test_a_cycle_analyst_tells_rider_and_battery_apart_and_is_asked_for_its_kilometres() -> None:
    file, data, _ = FILES["analyst"]
    asked = read_file(file, data).question
    assert asked is not None
    assert {c.name: c.units for c in asked.columns if c.units} == {
        "S": ("km/h", "mph"),
        "D": ("km", "mi"),
    }

    ride = ride_of("analyst")

    assert column_of(ride, "rider_torque_nm")[0] == pytest.approx(20.0)
    assert column_of(ride, "rider_power_w")[0] == pytest.approx(20.0 * 60 * 2 * np.pi / 60, abs=0.1)
    assert column_of(ride, "battery_current_a")[0] == pytest.approx(4.0)
    assert "motor_power_w" not in {channel.name for channel in ride.rows.channels}
    assert not ride.start_known


def test_a_log_that_began_without_its_header_and_was_reset_is_two_rides() -> None:
    text = analyst(300, 1.0, header=False, first_km=7.0) + analyst(200, 1.0, header=False)

    rides = read_file("CAlog_7.txt", text.encode(), KM).rides

    assert [len(ride.rows.times_us) for ride in rides] == [300, 200]


def test_a_vesc_log_goes_over_midnight_and_has_no_position_without_a_receiver() -> None:
    ride = ride_of("vesc")

    assert ride.period_us == 100_000
    assert ride.started_us == 1_728_601_199 * 1_000_000  # 23:59:59 in Dublin, UTC+1
    assert column_of(ride, "speed_kmh")[0] == pytest.approx(19.8)
    assert column_of(ride, "battery_soc_pct")[0] == pytest.approx(80.5)
    assert column_of(ride, "motor_current_a")[0] == pytest.approx(12.25)
    names = {channel.name for channel in ride.rows.channels}
    # Nobody knows whether a thermistor is fitted: it is no motor temperature.
    assert not names & {"latitude_deg", "altitude_m", "motor_temperature_degc"}
    assert "temp_motor" in names


@pytest.mark.parametrize("name", FILES)
def test_every_row_is_kept_or_counted(name: str) -> None:
    intake = ride_of(name).intake

    assert intake is not None
    dropped = sum(intake.rows_dropped.values())
    assert intake.rows_read == intake.rows_kept + intake.rows_joined + dropped
    assert intake.rows_kept == len(ride_of(name).rows.times_us)


@pytest.mark.parametrize("name", FILES)
def test_encodings_and_line_ends_make_no_difference(name: str) -> None:
    file, data, said = FILES[name]
    text = data.decode("latin-1" if name in ("joule", "ergomo") else "utf-8")
    plain = ride_of(name)

    for other in (
        text.replace("\r\n", "\n").encode("utf-8-sig"),
        text.replace("\r\n", "\n").replace("\n", "\r\n").encode("utf-16"),
        ("\n" + text).encode(),
    ):
        (ride,) = read_file(file, other, said).rides
        assert ride.rows.times_us.tolist() == plain.rows.times_us.tolist()
        for channel, told in plain.rows.counts.items():
            assert ride.rows.counts[channel].tolist() == told.tolist(), channel


@pytest.mark.parametrize("name", FILES)
def test_a_table_cut_anywhere_keeps_its_whole_rows(name: str) -> None:
    file, data, said = FILES[name]
    whole = ride_of(name)
    ends = [at + 1 for at, byte in enumerate(data) if byte == 0x0A]

    for length in range(ends[8], len(data), len(data) // 100):
        outcome = read_file(file, data[:length], said)

        if outcome.state == REJECTED:
            continue
        rows = sum(len(ride.rows.times_us) for ride in outcome.rides)
        assert rows <= len(whole.rows.times_us)
        (ride,) = outcome.rides
        same = slice(0, rows - 1)
        assert ride.rows.times_us[same].tolist() == whole.rows.times_us[same].tolist(), length


@pytest.mark.parametrize("name", FILES)
def test_flipped_bits_raise_nothing(name: str) -> None:
    file, data, said = FILES[name]
    chance = random.Random(11)

    for _ in range(60):
        damaged = bytearray(data)
        for _ in range(chance.randrange(1, 20)):
            damaged[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
        assert read_file(file, bytes(damaged), said).state in (COMPLETE, PARTIAL, REJECTED)
