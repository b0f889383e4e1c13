"""Goal: every url has an id of its own that stands in a path, and the usual ones can be read.

Method: pairs of urls made to collide and urls of any characters; what is distinct stays distinct.
"""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.errors import NotFound
from backend.units.addresses import canonical, id_of
from backend.units.service import Devices
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

PATH_SAFE = re.compile(r"[a-z0-9]([a-z0-9-]{0,58}[a-z0-9])?")
# What people and attackers write: usual urls, their ids as urls, and anything between.
WORDS = "sim : /dev/ tty USB usb 0 1 - -- / . socket:// com COM 3 日本 localhost 127 ? none é a"
PIECES = st.sampled_from([*WORDS.split(), " ", "e\u0301"])
URLS = st.one_of(st.lists(PIECES, max_size=8).map("".join), st.text(max_size=500))


@given(URLS, URLS)
def test_two_urls_never_share_an_id(one: str, other: str) -> None:
    assert (id_of(one) == id_of(other)) == (one == other)


@given(URLS)
def test_an_id_stands_in_a_path_as_it_is(url: str) -> None:
    assert PATH_SAFE.fullmatch(id_of(url))


@given(URLS)
def test_an_id_as_a_url_is_another_unit(url: str) -> None:
    assert id_of(id_of(url)) != id_of(url) or id_of(url) == url == "sim"


@pytest.mark.parametrize(
    ("url", "expected"),
    [
        ("sim", "sim"),
        ("sim:two", "sim-two"),
        ("/dev/ttyUSB0", "dev-ttyusb0"),
        ("/dev/ttyACM12", "dev-ttyacm12"),
        ("/dev/rfcomm0", "dev-rfcomm0"),
        ("COM3", "com3"),
        ("socket://127.0.0.1:8751", "socket-127-0-0-1-8751"),
        ("socket://bench:1", "socket-bench-1"),
    ],
)
def test_a_usual_url_has_an_id_that_can_be_read(url: str, expected: str) -> None:
    assert id_of(url) == expected


def test_the_id_of_a_url_is_the_same_in_every_process() -> None:
    # By hand: printf '日本' | sha256sum
    assert id_of("日本") == "unit--cf2abf0c5be326cb"


@pytest.mark.parametrize(
    ("one", "other"),
    [("/dev/x y", "/dev/x/y"), ("/dev/ttyUSB0", "/dev/ttyusb0"), ("日本", "韓国")],
)
def test_urls_that_once_collided_are_two_units_and_each_is_removed_by_its_id(
    one: str, other: str
) -> None:
    def nobody(url: str) -> UnitOpener:
        opener = UnitOpener(FakeUnit(), url)
        opener.unplug()
        return opener

    devices = Devices(opener=nobody)
    try:
        ids = [devices.add(url, wait_s=5.0).id for url in (one, other)]
        assert len(set(ids)) == 2
        devices.remove(ids[0])
        assert [device.url for device in devices.list()] == [other]
        devices.remove(ids[1])
        with pytest.raises(NotFound):
            devices.get(ids[1])
    finally:
        devices.close()


def test_a_unit_is_found_by_its_url_its_number_and_its_key_as_well() -> None:
    devices = Devices(opener=lambda url: UnitOpener(FakeUnit(), url))
    serial_number = FakeUnit().uid.hex()
    try:
        devices.add("socket://bench:1")
        for name in ("socket-bench-1", "socket://bench:1", serial_number, f"ebl:{serial_number}"):
            assert devices.get(name).id == "socket-bench-1"
    finally:
        devices.close()


def test_windows_has_one_port_of_a_name_and_other_systems_two() -> None:
    assert canonical("com3?baud=115200", "win32") == canonical(r"\\.\COM3?baud=115200", "win32")
    assert canonical("com3", "linux") != canonical("COM3", "linux")
