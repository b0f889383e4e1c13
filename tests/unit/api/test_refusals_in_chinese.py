"""Goal: whatever code a refusal carries, and whatever a unit's state, a Chinese reader is told in
Chinese what it means and why it is so.
"""

from __future__ import annotations

import importlib
import inspect
import json
import pkgutil
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import backend
from backend.device.ebl.session import reasons
from backend.device.ebl.session.reasons import port_reason
from backend.device.link import port_errors
from backend.device.states import code_of
from backend.errors import SpindleError
from backend.web.problem import CODE_OF_STATUS
from firmware_protocol._generated import Status

ROOT = Path(__file__).resolve().parents[3]
CODES = json.loads((ROOT / "frontend/messages/zh/codes.json").read_text(encoding="utf-8"))


def tree(of: type[SpindleError]) -> Iterator[type[SpindleError]]:
    yield of
    for kind in of.__subclasses__():
        yield from tree(kind)


# Every package that can refuse, whatever other tests have imported; migrations run elsewhere.
for module in pkgutil.walk_packages(backend.__path__, "backend."):
    if "__main__" not in module.name and "migrations" not in module.name:
        importlib.import_module(module.name)
DEFAULTS = {kind.default_code for kind in tree(SpindleError)}
STATUSES = {status.name.lower() for status in Status} - {"ok", "pending"}


VERDICTS = {"truncated", "damaged", "part_unreadable", "duplicate", "filled", "ride_is_live"}


@pytest.mark.parametrize(
    "code", sorted(VERDICTS | DEFAULTS | STATUSES | set(CODE_OF_STATUS.values()))
)
def test_a_code_has_chinese_words(code: str) -> None:
    assert CODES["refusal"].get(code)


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
