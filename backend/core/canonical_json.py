"""One spelling of plain JSON, so that the same content has the same hash."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any


def canonical_text(body: Mapping[str, Any]) -> str:
    """ASCII, whatever the order of the names. body: plain JSON."""
    return json.dumps(body, sort_keys=True, separators=(",", ":"))


def sha256_of(body: Mapping[str, Any]) -> str:
    """Of its canonical text, in hex. body: plain JSON."""
    return hashlib.sha256(canonical_text(body).encode()).hexdigest()
