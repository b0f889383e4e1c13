"""Ids of devices: from a url, the same in every process and after every start.

An id is of `a-z`, `0-9` and `-`, never empty and at most 60 characters, so that it stands in a path
as it is. Usual urls have readable ones: `sim`, `sim-two`, `dev-ttyusb0`, `com3`,
`socket-127-0-0-1-8751`. Each of these belongs to one url alone; every other url's id ends in two
dashes and a part of its hash, which no readable id has.
"""

from __future__ import annotations

import hashlib
import re
import sys

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
        found = re.fullmatch(pattern, name, re.ASCII)
        if found is None:
            continue
        return f"/dev/tty{found[1].upper()}{found[2]}" if url is None else found.expand(url)
    return None
