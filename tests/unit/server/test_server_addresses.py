"""Goal: a phone is shown addresses at which it finds the server, and none at which it does not.

Method: servers that listen in every way, on a machine whose addresses are those of RFC 5737; and
the real machine, which must answer at each address it names for itself.
"""

from __future__ import annotations

import socket
from datetime import UTC, datetime
from ipaddress import ip_address
from pathlib import Path

import pytest

from backend.server import addresses
from backend.server.addresses import ServerAddresses, certificate_names, machine_addresses
from backend.server.certificate import ServerCertificate

HERE = "http://127.0.0.1:8750/"
OURS = [ip_address("192.0.2.7"), ip_address("198.51.100.4"), ip_address("2001:db8::7")]
CERTIFICATE = ServerCertificate(
    Path("c.pem"), Path("k.pem"), "7F:94:E5", datetime(2027, 1, 1, tzinfo=UTC), is_own=True
)


@pytest.fixture(autouse=True)
def machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(addresses, "machine_addresses", lambda: OURS)


def urls(server: ServerAddresses, called: str = HERE, port: int = 8750) -> list[str]:
    return [one.url for one in server.now(called, port).addresses]


def listening(
    host: str,
    *names: str,
    behind_proxy: bool = False,
    root_path: str = "",
    certificate: ServerCertificate | None = None,
) -> ServerAddresses:
    return ServerAddresses(host, names, behind_proxy, root_path, certificate)


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1"])
def test_who_listens_on_this_machine_alone_is_reached_by_no_phone(host: str) -> None:
    assert urls(listening(host, "bikes.example.org")) == []


def test_every_address_of_the_machine_reaches_who_listens_on_all_of_them() -> None:
    four = ["http://192.0.2.7:8750/", "http://198.51.100.4:8750/"]

    assert urls(listening("0.0.0.0")) == four
    # The way the socket is made, `::` takes no IPv4.
    assert urls(listening("::")) == ["http://[2001:db8::7]:8750/"]
    assert urls(listening("192.0.2.7")) == ["http://192.0.2.7:8750/"]


def test_a_name_that_somebody_gave_comes_before_the_numbers() -> None:
    first, *_ = urls(listening("0.0.0.0", "bikes.example.org", certificate=CERTIFICATE), port=443)

    assert first == "https://bikes.example.org/"


def test_what_the_phone_or_the_proxy_called_comes_first_and_once() -> None:
    by_name = "https://bikes.example.org/spindle/"
    behind = listening("127.0.0.1", "bikes.example.org", behind_proxy=True, root_path="/spindle")

    assert urls(behind, called=by_name) == [by_name]
    assert urls(behind, called="http://localhost:8750/spindle/") == []
    called = "http://198.51.100.4:8750/"
    assert urls(listening("0.0.0.0"), called) == [called, "http://192.0.2.7:8750/"]


@pytest.mark.parametrize("port", ["x" * 9000, "99999", "-1", ""])
def test_a_port_that_is_none_makes_no_address(port: str) -> None:
    found = urls(listening("192.0.2.7"), f"http://198.51.100.4:{port}/")

    assert [one for one in found if "198" in one] in ([], ["http://198.51.100.4/"])


def test_the_fingerprint_is_told_with_the_addresses() -> None:
    answer = listening("0.0.0.0", certificate=CERTIFICATE).now(HERE, 8750)

    assert answer.addresses[0].url == "https://192.0.2.7:8750/"
    assert answer.addresses[0].qr.startswith("data:image/svg+xml")
    assert answer.certificate is not None
    assert (answer.certificate.sha256, answer.certificate.is_own) == ("7F:94:E5", True)
    assert listening("0.0.0.0").now(HERE, 8750).certificate is None


def test_the_certificate_is_for_every_name_of_the_machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(socket, "gethostname", lambda: "bench")

    names = certificate_names(["bikes.example.org"])

    assert {"localhost", "127.0.0.1", "::1", "bench", "bench.local", "192.0.2.7"} <= set(names)
    assert "bikes.example.org" in names


def test_this_machine_listens_at_each_address_it_names() -> None:
    for one in machine_addresses():
        assert not one.is_loopback
        family = socket.AF_INET if one.version == 4 else socket.AF_INET6
        socket.create_server((str(one), 0), family=family).close()
