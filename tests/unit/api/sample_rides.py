"""A ride as the API answers it."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from backend.core.ride import RideSummary

SAMPLE_RIDE: dict[str, Any] = {
    "id": 1,
    "state": "done",
    "origin": "imported",
    "name": "over the pass",
    "notes": "",
    "started_at": "2023-11-14T22:13:20Z",
    "row_count": 7200,
    "period_us": 1_000_000,
    "channels": [{"name": "speed_kmh", "unit": "km/h", "scale": 0.01, "derived": False}],
    "motor_torque_meaning": None,
    "unit_key": None,
    "bike_id": None,
    "device": dict.fromkeys(
        (
            "device_id",
            "device_serial",
            "device_model",
            "firmware_version",
            "config_generation",
            "config_crc32",
            "gear_ratio",
        )
    ),
    "gaps": [],
    "filled": [],
    "events": [],
    "completeness": 1.0,
    "cut_short": False,
    "sport": None,
    "intake": None,
    "laps": [],
    "pauses": [],
    "instruments": [],
    "statements": [],
    "upload_id": None,
    "object_bytes": 4096,
    "damage": None,
    "same_ride_as": None,
    "owner_id": None,
    "outdone": False,
    "tags": ["winter"],
    "place": {"name": "Dublin", "country": "IE", "zone": "Europe/Dublin", "is_loop": False},
    "speed_line_kmh": [20.0, None] * 32,
    "doubts": [],
    "summary": {**dict.fromkeys(field.name for field in fields(RideSummary)), "duration_s": 7200.0},
}
