"""What the application says of itself, made once for all tests of a process."""

from __future__ import annotations

import functools
from typing import Any

from backend.app import build_api
from backend.web.app import WebSettings


@functools.cache
def description() -> dict[str, Any]:
    """The OpenAPI description; made when it is first asked for, not when tests are collected."""
    return build_api(WebSettings(version="0")).openapi()
