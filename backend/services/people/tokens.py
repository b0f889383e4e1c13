"""Random secrets, and what is kept of them. They are long enough that a plain hash will do."""

from __future__ import annotations

import hashlib
import re
import secrets

# A key as a program sends it: `sp_`, what it is found by, the secret.
KEY_FORM = re.compile(r"sp_([0-9a-f]{8})_([0-9a-f]{64})")


def new_token() -> str:
    """256 bits that go into a cookie, a ticket or a link."""
    return secrets.token_urlsafe(32)


def kept(secret: str) -> str:
    """What is kept of a secret: SHA-256 in hex."""
    return hashlib.sha256(secret.encode()).hexdigest()


def same(kept_one: str, secret: str) -> bool:
    """Whether a secret is the kept one, in the same time whatever it is."""
    return secrets.compare_digest(kept_one, kept(secret))


def new_key() -> tuple[str, str, str]:
    """A key as it is shown once, its prefix, and its secret."""
    prefix, secret = secrets.token_hex(4), secrets.token_hex(32)
    return f"sp_{prefix}_{secret}", prefix, secret
