"""As whom an authenticator knows this server, and where it does at all."""

from __future__ import annotations

from dataclasses import dataclass
from ipaddress import ip_address

from backend.web.safety import host_name


@dataclass(frozen=True)
class RelyingParty:
    """A server at one of its addresses. id: the name that a passkey is for. origin: of its pages.

    The same server has another one by another name; there its passkeys are unknown.
    """

    id: str
    origin: str


def relying_party(host: str, encrypted: bool) -> RelyingParty | None:
    """The one of a request; None where no browser offers passkeys.

    host: of a request whose Host was checked. encrypted: whether it came by TLS. Level 3, 5.1.3 and
    5.1.4: the page is a secure context, and its host a name; an address is none.
    """
    name, host = host_name(host), host.lower()
    secure = encrypted or name == "localhost" or name.endswith(".localhost")
    # A dot at its end would make another name of it.
    if not secure or is_address(name) or host.partition(":")[0] != name:
        return None
    return RelyingParty(name, f"{'https' if encrypted else 'http'}://{host}")


def is_address(name: str) -> bool:
    """Whether a host is numbers; also where there is none."""
    try:
        ip_address(name)
    except ValueError:
        return name == ""
    return True
