"""The short codes by which a bike changes hands: read out, typed in, or scanned."""

from __future__ import annotations

import secrets

# Crockford's base 32: no letter looks like a digit, and what is mistaken for one is read as that.
ALPHABET = "0123456789ABCDEFGHJKMNPQRSTVWXYZ"
MISTAKEN = str.maketrans("OIL", "011")
LENGTH = 8


def new_code() -> str:
    """40 random bits, `XXXX-XXXX`. With the wait between tries nobody guesses one in its week."""
    code = "".join(secrets.choice(ALPHABET) for _ in range(LENGTH))
    return f"{code[:4]}-{code[4:]}"


def plain_code(text: str) -> str:
    """A code as it is compared, however somebody typed it."""
    return "".join(text.split()).replace("-", "").upper().translate(MISTAKEN)
