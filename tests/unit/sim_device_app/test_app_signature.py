"""Goal: the unit's SHA-512 and Ed25519 are those of FIPS 180-4 and RFC 8032.

Compared with hashlib, with the vectors of RFC 8032 chapter 7.1, and with OpenSSL's signatures.
"""

import hashlib

import pytest
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
from sim_device.firmware.python._native import ffi, lib

# Secret key, message, signature: TEST 1, 2 and 3 of RFC 8032, 7.1.
RFC_8032 = [
    (
        "9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60",
        "",
        "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bac"
        "c61e39701cf9b46bd25bf5f0595bbe24655141438e7a100b",
    ),
    (
        "4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb",
        "72",
        "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e"
        "458f3613d0f11d8c387b2eaeb4302aeeb00d291612bb0c00",
    ),
    (
        "c5aa8df43f9f837bedb7442f31dcb7b166d38535076f094b85ce3a2e0b4458f7",
        "af82",
        "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f290"
        "ae67f760984dc6594a7c15e9716ed28dc027beceea1ec40a",
    ),
]


def digest(data: bytes, piece: int) -> bytes:
    hashed = ffi.new("sha512 *")
    result = ffi.new("uint8_t[64]")
    lib.sha512_init(hashed)
    for at in range(0, len(data), piece):
        part = data[at : at + piece]
        lib.sha512_update(hashed, part, len(part))
    lib.sha512_final(hashed, result)
    return bytes(result)


def is_valid(signature: bytes, public_key: bytes, message: bytes) -> bool:
    return bool(lib.signature_is_valid(signature, public_key, message, len(message)))


def public_key_of(secret: bytes) -> bytes:
    return Ed25519PrivateKey.from_private_bytes(secret).public_key().public_bytes_raw()


def test_hashes_are_those_of_the_standard_library_for_every_length_around_a_block() -> None:
    for length in range(0, 300):
        data = bytes((7 * index + length) % 256 for index in range(length))
        assert digest(data, 1 + length % 13) == hashlib.sha512(data).digest()


@pytest.mark.parametrize(("secret", "message", "signature"), RFC_8032)
def test_the_standard_s_signatures_are_valid(secret: str, message: str, signature: str) -> None:
    key = public_key_of(bytes.fromhex(secret))

    assert is_valid(bytes.fromhex(signature), key, bytes.fromhex(message))


def test_one_bit_wrong_anywhere_is_noticed() -> None:
    private = Ed25519PrivateKey.from_private_bytes(bytes(range(32)))
    key, message = private.public_key().public_bytes_raw(), bytes(range(105))
    signature = private.sign(message)
    assert is_valid(signature, key, message)

    for bit in range(0, 8 * 64, 5):
        assert not is_valid(flipped(signature, bit), key, message)
    for bit in range(0, 8 * 105, 11):
        assert not is_valid(signature, key, flipped(message, bit))
    for bit in range(0, 8 * 32, 3):
        assert not is_valid(signature, flipped(key, bit), message)


def test_a_signature_moved_by_the_group_s_order_is_no_second_signature() -> None:
    order = 2**252 + 27742317777372353535851937790883648493
    private = Ed25519PrivateKey.from_private_bytes(bytes(range(32)))
    key, message = private.public_key().public_bytes_raw(), b"once"
    signature = private.sign(message)

    moved = int.from_bytes(signature[32:], "little") + order

    assert not is_valid(signature[:32] + moved.to_bytes(32, "little"), key, message)


def flipped(data: bytes, bit: int) -> bytes:
    changed = bytearray(data)
    changed[bit // 8] ^= 1 << bit % 8
    return bytes(changed)
