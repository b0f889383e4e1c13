"""Names and addresses of machines."""

from __future__ import annotations

from ipaddress import ip_address


def is_of_this_machine(host: str) -> bool:
    """Whether a name or an address means the machine that it is used on."""
    if host.rstrip(".").lower() == "localhost":
        return True
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return False


def bracketed(host: str) -> str:
    """A host as an address of a page has it (RFC 3986, section 3.2.2)."""
    return f"[{host}]" if ":" in host else host
