"""The ports there are: what hangs on each, who has it open, whether we may."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from serial.tools import list_ports as pyserial_ports

from backend.core.described import described

DeviceKind = Literal["simulated", "serial", "socket"]


@described
class Port:
    """A place where a unit may be: pass `url` to `POST /devices`."""

    url: str
    kind: DeviceKind
    description: str
    """In the adapter's own words."""
    manufacturer: str | None = None
    usb_vendor_id: int | None = None
    usb_product_id: int | None = None
    usb_serial_number: str | None = None
    """Finds the same adapter again under a new name."""
    in_use: bool | None = None
    """null where it is unknown without opening it."""
    hint: str | None = None
    """What stands in the way and what to do about it."""
    hint_code: str | None = None
    """A word for the hint: `port_permission` or `port_busy`, as a device's `reason_code`."""


SIMULATED = Port(
    url="sim", kind="simulated", description="A simulated drive unit, started by Spindle"
)


def is_character_device(name: str) -> bool | None:
    """What kind of file this is; None where there is none, or none that can be looked at."""
    try:
        return stat.S_ISCHR(Path(name).stat().st_mode)
    except (OSError, ValueError):
        return None


def list_ports() -> list[Port]:
    """Every serial port of this machine, without opening any, and the simulated unit."""
    ports = sorted(pyserial_ports.comports(), key=lambda port: str(port.device))
    holders = _open_devices()
    return [_describe(port, holders) for port in ports] + [SIMULATED]


def device_with_usb_serial(number: str) -> str | None:
    """The port the USB adapter with this serial number has now, None when it is not plugged in."""
    for port in pyserial_ports.comports():
        if port.serial_number == number:
            return str(port.device)
    return None


def usb_serial_of(device: str) -> str | None:
    """The serial number of the USB adapter behind `device`, None when it has none."""
    for port in pyserial_ports.comports():
        if port.device == device:
            return str(port.serial_number) if port.serial_number else None
    return None


def _describe(port: pyserial_ports.ListPortInfo, holders: set[str] | None) -> Port:
    device = str(port.device)
    in_use = None if holders is None else os.path.realpath(device) in holders
    hint, hint_code = _hint(device, in_use)
    return Port(
        url=device,
        kind="serial",
        description=str(port.description or device),
        manufacturer=port.manufacturer,
        usb_vendor_id=port.vid,
        usb_product_id=port.pid,
        usb_serial_number=port.serial_number,
        in_use=in_use,
        hint=hint,
        hint_code=hint_code,
    )


def _hint(device: str, in_use: bool | None) -> tuple[str, str] | tuple[None, None]:
    if os.name == "posix" and not os.access(device, os.R_OK | os.W_OK):
        return (
            "You may not open this port. Add yourself to the group that owns it "
            "(`sudo usermod -aG dialout $USER`, on Arch `uucp`) and sign in again.",
            "port_permission",
        )
    if in_use:
        return "A program has this port open.", "port_busy"
    return None, None


def _open_devices() -> set[str] | None:
    """Files under /dev that a process we may look at has open; None where that is unknown."""
    if not sys.platform.startswith("linux"):
        return None
    return {target for target in _link_targets(Path("/proc")) if target.startswith("/dev/tty")}


def _link_targets(proc: Path) -> Iterable[str]:
    for process in proc.glob("[0-9]*"):
        try:
            for descriptor in (process / "fd").iterdir():
                yield str(descriptor.readlink())
        except OSError:
            continue
