"""Goal: the maker's tool makes keys nobody else can read and tokens for what it shows."""

from __future__ import annotations

import json
import stat
from pathlib import Path

import pytest
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey

from backend.cli import main
from firmware_protocol._generated import Access
from firmware_protocol.parameters import default_config, pack_image
from firmware_protocol.unlock_token import Challenge, Token, signed_message

CHALLENGE = Challenge(b"u" * 12, b"n" * 16, Access.DEALER, 61_000_000, pack_image(default_config()))


def written(folder: Path, **changed: object) -> Path:
    file = folder / "challenge.json"
    challenge = {
        "uid": CHALLENGE.uid.hex(),
        "nonce": CHALLENGE.nonce.hex(),
        "level": "dealer",
        "ttl_s": 60,
        "expires_us": CHALLENGE.expires_us,
        "image": CHALLENGE.image.hex(),
    }
    file.write_text(json.dumps(challenge | changed))
    return file


def test_a_private_key_is_its_owner_s_alone_and_is_never_overwritten(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    key = tmp_path / "maker.pem"
    assert main(["unlock", "keygen", str(key)]) == 0
    made = key.read_bytes()

    assert stat.S_IMODE(key.stat().st_mode) == 0o600
    assert len(bytes.fromhex((tmp_path / "maker.pem.pub").read_text())) == 32
    assert main(["unlock", "keygen", str(key)]) == 1
    assert key.read_bytes() == made
    assert "never overwritten" in capsys.readouterr().err


@pytest.mark.parametrize("level", ["dealer", "DEALER"], ids=["of today", "of version 0.2"])
def test_a_token_is_signed_for_exactly_the_challenge_and_says_what_it_allows(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], level: str
) -> None:
    key = tmp_path / "maker.pem"
    main(["unlock", "keygen", str(key)])
    capsys.readouterr()

    assert main(["unlock", "sign", str(key), str(written(tmp_path, level=level))]) == 0

    said = capsys.readouterr()
    token = Token.from_hex(said.out.strip())
    public = Ed25519PublicKey.from_public_bytes(
        bytes.fromhex((tmp_path / "maker.pem.pub").read_text())
    )
    public.verify(token.signature, signed_message(CHALLENGE, token.expires_us))
    assert token.expires_us == CHALLENGE.expires_us
    assert "level dealer, allows" in said.err
    assert "assist_cutoff_kmh" in said.err
    assert "25.0 km/h" in said.err


@pytest.mark.parametrize(
    "wrong",
    [{"image": "00"}, {"level": "king"}, {"level": 1}, {"uid": "no hex"}, {"expires_us": "soon"}],
)
def test_what_is_no_challenge_is_not_signed(tmp_path: Path, wrong: dict[str, object]) -> None:
    key = tmp_path / "maker.pem"
    main(["unlock", "keygen", str(key)])

    assert main(["unlock", "sign", str(key), str(written(tmp_path, **wrong))]) == 2


def test_what_is_no_key_does_not_sign(tmp_path: Path) -> None:
    key = tmp_path / "maker.pem"
    key.write_text("not a key")

    assert main(["unlock", "sign", str(key), str(written(tmp_path))]) == 2
    assert main(["unlock", "sign", str(tmp_path / "none.pem"), str(written(tmp_path))]) == 2
