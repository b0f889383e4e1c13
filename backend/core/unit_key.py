"""The key of a unit: what its rides, its revisions and its bike are found by, whatever the cable.

    ebl:53504e444c45303030303031    family and serial number
    bafang:name:Commuter            a unit without a serial number, by its owner's name for it
    bafang:url:/dev/ttyUSB0         one with neither: only where it is connected is known

The last kind is a guess: the next unit on that port would have it too. Nothing is written to such a
unit, and it is on no bike, until somebody says which one it is.
"""

from __future__ import annotations

import hashlib

# The family of our own protocol: every unit of before units had keys.
EBL = "ebl"
# So much of a serial number is enough to tell the bikes of a workshop apart.
SERIAL_TAIL = 6


def unit_key(family: str, serial_number: str | None, name: str | None, url: str) -> str:
    """The key of a unit. name: its owner's; it counts only where there is no serial number."""
    if serial_number is not None:
        return serial_key(family, serial_number)
    return f"{family}:name:{name}" if name is not None else f"{family}:url:{url}"


def serial_key(family: str, serial_number: str) -> str:
    """The key of a unit that has a serial number."""
    return f"{family}:{serial_number}"


def serial_of(key: str) -> str | None:
    """The serial number in a key; None of a unit without one."""
    number = key.partition(":")[2]
    return None if number.startswith(("name:", "url:")) else number


def ebl_key(serial_number: str | None) -> str | None:
    """The key of a unit from something that is older than keys; None where it names no unit."""
    return None if serial_number is None else serial_key(EBL, serial_number)


def identifies_unit(key: str) -> bool:
    """Whether a key names one unit, and not whatever is behind a url."""
    return not key.partition(":")[2].startswith("url:")


def unit_tag(key: str) -> str:
    """Eight hex digits that name a unit where its key would be too long or not ASCII."""
    return hashlib.sha256(key.encode()).hexdigest()[:8]


def bike_name(key: str, name: str | None, model: str | None) -> str:
    """What a bike is called that was made for a unit: its owner's word, else model and number."""
    _, *rest = key.split(":", 2)
    if name is None and rest[0] == "name":
        name = rest[-1]
    return name or " ".join(filter(None, (model, rest[-1][-SERIAL_TAIL:])))
