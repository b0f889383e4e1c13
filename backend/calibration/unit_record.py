"""The unit's record of its calibration: parameters to coefficients, and what is to be written."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from backend.calibration.coefficients import Coefficients
from backend.device.configuration import Value

PARAMETER_OF = {
    "offset_counts": "sensor_offset_counts",
    "gain_nm_per_count": "sensor_gain_nm_per_count",
    "offset_counts_per_k": "sensor_offset_counts_per_k",
    "gain_share_per_k": "sensor_gain_share_per_k",
    "reference_degc": "sensor_reference_degc",
}
CALIBRATED_AT, NUMBER = "calibrated_at_utc_s", "calibration_number"
CERTIFICATE = "calibration_certificate"
RECORD = (*PARAMETER_OF.values(), CALIBRATED_AT, NUMBER, CERTIFICATE)
CERTIFICATE_BYTES = 8
"""Of the certificate's SHA-256 in the unit."""


def record_of(parameters: Mapping[str, Value]) -> dict[str, Any]:
    """A unit's record, of those parameters that it has."""
    return {name: parameters[name] for name in RECORD if name in parameters}


def coefficients_of(record: Mapping[str, Any]) -> Coefficients | None:
    """The coefficients of a record; None of one without offset and gain."""
    values = {name: record.get(parameter) for name, parameter in PARAMETER_OF.items()}
    offset, gain = values["offset_counts"], values["gain_nm_per_count"]
    if offset is None or gain is None or not gain > 0:
        return None
    optional = {
        name: None if value is None else float(value)
        for name, value in values.items()
        if name not in ("offset_counts", "gain_nm_per_count")
    }
    return Coefficients(float(offset), float(gain), **optional)


def record_to_write(
    read_back: Mapping[str, Any], coefficients: Coefficients, calibrated_us: int, sha256: str
) -> dict[str, Any]:
    """What goes into a unit with the record `read_back`: only what it has a place for.

    A temperature coefficient that the captures could not tell stays as it was: at the reference,
    where they were taken, it changes nothing.
    """
    record: dict[str, Any] = {}
    for name, parameter in PARAMETER_OF.items():
        value = getattr(coefficients, name)
        record[parameter] = read_back.get(parameter) if value is None else value
    record[CALIBRATED_AT] = calibrated_us // 1_000_000
    record[NUMBER] = int(read_back.get(NUMBER) or 0) + 1
    record[CERTIFICATE] = list(bytes.fromhex(sha256)[:CERTIFICATE_BYTES])
    return {name: value for name, value in record.items() if name in read_back}
