"""Which unit a request is for: a connection may lead to another one by the time it comes."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import unquote

from fastapi import Depends, Header

from backend.units.service import Devices
from backend.web.services import provided

KEY_MAX = 1200


def check_meant(
    device_id: str,
    devices: Annotated[Devices, provided("devices")],
    spindle_unit: Annotated[
        str | None,
        Header(
            description="The `unit_key` of the unit the request is for, percent-encoded UTF-8. At "
            "another one the answer is 412 `other_unit`, and nothing is changed.",
            max_length=KEY_MAX,
        ),
    ] = None,
) -> None:
    """Refuse what is meant for another unit than the one on the connection. Raises OtherUnit."""
    if spindle_unit is not None:
        devices.check_meant(device_id, unquote(spindle_unit))


FOR_ONE_UNIT = [Depends(check_meant)]
"""Dependencies of every operation under `/devices/{device_id}`."""
