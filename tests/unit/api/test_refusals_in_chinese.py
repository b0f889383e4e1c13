"""Goal: whatever code a refusal carries, a Chinese reader is told in Chinese what it means."""

from __future__ import annotations

import importlib
import json
import pkgutil
from collections.abc import Iterator
from pathlib import Path

import pytest

import backend
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
