"""Why a port does not open or is gone, in words: which port, the cause, the remedy."""

from __future__ import annotations

import errno

from backend.errors import LinkError


def cannot_open(name: str, error: OSError) -> LinkError:
    """Translate a failed open of the port `name` into cause and remedy."""
    number = error.errno
    text = str(error).lower()
    if number in (errno.EACCES, errno.EPERM):
        return LinkError(
            f"{name}: not allowed to open it. On Linux, add yourself to the group that owns the "
            "port (`sudo usermod -aG dialout $USER`, on Arch `uucp`) and sign in again.",
            code="port_permission",
        )
    if number in (errno.EBUSY, errno.EAGAIN) or "exclusively lock" in text:
        return LinkError(
            f"{name}: another program has it open. Close that program (a serial monitor, a second "
            "Spindle, ModemManager) and it is taken up by itself.",
            code="port_busy",
        )
    if number in (errno.ENOENT, errno.ENODEV, errno.ENXIO) or "filenotfound" in text:
        return LinkError(
            f"{name}: there is no such port. Plug the unit in or pick a port from the list; it is "
            "taken up by itself when it appears.",
            code="port_absent",
        )
    if number == errno.ECONNREFUSED:
        return LinkError(
            f"{name}: nothing listens there. Start the unit or the bridge "
            "(`spindle sim --tcp PORT`) and check host and port.",
            code="port_absent",
        )
    if isinstance(error, TimeoutError):
        return LinkError(
            f"{name}: the host does not answer. Check the address and the network.",
            code="port_absent",
        )
    return LinkError(f"{name}: cannot be opened ({error}). Check the cable and the name.")


def another_adapter(name: str, usb_serial_number: str) -> LinkError:
    """Say that the port `name` is another adapter's since the one we had was unplugged."""
    return LinkError(
        f"{name}: another adapter has this name now, and the one with serial number "
        f"{usb_serial_number} is not plugged in. Plug that one in and it is taken up by itself, or "
        "remove this device and add the port anew.",
        code="port_absent",
    )


def vanished(name: str, cause: object) -> LinkError:
    """Say that an open port went away while it was used."""
    return LinkError(
        f"{name}: the port vanished ({cause}). Check cable and power; it is taken up again by "
        "itself when it returns.",
        code="port_vanished",
    )
