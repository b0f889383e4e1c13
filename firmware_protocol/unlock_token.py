"""What a maker signs, so that one unit takes one configuration once (SPEC.md, 2.7).

A token is the time it ends, by the unit's clock, and an Ed25519 signature over `signed_message`.
"""

import hashlib
import struct
from dataclasses import dataclass

from firmware_protocol._generated import Access

SIGNATURE_LENGTH = 64
TOKEN_LENGTH = 8 + SIGNATURE_LENGTH
PREFIX = b"EBL1"


@dataclass(frozen=True)
class Challenge:
    """What a unit wants signed. image: the whole configuration that is to become active."""

    uid: bytes
    nonce: bytes
    level: Access
    expires_us: int
    image: bytes


@dataclass(frozen=True)
class Token:
    """The answer: the microsecond of the unit's clock at which it ends, and the signature."""

    expires_us: int
    signature: bytes

    @classmethod
    def from_hex(cls, text: str) -> "Token":
        """The token in its written form. Raises ValueError if it is none."""
        data = bytes.fromhex(text)
        if len(data) != TOKEN_LENGTH:
            raise ValueError(f"a token has {TOKEN_LENGTH} bytes, this one {len(data)}")
        return cls(struct.unpack_from("<Q", data)[0], data[8:])

    def hex(self) -> str:
        """The written form."""
        return (struct.pack("<Q", self.expires_us) + self.signature).hex()


def signed_message(challenge: Challenge, expires_us: int) -> bytes:
    """The bytes under the signature: prefix, uid, nonce, level, expiry, SHA-512 of the image."""
    return (
        PREFIX
        + challenge.uid
        + challenge.nonce
        + struct.pack("<BQ", challenge.level, expires_us)
        + hashlib.sha512(challenge.image).digest()
    )
