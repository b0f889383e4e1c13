"""What a ride is called that came as a file."""

from __future__ import annotations


def ride_name(file_name: str) -> str:
    """`activities/Morning.fit.gz` -> `Morning`."""
    last = file_name.replace("\\", "/").rsplit("/", 1)[-1] or file_name
    packed = last[:-3] if last.lower().endswith(".gz") else last
    return packed.rsplit(".", 1)[0] or packed
