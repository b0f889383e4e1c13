"""The certificate by which this server speaks TLS: its own, or one that somebody gives it.

Its own is signed by itself, since no authority signs for a workshop's network. What phones demand
of it: a name in subjectAltName, use for a server, an end (Apple: 825 days, and 398 of a public
one). It is no authority: a phone that took it for one would believe it about every other site.
"""

from __future__ import annotations

import os
import re
import ssl
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from ipaddress import ip_address
from pathlib import Path

from cryptography import x509
from cryptography.exceptions import UnsupportedAlgorithm
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from backend.errors import FieldError, InvalidRequest, StoreError

VALID = timedelta(days=397)
# A server is started more often than once a month; who runs one for longer sees the end on a page.
RENEWED_BEFORE = timedelta(days=30)
# The clock of a phone that was off for long may be behind.
BEGUN_BEFORE = timedelta(days=1)
# A laptop that goes between two networks keeps one certificate, and no phone is warned anew.
NAMES_MAX = 32
SIGNS_ONLY = x509.KeyUsage(
    digital_signature=True,
    content_commitment=False,
    key_encipherment=False,
    data_encipherment=False,
    key_agreement=False,
    key_cert_sign=False,
    crl_sign=False,
    encipher_only=False,
    decipher_only=False,
)
LABEL = r"[a-z0-9_]([a-z0-9_-]{0,61}[a-z0-9])?"
DNS_NAME = re.compile(rf"{LABEL}(\.{LABEL})*")


@dataclass(frozen=True)
class ServerCertificate:
    """Files in PEM, and what people compare.

    sha256: of the certificate, in pairs of hexadecimal digits, as browsers show it. is_own: made
    here, so that a browser warns of it.
    """

    certificate: Path
    key: Path
    sha256: str
    ends_at: datetime
    is_own: bool

    def context(self) -> ssl.SSLContext:
        """TLS as this server speaks it. Raises InvalidRequest for files that are no pair."""
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.minimum_version = ssl.TLSVersion.TLSv1_2
        try:
            # Nobody is there to be asked for the password of a key.
            context.load_cert_chain(self.certificate, self.key, password=_no_password)
        except (OSError, ValueError) as error:
            raise _at_fault(
                "tls_key",
                f"{self.key} is not the key of {self.certificate}, or needs a password: {error}.",
            ) from None
        return context


def own_certificate(folder: Path, names: Iterable[str], now: datetime) -> ServerCertificate:
    """The one in this folder; made where there is none, renewed with the same key where it ends
    soon or lacks one of the names.

    names: DNS names and addresses by which the server may be called. Raises InvalidRequest for a
    key that cannot be read, StoreError where the folder cannot be written.
    """
    certificate, key_file = folder / "certificate.pem", folder / "key.pem"
    needed = list(dict.fromkeys(name for name in map(str.lower, names) if _general_name(name)))
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        key = _read_key(key_file) if key_file.exists() else _new_key(key_file)
        found = _found(certificate, key)
        old = [] if found is None else _names_of(found)
        if found is None or not set(needed) <= set(old) or _ends_soon(found, now):
            found = _signed(key, list(dict.fromkeys([*needed, *old]))[:NAMES_MAX], now)
            _write(certificate, found.public_bytes(serialization.Encoding.PEM), 0o644)
    except OSError as error:
        raise StoreError(
            f"The server's certificate cannot be kept in {folder}: {error.strerror or error}."
        ) from None
    return _described(found, certificate, key_file, is_own=True)


def given_certificate(certificate: Path, key: Path, now: datetime) -> ServerCertificate:
    """One that somebody gives. Raises InvalidRequest for what a server could not use."""
    try:
        content = certificate.read_bytes()
    except OSError as error:
        message = f"{certificate} cannot be read: {error.strerror or error}."
        raise _at_fault("tls_certificate", message) from None
    try:
        read = x509.load_pem_x509_certificate(content)
    except ValueError:
        raise _at_fault("tls_certificate", f"{certificate} is no certificate in PEM.") from None
    if not key.is_file():
        raise _at_fault("tls_key", f"{key} is no file.")
    if read.not_valid_after_utc < now:
        message = f"{certificate} ended at {read.not_valid_after_utc:%Y-%m-%d %H:%M} UTC."
        raise _at_fault("tls_certificate", message)
    given = _described(read, certificate, key, is_own=False)
    given.context()
    return given


def _described(
    read: x509.Certificate, certificate: Path, key: Path, is_own: bool
) -> ServerCertificate:
    sha256 = read.fingerprint(hashes.SHA256()).hex(":").upper()
    return ServerCertificate(certificate, key, sha256, read.not_valid_after_utc, is_own)


def _at_fault(name: str, message: str) -> InvalidRequest:
    sentence = f"{name}: {message}"
    return InvalidRequest(sentence, fields=[FieldError(name, "unusable", sentence)])


def _no_password() -> str:
    raise ValueError("it is encrypted")


def _read_key(file: Path) -> ec.EllipticCurvePrivateKey:
    try:
        key = serialization.load_pem_private_key(file.read_bytes(), None)
    except (ValueError, TypeError, UnsupportedAlgorithm):
        key = None
    if not isinstance(key, ec.EllipticCurvePrivateKey):
        raise _at_fault(
            "tls",
            f"{file} is no key that this server made. Remove it to have another made; every phone "
            "is then warned once more.",
        )
    return key


def _new_key(file: Path) -> ec.EllipticCurvePrivateKey:
    key = ec.generate_private_key(ec.SECP256R1())
    content = key.private_bytes(
        serialization.Encoding.PEM,
        serialization.PrivateFormat.PKCS8,
        serialization.NoEncryption(),
    )
    _write(file, content, 0o600)
    return key


def _write(file: Path, content: bytes, mode: int) -> None:
    """Write a file in full or not at all, and never with more rights than it is to have."""
    fresh = file.with_name(f"{file.name}.new")
    # Left by a process that was killed.
    fresh.unlink(missing_ok=True)
    descriptor = os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode)
    with os.fdopen(descriptor, "wb") as opened:
        opened.write(content)
        opened.flush()
        os.fsync(opened.fileno())
    fresh.replace(file)


def _found(file: Path, key: ec.EllipticCurvePrivateKey) -> x509.Certificate | None:
    """The certificate there is, if it is of this key."""
    with suppress(FileNotFoundError, ValueError):
        read = x509.load_pem_x509_certificate(file.read_bytes())
        if read.public_key() == key.public_key():
            return read
    return None


def _ends_soon(read: x509.Certificate, now: datetime) -> bool:
    # One from the future was made while the clock was wrong.
    return read.not_valid_after_utc - now < RENEWED_BEFORE or read.not_valid_before_utc > now


def _names_of(read: x509.Certificate) -> list[str]:
    try:
        names = read.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except x509.ExtensionNotFound:
        return []
    return [str(one.value).lower() for one in names]


def _general_name(name: str) -> x509.GeneralName | None:
    """An address or a DNS name; None for what is neither, like a machine called "Anna’s"."""
    with suppress(ValueError):
        return x509.IPAddress(ip_address(name))
    return x509.DNSName(name) if DNS_NAME.fullmatch(name) else None


def _signed(key: ec.EllipticCurvePrivateKey, names: list[str], now: datetime) -> x509.Certificate:
    """A certificate of a server, by the key for itself."""
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "Spindle")])
    public = key.public_key()
    begins = now.astimezone(UTC).replace(microsecond=0) - BEGUN_BEFORE
    alternatives = x509.SubjectAlternativeName(
        [one for one in map(_general_name, names) if one is not None]
    )
    return (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(public)
        .serial_number(x509.random_serial_number())
        .not_valid_before(begins)
        .not_valid_after(begins + VALID)
        .add_extension(alternatives, critical=False)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(SIGNS_ONLY, critical=True)
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), critical=False)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(public), critical=False)
        .sign(key, hashes.SHA256())
    )
