"""By which addresses this server can be reached from the network. Nothing is sent to find out."""

from __future__ import annotations

import socket
import struct
import sys
from collections.abc import Iterable, Sequence
from contextlib import closing, suppress
from datetime import datetime
from ipaddress import IPv4Address, IPv6Address, ip_address
from pathlib import Path
from urllib.parse import urlsplit

from backend.core.described import described
from backend.core.hosts import bracketed, is_of_this_machine
from backend.core.qr import qr_of
from backend.server.certificate import ServerCertificate

# Of RFC 5737 and RFC 3849, for documents: no machine has them, and a datagram socket that is
# connected sends nothing. The system only chooses by which of its own addresses it would.
NOBODY = ((socket.AF_INET, "192.0.2.1"), (socket.AF_INET6, "2001:db8::1"))
# Linux: the IPv4 address of an interface (netdevice(7)), and the list of those of IPv6.
SIOCGIFADDR = 0x8915
IPV6_INTERFACES = Path("/proc/net/if_inet6")
ADDRESSES_MAX = 8
DEFAULT_PORTS = {"http": 80, "https": 443}

Machine = IPv4Address | IPv6Address


@described
class Address:
    url: str
    """With a slash at its end."""
    qr: str
    """It as a QR code: a `data:` address of an SVG."""


@described
class CertificateSeen:
    sha256: str
    """Of the certificate, in pairs of hexadecimal digits, as browsers show it."""
    ends_at: datetime
    is_own: bool
    """Whether this server made it, so that a browser warns of it."""


@described
class Addresses:
    addresses: tuple[Address, ...]
    """The one that was called first; none while only this machine reaches the server."""
    certificate: CertificateSeen | None
    """Null where this server does not speak TLS itself."""


class ServerAddresses:
    """Where people find this server. For any thread.

    host: where it listens. names: by which browsers may call it. behind_proxy: nobody calls it by
    a name and its own port. root_path: below which a proxy has it. certificate: None without TLS.
    """

    def __init__(
        self,
        host: str,
        names: Sequence[str],
        behind_proxy: bool,
        root_path: str,
        certificate: ServerCertificate | None,
    ) -> None:
        self.certificate = certificate
        self._host = host
        self._names = () if behind_proxy else tuple(names)
        self._root_path = root_path

    def now(self, called: str, port: int) -> Addresses:
        """The addresses there are at this moment.

        called: the address of the request that asks. port: where this server listens.
        """
        scheme = "http" if self.certificate is None else "https"
        hosts = [] if is_of_this_machine(self._host) else [*self._names, *self._listened_on()]
        urls = [url_of(scheme, host, port, self._root_path) for host in hosts]
        different = list(dict.fromkeys([*self._as_called(called), *urls]))[:ADDRESSES_MAX]
        seen = None
        if (mine := self.certificate) is not None:
            seen = CertificateSeen(mine.sha256, mine.ends_at, mine.is_own)
        return Addresses(tuple(Address(url, qr_of(url)) for url in different), seen)

    def _as_called(self, called: str) -> list[str]:
        """The address of a request, if another machine could use it; what stands behind its host
        was checked by nobody."""
        parts = urlsplit(called)
        with suppress(ValueError):
            host, port = parts.hostname or "localhost", parts.port or DEFAULT_PORTS[parts.scheme]
            if not is_of_this_machine(host):
                return [url_of(parts.scheme, host, port, self._root_path)]
        return []

    def _listened_on(self) -> list[str]:
        """Of the machine's addresses those that this server takes, or the only one it does."""
        if self._host not in ("0.0.0.0", "::"):
            return [self._host]
        version = 4 if self._host == "0.0.0.0" else 6
        return [str(one) for one in machine_addresses() if one.version == version]


def url_of(scheme: str, host: str, port: int, root_path: str = "") -> str:
    """The address of a page, its host a name or an address."""
    at = "" if port == DEFAULT_PORTS[scheme] else f":{port}"
    return f"{scheme}://{bracketed(host)}{at}{root_path}/"


def certificate_names(allowed_hosts: Iterable[str]) -> list[str]:
    """What the server's own certificate is for: this machine by each of its names and addresses."""
    machine = socket.gethostname()
    named = [machine] if "." in machine else [machine, f"{machine}.local"]
    addresses = [str(one) for one in machine_addresses()]
    return ["localhost", "127.0.0.1", "::1", *allowed_hosts, *named, *addresses]


def machine_addresses() -> list[Machine]:
    """The machine's own addresses, but for loopback and link-local ones; the one by which it
    reaches other networks first."""
    found = [*_towards_other_networks()]
    # A workshop's network need not lead anywhere.
    found += _of_interfaces() if sys.platform == "linux" else _of_the_name()
    usable = [one for one in found if not (one.is_loopback or one.is_link_local)]
    return list(dict.fromkeys(usable))


def _towards_other_networks() -> Iterable[Machine]:
    for family, nobody in NOBODY:
        with suppress(OSError), closing(socket.socket(family, socket.SOCK_DGRAM)) as unsent:
            unsent.connect((nobody, 9))
            yield ip_address(unsent.getsockname()[0])


def _of_the_name() -> list[Machine]:
    """What the system says of its own name; on Linux it might ask a name server."""
    with suppress(OSError, UnicodeError):
        answers = socket.getaddrinfo(socket.gethostname(), None)
        return [ip_address(str(answer[4][0]).partition("%")[0]) for answer in answers]
    return []


def _of_interfaces() -> list[Machine]:
    found: list[Machine] = []
    if sys.platform == "linux":
        from fcntl import ioctl

        with closing(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) as unsent:
            for _, name in socket.if_nameindex():
                with suppress(OSError):
                    asked = struct.pack("40s", name.encode())
                    found.append(IPv4Address(ioctl(unsent, SIOCGIFADDR, asked)[20:24]))
        with suppress(OSError):
            lines = IPV6_INTERFACES.read_text(encoding="ascii").splitlines()
            found += [IPv6Address(bytes.fromhex(line.split()[0])) for line in lines]
    return found
