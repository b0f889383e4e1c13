"""Goal: whatever a unit's state, a Chinese reader is told in Chinese why it is so."""

from __future__ import annotations

import inspect
import json
import re
from pathlib import Path

import pytest

from backend.device.ebl.session import reasons
from backend.device.ebl.session.reasons import port_reason
from backend.device.link import port_errors
from backend.device.states import code_of

ROOT = Path(__file__).resolve().parents[3]
CODES = json.loads((ROOT / "frontend/messages/zh/codes.json").read_text(encoding="utf-8"))
OURS = set(re.findall(r'"([a-z_]+)"\s*,?\s*\)', inspect.getsource(reasons)))
PORTS = set(re.findall(r'code="([a-z_]+)"', inspect.getsource(port_errors)))


@pytest.mark.parametrize("code", sorted(OURS | PORTS | {"link"}))
def test_a_reason_has_chinese_words(code: str) -> None:
    assert CODES["reason"].get(code)


def test_every_sentence_carries_its_code_and_the_port_s_own() -> None:
    assert {"ready", "silent", "restarted", "nobody", "read_only"} <= OURS
    absent = port_reason(port_errors.cannot_open("COM3", FileNotFoundError(2, "gone")))
    assert (code_of(absent), absent[:4]) == ("port_absent", "COM3")
    assert code_of("a sentence of somebody else") == ""
