"""What a request may ask the server to open.

A request comes from whoever reaches the API; the command line comes from whoever owns the machine.
So a request names no file: not a simulated unit's flash, key or scenario, and no device of the
system that is not a serial port. It may name a host and port, since a unit behind TCP is just that.
"""

from __future__ import annotations

import os
from urllib.parse import parse_qs

from backend.device.ports import is_character_device, kind_of
from backend.errors import FieldError, InvalidRequest
from backend.law.scenarios import live_scenarios

# Settings of a simulated unit that are paths.
FILE_SETTINGS = frozenset({"flash", "unlock_key"})
NO_SCENARIO = "none"
# Where systems have their terminals; opening another device can do things (a watchdog starts).
TERMINALS = ("/dev/tty", "/dev/pts/", "/dev/cu.", "/dev/rfcomm", "/dev/ircomm", "/dev/usb/tts/")


def check_asked(url: str) -> None:
    """Raises InvalidRequest for a url that names a file or device of the server's machine."""
    kind = kind_of(url)
    settings = parse_qs(url.partition("?")[2], keep_blank_values=True)
    if kind == "simulated":
        for name in sorted(FILE_SETTINGS & settings.keys()):
            raise _refused(
                f"{name} names a file of this machine: only `spindle serve --device` may."
            )
        known = [NO_SCENARIO, *(name for name, _ in live_scenarios())]
        for scenario in settings.get("scenario", []):
            if scenario not in known:
                raise _refused(
                    f"There is no scenario {scenario!r}; there are {', '.join(known)}. A file of "
                    "your own is for `spindle serve --device`."
                )
    elif kind == "serial":
        name = url.strip().partition("?")[0]
        if is_character_device(name) and not os.path.realpath(name).startswith(TERMINALS):
            raise _refused(
                f"{name} is no serial port; one of another kind is for `spindle serve --device`."
            )


def _refused(message: str) -> InvalidRequest:
    return InvalidRequest(message, fields=[FieldError("url", "not_from_here", message)])
