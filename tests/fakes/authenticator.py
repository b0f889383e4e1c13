"""An authenticator and its browser, as far as a server sees them (W3C Web Authentication, level 3):
what a phone's screen lock or a key on a ring would answer.
"""

from __future__ import annotations

import hashlib
import json
import secrets
import struct
from base64 import urlsafe_b64encode
from dataclasses import dataclass, field, replace
from typing import Any

import cbor2
from cryptography.hazmat.primitives.asymmetric.ec import (
    ECDSA,
    SECP256R1,
    EllipticCurvePrivateKey,
    generate_private_key,
)
from cryptography.hazmat.primitives.hashes import SHA256

PRESENT, VERIFIED, CREDENTIAL = 0x01, 0x04, 0x40
ES256 = -7


def base64url(data: bytes) -> str:
    return urlsafe_b64encode(data).rstrip(b"=").decode()


def new_private_key() -> EllipticCurvePrivateKey:
    return generate_private_key(SECP256R1())


@dataclass
class Authenticator:
    """With one credential. origin: of the page that its browser shows. count: how often it was
    used; None for one that does not count. flags: what it says of its person."""

    origin: str
    count: int | None = 0
    flags: int = PRESENT | VERIFIED
    user_handle: str = ""
    key: EllipticCurvePrivateKey = field(default_factory=new_private_key)
    credential_id: bytes = field(default_factory=lambda: secrets.token_bytes(32))

    def copy(self) -> Authenticator:
        """Somebody has what is in it."""
        return replace(self)

    def make(self, challenge: dict[str, Any], **instead: str) -> dict[str, str]:
        """The answer to what `begin_passkey` gave. instead: of its members."""
        asked = challenge | instead
        assert ES256 in asked["algorithms"]
        self.user_handle = asked["user_handle"]
        public = self.key.public_key().public_numbers()
        cose = {1: 2, 3: ES256, -1: 1, -2: public.x.to_bytes(32), -3: public.y.to_bytes(32)}
        credential = bytes(16) + struct.pack(">H", len(self.credential_id)) + self.credential_id
        data = self._data(asked["rp_id"], CREDENTIAL) + credential + cbor2.dumps(cose)
        made = {"fmt": "none", "attStmt": {}, "authData": data}
        return {
            "client_data": base64url(self._client_data("webauthn.create", asked["challenge"])),
            "attestation": base64url(cbor2.dumps(made)),
        }

    def prove(self, challenge: dict[str, Any], **instead: str) -> dict[str, str]:
        """The answer to what `begin_passkey_sign_in` gave. instead: of its members."""
        asked = challenge | instead
        client_data = self._client_data("webauthn.get", asked["challenge"])
        data = self._data(asked["rp_id"])
        signed = data + hashlib.sha256(client_data).digest()
        return {
            "credential_id": base64url(self.credential_id),
            "client_data": base64url(client_data),
            "authenticator_data": base64url(data),
            "signature": base64url(self.key.sign(signed, ECDSA(SHA256()))),
            "user_handle": self.user_handle,
        }

    def _client_data(self, kind: str, challenge: str) -> bytes:
        members = {"type": kind, "challenge": challenge, "origin": self.origin}
        return json.dumps(members | {"crossOrigin": False}).encode()

    def _data(self, rp_id: str, more: int = 0) -> bytes:
        """The data that is signed: whose page, what of the person, how often."""
        if self.count is not None:
            self.count += 1
        count = struct.pack(">I", self.count or 0)
        return hashlib.sha256(rp_id.encode()).digest() + bytes([self.flags | more]) + count
