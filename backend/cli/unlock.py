"""`spindle unlock ...`: the maker's tool. It needs the private key and no server."""

from __future__ import annotations

import json
import os
import sys
from argparse import Namespace
from pathlib import Path
from typing import Any

from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
from cryptography.hazmat.primitives.serialization import (
    Encoding,
    NoEncryption,
    PrivateFormat,
    load_pem_private_key,
)

from backend.cli.device import read_json
from backend.errors import InvalidRequest, RequestRefused
from firmware_protocol._generated import BAND_BY_NAME, PARAMETERS, Access
from firmware_protocol.parameters import unpack_image
from firmware_protocol.spelling import member_of, word_of
from firmware_protocol.unlock_token import Challenge, Token, signed_message

OWNER_ONLY = 0o600


def keygen(options: Namespace) -> int:
    """Makes a private key that only its owner can read, and the public one for units."""
    private = Ed25519PrivateKey.generate()
    pem = private.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    file: Path = options.file
    try:
        handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, OWNER_ONLY)
    except FileExistsError:
        raise RequestRefused(f"{file} exists; a key is never overwritten.") from None
    except OSError as error:
        raise RequestRefused(f"{file} cannot be written: {error.strerror}.") from None
    with os.fdopen(handle, "wb") as stream:
        stream.write(pem)
    public = file.with_name(f"{file.name}.pub")
    public.write_text(private.public_key().public_bytes_raw().hex() + "\n", encoding="ascii")
    print(public)
    return 0


def sign(options: Namespace) -> int:
    """Shows what would be allowed on standard error, and prints the token for it."""
    private = private_key(options.key)
    challenge = challenge_of(read_challenge(options.challenge))
    image = unpack_image(challenge.image)
    protected = [
        row
        for row in PARAMETERS
        if row.ratchet or row.access == Access.FACTORY or row.name in BAND_BY_NAME
    ]
    level = word_of(challenge.level.name)
    sys.stderr.write(f"unit {challenge.uid.hex()}, level {level}, allows:\n")
    for row in protected:
        sys.stderr.write(f"  {row.name:32} {image[row.name]} {row.unit}\n")
    signature = private.sign(signed_message(challenge, challenge.expires_us))
    print(Token(challenge.expires_us, signature).hex())
    return 0


def private_key(file: Path) -> Ed25519PrivateKey:
    """The key in a file of keygen. Raises InvalidRequest."""
    try:
        key = load_pem_private_key(file.read_bytes(), None)
    except OSError as error:
        raise InvalidRequest(f"{file} cannot be read: {error.strerror}.") from None
    except (ValueError, TypeError) as error:
        raise InvalidRequest(f"{file} is not a private key of keygen: {error}.") from None
    if not isinstance(key, Ed25519PrivateKey):
        raise InvalidRequest(f"{file} holds a key of another kind than Ed25519.")
    return key


def read_challenge(file: Path | None) -> Any:
    """The JSON of a challenge, or of the whole refusal that carries one."""
    try:
        read = read_json(file) if file is not None else json.load(sys.stdin)
    except ValueError as error:
        raise InvalidRequest(f"Standard input is not JSON: {error}.") from None
    return read.get("challenge", read) if isinstance(read, dict) else read


def challenge_of(read: Any) -> Challenge:
    """The challenge in its JSON form. Raises InvalidRequest naming what is wrong."""
    try:
        challenge = Challenge(
            uid=bytes.fromhex(read["uid"]),
            nonce=bytes.fromhex(read["nonce"]),
            level=member_of(Access, read["level"]),
            expires_us=int(read["expires_us"]),
            image=bytes.fromhex(read["image"]),
        )
        unpack_image(challenge.image)
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise InvalidRequest(f"This is not a challenge of a unit: {error!r}.") from None
    return challenge
