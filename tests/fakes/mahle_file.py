"""A ride as Mahle's My SmartBike exports it, made here: what says a thing twice agrees."""

from __future__ import annotations

import json
from datetime import UTC, datetime, timedelta
from typing import Any

# Points carry the rider's clock, two hours ahead of the totals'.
STARTED = datetime(2024, 7, 24, 15, 35, 43, tzinfo=UTC)
AHEAD = timedelta(hours=2)
EVERY_S = 4
SPEED_KMH = 18.0


def mahle_ride(count: int = 200, **members: Any) -> dict[str, Any]:
    """A ride of `count` points, 4 s apart, on a level road to the east, the motor on in its middle
    third. members: in place of the document's own."""
    points = [mahle_point(number, count) for number in range(count)]
    duration_s = EVERY_S * (count - 1)
    metres = round(SPEED_KMH / 3.6 * duration_s)
    return {
        "activity_name": "Zum Rhein",
        "description": "Gegen den Wind",
        "activity_visibility": "PRIVATE",
        "start_date": f"{STARTED:%Y-%m-%d %H:%M:%S}",
        "stop_date": f"{STARTED + timedelta(seconds=duration_s + 2):%Y-%m-%d %H:%M:%S}",
        "ride_time": duration_s,
        "total_distance": metres,
        "ride_distance": metres,
        "avg_speed": SPEED_KMH,
        "max_speed": SPEED_KMH,
        "calories": None,
        "avg_cadence": 60,
        "max_torque": 1023,
        "batteries": [{"battery_cycles": 12, "consumed_capacity": 5.5, "consumed_percentage": 2}],
        "weather": {"main": {"temp": 22.4}, "wind": {"deg": 293}},
        "max_rider_watts": max(point["rw"] for point in points),
        "avg_rider_watts": round(sum(point["rw"] for point in points) / count, 2),
        **members,
        "locations": points,
        "object_serial": "SI000100000000001",
        "device_uuid": "0123456789abcdef",
    }


def mahle_point(number: int, count: int) -> dict[str, Any]:
    """A point; every tenth pauses."""
    motor_on = count // 3 <= number < 2 * count // 3
    since_s = EVERY_S * number
    at = STARTED + AHEAD + timedelta(seconds=since_s + 1.28)
    return {
        "al": 1 if motor_on else 0,
        **({"aw": "PAUSE"} if number == count // 2 else {}),
        "bt": [
            {
                "bc": 12,
                "cc": round(244.8 - 0.1 * max(0, number - count // 3), 1),
                "po": 2.9 if motor_on else 0,
                "sc": 99,
                "tm": 23,
                "vl": 36.5,
            }
        ],
        "cp": 60 + number % 7,
        "gd": round(SPEED_KMH / 3.6 * since_s),
        "ge": 184.5,
        "la": 50.6210487,
        "lo": round(6.9614881 + 7e-5 * EVERY_S * number, 7),
        "mw": 88 if motor_on else 0,
        "or": 155900 + 100 * (number % 3),
        "rw": round(90.5 + number % 11, 2),
        "sl": -0.5,
        "sp": SPEED_KMH,
        "tm": 24,
        "ts": f"{at:%Y-%m-%d %H:%M:%S}.{at.microsecond // 1000:03}",
    }


def mahle_file(ride: dict[str, Any] | None = None) -> bytes:
    """The file's bytes, laid out as the export lays them out."""
    return json.dumps(ride or mahle_ride(), indent=2, ensure_ascii=False).encode()
