"""One spelling of plain JSON, so that the same content has the same hash."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any


def sha256_of(body: Mapping[str, Any]) -> str:
    """In hex, whatever the order of the names. body: plain JSON."""
    text = json.dumps(body, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()
