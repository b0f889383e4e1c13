"""Goal: the server's own certificate is one that phones can take, stays as long as it can, and is
never left half made.

Method: Python's ssl, which is OpenSSL, shakes hands with it in memory and checks each name as a
browser does; the openssl command reads it where there is one. A kill is an exception at the Nth
step that reaches the disk.
"""

from __future__ import annotations

import os
import shutil
import ssl
import subprocess
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
from cryptography import x509
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import (
    BestAvailableEncryption,
    Encoding,
    PrivateFormat,
    PublicFormat,
)
from cryptography.x509.oid import ExtendedKeyUsageOID, ExtensionOID

from backend.errors import InvalidRequest, StoreError
from backend.server.certificate import ServerCertificate, given_certificate, own_certificate

NAMES = ["localhost", "127.0.0.1", "::1", "bikes.example.org", "192.0.2.7", "Workshop"]
NOW = datetime.now(UTC)


def own(folder: Path, *more: str, at: datetime = NOW) -> ServerCertificate:
    return own_certificate(folder / "tls", [*NAMES, *more], at)


def read(made: ServerCertificate) -> x509.Certificate:
    return x509.load_pem_x509_certificate(made.certificate.read_bytes())


def public_key(made: ServerCertificate) -> bytes:
    return read(made).public_key().public_bytes(Encoding.DER, PublicFormat.SubjectPublicKeyInfo)


def shake_hands(made: ServerCertificate, name: str) -> None:
    """Client and server in memory; the client trusts this certificate alone. Raises SSLError."""
    to_client, to_server = ssl.MemoryBIO(), ssl.MemoryBIO()
    trusting = ssl.create_default_context(cafile=made.certificate)
    client = trusting.wrap_bio(to_client, to_server, server_hostname=name)
    server = made.context().wrap_bio(to_server, to_client, server_side=True)
    left = [client, server]
    while left:
        for side in list(left):
            try:
                side.do_handshake()
                left.remove(side)
            except ssl.SSLWantReadError:
                continue


@pytest.mark.parametrize(
    "name", ["localhost", "127.0.0.1", "::1", "bikes.example.org", "192.0.2.7", "workshop"]
)
def test_who_trusts_it_reaches_the_server_by_each_of_its_names(tmp_path: Path, name: str) -> None:
    shake_hands(own(tmp_path), name)


@pytest.mark.parametrize("name", ["other.example.org", "192.0.2.8", "example.org"])
def test_it_is_for_no_other_name(tmp_path: Path, name: str) -> None:
    with pytest.raises(ssl.SSLCertVerificationError, match="mismatch"):
        shake_hands(own(tmp_path), name)


def test_it_is_what_apple_and_the_browsers_demand_of_a_server_and_no_authority(
    tmp_path: Path,
) -> None:
    made = read(own(tmp_path))
    find = made.extensions.get_extension_for_oid

    # https://support.apple.com/103769; 398 days are the most of a public one.
    assert made.not_valid_after_utc - made.not_valid_before_utc <= timedelta(days=397)
    assert list(find(ExtensionOID.EXTENDED_KEY_USAGE).value) == [ExtendedKeyUsageOID.SERVER_AUTH]
    assert made.signature_hash_algorithm is not None
    assert made.signature_hash_algorithm.name == "sha256"
    constraints = find(ExtensionOID.BASIC_CONSTRAINTS)
    assert constraints.critical
    assert constraints.value == x509.BasicConstraints(ca=False, path_length=None)
    assert made.not_valid_before_utc < NOW - timedelta(hours=23)


@pytest.mark.skipif(shutil.which("openssl") is None, reason="needs the openssl command")
def test_openssl_reads_the_same(tmp_path: Path) -> None:
    made = own(tmp_path)
    words = ["openssl", "x509", "-noout", "-text", "-fingerprint", "-sha256", "-in"]
    said = subprocess.run(
        [*words, str(made.certificate)], capture_output=True, text=True, check=True
    ).stdout

    assert f"Fingerprint={made.sha256}\n" in said
    assert "ASN1 OID: prime256v1" in said
    assert "TLS Web Server Authentication" in said
    assert "CA:FALSE" in said
    for name in ("DNS:localhost", "DNS:workshop", "IP Address:127.0.0.1", "IP Address:192.0.2.7"):
        assert name in said


def test_nobody_else_may_read_the_key(tmp_path: Path) -> None:
    made = own(tmp_path)

    assert made.key.stat().st_mode & 0o777 == 0o600
    assert made.key.parent.stat().st_mode & 0o777 == 0o700
    assert sorted(one.name for one in made.key.parent.iterdir()) == ["certificate.pem", "key.pem"]


def test_every_start_shows_the_same_certificate(tmp_path: Path) -> None:
    first = own(tmp_path)

    # A network that is away is no reason to warn every phone.
    again = own_certificate(tmp_path / "tls", NAMES[:3], NOW + timedelta(days=300))

    assert again == first


def test_it_is_renewed_in_its_last_month_with_the_key_it_had(tmp_path: Path) -> None:
    first = own(tmp_path)

    kept = own(tmp_path, at=first.ends_at - timedelta(days=31))
    renewed_at = first.ends_at - timedelta(days=29)
    renewed = own(tmp_path, at=renewed_at)

    assert kept == first
    assert renewed.sha256 != first.sha256
    assert public_key(renewed) == public_key(first)
    assert renewed.ends_at > renewed_at + timedelta(days=390)


def test_one_made_while_the_clock_was_ahead_is_renewed(tmp_path: Path) -> None:
    ahead = own(tmp_path, at=NOW + timedelta(days=900))

    assert own(tmp_path).ends_at < ahead.ends_at
    shake_hands(own(tmp_path), "localhost")


def test_a_new_address_renews_it_and_a_way_back_does_not(tmp_path: Path) -> None:
    first = own(tmp_path)

    elsewhere = own_certificate(tmp_path / "tls", [*NAMES[:3], "198.51.100.4"], NOW)
    back = own(tmp_path)

    assert public_key(elsewhere) == public_key(first)
    assert back == elsewhere
    shake_hands(back, "198.51.100.4")
    shake_hands(back, "192.0.2.7")


def test_a_machine_with_a_name_that_is_none_has_the_others(tmp_path: Path) -> None:
    made = own(tmp_path, "Anna’s Mac", "a b", "", "-x", "x" * 64)

    names = read(made).extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    assert [str(one.value) for one in names] == [name.lower() for name in NAMES]


class Killed(BaseException):
    """The process ends here."""


@pytest.mark.parametrize("step", ["fsync", "open"])
@pytest.mark.parametrize("nth", [1, 2])
def test_a_kill_at_any_step_leaves_a_folder_from_which_the_next_start_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: str, nth: int
) -> None:
    real = getattr(os, step)
    calls = 0

    def until_killed(*given: Any) -> Any:
        nonlocal calls
        done = real(*given)
        calls += 1
        if calls == nth:
            raise Killed
        return done

    with monkeypatch.context() as patching:
        patching.setattr(os, step, until_killed)
        with pytest.raises(Killed):
            own(tmp_path)
    key = tmp_path / "tls" / "key.pem"
    before = key.read_bytes() if key.exists() else None

    made = own(tmp_path)

    assert before in (None, key.read_bytes())
    assert sorted(one.name for one in key.parent.iterdir()) == ["certificate.pem", "key.pem"]
    shake_hands(made, "localhost")


def test_a_certificate_of_another_key_is_replaced(tmp_path: Path) -> None:
    mine, other = own(tmp_path / "a"), own(tmp_path / "b")
    mine.certificate.write_bytes(other.certificate.read_bytes())

    assert own(tmp_path / "a").sha256 not in (mine.sha256, other.sha256)
    shake_hands(own(tmp_path / "a"), "localhost")


def test_a_key_that_is_none_is_named_and_left_alone(tmp_path: Path) -> None:
    made = own(tmp_path)
    made.key.write_text("not a key")

    with pytest.raises(InvalidRequest, match=r"tls: .*key\.pem is no key") as refusal:
        own(tmp_path)
    assert [field.field for field in refusal.value.fields] == ["tls"]
    assert made.key.read_text() == "not a key"


def test_a_folder_that_cannot_be_is_told(tmp_path: Path) -> None:
    (tmp_path / "tls").write_text("in the way")

    with pytest.raises(StoreError, match="cannot be kept"):
        own(tmp_path)


def test_one_that_is_given_is_used_as_it_is(tmp_path: Path) -> None:
    made = own(tmp_path)

    given = given_certificate(made.certificate, made.key, NOW)

    assert (given.sha256, given.ends_at, given.is_own) == (made.sha256, made.ends_at, False)
    shake_hands(given, "localhost")


def test_what_is_wrong_with_files_that_are_given_names_its_setting(tmp_path: Path) -> None:
    good, other = own(tmp_path / "a"), own(tmp_path / "b")
    locked, nothing = tmp_path / "locked.pem", tmp_path / "nothing.pem"
    locked.write_bytes(
        ec.generate_private_key(ec.SECP256R1()).private_bytes(
            Encoding.PEM, PrivateFormat.PKCS8, BestAvailableEncryption(b"secret")
        )
    )

    for setting, certificate, key, at in (
        ("tls_certificate", nothing, good.key, NOW),
        ("tls_certificate", good.key, good.key, NOW),
        ("tls_certificate", good.certificate, good.key, good.ends_at + timedelta(days=1)),
        ("tls_key", good.certificate, nothing, NOW),
        ("tls_key", good.certificate, other.key, NOW),
        ("tls_key", good.certificate, good.certificate, NOW),
        ("tls_key", good.certificate, locked, NOW),
    ):
        with pytest.raises(InvalidRequest) as refusal:
            given_certificate(certificate, key, at)
        assert [field.field for field in refusal.value.fields] == [setting]
        assert setting in refusal.value.message
