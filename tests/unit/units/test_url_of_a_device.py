"""Goal: a request opens units, never files or other devices of the server's machine."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from backend.errors import InvalidRequest
from backend.units.addresses import check_url


@pytest.mark.parametrize(
    "url",
    [
        "sim:x?scenario=/etc/passwd",
        "sim:x?scenario=my.toml",
        "sim:x?scenario=commute&scenario=..%2Fmine.toml",
        "sim:x?scenario=",
        "sim:x?flash=/tmp/flash",
        "sim:x?%66lash=/tmp/flash",
        "sim:x?unlock_key=/etc/passwd",
        "/dev/null",
        "/dev/urandom",
        " /dev/null?baud=9600",
    ],
)
def test_what_names_a_file_or_another_device_is_refused_for_its_url(url: str) -> None:
    with pytest.raises(InvalidRequest) as caught:
        check_url(url)

    assert [fault.field for fault in caught.value.fields] == ["url"]


@pytest.mark.parametrize(
    "url",
    [
        "sim",
        "sim:x?scenario=commute",
        "sim:x?scenario=none",
        "socket://bench:1",
        "/dev/ttyUSB77",
        # No file has so long a name; that it is not there is said when it is opened.
        "x" * 400,
    ],
)
def test_a_unit_is_none_of_these(url: str) -> None:
    check_url(url)


def test_a_link_to_a_pseudo_terminal_is_a_serial_port(tmp_path: Path) -> None:
    master, slave = os.openpty()
    (tmp_path / "bike").symlink_to(os.ttyname(slave))

    check_url(str(tmp_path / "bike"))

    os.close(master)
    os.close(slave)


def test_a_link_to_another_device_is_none(tmp_path: Path) -> None:
    (tmp_path / "bike").symlink_to("/dev/zero")

    with pytest.raises(InvalidRequest):
        check_url(str(tmp_path / "bike"))
