"""Goal: from refusal to raised limit with nothing but the commands of docs/safety.md."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fakes.command import spindle
from tests.fakes.server import ServerHere, SpindleServer


@pytest.fixture
def shop(tmp_path: Path) -> Iterator[SpindleServer]:
    """A server with one standing unit that carries the maker's key."""
    assert spindle(None, "unlock", "keygen", tmp_path / "maker.pem").returncode == 0
    unit = f"sim:shop?clock=virtual&scenario=none&unlock_key={tmp_path / 'maker.pem.pub'}"
    with ServerHere(tmp_path / "data", [unit]) as server:
        server.advance(server.ready_device(), 0.1)
        yield server


def test_a_lowered_limit_goes_up_with_a_token_and_not_without(
    shop: SpindleServer, tmp_path: Path
) -> None:
    device = shop.ready_device()
    lowered = spindle(shop, "device", "set", "assist_cutoff_kmh=20")
    assert lowered.returncode == 0, lowered.stderr

    refused = spindle(shop, "device", "set", "assist_cutoff_kmh=25")
    assert refused.returncode == 1
    assert "assist_cutoff_kmh should go up from 20.0 to 25.0 km/h" in refused.stderr
    challenge = tmp_path / "challenge.json"
    challenge.write_text(refused.stdout)
    signed = spindle(None, "unlock", "sign", tmp_path / "maker.pem", challenge)
    token = signed.stdout.strip()
    shop.until_writable(device)
    raised = spindle(shop, "device", "set", "assist_cutoff_kmh=25", "--token", token)
    shop.until_writable(device)
    again = spindle(shop, "device", "set", "assist_cutoff_kmh=20")
    replayed = spindle(shop, "device", "set", "assist_cutoff_kmh=25", "--token", token)

    assert raised.returncode == 0, raised.stderr
    assert again.returncode == 0, again.stderr
    assert replayed.returncode == 1
    assert "challenge this token answers is over" in replayed.stderr


def test_a_typed_view_takes_the_token_as_well(shop: SpindleServer, tmp_path: Path) -> None:
    device = shop.ready_device()
    path = f"/devices/{device}/parts/limits"
    before = shop.get(path)
    shop.ask("PUT", path, json=before | {"motor_torque_nm_max": 1.0})

    refused = shop.client.put(path, json=before)
    challenge = tmp_path / "challenge.json"
    challenge.write_text(json.dumps(refused.json()["challenge"]))
    signed = spindle(None, "unlock", "sign", tmp_path / "maker.pem", challenge)
    shop.until_writable(device)
    raised = shop.client.put(path, json=before, params={"token": signed.stdout.strip()})
    no_token = shop.client.put(path, json=before, params={"token": "open sesame"})

    assert (refused.status_code, refused.json()["code"]) == (403, "token_needed")
    assert refused.json()["challenge"]["level"] == "dealer"
    assert set(refused.json()["challenge"]) == {
        "uid", "nonce", "level", "ttl_s", "expires_us", "image", "image_sha512",
    }  # fmt: skip
    assert raised.status_code == 200, raised.text
    assert shop.get(path) == before
    assert no_token.status_code == 422
