"""Addresses of units: what a request may open, and the id that a url gives.

A request comes from whoever reaches the API; the command line comes from whoever owns the machine.
So a request names no file: not a simulated unit's flash, key or scenario, and no device of the
system that is not a serial port. It may name a host and port, since a unit behind TCP is just that.

An id is of `a-z`, `0-9` and `-`, never empty and at most 60 characters, so that it stands in a path
as it is. Usual urls have readable ones: `sim`, `sim-two`, `dev-ttyusb0`, `com3`,
`socket-127-0-0-1-8751`. Each of these belongs to one url alone; every other url's id ends in two
dashes and a part of its hash, which no readable id has.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
from urllib.parse import parse_qs

from backend.device.ports import is_character_device, kind_of
from backend.errors import FieldError, InvalidRequest
from backend.law.presets import live_scenarios

# Settings of a simulated unit that are paths.
FILE_SETTINGS = frozenset({"flash", "unlock_key"})
NO_SCENARIO = "none"
# Where systems have their terminals; opening another device can do things (a watchdog starts).
TERMINALS = ("/dev/tty", "/dev/pts/", "/dev/cu.", "/dev/rfcomm", "/dev/ircomm", "/dev/usb/tts/")


def check_url(url: str) -> None:
    """Raises InvalidRequest for a url that names a file or device of the server's machine."""
    kind = kind_of(url)
    settings = parse_qs(url.partition("?")[2], keep_blank_values=True)
    if kind == "simulated":
        for name in sorted(FILE_SETTINGS & settings.keys()):
            raise _refused(
                f"{name} names a file of this machine: only `spindle serve --device` may."
            )
        scenarios = [NO_SCENARIO, *(name for name, _ in live_scenarios())]
        for scenario in settings.get("scenario", []):
            if scenario not in scenarios:
                raise _refused(
                    f"There is no scenario {scenario!r}; there are {', '.join(scenarios)}. A file "
                    "of your own is for `spindle serve --device`."
                )
    elif kind == "serial":
        name = url.strip().partition("?")[0]
        if is_character_device(name) and not os.path.realpath(name).startswith(TERMINALS):
            raise _refused(
                f"{name} is no serial port; one of another kind is for `spindle serve --device`."
            )


def _refused(message: str) -> InvalidRequest:
    return InvalidRequest(message, fields=[FieldError("url", "not_from_here", message)])


# Longer than any readable id; the hash tells the rest.
NAME_CHARACTERS_MAX = 40
HASH_CHARACTERS = 16
# What a readable id stands for. A pattern whose url has capitals names them itself.
OWNERS = (
    (r"sim", r"sim"),
    (r"sim-([a-z0-9]+)", r"sim:\1"),
    (r"com(\d+)", r"COM\1"),
    (r"dev-tty(usb|acm|ama|s)(\d+)", None),
    (r"dev-([a-z0-9]+)", r"/dev/\1"),
    (r"socket-(\d+)-(\d+)-(\d+)-(\d+)-(\d+)", r"socket://\1.\2.\3.\4:\5"),
    (r"socket-([a-z][a-z0-9]*)-(\d+)", r"socket://\1:\2"),
)


def canonical(url: str, platform: str = sys.platform) -> str:
    """The url under which a port is known here: Windows has one COM3 however it is written."""
    url = url.strip()
    if platform == "win32" and re.match(r"(\\\\\.\\)?com\d+(\?|$)", url, re.IGNORECASE):
        name, mark, query = url.partition("?")
        return name.upper().removeprefix("\\\\.\\") + mark + query
    return url


def id_of(url: str) -> str:
    """The id of a canonical url."""
    name = re.sub(r"[^a-z0-9]+", "-", url.lower()).strip("-")
    if len(name) <= NAME_CHARACTERS_MAX and url == _owner(name):
        return name
    digest = hashlib.sha256(url.encode("utf-8", "surrogatepass")).hexdigest()
    short = name[:NAME_CHARACTERS_MAX].rstrip("-") or "unit"
    return f"{short}--{digest[:HASH_CHARACTERS]}"


def _owner(name: str) -> str | None:
    """The one url that this readable id belongs to."""
    for pattern, url in OWNERS:
        match = re.fullmatch(pattern, name, re.ASCII)
        if match is None:
            continue
        return f"/dev/tty{match[1].upper()}{match[2]}" if url is None else match.expand(url)
    return None
