"""A maker on the bench: a key of its own, and tokens for what a unit asks."""

from __future__ import annotations

from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
from sim_device.firmware.python._native import lib

from backend.errors import TokenNeeded
from firmware_protocol import codec, parameters
from firmware_protocol._generated import (
    Access,
    AuthChallengeRequest,
    AuthChallengeResponse,
    AuthResponseRequest,
    CfgCommitRequest,
    CfgSetRequest,
    CfgValidateRequest,
    CommitFlags,
    Status,
)
from firmware_protocol.layout import Value
from firmware_protocol.spelling import member_of
from firmware_protocol.unlock_token import Challenge, Token, signed_message
from tests.fakes.bench_unit import BenchUnit, crc32


class Maker:
    """Signs with the key made of `seed`."""

    def __init__(self, seed: int = 1) -> None:
        self._key = Ed25519PrivateKey.from_private_bytes(bytes([seed]) * 32)
        self.public_key = self._key.public_key().public_bytes_raw()

    def sign(self, challenge: Challenge, expires_us: int | None = None) -> Token:
        """A token that ends with the challenge, or earlier or later."""
        ends_us = challenge.expires_us if expires_us is None else expires_us
        return Token(ends_us, self._key.sign(signed_message(challenge, ends_us)))


def provision(unit: BenchUnit, maker: Maker) -> None:
    """Give the unit the maker's key, and restart it."""
    assert lib.bench_provision_unlock_key(unit.board, maker.public_key) == 0
    unit.boot()


def staged(unit: BenchUnit, changes: dict[str, Value]) -> tuple[int, bytes]:
    """A valid transaction with the changes, and the image it stages."""
    transaction = unit.begin()
    image = unit.stage(transaction, changes)
    return transaction, image


def staged_anyhow(unit: BenchUnit, changes: dict[str, Value]) -> codec.Response:
    """SET and VALIDATE whatever they answer; the first response that is not OK, or the last."""
    transaction = unit.begin()
    for items in parameters.set_items(changes):
        response = unit.ask(CfgSetRequest(transaction, items))
        if response.status != Status.OK:
            return response
    return unit.ask(CfgValidateRequest(transaction))


def challenged(unit: BenchUnit, level: Access, image: bytes) -> Challenge:
    """What the unit wants signed for this image."""
    asked = unit.ask(AuthChallengeRequest(level))
    message = asked.message
    assert isinstance(message, AuthChallengeResponse), asked
    assert message.level == level
    return Challenge(message.uid, message.nonce, level, message.expires_us, image)


def write_with_the_makers_word(
    unit: BenchUnit, maker: Maker, changes: dict[str, Value], confirm_s: int = 0
) -> None:
    """A whole transaction under a FACTORY token. confirm_s: on trial for so long."""
    transaction, image = staged(unit, changes)
    token = maker.sign(challenged(unit, Access.FACTORY, image))
    assert respond(unit, transaction, token).status == Status.OK
    flags = CommitFlags.PROVISIONAL if confirm_s else 0
    response = unit.ask(CfgCommitRequest(transaction, crc32(image), flags, confirm_s))
    assert response.status == Status.OK, response


def respond(unit: BenchUnit, transaction: int, token: Token) -> codec.Response:
    """Show the token."""
    return unit.ask(AuthResponseRequest(transaction, token.expires_us, token.signature))


def commit(unit: BenchUnit, transaction: int, image: bytes) -> codec.Response:
    """Ask for the staged image to become active."""
    return unit.ask(CfgCommitRequest(transaction, crc32(image), 0, 0))


def challenge_of(error: TokenNeeded) -> Challenge:
    """What a host was told to have signed."""
    asked = error.challenge
    return Challenge(
        bytes.fromhex(str(asked["uid"])),
        bytes.fromhex(str(asked["nonce"])),
        member_of(Access, str(asked["level"])),
        int(asked["expires_us"]),
        bytes.fromhex(str(asked["image"])),
    )
